#pragma once
#include "osculate/model/model.hpp"

namespace osculate::model {

/// Factors of the bodies' tangent, of a symmetric matrix; an unsymmetric one has twice as many of
/// both.
struct FactorEstimate {
  double entries = 0;
  double operations = 0;  ///< additions and multiplications of one factorisation
};

/// These, before there is a matrix: bodies are cut in half again and again, as an ordering by
/// nested dissection does it, and the dense fronts are counted that the nodes on the cuts make with
/// those on the cuts around them. Costs about as much memory as the mesh and far less time than an
/// ordering of the matrix.
///
/// Formula    entries: sum of s (s + 1) / 2 + s b over the cuts; operations: of
///            s (s^2 / 3 + s b + b^2); s unknowns on it, b on those around it
/// Limits     cuts are planes; contact couples no bodies. Entries are right to about a factor of
///            1.5, operations to its square
/// Tested by  tests/unit/model/test_factor_estimate.cpp
template <int Dim>
[[nodiscard]] FactorEstimate factor_estimate(const BasicModel<Dim>& model);

/// What the direct solver needs for so many of them [bytes], about.
[[nodiscard]] double factor_bytes(double entries);

/// Whether steps need such factors.
[[nodiscard]] bool factors_tangents(const std::vector<Step>& steps);

}  // namespace osculate::model

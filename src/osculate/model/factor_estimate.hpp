#pragma once
#include "osculate/model/model.hpp"

namespace osculate::model {

/// Entries of the factors of the bodies' tangent, before there is a matrix: bodies are cut in half
/// again and again, as an ordering by nested dissection does it, and the dense fronts are counted
/// that the nodes on the cuts make with those on the cuts around them. Costs about as much memory
/// as the mesh and far less time than an ordering of the matrix.
///
/// Of a symmetric matrix; an unsymmetric one has twice as many.
///
/// Formula    sum of s (s + 1) / 2 + s b over the cuts: s unknowns on it, b on those around it
/// Limits     cuts are planes; contact couples no bodies. Right to about a factor of 1.5
/// Tested by  tests/unit/model/test_factor_estimate.cpp
template <int Dim>
[[nodiscard]] double factor_entries(const BasicModel<Dim>& model);

/// What the direct solver needs for so many of them [bytes], about.
[[nodiscard]] double factor_bytes(double entries);

/// Whether steps need such factors.
[[nodiscard]] bool factors_tangents(const std::vector<Step>& steps);

}  // namespace osculate::model

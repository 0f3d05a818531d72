#pragma once
#include <string>
#include <vector>

#include "osculate/model/diagnosis.hpp"

namespace osculate::model {

/// Whether the loads of the last evaluation pull a body off what it touches: their resultant on its
/// nodes points where closed contacts would push it.
///
/// Tested by  tests/system/test_diagnosis.py
template <int Dim>
[[nodiscard]] bool pulled_away(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                               const std::vector<Index>& body);

/// Points with multipliers in the normal direction whose gap is prescribed: none of the unknowns it
/// depends on is free, so that no traction can close it.
///
/// Tested by  tests/system/test_diagnosis.py
struct HeldPoints {
  std::string pair;
  int count = 0;
  Index node = -1;  ///< of the first one
};
template <int Dim>
[[nodiscard]] std::vector<HeldPoints> held_points(const BasicSystem<Dim>& system,
                                                  const BasicModel<Dim>& model,
                                                  const BasicState<Dim>& state);

/// The deepest overlap of a state in which nothing has moved yet.
struct InitialOverlap {
  std::string pair;
  Index node = -1;              ///< of the slave
  double depth = 0, share = 0;  ///< length; of the height of the cells behind it
};

/// Share 0: something has moved, or overlaps do not act at once.
///
/// Tested by  tests/system/test_diagnosis.py
template <int Dim>
[[nodiscard]] InitialOverlap initial_overlap(const BasicModel<Dim>& model,
                                             const BasicState<Dim>& state);

}  // namespace osculate::model

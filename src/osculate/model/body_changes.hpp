#pragma once
#include <span>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::model {

/// Whether bodies or equations change when a step begins.
template <int Dim>
[[nodiscard]] bool bodies_change(const BasicModel<Dim>& original, std::size_t step);

/// Materials, cells and equations of `now`, a copy of `original`, as they are in a step: all
/// changes up to there are made.
///
/// Requires   materials that take the place of others remember the same (CellMemory stays as it is)
/// Tested by  tests/unit/deck/test_body_changes.cpp, verification/body_changes
template <int Dim>
void change_bodies(const BasicModel<Dim>& original, std::size_t step, BasicModel<Dim>& now);

/// The state in which a step begins: cells that come back without strain are free of it where their
/// nodes are, and nothing has happened to their points yet. Cells that are not there keep what
/// their points remember.
template <int Dim>
[[nodiscard]] BasicState<Dim> begin_bodies(const BasicModel<Dim>& original, std::size_t step,
                                           BasicState<Dim> state);

/// What the points of cells remember that are not evaluated, or that no law writes: of cells that
/// are not there all of it, of others the displacements at which they are free of strain.
template <int Dim>
void keep_memory(const BasicModel<Dim>& now, std::span<const double> committed,
                 std::span<double> next);

}  // namespace osculate::model

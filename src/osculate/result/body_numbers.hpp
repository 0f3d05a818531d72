#pragma once
// Shared by the sources of this layer; not for users.
#include <string>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::result {

/// Bodies as users see them counted: the connected parts of the cells with a section in the order
/// of their first cell (as in the names of the pairs of `contact: all`), then the rigid bodies.
///
/// Tested by  tests/unit/result/test_field_files.cpp
struct BodyNumbers {
  /// Of deformable bodies the section of the first cell, with the body's number behind it where
  /// several bodies begin in one section.
  std::vector<std::string> names;
  std::size_t deformable = 0;               ///< so many of them
  std::vector<std::vector<Index>> of_cell;  ///< by block and cell; -1: a cell without section

  [[nodiscard]] Index of(const mesh::CellRef& ref) const {
    return of_cell[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)];
  }
};

template <int Dim>
[[nodiscard]] BodyNumbers body_numbers(const model::BasicModel<Dim>& model);

}  // namespace osculate::result

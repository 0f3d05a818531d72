#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "osculate/cell/cell_type.hpp"

namespace osculate::io::inp {

/// Where an element lives: in the plane (strain, stress or axisymmetric), as a solid, as a shell,
/// membrane or surface in space, as a beam, truss or rigid line.
enum class Family : std::uint8_t { plane, solid, surface, line };

/// An element of Abaqus or CalculiX as a mesh sees it.
struct ElementType {
  std::string_view name;      ///< without the letters of its variants: C3D20 stands for C3D20RH
  std::string_view variants;  ///< letters that may follow, in any choice
  cell::CellType cell;
  Family family;
};

/// The bricks that B32R becomes, a variant of C3D20 that no deck has itself.
inline constexpr std::string_view beam_brick = "C3D20RB";

/// By its name in capitals; null: no cell for it.
///
/// Source     Abaqus Elements Guide, "Node ordering and face numbering"; CalculiX CrunchiX User's
///            Manual, "Element types"
/// Tested by  tests/unit/io/test_inp_elements.cpp
[[nodiscard]] const ElementType* find_element_type(std::string_view name);
/// All there are: `C3D4, C3D6, ...`.
[[nodiscard]] std::string element_type_names();

/// For each node of the element in the deck's order its place in the cell.
[[nodiscard]] std::span<const std::int8_t> cell_places(const ElementType& type);

/// A side of an element.
struct Side {
  /// `whole`: the element itself, a surface; `reversed` seen from below.
  enum class Kind : std::uint8_t { none, face, edge, whole, reversed } kind = Kind::none;
  int local = 0;  ///< number of the face or edge in the cell
};

/// The side that a deck calls S1, ..., E1, ..., SPOS, SNEG (in capitals); Kind::none: the element
/// has no such side. Of solids S1... are faces, of plane elements edges. Of shells SNEG is S1, SPOS
/// is S2, and S3... are edges as in CalculiX, E1... as in Abaqus.
[[nodiscard]] Side find_side(const ElementType& type, std::string_view label);
/// What a side (S1, SPOS, E1, ...) or, `of_load`, the side that a load P, P1, ... acts on is called
/// on a solid. Of shells and beams (`family` surface and line) this is the solid that they are
/// expanded to, and their loads push along the normal, along the first and the second axis; of
/// plane elements beside solids likewise, whose edges S1, S2, ... are S3, S4, ... there.
[[nodiscard]] std::string solid_side(std::string_view label, bool of_load, Family family);
/// What may be written: `S1 to S6`.
[[nodiscard]] std::string side_names(const ElementType& type);

}  // namespace osculate::io::inp

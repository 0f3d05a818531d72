#pragma once
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "osculate/io/inp/members.hpp"

namespace osculate::io::inp {

/// How shells, beams and trusses fill space, and plane elements beside solids. Lengths of beams are
/// along their first and second axis.
struct ThinSection {
  enum class Shape : std::uint8_t { plate, rectangle, ellipse, pipe, box } shape = Shape::plate;
  /// What holds the two sides of plane elements: a plate normal to z, or a sector of 2 degrees
  /// about the y axis.
  enum class Plane : std::uint8_t { none, strain, stress, axisymmetric } plane = Plane::none;
  bool hinged = false;                ///< of trusses: ends turn freely
  std::array<double, 2> thickness{};  ///< 0: of the nodes
  /// Of a pipe its wall; of a box those at the first axis forth, the second forth, the first back,
  /// the second back.
  std::array<double, 4> wall{};
  std::vector<double> layers{};    ///< of a plate of several: their thickness, bottom first
  std::array<double, 2> offset{};  ///< of the reference from the middle, in thicknesses
  Vec3 axis = -Vec3::UnitZ();      ///< beams: along the first axis
  Place at{};                      ///< of the card, of plane elements

  [[nodiscard]] bool is_hollow() const { return shape == Shape::pipe || shape == Shape::box; }
  [[nodiscard]] bool is_plane() const { return plane != Plane::none; }
};

/// The whole of an axisymmetric model over the sector of 2 degrees that stands for it beside
/// solids.
inline constexpr double sectors_of_ring = 180;

/// What a deck says of elements that are expanded to solids.
struct ThinCards {
  bool sectors = false;  ///< axisymmetric elements are
  bool finite = false;   ///< has_finite_step
  std::vector<ThinSection> sections;
  std::vector<int> section_of;                       ///< by element; -1: not expanded
  std::map<Index, std::array<double, 2>> thickness;  ///< by node
  std::map<std::pair<Index, Index>, Vec3> normals;   ///< by element and node
  std::map<Index, std::array<bool, 3>> rotations;    ///< by node: held, turned or with a moment
  std::map<Index, std::array<bool, 6>> held;         ///< by node: directions of `*BOUNDARY`
  std::set<Index> held_along_axes;                   ///< nodes of `*BOUNDARY` with a `*TRANSFORM`
  std::set<Index> joined;  ///< nodes that `*EQUATION`, `*MPC` or `*RIGID BODY` name
};

/// Whether a card is an `*MPC` with PLANE, STRAIGHT or BEAM.
[[nodiscard]] bool moves_far(const Deck& deck, const Card& mpc);
/// Whether a material is one of any strain, such as a hyperelastic one.
[[nodiscard]] bool has_finite_law(const Deck& deck);
/// Whether a step has NLGEOM, or a material is one of any strain: displacements and rotations are
/// of any size. An `*MPC` that moves far gives the first step NLGEOM, as in CalculiX, unless it
/// says NLGEOM=NO.
[[nodiscard]] bool has_finite_step(const Deck& deck);
/// Whether a section card is one of a shell of layers.
[[nodiscard]] bool is_layered(const Card& card);
/// Whether a section card is one whose elements are expanded: shells, beams with
/// rectangular and elliptic sections, pipes and boxes.
[[nodiscard]] bool is_thin_section(const Card& card);

/// From `*SHELL SECTION`, `*BEAM SECTION`, `*BEAM GENERAL SECTION`, `*SOLID SECTION` of trusses,
/// `*NODAL THICKNESS`,
/// `*NORMAL`, `*BOUNDARY`, rotations in `*CLOAD`, and nodes that `*TRANSFORM`, `*EQUATION`,
/// `*MPC` and `*RIGID BODY` name. Plane elements with a section are expanded
/// where solids, shells, beams or trusses have one, too; beside axisymmetric ones their thickness
/// is a 180th, as in CalculiX.
///
/// Errors     core::InputError: a thickness that is not positive, elements that are neither
/// Tested by  tests/unit/io/test_inp_expand.cpp, test_inp_plane.cpp
[[nodiscard]] ThinCards thin_cards(const Deck& deck, const RawMesh& raw, const Numbering& numbering,
                                   Members& members);

}  // namespace osculate::io::inp

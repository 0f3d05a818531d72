#pragma once
#include <map>
#include <utility>
#include <vector>

#include "osculate/io/inp/hollow_section.hpp"
#include "osculate/io/inp/thin_groups.hpp"

namespace osculate::io::inp {

/// The nodes that one node becomes. Shells: bottom, middle, top. Beams: the corners of the section,
/// seen against the tangent counterclockwise from the first axis back and the second one forth;
/// then the middles between them. -1: not needed.
using Fiber = std::array<Index, 8>;

[[nodiscard]] inline bool is_plate(const ThinGroup& group) {
  return group.section->shape == ThinSection::Shape::plate;
}

/// In the deck's order of C3D6, 8, 15 and 20: bottom, top, their middles, those between them.
[[nodiscard]] std::vector<Index> plate_nodes(const std::vector<Fiber>& at, std::size_t corners);
/// In the deck's order of C3D8 and C3D20; `at` has the ends, then the middle.
[[nodiscard]] std::vector<Index> beam_nodes(const std::vector<Fiber>& at);

/// The nodes that those of shells and beams become, with all between them: levels of layers, points
/// of hollow sections.
///
/// Tested by  tests/unit/io/test_inp_expand.cpp, test_inp_hollow.cpp
class Fibers {
 public:
  using Shares = std::vector<std::pair<Index, double>>;  ///< nodes, and what each counts for

  explicit Fibers(mesh::Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] const Vec3& at(Index node) const {
    return mesh_.nodes[static_cast<std::size_t>(node)];
  }
  Index add_node(const Vec3& place);
  Fiber fiber_of(Index node, const ThinGroup& group);
  /// A node moves as others do by their shares.
  void follow(Index node, const Shares& shares);

  // ---- plane elements
  /// All nodes of a fiber move with the deck's node in its plane, those of sectors turned with
  /// them. Its sides do not part in plane strain, and alike to both sides in plane stress.
  ///
  /// Formula    strain  u_i = (u_x, u_y, 0) ; stress  u_i = (u_x, u_y, w_i) , w_bottom = -w_top ,
  ///            w_middle = 0 ; axisymmetric  u_i = (cos a_i u_x, u_y, sin a_i u_x) , a = -1, 0, 1
  ///            deg
  /// Source     answers of ccx 2.20
  /// Tested by  tests/unit/io/test_inp_plane.cpp
  void follow_plane(Index node, const ThinGroup& group, const Fiber& fiber);
  /// The deck's node does not leave its plane, also where solids have it: then no step may
  /// prescribe anything else.
  void keep_in_plane(Index node, const Fiber& fiber, bool in_solids);

  // ---- layers
  /// Bottom, middle and top of each layer; without middles where there is no corner. Of the fiber
  /// that stands for all its bottom and top.
  Fiber add_levels(Index node, const ThinGroup& group);
  /// The part of its shell that each level has: of a corner what acts on it is shared out as the
  /// traction of a side that is constant over it.
  ///
  /// Formula    u = sum h_i / h (2 u_middle - (u_bottom + u_top) / 2) , without middles
  ///            sum h_i / h (u_bottom + u_top) / 2
  [[nodiscard]] Shares shares_of_levels(const ThinGroup& group, const Fiber& fiber) const;
  /// The normal stays straight.
  void straighten_levels(const ThinGroup& group, const Fiber& fiber, int direction);
  [[nodiscard]] std::vector<std::vector<Index>> layer_nodes(const ThinSection& section,
                                                            const std::vector<Fiber>& at,
                                                            std::size_t corners) const;

  // ---- hollow sections
  const HollowSection& hollow(const ThinSection& section);
  /// The points at an end of a beam move with the eight of its fiber.
  void tie_points(const ThinGroup& group, const Fiber& fiber);
  /// Those in its middle with all twenty nodes of the brick that the beam would be.
  ///
  /// Formula    u = sum_corners N4 u_middle + 1/2 sum_ends (sum N8 u - sum_corners N4 u)
  void tie_middle(const HollowSection& section, const std::vector<Fiber>& at);
  const std::vector<double>& shares(const ThinGroup& group);
  const std::vector<double>& axis_shares(const ThinGroup& group);
  /// Nodes of a hollow section with what they count for, of those that count.
  [[nodiscard]] Shares shares_of(const Fiber& fiber, const std::vector<double>& share) const;
  /// The cells of a hollow beam between its fibers.
  [[nodiscard]] std::vector<std::vector<Index>> hollow_nodes(const HollowSection& section,
                                                             const std::vector<Fiber>& at) const;

 protected:
  mesh::Mesh& mesh_;
  /// Levels of layers, points of hollow sections, by the first of a fiber.
  std::map<Index, std::vector<Index>> points_;

 private:
  /// What a fiber counts for a place of its section.
  static void add_shares(const Fiber& fiber, const Vec2& place, double factor, bool corners,
                         Shares& to);
  /// Nodes of a hollow section; in the middle of a beam those of corners alone.
  void add_points(const ThinGroup& group, const Fiber& fiber);

  std::map<const ThinSection*, HollowSection> hollow_;
  std::int64_t next_ = 0;  ///< number of the next node
};

}  // namespace osculate::io::inp

#include "osculate/io/inp/expand.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/io/inp/hollow_section.hpp"
#include "osculate/io/inp/thin_groups.hpp"

namespace osculate::io::inp {
namespace {

using Shape = ThinSection::Shape;

/// The nodes that one node becomes. Shells: bottom, middle, top. Beams: the corners of the section,
/// seen against the tangent counterclockwise from the first axis back and the second one forth;
/// then the middles between them. -1: not needed.
using Fiber = std::array<Index, 8>;

bool is_plate(const ThinGroup& group) { return group.section->shape == Shape::plate; }

/// What moves with the deck's node in the mean: bottom and top, corners of a section.
std::vector<Index> corners_of(const ThinGroup& group, const Fiber& fiber) {
  if (is_plate(group)) return {fiber[0], fiber[2]};
  return {fiber[0], fiber[1], fiber[2], fiber[3]};
}

class Expander {
 public:
  Expander(const Deck& deck, const ThinCards& cards, Numbering& numbering, mesh::Mesh& mesh)
      : deck_(deck), cards_(cards), numbering_(numbering), mesh_(mesh) {}

  Expansion expand() {
    take_cells();
    const auto all = thin_groups(deck_, cards_, numbering_, mesh_);
    std::map<std::pair<Index, int>, Fiber> fibers;  // by element and its node
    for (const auto& [node, groups] : all) {
      std::vector<Fiber> here;
      for (const ThinGroup& group : groups) {
        here.push_back(fiber_of(node, group));
        for (const auto& member : group.members) fibers[member] = here.back();
      }
      join(node, groups, here);
    }
    for (std::size_t e = 0; e < cards_.section_of.size(); ++e)
      if (cards_.section_of[e] >= 0) add_cell(static_cast<Index>(e), fibers);
    return std::move(out_);
  }

 private:
  const Vec3& at(Index node) const { return mesh_.nodes[static_cast<std::size_t>(node)]; }

  /// Nodes of the elements that are expanded, whose cells leave the mesh.
  void take_cells() {
    std::vector<mesh::Block> old = std::move(mesh_.blocks);
    mesh_.blocks.clear();
    for (const mesh::Block& block : old) mesh_.blocks.push_back({block.type, {}});
    for (std::size_t e = 0; e < numbering_.elements.size(); ++e) {
      Element& element = numbering_.elements[e];
      const auto b = static_cast<std::size_t>(element.cell.block);
      const Index* const nodes = old[b].cell(element.cell.cell);
      const std::span<const Index> all(nodes,
                                       static_cast<std::size_t>(cell::info(old[b].type).nodes));
      if (!old[b].numbers.empty())
        numbers_.push_back(old[b].numbers[static_cast<std::size_t>(element.cell.cell)]);
      if (cards_.section_of[e] >= 0)
        element.deck_nodes.assign(all.begin(), all.end());
      else
        element.cell = append(element.cell.block, static_cast<Index>(e), all);
    }
    for (const std::int64_t number : numbers_) next_cell_ = std::max(next_cell_, number + 1);
  }

  mesh::CellRef append(Index block, Index element, std::span<const Index> nodes) {
    mesh::Block& to = mesh_.blocks[static_cast<std::size_t>(block)];
    to.connectivity.insert(to.connectivity.end(), nodes.begin(), nodes.end());
    if (!numbers_.empty()) to.numbers.push_back(numbers_[static_cast<std::size_t>(element)]);
    return {block, to.size() - 1};
  }

  Index add_node(const Vec3& place) {
    if (!mesh_.numbers.empty()) {
      if (next_ == 0) next_ = *std::max_element(mesh_.numbers.begin(), mesh_.numbers.end()) + 1;
      mesh_.numbers.push_back(next_++);
    }
    mesh_.nodes.push_back(place);
    return static_cast<Index>(mesh_.nodes.size()) - 1;
  }

  Fiber fiber_of(Index node, const ThinGroup& group) {
    Fiber fiber;
    fiber.fill(-1);
    const Vec3 origin = at(node);
    const std::array<double, 2>& offset = group.section->offset;
    if (is_plate(group)) {
      for (const std::size_t k : {0, 1, 2})
        if (k != 1 || group.has_middle)
          fiber[k] = add_node(origin + group.thickness[0] *
                                           (0.5 * (static_cast<double>(k) - 1) - offset[0]) *
                                           group.normal);
      return fiber;
    }
    const Vec3 first = group.normal.cross(group.tangent);
    for (std::size_t k = 0; k < (group.has_middle ? 8U : 4U); ++k) {
      const bool round = k < 4 && group.section->shape == Shape::ellipse;
      const double half = round ? 0.5 / std::numbers::sqrt2 : 0.5;
      fiber[k] = add_node(origin + group.thickness[0] * (half * around[k][0] - offset[0]) * first +
                          group.thickness[1] * (half * around[k][1] - offset[1]) * group.normal);
    }
    if (group.section->is_hollow()) add_points(group, fiber);
    return fiber;
  }

  // ---- hollow sections --------------------------------------------------------------------------

  using Shares = std::vector<std::pair<Index, double>>;  ///< nodes, and what each counts for

  /// What a fiber counts for a place of its section.
  static void add_shares(const Fiber& fiber, const Vec2& place, double factor, bool corners,
                         Shares& to) {
    const auto four = shares_of_corners(place);
    const auto eight = shares_around(place);
    for (std::size_t k = 0; k < (corners ? 4U : 8U); ++k)
      to.emplace_back(fiber[k], factor * (corners ? four[k] : eight[k]));
  }
  void follow(Index node, const Shares& shares) {
    for (int k = 0; k < 3; ++k) {
      mesh::Relation& relation = mesh_.relations.emplace_back();
      relation.terms.push_back({node, k, 1});
      for (const auto& [other, share] : shares)
        if (std::abs(share) > 1e-14) relation.terms.push_back({other, k, -share});
    }
  }

  /// Nodes of a hollow section; in the middle of a beam those of corners alone.
  void add_points(const ThinGroup& group, const Fiber& fiber) {
    const HollowSection& section = hollow(*group.section);
    std::vector<Index>& points = points_[fiber[0]];
    for (std::size_t p = 0; p < section.points.size(); ++p) {
      Index& node = points.emplace_back(-1);
      if (!group.has_middle && !section.is_corner[p]) continue;
      Shares shares;
      add_shares(fiber, section.points[p], 1, !group.has_middle, shares);
      Vec3 place = Vec3::Zero();
      for (const auto& [other, share] : shares) place += share * at(other);
      node = add_node(place);
    }
  }
  const HollowSection& hollow(const ThinSection& section) {
    const auto [found, is_new] = hollow_.try_emplace(&section);
    if (is_new) found->second = hollow_section(section);
    return found->second;
  }
  /// The points at an end of a beam move with the eight of its fiber.
  void tie_points(const ThinGroup& group, const Fiber& fiber) {
    const HollowSection& section = hollow(*group.section);
    for (std::size_t p = 0; p < section.points.size(); ++p) {
      Shares shares;
      add_shares(fiber, section.points[p], 1, false, shares);
      follow(points_.at(fiber[0])[p], shares);
    }
  }
  /// Those in its middle with all twenty nodes of the brick that the beam would be.
  ///
  /// Formula    u = sum_corners N4 u_middle + 1/2 sum_ends (sum N8 u - sum_corners N4 u)
  void tie_middle(const HollowSection& section, const std::vector<Fiber>& at) {
    const std::vector<Index>& points = points_.at(at[2][0]);
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (points[p] < 0) continue;
      Shares shares;
      const Vec2& place = section.points[p];
      add_shares(at[2], place, 1, true, shares);
      for (const std::size_t end : {0, 1}) {
        add_shares(at[end], place, 0.5, false, shares);
        add_shares(at[end], place, -0.5, true, shares);
      }
      follow(points[p], shares);
    }
  }
  const std::vector<double>& shares(const ThinGroup& group) {
    const HollowSection& section = hollow(*group.section);
    return group.has_middle ? section.share : section.corner_share;
  }
  const std::vector<double>& axis_shares(const ThinGroup& group) {
    const HollowSection& section = hollow(*group.section);
    return group.has_middle ? section.axis_share : section.axis_corner_share;
  }
  /// Nodes of a hollow section with what they count for, of those that count.
  Shares shares_of(const Fiber& fiber, const std::vector<double>& share) const {
    Shares shares;
    for (std::size_t p = 0; p < share.size(); ++p)
      if (share[p] != 0) shares.emplace_back(points_.at(fiber[0])[p], share[p]);
    return shares;
  }
  /// The cells of a hollow beam between its fibers.
  std::vector<std::vector<Index>> hollow_nodes(const HollowSection& section,
                                               const std::vector<Fiber>& at) const {
    std::vector<std::vector<Index>> all;
    for (const auto& cell : section.cells) {
      std::vector<Fiber> own(3);
      for (std::size_t end = 0; end < 3; ++end)
        for (std::size_t k = 0; k < 8; ++k) own[end][k] = points_.at(at[end][0])[cell[k]];
      all.push_back(beam_nodes(own));
    }
    return all;
  }

  // ---- what the deck's node does ----------------------------------------------------------------

  void join(Index node, const std::vector<ThinGroup>& groups, const std::vector<Fiber>& fibers) {
    Knot knot{node, {node}};
    std::size_t stiff = 0, last = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].section->hinged) {
        add_mean(node, corners_of(groups[g], fibers[g]));
        add_spin(groups[g], fibers[g]);
        continue;
      }
      ++stiff;
      last = g;
      for (const Index n : fibers[g])
        if (n >= 0) knot.nodes.push_back(n);
    }
    const bool rigid = stiff > 1 && cards_.finite;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!groups[g].section->is_hollow() || !groups[g].has_middle) continue;
      const std::vector<Index>& points = points_.at(fibers[g][0]);
      if (rigid) knot.nodes.insert(knot.nodes.end(), points.begin(), points.end());
      if (!rigid) tie_points(groups[g], fibers[g]);
    }
    if (stiff > 1 && cards_.finite) out_.knots.push_back(std::move(knot));
    if (stiff > 1 && !cards_.finite) knit(knot, groups);
    if (stiff != 1) return;
    if (is_plate(groups[last]) && groups[last].has_middle)
      add_weighted(node, fibers[last]);
    else if (groups[last].section->is_hollow())
      follow(node, shares_of(fibers[last], axis_shares(groups[last])));
    else
      add_mean(node, corners_of(groups[last], fibers[last]));
    straighten(node, groups[last], fibers[last]);
    add_rotations(node, groups[last], fibers[last]);
  }

  void add_mean(Index node, const std::vector<Index>& corners) {
    for (int k = 0; k < 3; ++k) add_mean(node, corners, k);
  }
  void add_mean(Index node, const std::vector<Index>& corners, int direction) {
    const double factor = -1 / static_cast<double>(corners.size());
    mesh::Relation& relation = mesh_.relations.emplace_back();
    relation.terms.push_back({node, direction, 1});
    for (const Index corner : corners) relation.terms.push_back({corner, direction, factor});
  }

  /// Of a corner of a shell of second order: what acts on it is shared out as the traction of a
  /// side is that is constant over it: -1/12 to a corner, 1/3 to a middle.
  ///
  /// Formula    u = 2 u_middle - (u_bottom + u_top) / 2
  void add_weighted(Index node, const Fiber& fiber) {
    for (int k = 0; k < 3; ++k)
      mesh_.relations.push_back(
          {{{node, k, 1}, {fiber[0], k, 0.5}, {fiber[1], k, -2}, {fiber[2], k, 0.5}}});
  }

  /// Where a node is held the edges of its section keep their middles between their ends; hollow
  /// sections are held in the mean.
  void straighten(Index node, const ThinGroup& group, const Fiber& fiber) {
    const auto held = cards_.held.find(node);
    if (held == cards_.held.end() || !group.has_middle || group.section->is_hollow()) return;
    for (int k = 0; k < 3; ++k) {
      if (!held->second[static_cast<std::size_t>(k)]) continue;
      if (is_plate(group))
        add_mean(fiber[1], {fiber[0], fiber[2]}, k);
      else
        for (std::size_t m = 0; m < 4; ++m)
          add_mean(fiber[4 + m], {fiber[m], fiber[(m + 1) % 4]}, k);
    }
  }

  /// How a knot may stretch: beams of one direction in their plane, others alike all around.
  static std::vector<Mat<3, 3>> stretches(const std::vector<ThinGroup>& groups) {
    const ThinGroup* first = nullptr;
    constexpr double parallel = 1 - 1e-6;
    for (const ThinGroup& group : groups) {
      if (group.section->hinged) continue;
      if (!first) first = &group;
      if (is_plate(group) || std::abs(group.tangent.dot(first->tangent)) < parallel)
        return {Mat<3, 3>::Identity()};
    }
    const Vec3 &a = first->normal, b = first->normal.cross(first->tangent);
    return {a * a.transpose(), b * b.transpose(), a * b.transpose() + b * a.transpose()};
  }

  /// A knot with small rotations, which stretches: relations.
  ///
  /// Formula    u_i = u + turn x arm_i + sum_s size_s stretch_s arm_i
  void knit(const Knot& knot, const std::vector<ThinGroup>& groups) {
    const Index turns = add_node(at(knot.node)), sizes = add_node(at(knot.node));
    out_.rotations[knot.node] = turns;
    const std::vector<Mat<3, 3>> all = stretches(groups);
    Mat<3, 3> about = Mat<3, 3>::Zero();
    for (const Index node : knot.nodes) {
      if (node == knot.node) continue;
      const Vec3 arm = at(node) - at(knot.node);
      about += arm.squaredNorm() * Mat<3, 3>::Identity() - arm * arm.transpose();
      for (int k = 0; k < 3; ++k) {
        std::vector<mesh::Relation::Term> terms{{node, k, 1}, {knot.node, k, -1}};
        for (int r = 0; r < 3; ++r) terms.push_back({turns, r, -Vec3::Unit(r).cross(arm)[k]});
        for (std::size_t s = 0; s < all.size(); ++s)
          terms.push_back({sizes, static_cast<int>(s), -all[s].row(k).dot(arm)});
        std::erase_if(terms, [&](const auto& term) {
          return std::abs(term.factor) <= 1e-12 * arm.norm() && term.node != node;
        });
        mesh_.relations.push_back({std::move(terms)});
      }
    }
    // arms along one line do not turn about it
    const Eigen::SelfAdjointEigenSolver<Mat<3, 3>> spectrum(about);
    if (spectrum.eigenvalues()[0] > 1e-8 * spectrum.eigenvalues()[2]) return;
    std::vector<mesh::Relation::Term> terms;
    for (int k = 0; k < 3; ++k)
      if (const double factor = spectrum.eigenvectors()(k, 0); std::abs(factor) > 1e-8)
        terms.push_back({turns, k, factor});
    mesh_.relations.push_back({std::move(terms)});
  }

  /// Factors of the displacements in the mean of the corners' rotations about an axis.
  std::vector<mesh::Relation::Term> rotation(const std::vector<Index>& corners,
                                             const Vec3& axis) const {
    const auto count = static_cast<double>(corners.size());
    Vec3 middle = Vec3::Zero();
    for (const Index corner : corners) middle += at(corner) / count;
    std::vector<mesh::Relation::Term> terms;
    for (const Index corner : corners) {
      const Vec3 arm = at(corner) - middle;
      const Vec3 radius = arm - arm.dot(axis) * axis;
      const Vec3 factor = axis.cross(radius) / (count * radius.squaredNorm());
      for (int k = 0; k < 3; ++k)
        if (std::abs(factor[k]) > 1e-12 * factor.norm()) terms.push_back({corner, k, factor[k]});
    }
    return terms;
  }

  /// The same of a whole section.
  ///
  /// Formula    axis . J^-1 sum share r x u , J = sum share (r^2 I - r r^T) , r from the centroid
  std::vector<mesh::Relation::Term> mean_rotation(const Shares& shares, const Vec3& axis) const {
    Vec3 middle = Vec3::Zero();
    for (const auto& [node, share] : shares) middle += share * at(node);
    Mat<3, 3> inertia = Mat<3, 3>::Zero();
    for (const auto& [node, share] : shares) {
      const Vec3 arm = at(node) - middle;
      inertia += share * (arm.squaredNorm() * Mat<3, 3>::Identity() - arm * arm.transpose());
    }
    const Vec3 way = inertia.inverse() * axis;
    std::vector<mesh::Relation::Term> terms;
    for (const auto& [node, share] : shares) {
      const Vec3 factor = share * way.cross(at(node) - middle);
      for (int k = 0; k < 3; ++k)
        if (std::abs(factor[k]) > 1e-12 * std::abs(share) * way.norm() * (at(node) - middle).norm())
          terms.push_back({node, k, factor[k]});
    }
    return terms;
  }

  /// Of the rotations that the deck names. A shell has none about its normal, and two at most: the
  /// third one is zero.
  void add_rotations(Index node, const ThinGroup& group, const Fiber& fiber) {
    const auto named = cards_.rotations.find(node);
    if (named == cards_.rotations.end()) return;
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return std::abs(group.normal[a]) < std::abs(group.normal[b]);
    });
    const Index turns = out_.rotations.emplace(node, add_node(at(node))).first->second;
    std::vector<Vec3> ways;  // of the top of a shell
    for (const int k : order) {
      if (!named->second[static_cast<std::size_t>(k)]) continue;
      const Vec3 axis = Vec3::Unit(k);
      const Vec3 way = axis.cross(group.normal);
      constexpr double small = 1e-3;
      mesh::Relation& relation = mesh_.relations.emplace_back();
      relation.terms.push_back({turns, k, -1});
      if (is_plate(group) && (way.norm() < small || ways.size() > 1 ||
                              (!ways.empty() && ways.back().cross(way).norm() < small)))
        continue;
      ways.push_back(way);
      const auto others = group.section->is_hollow()
                              ? mean_rotation(shares_of(fiber, shares(group)), axis)
                              : rotation(corners_of(group, fiber), axis);
      relation.terms.insert(relation.terms.end(), others.begin(), others.end());
    }
  }

  /// The first end of a truss does not turn about it.
  void add_spin(const ThinGroup& group, const Fiber& fiber) {
    if (group.members.front().second != 0) return;
    mesh::Relation& relation = mesh_.relations.emplace_back();
    relation.terms = rotation(corners_of(group, fiber), group.tangent);
    const auto largest = std::max_element(
        relation.terms.begin(), relation.terms.end(),
        [](const auto& a, const auto& b) { return std::abs(a.factor) < std::abs(b.factor); });
    std::iter_swap(relation.terms.begin(), largest);
  }

  // ---- cells ------------------------------------------------------------------------------------

  void add_cell(Index e, const std::map<std::pair<Index, int>, Fiber>& fibers) {
    Element& element = numbering_.elements[static_cast<std::size_t>(e)];
    const cell::CellInfo& info = cell::info(element.type->cell);
    std::vector<Fiber> at_nodes;
    for (int k = 0; k < info.nodes; ++k) at_nodes.push_back(fibers.at({e, k}));
    const ThinSection& section =
        cards_.sections[static_cast<std::size_t>(cards_.section_of[static_cast<std::size_t>(e)])];
    std::vector<std::vector<Index>> cells;
    if (section.is_hollow()) {
      tie_middle(hollow(section), at_nodes);
      cells = hollow_nodes(hollow(section), at_nodes);
    } else {
      cells.push_back(info.dimension == 2
                          ? plate_nodes(at_nodes, static_cast<std::size_t>(info.corners))
                          : beam_nodes(at_nodes));
    }
    const std::vector<Index>& nodes = cells[0];
    const std::string letters =
        numbering_.variants[element.variant].substr(element.type->name.size());
    const bool reduced = letters.find('R') != std::string::npos && nodes.size() % 4 == 0;
    const std::string solid = "C3D" + std::to_string(nodes.size());
    element.type = find_element_type(solid);
    element.variant = variant_place(numbering_, solid + (reduced             ? "R"
                                                         : nodes.size() == 8 ? "I"
                                                                             : ""));
    element.cell = append_solid(element, e, nodes);
    for (std::size_t c = 1; c < cells.size(); ++c) {
      element.others.push_back(append_solid(element, e, cells[c]));
      const auto b = static_cast<std::size_t>(element.cell.block);
      if (!numbers_.empty()) mesh_.blocks[b].numbers.back() = next_cell_++;
    }
  }
  /// A cell whose nodes come in the deck's order.
  mesh::CellRef append_solid(const Element& element, Index e, const std::vector<Index>& nodes) {
    const std::span<const std::int8_t> places = cell_places(*element.type);
    std::vector<Index> in_cell(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k)
      in_cell[static_cast<std::size_t>(places[k])] = nodes[k];
    return append(block_of_type(mesh_, element.type->cell), e, in_cell);
  }

  /// In the deck's order of C3D6, 8, 15 and 20: bottom, top, their middles, those between them.
  static std::vector<Index> plate_nodes(const std::vector<Fiber>& at, std::size_t corners) {
    std::vector<Index> nodes;
    const auto add = [&](std::size_t first, std::size_t last, std::size_t level) {
      for (std::size_t k = first; k < last; ++k) nodes.push_back(at[k][level]);
    };
    add(0, corners, 0);
    add(0, corners, 2);
    if (at.size() == corners) return nodes;
    add(corners, at.size(), 0);
    add(corners, at.size(), 2);
    add(0, corners, 1);
    return nodes;
  }

  /// In the deck's order of C3D8 and C3D20; `at` has the ends, then the middle.
  static std::vector<Index> beam_nodes(const std::vector<Fiber>& at) {
    const Fiber &a = at[0], &b = at[1];
    std::vector<Index> nodes{a[0], b[0], b[1], a[1], a[3], b[3], b[2], a[2]};
    if (at.size() == 2) return nodes;
    const Fiber& m = at[2];
    nodes.insert(nodes.end(),
                 {m[0], b[4], m[1], a[4], m[3], b[6], m[2], a[6], a[7], b[7], b[5], a[5]});
    return nodes;
  }

  const Deck& deck_;
  const ThinCards& cards_;
  Numbering& numbering_;
  mesh::Mesh& mesh_;
  Expansion out_;
  std::vector<std::int64_t> numbers_;  ///< of the elements; empty: none
  std::int64_t next_ = 0;              ///< number of the next node
  std::int64_t next_cell_ = 0;         ///< number of the next cell beyond one of an element
  std::map<const ThinSection*, HollowSection> hollow_;
  std::map<Index, std::vector<Index>> points_;  ///< of hollow sections, by the first of a fiber
};

}  // namespace

Expansion expand(const Deck& deck, const ThinCards& cards, Numbering& numbering, mesh::Mesh& mesh) {
  return Expander(deck, cards, numbering, mesh).expand();
}

}  // namespace osculate::io::inp

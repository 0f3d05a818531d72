#include "osculate/io/inp/expand.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/io/inp/fibers.hpp"
#include "osculate/mesh/boundary.hpp"

namespace osculate::io::inp {
namespace {

/// What moves with the deck's node in the mean: bottom and top, corners of a section.
std::vector<Index> corners_of(const ThinGroup& group, const Fiber& fiber) {
  if (is_plate(group)) return {fiber[0], fiber[2]};
  return {fiber[0], fiber[1], fiber[2], fiber[3]};
}

class Expander : private Fibers {
 public:
  Expander(const Deck& deck, const ThinCards& cards, Numbering& numbering, mesh::Mesh& mesh)
      : Fibers(mesh), deck_(deck), cards_(cards), numbering_(numbering) {}

  Expansion expand() {
    in_solids_.resize(mesh_.nodes.size());
    take_cells();
    const auto all = thin_groups(deck_, cards_, numbering_, mesh_);
    std::map<std::pair<Index, int>, Fiber> fibers;  // by element and its node
    for (const auto& [node, groups] : all) {
      std::vector<Fiber> here;
      for (const ThinGroup& group : groups) {
        here.push_back(fiber_of(node, group));
        note(node, group, here.back());
        for (const auto& member : group.members) fibers[member] = here.back();
      }
      join(node, groups, here);
    }
    for (std::size_t e = 0; e < cards_.section_of.size(); ++e)
      if (cards_.section_of[e] >= 0) add_cell(static_cast<Index>(e), fibers);
    return std::move(out_);
  }

 private:
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
      if (cards_.section_of[e] < 0 && element.type->family == Family::solid)
        for (const Index node : all) in_solids_[static_cast<std::size_t>(node)] = true;
    }
    for (const std::int64_t number : numbers_) next_cell_ = std::max(next_cell_, number + 1);
  }

  mesh::CellRef append(Index block, Index element, std::span<const Index> nodes) {
    mesh::Block& to = mesh_.blocks[static_cast<std::size_t>(block)];
    to.connectivity.insert(to.connectivity.end(), nodes.begin(), nodes.end());
    if (!numbers_.empty()) to.numbers.push_back(numbers_[static_cast<std::size_t>(element)]);
    return {block, to.size() - 1};
  }

  /// What the deck's node became.
  void note(Index node, const ThinGroup& group, const Fiber& fiber) {
    std::vector<Index> all(fiber.begin(), fiber.end());
    if (const auto more = points_.find(fiber[0]); more != points_.end())
      all.insert(all.end(), more->second.begin(), more->second.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const Vec3 first =
        is_plate(group) ? Vec3(Vec3::Zero()) : Vec3(group.normal.cross(group.tangent));
    for (const Index one : all) {
      if (one < 0) continue;
      if (group.section->is_plane()) {
        mesh_.expanded.push_back({one, node, Vec2::Zero(), true});
        continue;
      }
      const Vec3 arm = at(one) - at(node);
      mesh_.expanded.push_back({one, node, {arm.dot(group.normal), arm.dot(first)}});
    }
  }

  // ---- what the deck's node does ----------------------------------------------------------------

  [[noreturn]] void fail_at(const ThinGroup& group, Index node, const char* what) const {
    fail(deck_, group.section->at,
         fmt::format("*SOLID SECTION: {} {}", mesh::describe_node(mesh_, node), what));
  }

  /// Whether the groups are of plane elements; fails where these meet shells or beams.
  bool join_plane(Index node, const std::vector<ThinGroup>& groups,
                  const std::vector<Fiber>& fibers) {
    const auto plane = [](const ThinGroup& group) { return group.section->is_plane(); };
    const auto count = std::ranges::count_if(groups, plane);
    if (count == 0) return false;
    const ThinGroup& first = *std::ranges::find_if(groups, plane);
    if (count < std::ssize(groups))
      fail_at(first, node,
              "is one of plane elements and of shells, beams or trusses: not supported");
    constexpr double rounding = 1e-9;
    if (std::abs(at(node).z()) > rounding * at(node).norm())
      fail_at(first, node, "of plane elements is not at z = 0");
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].section->plane == ThinSection::Plane::axisymmetric && at(node).x() < 0)
        fail_at(groups[g], node, "of axisymmetric elements has a negative radius (x)");
      follow_plane(node, groups[g], fibers[g]);
    }
    keep_in_plane(node, fibers[0], in_solids_[static_cast<std::size_t>(node)]);
    return true;
  }

  void join(Index node, const std::vector<ThinGroup>& groups, const std::vector<Fiber>& fibers) {
    if (join_plane(node, groups, fibers)) return;
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
      if (!groups[g].section->layers.empty()) add_inner_levels(fibers[g], knot);
      if (!groups[g].section->is_hollow() || !groups[g].has_middle) continue;
      const std::vector<Index>& points = points_.at(fibers[g][0]);
      if (rigid) knot.nodes.insert(knot.nodes.end(), points.begin(), points.end());
      if (!rigid) tie_points(groups[g], fibers[g]);
    }
    if (stiff > 1 && cards_.finite) out_.knots.push_back(std::move(knot));
    if (stiff > 1 && !cards_.finite) knit(knot, groups);
    if (stiff != 1) return;
    if (!groups[last].section->layers.empty())
      follow(node, shares_of_levels(groups[last], fibers[last]));
    else if (is_plate(groups[last]) && groups[last].has_middle && !moves_in_the_mean(node))
      add_weighted(node, fibers[last]);
    else if (groups[last].section->is_hollow())
      follow(node, shares_of(fibers[last], axis_shares(groups[last])));
    else
      add_mean(node, corners_of(groups[last], fibers[last]));
    add_rotations(node, groups[last], fibers[last]);
    straighten(node, groups[last], fibers[last]);
  }

  /// What conditions between nodes and supports along axes of a node act on: its bottom and top.
  [[nodiscard]] bool moves_in_the_mean(Index node) const {
    return cards_.joined.contains(node) || cards_.held_along_axes.contains(node);
  }

  /// The levels between bottom and top belong to a knot, too.
  void add_inner_levels(const Fiber& fiber, Knot& knot) const {
    const std::vector<Index>& levels = points_.at(fiber[0]);
    for (std::size_t k = 1; k + 1 < levels.size(); ++k)
      if (levels[k] >= 0) knot.nodes.push_back(levels[k]);
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

  /// From the step on that holds a displacement of a shell's node its middle keeps between bottom
  /// and top in that direction; from the step on that holds a rotation of a beam's node the middles
  /// of the edges of its section keep between their ends. Hollow sections are held in the mean.
  void straighten(Index node, const ThinGroup& group, const Fiber& fiber) {
    const auto held = cards_.held.find(node);
    const bool layered = !group.section->layers.empty();  // levels at middles of sides, too
    if (held == cards_.held.end() || group.section->is_hollow()) return;
    if (!group.has_middle && !layered) return;
    const std::size_t first = mesh_.relations.size();
    if (!is_plate(group)) {
      if (!held->second[3] && !held->second[4] && !held->second[5]) return;
      for (std::size_t m = 0; m < 4; ++m) add_mean(fiber[4 + m], {fiber[m], fiber[(m + 1) % 4]});
      for (std::size_t r = first; r < mesh_.relations.size(); ++r)
        mesh_.relations[r].from = {out_.rotations.at(node), -1};
      return;
    }
    if (cards_.held_along_axes.contains(node)) return;
    for (int k = 0; k < 3; ++k) {
      if (!held->second[static_cast<std::size_t>(k)]) continue;
      if (layered)
        straighten_levels(group, fiber, k);
      else
        add_mean(fiber[1], {fiber[0], fiber[2]}, k);
    }
    for (std::size_t r = first; r < mesh_.relations.size(); ++r)
      mesh_.relations[r].from = {node, mesh_.relations[r].terms[0].direction};
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

  /// The type of the solid that an element becomes.
  [[nodiscard]] std::string solid_variant(const Element& element, const ThinSection& section,
                                          std::size_t nodes) const {
    std::string letters = numbering_.variants[element.variant].substr(element.type->name.size());
    const bool reduced = letters.find('R') != std::string::npos && nodes % 4 == 0;
    const std::string solid = "C3D" + std::to_string(nodes);
    if (section.is_plane()) {  // there is no hybrid plane stress
      if (section.plane == ThinSection::Plane::stress) std::erase(letters, 'H');
      return solid + letters;
    }
    const bool of_beam = reduced && cell::info(element.type->cell).dimension == 1 && nodes == 20 &&
                         !section.is_hollow();
    if (of_beam) return std::string(beam_brick);
    return solid + (reduced ? "R" : nodes == 8 ? "I" : "");
  }

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
    } else if (!section.layers.empty()) {
      cells = layer_nodes(section, at_nodes, static_cast<std::size_t>(info.corners));
      element.layered = true;
    } else {
      cells.push_back(info.dimension == 2
                          ? plate_nodes(at_nodes, static_cast<std::size_t>(info.corners))
                          : beam_nodes(at_nodes));
    }
    const std::vector<Index>& nodes = cells[0];
    const std::string solid = solid_variant(element, section, nodes.size());
    element.type = find_element_type("C3D" + std::to_string(nodes.size()));
    element.variant = variant_place(numbering_, solid);
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

  const Deck& deck_;
  const ThinCards& cards_;
  Numbering& numbering_;
  Expansion out_;
  std::vector<std::int64_t> numbers_;  ///< of the elements; empty: none
  std::int64_t next_cell_ = 0;         ///< number of the next cell beyond one of an element
  std::vector<bool> in_solids_;        ///< by node of the deck
};

}  // namespace

Expansion expand(const Deck& deck, const ThinCards& cards, Numbering& numbering, mesh::Mesh& mesh) {
  return Expander(deck, cards, numbering, mesh).expand();
}

}  // namespace osculate::io::inp

#include "osculate/io/inp/fibers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace osculate::io::inp {
namespace {

using Shape = ThinSection::Shape;
using Plane = ThinSection::Plane;

/// From the axis to bottom, middle and top of a sector of 2 degrees, along x and z.
Vec2 direction_of_level(std::size_t level) {
  const double angle = (static_cast<double>(level) - 1) * std::numbers::pi / sectors_of_ring;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

std::vector<Index> plate_nodes(const std::vector<Fiber>& at, std::size_t corners) {
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

std::vector<Index> beam_nodes(const std::vector<Fiber>& at) {
  const Fiber &a = at[0], &b = at[1];
  std::vector<Index> nodes{a[0], b[0], b[1], a[1], a[3], b[3], b[2], a[2]};
  if (at.size() == 2) return nodes;
  const Fiber& m = at[2];
  nodes.insert(nodes.end(),
               {m[0], b[4], m[1], a[4], m[3], b[6], m[2], a[6], a[7], b[7], b[5], a[5]});
  return nodes;
}

Index Fibers::add_node(const Vec3& place) {
  if (!mesh_.numbers.empty()) {
    if (next_ == 0) next_ = *std::max_element(mesh_.numbers.begin(), mesh_.numbers.end()) + 1;
    mesh_.numbers.push_back(next_++);
  }
  mesh_.nodes.push_back(place);
  return static_cast<Index>(mesh_.nodes.size()) - 1;
}

Fiber Fibers::fiber_of(Index node, const ThinGroup& group) {
  Fiber fiber;
  fiber.fill(-1);
  const Vec3 origin = at(node);
  if (group.section->plane == Plane::axisymmetric) {
    for (const std::size_t k : {0, 1, 2})
      if (k != 1 || group.has_middle) {
        const Vec2 way = direction_of_level(k);
        fiber[k] = add_node({origin.x() * way[0], origin.y(), origin.x() * way[1]});
      }
    return fiber;
  }
  const std::array<double, 2>& offset = group.section->offset;
  if (is_plate(group)) {
    if (!group.section->layers.empty()) return add_levels(node, group);
    for (const std::size_t k : {0, 1, 2})
      if (k != 1 || group.has_middle)
        fiber[k] =
            add_node(origin + group.thickness[0] *
                                  (0.5 * (static_cast<double>(k) - 1) - offset[0]) * group.normal);
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

void Fibers::follow_plane(Index node, const ThinGroup& group, const Fiber& fiber) {
  const Plane plane = group.section->plane;
  for (const std::size_t k : {0, 1, 2}) {
    if (fiber[k] < 0) continue;
    const Vec2 way = plane == Plane::axisymmetric ? direction_of_level(k) : Vec2(1, 0);
    mesh_.relations.push_back({{{fiber[k], 0, 1}, {node, 0, -way[0]}}});
    mesh_.relations.push_back({{{fiber[k], 1, 1}, {node, 1, -1}}});
    if (way[1] != 0)
      mesh_.relations.push_back({{{fiber[k], 2, 1}, {node, 0, -way[1]}}});
    else if (plane != Plane::stress || k == 1)
      mesh_.relations.push_back({{{fiber[k], 2, 1}}});
  }
  if (plane == Plane::stress) mesh_.relations.push_back({{{fiber[0], 2, 1}, {fiber[2], 2, 1}}});
}
void Fibers::keep_in_plane(Index node, const Fiber& fiber, bool in_solids) {
  mesh::Relation& relation = mesh_.relations.emplace_back();
  relation.terms.push_back({node, 2, 1});
  if (in_solids)
    relation.terms.insert(relation.terms.end(), {{fiber[0], 2, -.5}, {fiber[2], 2, -.5}});
}

Fiber Fibers::add_levels(Index node, const ThinGroup& group) {
  const ThinSection& section = *group.section;
  std::vector<Index> levels;
  double height = -(0.5 + section.offset[0]) * group.thickness[0];
  const Vec3 origin = at(node);
  levels.push_back(add_node(origin + height * group.normal));
  for (const double layer : section.layers) {
    levels.push_back(group.has_middle ? add_node(origin + (height + 0.5 * layer) * group.normal)
                                      : -1);
    height += layer;
    levels.push_back(add_node(origin + height * group.normal));
  }
  Fiber fiber;
  fiber.fill(-1);
  fiber[0] = levels.front();
  fiber[2] = levels.back();
  points_[fiber[0]] = std::move(levels);
  return fiber;
}
Fibers::Shares Fibers::shares_of_levels(const ThinGroup& group, const Fiber& fiber) const {
  const std::vector<Index>& levels = points_.at(fiber[0]);
  Shares shares;
  for (std::size_t i = 0; i < group.section->layers.size(); ++i) {
    const double part = group.section->layers[i] / group.thickness[0];
    const double ends = group.has_middle ? -0.5 : 0.5;
    shares.emplace_back(levels[2 * i], ends * part);
    if (group.has_middle) shares.emplace_back(levels[2 * i + 1], 2 * part);
    shares.emplace_back(levels[2 * i + 2], ends * part);
  }
  return shares;
}
void Fibers::straighten_levels(const ThinGroup& group, const Fiber& fiber, int direction) {
  const std::vector<Index>& levels = points_.at(fiber[0]);
  for (std::size_t k = 1; k + 1 < levels.size(); ++k) {
    if (levels[k] < 0) continue;
    const double up = (at(levels[k]) - at(fiber[0])).norm() / group.thickness[0];
    mesh_.relations.push_back(
        {{{levels[k], direction, 1}, {fiber[0], direction, up - 1}, {fiber[2], direction, -up}}});
  }
}
std::vector<std::vector<Index>> Fibers::layer_nodes(const ThinSection& section,
                                                    const std::vector<Fiber>& at,
                                                    std::size_t corners) const {
  std::vector<std::vector<Index>> all;
  for (std::size_t i = 0; i < section.layers.size(); ++i) {
    std::vector<Fiber> own(at.size());
    for (std::size_t n = 0; n < at.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k) own[n][k] = points_.at(at[n][0])[2 * i + k];
    all.push_back(plate_nodes(own, corners));
  }
  return all;
}

void Fibers::add_shares(const Fiber& fiber, const Vec2& place, double factor, bool corners,
                        Shares& to) {
  const auto four = shares_of_corners(place);
  const auto eight = shares_around(place);
  for (std::size_t k = 0; k < (corners ? 4U : 8U); ++k)
    to.emplace_back(fiber[k], factor * (corners ? four[k] : eight[k]));
}
void Fibers::follow(Index node, const Shares& shares) {
  for (int k = 0; k < 3; ++k) {
    mesh::Relation& relation = mesh_.relations.emplace_back();
    relation.terms.push_back({node, k, 1});
    for (const auto& [other, share] : shares)
      if (std::abs(share) > 1e-14) relation.terms.push_back({other, k, -share});
  }
}

void Fibers::add_points(const ThinGroup& group, const Fiber& fiber) {
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
const HollowSection& Fibers::hollow(const ThinSection& section) {
  const auto [found, is_new] = hollow_.try_emplace(&section);
  if (is_new) found->second = hollow_section(section);
  return found->second;
}
void Fibers::tie_points(const ThinGroup& group, const Fiber& fiber) {
  const HollowSection& section = hollow(*group.section);
  for (std::size_t p = 0; p < section.points.size(); ++p) {
    Shares shares;
    add_shares(fiber, section.points[p], 1, false, shares);
    follow(points_.at(fiber[0])[p], shares);
  }
}
void Fibers::tie_middle(const HollowSection& section, const std::vector<Fiber>& at) {
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
const std::vector<double>& Fibers::shares(const ThinGroup& group) {
  const HollowSection& section = hollow(*group.section);
  return group.has_middle ? section.share : section.corner_share;
}
const std::vector<double>& Fibers::axis_shares(const ThinGroup& group) {
  const HollowSection& section = hollow(*group.section);
  return group.has_middle ? section.axis_share : section.axis_corner_share;
}
Fibers::Shares Fibers::shares_of(const Fiber& fiber, const std::vector<double>& share) const {
  Shares shares;
  for (std::size_t p = 0; p < share.size(); ++p)
    if (share[p] != 0) shares.emplace_back(points_.at(fiber[0])[p], share[p]);
  return shares;
}
std::vector<std::vector<Index>> Fibers::hollow_nodes(const HollowSection& section,
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

}  // namespace osculate::io::inp

// `*MPC, MEANROT` of a deck: the mean rotation of nodes about an axis is the first displacement of
// a node whose coordinates are that axis.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

struct MeanRotation {
  std::vector<std::string> nodes;  ///< sets of one node each
  std::string pilot;               ///< likewise
  Vec3 axis = Vec3::Zero();
  io::inp::Place at;
};

/// Each node comes three times, once a direction; the last one is that of the rotation.
MeanRotation checked(const InpModel& m, const std::vector<std::string>& fields, io::inp::Place at) {
  MeanRotation one;
  one.at = at;
  if (fields.size() < 7) io::inp::fail(m.deck, at, "*MPC: MEANROT needs two nodes and its own");
  one.pilot = fields.back();
  for (std::size_t k = 0; k + 1 < fields.size(); ++k) {
    if (std::ranges::find(one.nodes, fields[k]) != one.nodes.end()) continue;
    if (std::count(fields.begin(), fields.end() - 1, fields[k]) != 3)
      io::inp::fail(m.deck, at, fmt::format("*MPC: MEANROT: expected '{}' three times", fields[k]));
    one.nodes.push_back(fields[k]);
  }
  one.axis = m.mesh.mesh.nodes[static_cast<std::size_t>(only_node(m, one.pilot))];
  if (!(one.axis.norm() > 0))
    io::inp::fail(m.deck, at, fmt::format("*MPC: MEANROT: '{}' has no axis", one.pilot));
  one.axis.normalize();
  return one;
}

std::vector<MeanRotation> mean_rotations(const InpModel& m) {
  std::vector<MeanRotation> all;
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "MPC") continue;
    std::vector<std::string> nodes;
    io::inp::Place at = card.at;
    bool here = false;
    const auto finish = [&] {
      if (here) all.push_back(checked(m, nodes, at));
      nodes.clear();
    };
    for (const Line& line : io::inp::lines_of(m.deck, card)) {
      Fields fields(m.deck, line);
      const std::string first = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
      if (!first.empty() && !io::inp::is_number(first)) {
        finish();
        here = first == "MEANROT";
        at = line.at;
      } else if (here && first != "0" && !first.empty()) {
        nodes.push_back(node_set_of(m, line, first));
      }
      while (here && !fields.done())
        if (const auto field = fields.next(); field && !field->empty() && *field != "0")
          nodes.push_back(node_set_of(m, line, *field));
    }
    finish();
  }
  return all;
}

std::string body_of(const MeanRotation& one) {
  return plain_name(fmt::format("rotation of {}", one.pilot));
}

const Vec3& place_of(const InpModel& m, const std::string& node) {
  return m.mesh.mesh.nodes[static_cast<std::size_t>(only_node(m, node))];
}

Vec3 middle_of(const InpModel& m, const MeanRotation& one) {
  Vec3 middle = Vec3::Zero();
  for (const std::string& node : one.nodes)
    middle += place_of(m, node) / static_cast<double>(one.nodes.size());
  return middle;
}

/// Factors of displacements in the mean of small rotations about the axis.
///
/// Formula    1/N sum (axis x r) . u / r^2 , r from the middle of the nodes, across the axis
void put_terms(const InpModel& m, const MeanRotation& one, int line, SourceNode& terms) {
  const auto add = [&](const std::string& on, int direction, double factor) {
    SourceNode& term = terms.items.emplace_back(inp_map(line));
    put(term, "on", inp_text(on, line));
    put(term, "of", inp_text(inp_component('u', direction), line));
    put(term, "factor", inp_number(factor, line));
  };
  add(one.pilot, 1, -1);
  const auto count = static_cast<double>(one.nodes.size());
  const Vec3 middle = middle_of(m, one);
  for (const std::string& node : one.nodes) {
    const Vec3 arm = place_of(m, node) - middle;
    const Vec3 radius = arm - arm.dot(one.axis) * one.axis;
    if (!(radius.norm() > 1e-9 * arm.norm())) continue;  // on the axis: it does not turn
    const Vec3 factor = one.axis.cross(radius) / (count * radius.squaredNorm());
    for (int k = 0; k < 3; ++k)
      if (std::abs(factor[k]) > 1e-12 * factor.norm()) add(node, k + 1, factor[k]);
  }
  if (terms.items.size() == 1)
    io::inp::fail(m.deck, one.at, "*MPC: MEANROT: its nodes lie on its axis");
}

/// The mean is that of small rotations where all nodes are as far from the axis.
void require_one_radius(const InpModel& m, const MeanRotation& one) {
  constexpr double rounding = 1e-4;
  const Vec3 middle = middle_of(m, one);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const std::string& node : one.nodes) {
    const double radius = one.axis.cross(place_of(m, node) - middle).norm();
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  if (most - least > rounding * most)
    io::inp::fail(m.deck, one.at,
                  "*MPC: MEANROT: with NLGEOM its nodes have to be as far from the axis");
}

}  // namespace

void put_rotating_bodies(InpModel& m, SourceNode& rigid) {
  if (!m.finite) return;
  for (const MeanRotation& one : mean_rotations(m)) {
    Eigen::Index along = 0;
    const double largest = one.axis.cwiseAbs().maxCoeff(&along);
    if (largest < 1 - 1e-12)
      io::inp::fail(m.deck, one.at,
                    "*MPC: MEANROT: with NLGEOM its axis has to be along x, y or z");
    require_one_radius(m, one);
    const int line = line_of(one.at);
    const InpBodyNode node{body_of(one), 4 + static_cast<int>(along), true,
                           one.axis[along] > 0 ? 1.0 : -1.0};
    if (!m.body_nodes.try_emplace(only_node(m, one.pilot), node).second)
      io::inp::fail(m.deck, one.at, "*MPC: MEANROT: its node belongs to a body already");
    SourceNode& body = put(rigid, body_of(one), inp_map(line));
    put(body, "set", inp_text(one.pilot, line));
    put(body, "reference", inp_point(place_of(m, one.pilot), 3, line));
  }
}

void put_mean_rotations(const InpModel& m, SourceNode& root) {
  if (!m.finite) return;
  for (const MeanRotation& one : mean_rotations(m)) {
    const int line = line_of(one.at);
    if (!find(root, "coupling")) put(root, "coupling", inp_list(line));
    SourceNode& entry = find(root, "coupling")->items.emplace_back(inp_map(line));
    SourceNode& on = put(entry, "on", inp_list(line));
    for (const std::string& node : one.nodes) on.items.push_back(inp_text(node, line));
    put(entry, "rigid", inp_text(body_of(one), line));
  }
}

void put_small_rotations(const InpModel& m, SourceNode& equations) {
  if (m.finite) return;
  for (const MeanRotation& one : mean_rotations(m)) {
    const int line = line_of(one.at);
    put_terms(m, one, line,
              put(equations.items.emplace_back(inp_map(line)), "terms", inp_list(line)));
  }
}

}  // namespace osculate::deck

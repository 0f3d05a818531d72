#include "osculate/model/passed_through.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/mesh/boundary.hpp"
#include "osculate/pairing/projected_point.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::model {

template <int Dim>
std::vector<char> in_front(const pairing::PairState<Dim>& state, double offset) {
  std::vector<char> front;
  front.reserve(state.points.size());
  for (const contact::PointHistory<Dim>& point : state.points)
    front.push_back(point.facet >= 0 && (point.active || point.gap >= offset));
  return front;
}

template <int Dim>
std::string passed_through(const BasicModel<Dim>& model, const BasicContactPair<Dim>& pair,
                           const std::vector<char>& before,
                           const pairing::PairEvaluation<Dim>& contact,
                           const std::vector<Vec<Dim>>& positions) {
  const pairing::PairDefinition<Dim>& definition = pair.definition;
  if (definition.filter.limited() || pairing::held_from_start(definition)) return {};
  if (definition.depth < 0) return {};  // not active: pair_changes.hpp
  std::vector<std::size_t> suspects;
  const std::size_t count =
      std::min({before.size(), contact.points.size(), definition.slave.points.size()});
  for (std::size_t i = 0; i < count; ++i) {
    const pairing::PointResult<Dim>& now = contact.points[i];
    const bool seen = now.status != contact::Status::open || now.outside_domain ||
                      (std::isfinite(now.gap) && now.gap >= -definition.depth);
    if (before[i] && !seen) suspects.push_back(i);
  }
  if (suspects.empty()) return {};
  const std::span<const Vec<Dim>> x(positions);
  std::vector<search::Box<Dim>> boxes;
  facet_boxes(definition.master, x, boxes);
  const pairing::Tree<Dim> tree(boxes);
  std::vector<Vec<Dim>> normals;
  pairing::point_normals<Dim>(definition.slave, x, normals);
  double deepest = 0;
  Index node = -1;
  for (const std::size_t i : suspects) {
    pairing::ProjectionQuery<Dim> query;
    query.point = pairing::position<Dim>(definition.slave.points[i], x);
    if (normals[i].squaredNorm() > 0) query.slave_normal = normals[i];
    const pairing::Projection<Dim> p = closest(definition.master, tree, x, query);
    if (p.feature != projection::Feature::face || p.beyond_end) continue;
    const double gap = projected_point(definition.master, p, query.point, x).kinematics.gap;
    if (!(gap - definition.offset < deepest)) continue;
    deepest = gap - definition.offset;
    node = definition.slave.points[i].nearest_node();
  }
  if (node < 0) return {};
  return fmt::format(
      "contact '{}': the slave went through the master within the increment and is not "
      "seen behind it ({} is {:.4g} deep): give the step more increments{}",
      pair.name, mesh::describe_node(model.mesh, node), -deepest,
      std::isfinite(definition.depth) ? ", or a larger search: {depth: ...}" : "");
}

template std::vector<char> in_front(const pairing::PairState<2>&, double);
template std::vector<char> in_front(const pairing::PairState<3>&, double);
template std::string passed_through(const Model&, const ContactPair&, const std::vector<char>&,
                                    const pairing::PairEvaluation<2>&, const std::vector<Vec2>&);
template std::string passed_through(const Model3&, const ContactPair3&, const std::vector<char>&,
                                    const pairing::PairEvaluation<3>&, const std::vector<Vec3>&);

}  // namespace osculate::model

#include "osculate/result/never_closed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "osculate/pairing/projected_point.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::result {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();

/// What the points of a slave see of a master.
struct Sight {
  double least = far;        ///< gap of those that face it
  double least_alike = far;  ///< distance of those that lie over it, but do not face it
  int facing = 0, alike = 0;
};

template <int Dim>
Sight sight_of(const pairing::PairDefinition<Dim>& pair, const pairing::SlaveSide<Dim>& slave,
               const std::vector<Vec<Dim>>& positions) {
  const std::span<const Vec<Dim>> x(positions);
  std::vector<search::Box<Dim>> boxes;
  facet_boxes(pair.master, x, boxes);
  const pairing::Tree<Dim> tree(boxes);
  std::vector<Vec<Dim>> normals;
  pairing::point_normals<Dim>(slave, x, normals);
  Sight sight;
  for (std::size_t i = 0; i < slave.points.size(); ++i) {
    pairing::ProjectionQuery<Dim> query;
    query.point = pairing::position<Dim>(slave.points[i], x);
    if (normals[i].squaredNorm() > 0) query.slave_normal = normals[i];
    const pairing::Projection<Dim> p = closest(pair.master, tree, x, query);
    if (p.feature != projection::Feature::none) {
      ++sight.facing;
      const bool over = p.feature == projection::Feature::face && !p.beyond_end;
      const double gap =
          over ? projected_point(pair.master, p, query.point, x).kinematics.gap : p.distance;
      sight.least = std::min(sight.least, gap - pair.offset);
      continue;
    }
    query.slave_normal.reset();
    const pairing::Projection<Dim> any = closest(pair.master, tree, x, query);
    if (any.feature == projection::Feature::none || any.beyond_end) continue;
    ++sight.alike;
    sight.least_alike = std::min(sight.least_alike, any.distance);
  }
  return sight;
}

/// The slave with many points on each facet.
template <int Dim>
pairing::SlaveSide<Dim> sampled_finely(pairing::SlaveSide<Dim> slave) {
  pairing::sample(slave, {pairing::Sampling::Rule::lobatto, 3, 4});
  return slave;
}

std::string gap_text(double least) {
  return std::isfinite(least) ? fmt::format("smallest gap {:.4g}", least)
                              : std::string("no point of the slave came near the master");
}

struct Reason {
  std::string text;
  bool is_fault = false;  ///< of the model; else it may be as it should
};

template <int Dim>
Reason reason(const model::BasicContactPair<Dim>& pair, const Penetration& found,
              const model::BasicModel<Dim>& model, const std::vector<Vec<Dim>>& x) {
  const pairing::PairDefinition<Dim>& definition = pair.definition;
  if (definition.filter.own && pair.group.empty())
    return {"one set is master and slave, which is contact of a surface with itself"};
  if (definition.filter.limited()) return {};
  const Sight now = sight_of<Dim>(definition, definition.slave, x);
  const Sight once = sight_of<Dim>(definition, definition.slave, model.reference);
  if (now.facing == 0 && now.alike > 0)
    return {
        "the normals of master and slave point the same way, as if one were behind the other: "
        "turn one of them round (`flip`, `inside`, the order of points), or, of bodies of cells, "
        "name the sides that face each other",
        true};
  if (now.least < 0 && std::isfinite(definition.depth))
    return {fmt::format("points are behind the master by more than search: {{depth: {:g}}}",
                        definition.depth),
            true};
  if (!definition.slave.boundary.facets.empty() && now.least > 0) {
    const Sight between = sight_of<Dim>(definition, sampled_finely(definition.slave), x);
    if (between.least < 0)
      return {fmt::format("the master is in the slave between its points, by {:.4g}: exchange "
                          "slave and master, or give the slave more points (a finer mesh, or "
                          "sampling: gauss)",
                          -between.least),
              true};
  }
  if (now.least > once.least && found.least_gap >= once.least * (1 - 1e-9))
    return {
        fmt::format("the bodies only move apart, from {:.4g} to {:.4g}", once.least, now.least)};
  return {};
}

}  // namespace

template <int Dim>
void measure_closing(const pairing::PairEvaluation<Dim>& contact, bool touched,
                     Penetration& found) {
  found.closed = found.closed || touched || pairing::touches(contact);
  for (const pairing::PointResult<Dim>& point : contact.points)
    if (std::isfinite(point.gap)) found.least_gap = std::min(found.least_gap, point.gap);
}

template <int Dim>
std::vector<std::string> never_closed(const model::BasicModel<Dim>& model,
                                      const std::vector<Penetration>& found,
                                      const std::vector<Vec<Dim>>& x) {
  std::map<std::string, std::size_t> nearest;  // pair of each contact that is open
  std::vector<std::string> closed;
  for (std::size_t p = 0; p < std::min(model.pairs.size(), found.size()); ++p) {
    const model::BasicContactPair<Dim>& pair = model.pairs[p];
    const std::string& contact = pair.group.empty() ? pair.name : pair.group;
    if (found[p].closed || pairing::held_from_start(pair.definition)) {
      closed.push_back(contact);
      continue;
    }
    const auto [place, is_new] = nearest.emplace(contact, p);
    if (!is_new && found[p].least_gap < found[place->second].least_gap) place->second = p;
  }
  std::vector<std::string> texts;
  for (const auto& [contact, p] : nearest) {
    if (std::find(closed.begin(), closed.end(), contact) != closed.end()) continue;
    const Reason why = reason(model.pairs[p], found[p], model, x);
    texts.push_back(fmt::format("{}contact '{}' was never closed: {}{}{}",
                                why.is_fault || closed.empty() ? "warning: " : "", contact,
                                gap_text(found[p].least_gap), why.text.empty() ? "" : "; ",
                                why.text));
  }
  return texts;
}

template void measure_closing(const pairing::PairEvaluation<2>&, bool, Penetration&);
template void measure_closing(const pairing::PairEvaluation<3>&, bool, Penetration&);
template std::vector<std::string> never_closed(const model::Model&, const std::vector<Penetration>&,
                                               const std::vector<Vec2>&);
template std::vector<std::string> never_closed(const model::Model3&,
                                               const std::vector<Penetration>&,
                                               const std::vector<Vec3>&);

}  // namespace osculate::result

#include "osculate/result/penetration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "osculate/mesh/boundary.hpp"
#include "osculate/model/penetration.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate::result {

template <int Dim>
void measure_penetration(const model::BasicContactPair<Dim>& pair,
                         const pairing::PairEvaluation<Dim>& contact, Penetration& found) {
  const pairing::PairDefinition<Dim>& definition = pair.definition;
  found.stiffening = contact.stiffening;
  found.mean = std::max(found.mean, model::mean_share(pair, contact));
  for (std::size_t i = 0; i < contact.points.size(); ++i) {
    const pairing::PointResult<Dim>& point = contact.points[i];
    if (point.status == contact::Status::open) continue;
    found.deepest = std::max(found.deepest, -point.gap);
    const double height = model::height_behind(pair, i);
    if (!(height > 0)) continue;
    const double share = -point.gap / height;
    const double penalty = contact.stiffening * pairing::point_penalty(definition, i).normal;
    found.needed = std::max(found.needed, penalty * share / model::penetration_target);
    if (!(share > found.share)) continue;
    found.share = share;
    if (i < definition.slave.points.size()) found.node = definition.slave.points[i].nearest_node();
  }
}

template <int Dim>
nlohmann::json penalty_json(const pairing::PairDefinition<Dim>& pair) {
  const pairing::PenaltyRange range = pairing::penalty_range(pair);
  const auto json_of = [&](double pairing::PointPenalty::*penalty) {
    return nlohmann::json{{"smallest", range.smallest.*penalty},
                          {"mean", range.mean.*penalty},
                          {"largest", range.largest.*penalty}};
  };
  nlohmann::json json{{"penalty", contact::penalty_of(pair.normal)},
                      {"penalty_of_points", json_of(&pairing::PointPenalty::normal)}};
  if (!pair.friction) return json;
  json["shear_penalty"] = contact::stiffness(*pair.friction);
  json["shear_penalty_of_points"] = json_of(&pairing::PointPenalty::shear);
  return json;
}

template <int Dim>
nlohmann::json penetration_json(const model::BasicContactPair<Dim>& pair,
                                const Penetration& found) {
  nlohmann::json json{{"name", pair.name},
                      {"automatic", pair.automatic},
                      {"penalty_factor", found.stiffening},
                      {"largest_penetration", found.deepest},
                      {"penetration_target", model::penetration_target * pair.height},
                      {"largest_share_of_height", found.share}};
  json.update(penalty_json(pair.definition));
  return json;
}

template <int Dim>
std::string missed_target(const model::BasicModel<Dim>& model,
                          const model::BasicContactPair<Dim>& pair, const Penetration& found) {
  // Where the mean meets the target single points may be deeper: corners, for one.
  constexpr double of_a_point = 5;
  const bool follows =
      model::adapts_penalty(model, pair) && found.mean <= model::penetration_target;
  if (!(found.share > (follows ? of_a_point : 1) * model::penetration_target)) return {};
  const std::string where = pair.heights.empty() || found.node < 0
                                ? std::string{}
                                : " at " + mesh::describe_node(model.mesh, found.node);
  return fmt::format(
      "warning: contact '{}': penetration up to {:.3g}, {:.2g} of the height of the cells "
      "behind it{} (target {:g}); a penalty of {:.3g} would reach the target",
      pair.name, found.deepest, found.share, where, model::penetration_target, found.needed);
}

template void measure_penetration(const model::ContactPair&, const pairing::PairEvaluation<2>&,
                                  Penetration&);
template void measure_penetration(const model::ContactPair3&, const pairing::PairEvaluation<3>&,
                                  Penetration&);
template nlohmann::json penalty_json(const pairing::PairDefinition<2>&);
template nlohmann::json penalty_json(const pairing::PairDefinition<3>&);
template nlohmann::json penetration_json(const model::ContactPair&, const Penetration&);
template nlohmann::json penetration_json(const model::ContactPair3&, const Penetration&);
template std::string missed_target(const model::Model&, const model::ContactPair&,
                                   const Penetration&);
template std::string missed_target(const model::Model3&, const model::ContactPair3&,
                                   const Penetration&);

}  // namespace osculate::result

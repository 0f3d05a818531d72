#include "osculate/model/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace osculate::model {
namespace {

double node_value(const Eigen::VectorXd& reaction, const State& state,
                  const HistoryRequest& request) {
  const int direction = request.quantity.back() == 'y' ? 1 : 0;
  const bool force = request.quantity.starts_with("rf");
  double sum = 0;
  for (const Index n : request.nodes)
    sum += force ? reaction[2 * n + direction] : state.u[2 * n + direction];
  return force || request.nodes.empty() ? sum : sum / static_cast<double>(request.nodes.size());
}

double rigid_value(const System& system, const Model& model, const State& state,
                   const HistoryRequest& request) {
  const auto b = static_cast<std::size_t>(request.target);
  const body::RigidMotion& motion = state.rigid[b];
  if (request.quantity == "ux") return motion.translation.x();
  if (request.quantity == "uy") return motion.translation.y();
  if (request.quantity == "rz") return motion.angle;
  const Eigen::VectorXd reaction = reactions(system);
  const std::vector<Vec2> x = system.positions(state);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Index n : model.rigid[b].nodes)
    sum += body::motion_gradient(motion, x[static_cast<std::size_t>(n)]).transpose() *
           reaction.segment<2>(2 * n);
  sum += reaction.segment<3>(system.dofs().body_dof(request.target, 0));
  if (request.quantity == "rfx") return sum[0];
  if (request.quantity == "rfy") return sum[1];
  return sum[2];
}

double pair_value(const System& system, const HistoryRequest& request) {
  const pairing::PairEvaluation<2>& pair =
      system.contact()[static_cast<std::size_t>(request.target)];
  double sum = 0;
  // What was assembled: with `residual: full` it is not just the traction times the area.
  for (const pairing::ContactBlock<2>& block : pair.blocks) {
    if (!block.active()) continue;
    if (request.quantity == "force_x") sum -= block.force[0];
    if (request.quantity == "force_y") sum -= block.force[1];
  }
  for (const pairing::PointResult<2>& p : pair.points) {
    const bool closed = p.status != contact::Status::open;
    if (request.quantity == "normal_force") sum -= p.weight * p.normal_traction;
    if (request.quantity == "shear_force") sum -= p.weight * p.shear_traction[0];
    if (request.quantity == "max_pressure") sum = std::max(sum, -p.normal_traction);
    if (request.quantity == "max_penetration" && closed) sum = std::max(sum, -p.gap);
    if (request.quantity == "stick") sum += p.status == contact::Status::stick ? 1 : 0;
    if (request.quantity == "slip") sum += p.status == contact::Status::slip ? 1 : 0;
    if (request.quantity == "open") sum += closed ? 0 : 1;
    if (request.quantity == "area" && closed) sum += p.weight;
  }
  return sum;
}

}  // namespace

Eigen::VectorXd reactions(const System& system) {
  const Forces& f = system.forces();
  return f.internal + f.contact - f.external;
}

double history_value(const System& system, const Model& model, const State& state,
                     const HistoryRequest& request) {
  switch (request.kind) {
    case HistoryRequest::Kind::nodes:
      return node_value(reactions(system), state, request);
    case HistoryRequest::Kind::rigid:
      return rigid_value(system, model, state, request);
    case HistoryRequest::Kind::pair:
      return pair_value(system, request);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

ContactFields contact_fields(const System& system, const Model& model, std::size_t pair) {
  ContactFields fields;
  fields.nodes = model.pairs[pair].definition.slave.nodes;
  for (const pairing::PointResult<2>& p : system.contact()[pair].points) {
    const bool found = p.history.facet >= 0;
    fields.copen.push_back(found ? p.gap : 0.0);
    fields.cpress.push_back(-p.normal_traction);
    fields.cshear.push_back(-p.shear_traction[0]);
    fields.cslip.push_back(p.history.slip[0]);
    fields.carea.push_back(p.weight);
    fields.cnforce.push_back(-p.weight * p.normal_traction);
    fields.csforce.push_back(-p.weight * p.shear_traction[0]);
    fields.cstatus.push_back(static_cast<double>(p.status));
    fields.cfeature.push_back(static_cast<double>(p.history.feature));
    fields.normal.push_back(p.normal);
  }
  return fields;
}

}  // namespace osculate::model

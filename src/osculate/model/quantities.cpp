#include "osculate/model/quantities.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace osculate::model {
namespace {

/// 0, 1, 2 for a quantity that ends in x, y, z.
int direction_of(const std::string& quantity) { return quantity.back() - 'x'; }

template <int Dim>
double node_value(const Eigen::VectorXd& reaction, const BasicState<Dim>& state,
                  const HistoryRequest& request) {
  const int direction = direction_of(request.quantity);
  const bool force = request.quantity.starts_with("rf");
  double sum = 0;
  for (const Index n : request.nodes)
    sum += force ? reaction[Dim * n + direction] : state.u[Dim * n + direction];
  return force || request.nodes.empty() ? sum : sum / static_cast<double>(request.nodes.size());
}

/// Moment about axes fixed in space that does the work of the forces `q` on the rotations.
Vec<1> moment_in_space(const body::RigidMotion&, const Vec<1>& q) { return q; }
Vec3 moment_in_space(const body::RigidMotion3& motion, const Vec3& q) {
  return Mat<3, 3>(body::rotation_tangent(motion.rotation).transpose()).fullPivLu().solve(q);
}

Vec<1> moment_of(const Vec2& arm, const Vec2& force) { return Vec<1>(turn(arm).dot(force)); }
Vec3 moment_of(const Vec3& arm, const Vec3& force) { return arm.cross(force); }

/// Force and moment that the supports exert on a rigid body.
template <int Dim>
Vec<body::motions<Dim>> rigid_reaction(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                                       const BasicState<Dim>& state, Index b) {
  constexpr int turns = body::rotations<Dim>;
  const body::BasicRigidMotion<Dim>& motion = state.rigid[static_cast<std::size_t>(b)];
  const Eigen::VectorXd reaction = reactions(system);
  const std::vector<Vec<Dim>> x = system.positions(state);
  Vec<Dim> force = Vec<Dim>::Zero();
  Vec<turns> moment = Vec<turns>::Zero();
  for (const Index n : model.rigid[static_cast<std::size_t>(b)].nodes) {
    const Vec<Dim> f = reaction.segment<Dim>(Dim * n);
    force += f;
    moment += moment_of(Vec<Dim>(x[static_cast<std::size_t>(n)] - motion.center()), f);
  }
  const Dof first = system.dofs().body_dof(b, 0);
  force += reaction.segment<Dim>(first);
  moment += moment_in_space(motion, Vec<turns>(reaction.segment<turns>(first + Dim)));
  Vec<body::motions<Dim>> sum;
  sum << force, moment;
  return sum;
}

template <int Dim>
double rigid_value(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                   const BasicState<Dim>& state, const HistoryRequest& request) {
  const std::string& quantity = request.quantity;
  const bool of_motion = quantity.size() == 2;  // u* and r*; else rf* and rm*
  const bool turns = of_motion ? quantity[0] == 'r' : quantity[1] == 'm';
  const int direction = direction_of(quantity);
  const int component = !turns ? direction : Dim == 2 ? 2 : 3 + direction;
  if (of_motion) return state.rigid[static_cast<std::size_t>(request.target)].component(component);
  return rigid_reaction(system, model, state, request.target)[component];
}

/// First of a block's nodes that is the slave's, and the one after the last: the first node alone,
/// at a crossing those behind the master's edge.
template <int Dim>
std::array<int, 2> slave_range(const pairing::PairDefinition<Dim>& pair,
                               const pairing::PointResult<Dim>& point,
                               const pairing::ContactBlock<Dim>& block) {
  if (!block.active()) return {0, 0};
  if (point.history.edge < 0) return {0, 1};
  return {pair.edges.master[static_cast<std::size_t>(point.history.facet)].count, block.count};
}

/// What was assembled: with `residual: full` it is not just the traction times the area.
template <int Dim>
double force_on_slave(const pairing::PairDefinition<Dim>& definition,
                      const pairing::PairEvaluation<Dim>& pair, int direction) {
  double sum = 0;
  for (std::size_t i = 0; i < pair.blocks.size(); ++i) {
    const std::array<int, 2> range = slave_range(definition, pair.points[i], pair.blocks[i]);
    for (int k = range[0]; k < range[1]; ++k) sum -= pair.blocks[i].force[Dim * k + direction];
  }
  return sum;
}

template <int Dim>
double pair_value(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                  const HistoryRequest& request) {
  const pairing::PairEvaluation<Dim>& pair =
      system.contact()[static_cast<std::size_t>(request.target)];
  double sum = 0;
  Vec<Dim> shear = Vec<Dim>::Zero();
  if (request.quantity.starts_with("force_"))
    sum = force_on_slave(model.pairs[static_cast<std::size_t>(request.target)].definition, pair,
                         direction_of(request.quantity));
  for (const pairing::PointResult<Dim>& p : pair.points) {
    const bool closed = p.status != contact::Status::open;
    if (request.quantity == "normal_force") sum -= p.weight * p.normal_traction;
    if (request.quantity == "shear_force") {
      if constexpr (Dim == 2)
        sum -= p.weight * p.shear_traction[0];
      else
        shear += p.weight * p.shear();
    }
    if (request.quantity == "max_pressure") sum = std::max(sum, -p.normal_traction);
    if (request.quantity == "max_penetration" && closed) sum = std::max(sum, -p.gap);
    if (request.quantity == "stick") sum += p.status == contact::Status::stick ? 1 : 0;
    if (request.quantity == "slip") sum += p.status == contact::Status::slip ? 1 : 0;
    if (request.quantity == "open") sum += closed ? 0 : 1;
    if (request.quantity == "area" && closed) sum += p.weight;
    if (request.quantity == "friction_work") sum += p.history.friction_work;
  }
  return sum + shear.norm();
}

/// The two directions in which shear is reported.
Mat<3, 2> shear_directions(const Vec3& normal) {
  constexpr double aligned = 1.7453e-3;  // 0.1 degree
  const Vec3 axis = normal.cross(Vec3::UnitX()).norm() < aligned ? Vec3::UnitZ() : Vec3::UnitX();
  Mat<3, 2> t;
  t.col(0) = (axis - axis.dot(normal) * normal).normalized();
  t.col(1) = normal.cross(t.col(0));
  return t;
}

void add_shear(const pairing::PointResult<2>& p, ContactFields& fields) {
  fields.cshear.push_back(-p.shear_traction[0]);
  fields.cslip.push_back(p.history.slip[0]);
  fields.csforce.push_back(-p.weight * p.shear_traction[0]);
}

void add_shear(const pairing::PointResult<3>& p, ContactFields3& fields) {
  const Mat<3, 2> t = shear_directions(p.normal);
  const Vec2 shear = -t.transpose() * p.shear();
  const Vec2 slip = t.transpose() * (p.frame * p.history.slip);
  fields.cshear.push_back(shear[0]);
  fields.cshear2.push_back(shear[1]);
  fields.cslip.push_back(slip[0]);
  fields.cslip2.push_back(slip[1]);
  fields.csforce.push_back(p.weight * shear.norm());
}

}  // namespace

template <int Dim>
Eigen::VectorXd reactions(const BasicSystem<Dim>& system) {
  const Forces& f = system.forces();
  return f.internal + f.contact - f.external;
}

template <int Dim>
double history_value(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                     const BasicState<Dim>& state, const HistoryRequest& request) {
  switch (request.kind) {
    case HistoryRequest::Kind::nodes:
      return node_value(reactions(system), state, request);
    case HistoryRequest::Kind::rigid:
      return rigid_value(system, model, state, request);
    case HistoryRequest::Kind::pair:
      return pair_value(system, model, request);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

template <int Dim>
BasicContactFields<Dim> contact_fields(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                                       std::size_t pair) {
  BasicContactFields<Dim> fields;
  fields.nodes = model.pairs[pair].definition.slave.nodes;
  for (const pairing::PointResult<Dim>& p : system.contact()[pair].points) {
    const contact::PointHistory<Dim>& h = p.history;
    const bool found = h.facet >= 0;
    if constexpr (Dim == 3)
      if (h.edge >= 0) fields.crossings.push_back({h.edge, h.flipped ? -h.xi[1] : h.xi[1]});
    fields.copen.push_back(found ? p.gap : 0.0);
    fields.cpress.push_back(-p.normal_traction);
    add_shear(p, fields);
    fields.carea.push_back(p.weight);
    fields.cnforce.push_back(-p.weight * p.normal_traction);
    fields.cstatus.push_back(static_cast<double>(p.status));
    fields.cfeature.push_back(static_cast<double>(p.history.feature));
    fields.normal.push_back(p.normal);
  }
  return fields;
}

template Eigen::VectorXd reactions(const System&);
template Eigen::VectorXd reactions(const System3&);
template double history_value(const System&, const Model&, const State&, const HistoryRequest&);
template double history_value(const System3&, const Model3&, const State3&, const HistoryRequest&);
template ContactFields contact_fields(const System&, const Model&, std::size_t);
template ContactFields3 contact_fields(const System3&, const Model3&, std::size_t);

}  // namespace osculate::model

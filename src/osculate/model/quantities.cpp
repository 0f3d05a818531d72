#include "osculate/model/quantities.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "osculate/body/spin.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::model {
namespace {

/// 0, 1, 2 for a quantity that ends in x, y, z.
int direction_of(const std::string& quantity) { return quantity.back() - 'x'; }

template <int Dim>
double node_velocity(const BasicState<Dim>& state, const HistoryRequest& request) {
  if (state.rates.empty() || request.nodes.empty()) return 0;
  double sum = 0;
  for (const Index n : request.nodes)
    sum += state.rates.velocity[Dim * n + direction_of(request.quantity)];
  return sum / static_cast<double>(request.nodes.size());
}

double energy_value(const Energies& e, std::string_view quantity) {
  const std::array<double, energy_quantities.size()> values{
      e.elapsed,  e.kinetic, e.strain,    e.contact,  e.external,
      e.friction, e.damping, e.numerical, e.residual, e.plastic};
  for (std::size_t i = 0; i < values.size(); ++i)
    if (energy_quantities[i] == quantity) return values[i];
  return std::numeric_limits<double>::quiet_NaN();
}

template <int Dim>
double node_value(const Eigen::VectorXd& reaction, const BasicState<Dim>& state,
                  const HistoryRequest& request) {
  const int direction = direction_of(request.quantity);
  if (request.quantity[0] == 'v') return node_velocity(state, request);
  const bool force = request.quantity.starts_with("rf");
  double sum = 0;
  for (const Index n : request.nodes)
    sum += force ? reaction[Dim * n + direction] : state.u[Dim * n + direction];
  return force || request.nodes.empty() ? sum : sum / static_cast<double>(request.nodes.size());
}

Vec<1> moment_about(const Vec2& arm, const Vec2& force) { return Vec<1>(turn(arm).dot(force)); }
Vec3 moment_about(const Vec3& arm, const Vec3& force) { return arm.cross(force); }

template <int Dim>
double rigid_value(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                   const BasicState<Dim>& state, const HistoryRequest& request) {
  const std::string& quantity = request.quantity;
  if (quantity[0] == 'v' || quantity[0] == 'w') {
    if (state.rates.empty()) return 0;
    const int i =
        quantity[0] == 'v' ? direction_of(quantity) : (Dim == 2 ? 2 : 3 + direction_of(quantity));
    return state.rates.velocity[system.dofs().body_dof(request.target, i)];
  }
  const bool of_motion = quantity.size() == 2;  // u* and r*; else rf* and rm*
  const bool turns = of_motion ? quantity[0] == 'r' : quantity[1] == 'm';
  const int direction = direction_of(quantity);
  const int rotation = Dim == 2 ? 0 : direction;
  if (!of_motion)
    return force_on_body(system, model, state, request.target,
                         reactions(system))[turns ? Dim + rotation : direction];
  const auto& motion = state.rigid[static_cast<std::size_t>(request.target)];
  return turns ? body::total_rotation(motion)[rotation] : motion.translation[direction];
}

/// First of a block's nodes that is the slave's, and the one after the last: the first ones, at a
/// edge-edge contact those behind the master's edge.
template <int Dim>
std::array<int, 2> slave_range(const pairing::PairDefinition<Dim>& pair,
                               const pairing::PointResult<Dim>& point,
                               const pairing::ContactBlock<Dim>& block) {
  if (!block.active()) return {0, 0};
  if (point.history.edge < 0) return {0, block.slave_count};
  return {pairing::edges_of(pair)->master[static_cast<std::size_t>(point.history.facet)].count,
          block.count};
}

/// What was assembled: with `residual: full` it is not just the traction times the area. Of a
/// second pass the force on its master.
template <int Dim>
double force_on_slave(const pairing::PairDefinition<Dim>& definition,
                      const pairing::PairEvaluation<Dim>& pair, bool reversed, int direction) {
  double sum = 0;
  for (std::size_t i = 0; i < pair.points.size(); ++i) {  // what follows carries no forces
    std::array<int, 2> range = slave_range(definition, pair.points[i], pair.blocks[i]);
    if (reversed) range = {range[1], pair.blocks[i].count};
    for (int k = range[0]; k < range[1]; ++k) sum -= pair.blocks[i].force[Dim * k + direction];
  }
  return sum;
}

template <int Dim>
double one_pair_value(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                      const HistoryRequest& request, Index target) {
  const pairing::PairEvaluation<Dim>& pair = system.contact()[static_cast<std::size_t>(target)];
  double sum = 0;
  Vec<Dim> shear = Vec<Dim>::Zero();
  const BasicContactPair<Dim>& of = model.pairs[static_cast<std::size_t>(target)];
  if (request.quantity.starts_with("force_"))
    sum = force_on_slave(of.definition, pair, of.reversed, direction_of(request.quantity));
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
    const PointState state = point_state(of.definition, p);
    if (request.quantity == "stick") sum += state == PointState::stick ? 1 : 0;
    if (request.quantity == "slipping") sum += state == PointState::slipping ? 1 : 0;
    if (request.quantity == "closed") sum += closed ? 1 : 0;
    if (request.quantity == "open") sum += closed ? 0 : 1;
    if (request.quantity == "slip" && closed) sum = std::max(sum, p.history.slip.norm());
    if (request.quantity == "area" && closed) sum += p.weight;
    if (request.quantity == "friction_work") sum += p.history.friction_work;
  }
  return sum + shear.norm();
}

template <int Dim>
double pair_value(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                  const HistoryRequest& request) {
  double value = one_pair_value(system, model, request, request.target);
  for (const Index pair : request.group) {
    const double other = one_pair_value(system, model, request, pair);
    const bool largest = request.quantity.starts_with("max_") || request.quantity == "slip";
    value = largest ? std::max(value, other) : value + other;
  }
  return value;
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

/// What the fields show at one place.
template <int Dim>
struct Shown {
  double weight = 0;  ///< of the values below in a mean
  double gap = 0, pressure = 0, area = 0;
  Vec<Dim> shear = Vec<Dim>::Zero(), slip = Vec<Dim>::Zero();  ///< on the slave; sliding
  double status = 0, feature = 0;
  Vec<Dim> normal = Vec<Dim>::UnitY();
};

template <int Dim>
Shown<Dim> shown(const pairing::PairDefinition<Dim>& pair, const pairing::PointResult<Dim>& p) {
  Shown<Dim> s;
  s.weight = 1;
  s.gap = p.history.facet >= 0 ? p.gap : 0.0;
  s.pressure = -p.normal_traction;
  s.area = p.weight;
  s.shear = -p.shear();
  s.slip = p.frame * p.history.slip;
  s.status = static_cast<double>(point_state(pair, p));
  s.feature = static_cast<double>(p.history.feature);
  s.normal = p.normal;
  return s;
}

void add_shear(const Shown<2>& s, ContactFields& fields) {
  const Vec2 along = -turn(s.normal);
  fields.cshear.push_back(s.shear.dot(along));
  fields.cslip.push_back(s.slip.dot(along));
  fields.csforce.push_back(s.area * fields.cshear.back());
}

void add_shear(const Shown<3>& s, ContactFields3& fields) {
  const Mat<3, 2> t = shear_directions(s.normal);
  const Vec2 shear = t.transpose() * s.shear;
  const Vec2 slip = t.transpose() * s.slip;
  fields.cshear.push_back(shear[0]);
  fields.cshear2.push_back(shear[1]);
  fields.cslip.push_back(slip[0]);
  fields.cslip2.push_back(slip[1]);
  fields.csforce.push_back(s.area * shear.norm());
}

template <int Dim>
void add_shown(const Shown<Dim>& s, BasicContactFields<Dim>& fields) {
  fields.copen.push_back(s.gap);
  fields.cpress.push_back(s.pressure);
  add_shear(s, fields);
  fields.carea.push_back(s.area);
  fields.cnforce.push_back(s.area * s.pressure);
  fields.cstatus.push_back(s.status);
  fields.cfeature.push_back(s.feature);
  fields.normal.push_back(s.normal);
}

/// The contact points' values at the slave's nodes: means with the weights N_k^2 (a constant is
/// kept, and no weight is negative); areas are N_k shares, status and feature those of the point
/// with the largest weight.
template <int Dim>
std::vector<Shown<Dim>> at_nodes(const pairing::PairDefinition<Dim>& pair,
                                 const std::vector<pairing::PointResult<Dim>>& points) {
  const pairing::SlaveSide<Dim>& slave = pair.slave;
  std::map<Index, std::size_t> slot;
  for (std::size_t n = 0; n < slave.nodes.size(); ++n) slot[slave.nodes[n]] = n;
  std::vector<Shown<Dim>> out(slave.nodes.size());
  std::vector<double> heaviest(out.size(), 0.0);
  for (std::size_t i = 0; i < slave.points.size(); ++i) {
    const Shown<Dim> p = shown(pair, points[i]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(slave.points[i].count); ++k) {
      const std::size_t n = slot.at(slave.points[i].nodes[k]);
      const double share = slave.points[i].shape[k], weight = share * share * p.area;
      Shown<Dim>& to = out[n];
      to.weight += weight;
      to.gap += weight * p.gap;
      to.pressure += weight * p.pressure;
      to.shear += weight * p.shear;
      to.slip += weight * p.slip;
      to.area += share * p.area;
      if (!(weight > heaviest[n])) continue;
      heaviest[n] = weight;
      to.status = p.status;
      to.feature = p.feature;
      to.normal = p.normal;
    }
  }
  for (Shown<Dim>& s : out) {
    if (!(s.weight > 0)) continue;
    for (double* const value : {&s.gap, &s.pressure}) *value /= s.weight;
    s.shear /= s.weight;
    s.slip /= s.weight;
  }
  return out;
}

}  // namespace

template <int Dim>
Vec<body::motions<Dim>> force_on_body(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                                      const BasicState<Dim>& state, Index b,
                                      const Eigen::VectorXd& forces) {
  constexpr int turns = body::rotations<Dim>;
  const body::BasicRigidMotion<Dim>& motion = state.rigid[static_cast<std::size_t>(b)];
  const std::vector<Vec<Dim>> x = system.positions(state);
  Vec<Dim> force = Vec<Dim>::Zero();
  Vec<turns> moment = Vec<turns>::Zero();
  for (const Index n : model.rigid[static_cast<std::size_t>(b)].nodes) {
    const Vec<Dim> f = forces.segment<Dim>(Dim * n);
    force += f;
    moment += moment_about(body::arm_of(motion, x[static_cast<std::size_t>(n)]), f);
  }
  const Dof first = system.dofs().body_dof(b, 0);
  force += forces.segment<Dim>(first);
  moment += body::moment_of(motion, Vec<turns>(forces.segment<turns>(first + Dim)));
  Vec<body::motions<Dim>> sum;
  sum << force, moment;
  return sum;
}

template <int Dim>
void pass_on(const BasicDofSpace<Dim>& dofs, Eigen::VectorXd& forces) {
  const Eigen::VectorXd before = forces;
  const Dof bodies = dofs.body_dof(0, 0);
  for (const Equation& equation : dofs.equations())
    for (std::size_t t = 1; t < equation.terms.size(); ++t) {
      const auto& [dof, factor] = equation.terms[t];
      const Equation::Term& lead = equation.terms.front();
      if (dofs.stands_alone(dof) || dof >= bodies)
        forces[dof] -= before[lead.dof] * factor / lead.factor;
    }
}

template <int Dim>
Eigen::VectorXd nodal_forces(const BasicSystem<Dim>& system) {
  const Eigen::VectorXd own = system.forces().internal + system.forces().contact;
  Eigen::VectorXd all = own;
  // What follows from others has but its load.
  for (const Equation& equation : system.dofs().equations())
    if (const Dof lead = equation.terms.front().dof; system.dofs().stands_alone(lead))
      all[lead] += system.forces().external[lead];
  pass_on(system.dofs(), all);
  // A node of a shell or beam has what those have that it was expanded to. In a body it is one of
  // its nodes, like those.
  const auto at = [](Index node) { return Eigen::seqN(Dim * node, Eigen::fix<Dim>); };
  const auto takes = [&](const mesh::Expanded& one) { return system.dofs().body_of(one.of) < 0; };
  const std::vector<mesh::Expanded>& expanded = system.model().mesh.expanded;
  for (const mesh::Expanded& one : expanded)
    if (takes(one)) all(at(one.of)) = own(at(one.of));
  for (const mesh::Expanded& one : expanded)
    if (takes(one)) all(at(one.of)) += own(at(one.node));
  return all;
}

template <int Dim>
Eigen::VectorXd reactions(const BasicSystem<Dim>& system) {
  const Forces& f = system.forces();
  Eigen::VectorXd all = f.internal + f.contact - f.external;
  if (f.inertia.size() > 0) all += f.inertia;
  pass_on(system.dofs(), all);
  return all;
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
    case HistoryRequest::Kind::whole:
      if (request.quantity == time_step_quantity) return state.rates.length;
      if (request.quantity == fraction_quantity) return state.fraction;
      return energy_value(state.rates.energies, request.quantity);
    case HistoryRequest::Kind::remembered:
      return largest_remembered(system.model(), state, request.nodes, request.quantity);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

template <int Dim>
BasicContactFields<Dim> contact_fields(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                                       std::size_t pair) {
  BasicContactFields<Dim> fields;
  const pairing::PairDefinition<Dim>& definition = model.pairs[pair].definition;
  const std::vector<pairing::PointResult<Dim>>& points = system.contact()[pair].points;
  fields.nodes = definition.slave.nodes;
  if (!pairing::sampled_at_nodes(definition.slave)) {
    for (const Shown<Dim>& s : at_nodes<Dim>(definition, points)) add_shown(s, fields);
    return fields;
  }
  for (const pairing::PointResult<Dim>& p : points) {
    const contact::PointHistory<Dim>& h = p.history;
    if constexpr (Dim == 3)
      if (h.edge >= 0) fields.edge_contacts.push_back({h.edge, h.flipped ? -h.xi[1] : h.xi[1]});
    add_shown(shown(definition, p), fields);
  }
  return fields;
}

template Vec<body::motions<2>> force_on_body(const System&, const Model&, const State&, Index,
                                             const Eigen::VectorXd&);
template Vec<body::motions<3>> force_on_body(const System3&, const Model3&, const State3&, Index,
                                             const Eigen::VectorXd&);
template Eigen::VectorXd nodal_forces(const System&);
template Eigen::VectorXd nodal_forces(const System3&);
template void pass_on(const DofSpace&, Eigen::VectorXd&);
template void pass_on(const DofSpace3&, Eigen::VectorXd&);
template Eigen::VectorXd reactions(const System&);
template Eigen::VectorXd reactions(const System3&);
template double history_value(const System&, const Model&, const State&, const HistoryRequest&);
template double history_value(const System3&, const Model3&, const State3&, const HistoryRequest&);
template ContactFields contact_fields(const System&, const Model&, std::size_t);
template ContactFields3 contact_fields(const System3&, const Model3&, std::size_t);

}  // namespace osculate::model

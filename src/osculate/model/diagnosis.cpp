#include "osculate/model/diagnosis.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "osculate/core/dense.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/body_resultants.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/joint_motions.hpp"
#include "osculate/model/system_impl.hpp"

namespace osculate::model {

template <int Dim>
std::vector<std::vector<Index>> deformable_bodies(const BasicModel<Dim>& model) {
  std::vector<Index> parent(model.reference.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index n) {
    while (parent[static_cast<std::size_t>(n)] != n) {
      auto& p = parent[static_cast<std::size_t>(n)];
      p = parent[static_cast<std::size_t>(p)];
      n = p;
    }
    return n;
  };
  std::vector<bool> used(parent.size(), false);
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (std::size_t i = 0; i < section.cells.size(); ++i) {
      if (is_removed(section, i)) continue;
      const std::span<const Index> nodes = cell_nodes(model.mesh, section.cells[i]).nodes;
      for (const Index node : nodes) {
        used[static_cast<std::size_t>(node)] = true;
        parent[static_cast<std::size_t>(root(node))] = root(nodes[0]);
      }
    }
  std::vector<std::vector<Index>> bodies;
  std::vector<Index> slot(parent.size(), -1);
  for (std::size_t n = 0; n < parent.size(); ++n) {
    if (!used[n]) continue;
    Index& s = slot[static_cast<std::size_t>(root(static_cast<Index>(n)))];
    if (s < 0) {
      s = static_cast<Index>(bodies.size());
      bodies.emplace_back();
    }
    bodies[static_cast<std::size_t>(s)].push_back(static_cast<Index>(n));
  }
  return bodies;
}

Eigen::MatrixXd plain_basis(Eigen::MatrixXd w) {
  constexpr double smallest = 1e-6;
  Eigen::Index done = 0;
  for (Eigen::Index row = 0; row < w.rows() && done < w.cols(); ++row) {
    Eigen::Index best = 0;
    if (w.row(row).tail(w.cols() - done).cwiseAbs().maxCoeff(&best) < smallest) continue;
    w.col(done).swap(w.col(done + best));
    w.col(done) /= w(row, done);
    for (Eigen::Index c = 0; c < w.cols(); ++c)
      if (c != done) w.col(c) -= w(row, c) * Eigen::VectorXd(w.col(done));
    ++done;
  }
  w.colwise().normalize();
  return w;
}

namespace {

template <int Dim>
std::string body_name(const BasicModel<Dim>& model, Index node) {
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (std::size_t i = 0; i < section.cells.size(); ++i) {
      if (is_removed(section, i)) continue;
      const std::span<const Index> nodes = cell_nodes(model.mesh, section.cells[i]).nodes;
      if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) return section.name;
    }
  return "?";
}

/// Rigid motions of one body, one a column: translations, then rotations about the centroid.
template <int Dim>
struct Modes {
  Eigen::MatrixXd z;  ///< unknowns x motions
  Vec<Dim> center = Vec<Dim>::Zero();
  double size = 1;
};

Mat<2, 1> turned(const Vec2& arm) { return turn(arm); }
Mat<3, 3> turned(const Vec3& arm) { return -body::cross_matrix(arm); }

template <int Dim>
Modes<Dim> rigid_modes(const BasicSystem<Dim>& system, const std::vector<Index>& nodes,
                       const std::vector<Vec<Dim>>& x) {
  Modes<Dim> modes;
  for (const Index n : nodes) modes.center += x[static_cast<std::size_t>(n)];
  modes.center /= static_cast<double>(nodes.size());
  double sum = 0;
  for (const Index n : nodes) sum += (x[static_cast<std::size_t>(n)] - modes.center).squaredNorm();
  modes.size = std::sqrt(sum / static_cast<double>(nodes.size()));
  modes.z = Eigen::MatrixXd::Zero(system.unknowns(), body::motions<Dim>);
  for (const Index n : nodes) {
    const Mat<Dim, body::rotations<Dim>> turns =
        turned(Vec<Dim>(x[static_cast<std::size_t>(n)] - modes.center)) / modes.size;
    for (int i = 0; i < Dim; ++i) {
      const Index u = system.dofs().unknown_of(system.dofs().node_dof(n, i));
      if (u < 0) continue;
      modes.z(u, i) = 1;
      modes.z.template block<1, body::rotations<Dim>>(u, Dim) = turns.row(i);
    }
  }
  return modes;
}

/// Combinations of the modes that leave the prescribed unknowns alone.
template <int Dim>
Eigen::MatrixXd admissible(const BasicSystem<Dim>& system, const Eigen::MatrixXd& z) {
  constexpr double smallest = 1e-12;
  const Eigen::Index m = z.cols();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(m, m);
  for (Index u = 0; u < system.dofs().unknowns(); ++u)
    if (system.prescribed(u)) gram += z.row(u).transpose() * z.row(u);
  if (gram.isZero(0)) return Eigen::MatrixXd::Identity(m, m);
  const core::Spectrum eigen = core::spectrum(gram);
  Eigen::Index free = 0;
  while (free < m && eigen.values[free] < smallest * eigen.values[m - 1]) ++free;
  return eigen.vectors.leftCols(free);
}

/// Points where its largest component is positive; round-off becomes zero.
template <class Vector>
void make_plain(Vector& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  if (v[largest] < 0) v = -v;
  for (double& component : v)
    if (std::abs(component) < 1e-9) component = 0.0;
}

template <int Dim>
BasicFreeMotion<Dim> motion_of(const Eigen::VectorXd& v, const Vec<Dim>& center, double ratio) {
  BasicFreeMotion<Dim> motion;
  motion.direction = v.head<Dim>();
  if (motion.direction.norm() > 1e-6) motion.direction.normalize();
  make_plain(motion.direction);
  const double rotation = Dim == 2 ? v[2] : v.tail(v.size() - Dim).norm();
  motion.rotation = std::abs(rotation) > 1e-6 ? rotation : 0.0;
  if constexpr (Dim == 3)
    if (motion.rotation > 0) {
      motion.axis = v.tail<3>() / rotation;
      make_plain(motion.axis);
    }
  motion.center = center;
  motion.stiffness_ratio = ratio;
  return motion;
}

double stiffest_diagonal(const la::SparseMatrix& k, const std::vector<bool>& prescribed) {
  double stiffest = 0;
  for (Index row = 0; row < k.n; ++row)
    for (Index e = k.row_start[static_cast<std::size_t>(row)];
         e < k.row_start[static_cast<std::size_t>(row) + 1]; ++e)
      if (k.column[static_cast<std::size_t>(e)] == row &&
          !prescribed[static_cast<std::size_t>(row)])
        stiffest = std::max(stiffest, std::abs(k.value[static_cast<std::size_t>(e)]));
  return stiffest;
}

/// A body, the motions that its prescriptions allow, and which of them nothing resists.
template <int Dim>
struct Body {
  std::vector<Index> nodes;
  std::string name;
  Vec<Dim> center = Vec<Dim>::Zero();
  Eigen::MatrixXd allowed;  ///< combinations of translations and rotations, one a column
};

/// Plain free motions of a body out of combinations of those it is allowed.
template <int Dim>
void add_motions(const Body<Dim>& body, const Eigen::MatrixXd& combinations,
                 const Eigen::VectorXd& ratios, std::vector<BasicFreeMotion<Dim>>& found) {
  Eigen::MatrixXd w = body.allowed * combinations;
  if (w.cols() > 1) w = plain_basis(std::move(w));
  for (Eigen::Index j = 0; j < w.cols(); ++j) {
    found.push_back(motion_of<Dim>(w.col(j), body.center, ratios[j]));
    found.back().body = body.name;
    found.back().nodes = body.nodes;
  }
}

/// The body of some that contact ties together whose motion it is.
struct Leader {
  std::size_t member = 0;
  bool pushed = false;  ///< and nothing is behind it
};

/// In the direction of the loads of all, others press on it and the least is behind it.
template <int Dim>
Leader leader_of(const std::vector<Body<Dim>>& bodies, const JointMotions& joint,
                 const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                 const Eigen::VectorXd& loads) {
  Vec<Dim> load = Vec<Dim>::Zero();
  for (const std::size_t b : joint.bodies)
    load += resultants(system, model, bodies[b].nodes, loads).load;
  Leader leader;
  int most = std::numeric_limits<int>::min();
  for (std::size_t i = 0; i < joint.bodies.size(); ++i) {
    if (joint.motions[i].cols() == 0) continue;
    const int sum = pressed(system, model, bodies[joint.bodies[i]].nodes, load).sum();
    if (sum > most) leader = {i, sum > 0};
    most = std::max(most, sum);
  }
  return leader;
}

}  // namespace

template <int Dim>
std::vector<BasicFreeMotion<Dim>> free_motions(BasicSystem<Dim>& system,
                                               const BasicModel<Dim>& model,
                                               const BasicState<Dim>& state,
                                               const Eigen::VectorXd& loads) {
  const std::vector<Vec<Dim>> x = system.positions(state);
  const la::SparseMatrix& k = system.matrix();
  std::vector<bool> prescribed(static_cast<std::size_t>(k.n));
  for (Index u = 0; u < k.n; ++u) prescribed[static_cast<std::size_t>(u)] = system.prescribed(u);
  std::vector<Body<Dim>> bodies;
  std::vector<CompactModes> modes;
  for (std::vector<Index>& nodes : deformable_bodies(system.model())) {  // of the running step
    const Modes<Dim> rigid = rigid_modes(system, nodes, x);
    Eigen::MatrixXd allowed = admissible(system, rigid.z);
    if (allowed.cols() == 0) continue;
    modes.push_back(compact(rigid.z * allowed));
    const std::string name = body_name(system.model(), nodes.front());
    bodies.push_back({std::move(nodes), name, rigid.center, std::move(allowed)});
  }
  const RigidStiffness stiffness(k, modes, stiffest_diagonal(k, prescribed));
  std::vector<BasicFreeMotion<Dim>> first, found;
  std::vector<bool> led(bodies.size(), false);
  for (const JointMotions& joint : joint_motions(stiffness)) {
    const Leader leader = leader_of(bodies, joint, system, model,
                                    loads.size() > 0 ? loads : system.forces().external);
    const std::size_t body = joint.bodies[leader.member], before = first.size();
    const Eigen::MatrixXd& of_leader = joint.motions[leader.member];
    add_motions<Dim>(bodies[body], of_leader,
                     Eigen::VectorXd::Constant(of_leader.cols(), joint.ratio), first);
    led[body] = true;
    for (std::size_t m = before; m < first.size(); ++m) {
      first[m].pushed = leader.pushed;
      for (std::size_t i = 0; i < joint.bodies.size(); ++i)
        if (i != leader.member && joint.motions[i].cols() > 0)
          first[m].along.push_back(bodies[joint.bodies[i]].name);
    }
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (led[b]) continue;
    const FreeCombinations alone = stiffness.free_of({b});
    if (alone.count() > 0) add_motions<Dim>(bodies[b], alone.columns, alone.ratios, found);
  }
  first.insert(first.end(), found.begin(), found.end());
  return first;
}

/// Formula    |v - Z c| <= 1e-3 |v| over all nodes of deformable bodies, Z c the nearest rigid
///            motions of the bodies
template <int Dim>
bool BasicSystem<Dim>::is_free_motion(const Trial& trial, const Eigen::VectorXd& mode) const {
  const State& state = trial.state;
  constexpr double nearly = 1e-3;
  if (mode.size() != displacements()) return true;
  const std::vector<Vec<Dim>> x = positions(state);
  double whole = 0, strained = 0;
  for (const std::vector<Index>& nodes : deformable_bodies(impl_->model)) {
    const Eigen::MatrixXd z = rigid_modes(*this, nodes, x).z;
    Eigen::VectorXd moved = mode;  // of this body
    for (Eigen::Index u = 0; u < z.rows(); ++u)
      if (z.row(u).isZero(0)) moved[u] = 0;
    const Eigen::VectorXd rigid = z * core::least_squares(z, moved);
    whole += moved.squaredNorm();
    strained += (moved - rigid).squaredNorm();
  }
  return strained <= nearly * nearly * whole;
}
template bool BasicSystem<2>::is_free_motion(const Trial&, const Eigen::VectorXd&) const;
template bool BasicSystem<3>::is_free_motion(const Trial&, const Eigen::VectorXd&) const;

namespace {

template <class Vector>
std::string direction_text(const Vector& v) {
  std::string text;
  for (const double c : v) text += fmt::format("{}{:.4f}", text.empty() ? "(" : ", ", c);
  return text + ")";
}

template <class Vector>
std::string point_text(const Vector& v) {
  std::string text;
  for (const double c : v) text += fmt::format("{}{:.4g}", text.empty() ? "(" : ", ", c);
  return text + ")";
}

template <int Dim>
std::string motion_text(const BasicFreeMotion<Dim>& motion) {
  if (std::abs(motion.rotation) <= 0.5) return "move along " + direction_text(motion.direction);
  if (Dim == 2) return "turn about " + point_text(motion.center);
  return fmt::format("turn about the axis {} through {}", direction_text(motion.axis),
                     point_text(motion.center));
}

}  // namespace

template <int Dim>
std::string free_motion_message(const std::vector<BasicFreeMotion<Dim>>& motions) {
  std::string text;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < motions.size() && motions[last + 1].center == motions[i].center) ++last;
    if (!text.empty()) text += "; ";
    text += fmt::format("body '{}' is free to ", motions[i].body);
    const bool every = last + 1 - i == static_cast<std::size_t>(body::motions<Dim>);
    text += every ? "move and turn in every direction: nothing holds it"
                  : fmt::format("{} (resistance {:.1e} of its stiffness)", motion_text(motions[i]),
                                motions[i].stiffness_ratio);
    if (!motions[i].along.empty())
      text += fmt::format(", and '{}' come{} along", fmt::join(motions[i].along, "', '"),
                          motions[i].along.size() == 1 ? "s" : "");
    if (every) i = last;
  }
  return text;
}

template <int Dim>
std::vector<OutsideDomain> outside_domain(const BasicSystem<Dim>& system,
                                          const BasicModel<Dim>& model) {
  std::vector<OutsideDomain> found;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const std::vector<pairing::SlavePoint<Dim>>& slaves = model.pairs[p].definition.slave.points;
    OutsideDomain here{model.pairs[p].name, {}};
    const auto& points = system.contact()[p].points;
    for (std::size_t i = 0; i < std::min(points.size(), slaves.size()); ++i)
      if (const Index node = slaves[i].nearest_node();
          points[i].outside_domain &&
          std::find(here.nodes.begin(), here.nodes.end(), node) == here.nodes.end())
        here.nodes.push_back(node);
    if (!here.nodes.empty()) found.push_back(std::move(here));
  }
  return found;
}

template <int Dim>
std::string outside_domain_message(const BasicModel<Dim>& model, const OutsideDomain& found) {
  constexpr std::size_t most = 3;
  std::string who;
  for (std::size_t i = 0; i < std::min(most, found.nodes.size()); ++i)
    who += (i ? ", " : "") + mesh::describe_node(model.mesh, found.nodes[i]);
  if (found.nodes.size() > most) who += fmt::format(" and {} more", found.nodes.size() - most);
  return fmt::format(
      "contact '{}': {} at or beyond the centre of curvature of the master's surface: no direction "
      "out of it is the nearest, so there is no contact force; a stiffer penalty, smaller "
      "increments or search: {{depth: ...}} keep points from getting that deep",
      found.pair, who + (found.nodes.size() == 1 ? " lies" : " lie"));
}

template std::vector<std::vector<Index>> deformable_bodies(const Model&);
template std::vector<std::vector<Index>> deformable_bodies(const Model3&);
template std::vector<OutsideDomain> outside_domain(const System&, const Model&);
template std::vector<OutsideDomain> outside_domain(const System3&, const Model3&);
template std::string outside_domain_message(const Model&, const OutsideDomain&);
template std::string outside_domain_message(const Model3&, const OutsideDomain&);
template std::vector<FreeMotion> free_motions(System&, const Model&, const State&,
                                              const Eigen::VectorXd&);
template std::vector<FreeMotion3> free_motions(System3&, const Model3&, const State3&,
                                               const Eigen::VectorXd&);
template std::string free_motion_message(const std::vector<FreeMotion>&);
template std::string free_motion_message(const std::vector<FreeMotion3>&);

}  // namespace osculate::model

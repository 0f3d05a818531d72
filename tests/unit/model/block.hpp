#pragma once
// Blocks of cells in the plane and in space, systems of them, and their analyses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "derivative_check.hpp"
#include "osculate/mesh/generate.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/surface.hpp"
#include "osculate/model/analysis.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/model/system.hpp"

namespace osculate::model {

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
struct DimensionNames {
  template <class Dimension>
  static std::string GetName(int) {
    return Dimension::value == 2 ? "Plane" : "Space";
  }
};

/// Some numbers in the plane, others in space.
using Numbers = std::vector<double>;
template <int Dim>
Numbers either(Numbers plane, Numbers space) {
  return Dim == 2 ? plane : space;
}
/// The plane is that of x and z, where z is called y: the last axis always points upwards.
template <int Dim>
Vec<Dim> either(const Vec3& x) {
  if constexpr (Dim == 2)
    return {x.x(), x.z()};
  else
    return x;
}
template <int Dim>
inline constexpr int up = Dim - 1;
inline std::string with_axis(const std::string& name, int axis) {
  return name + "xyz"[static_cast<std::size_t>(axis)];
}

template <int Dim>
solid::Section<Dim> section_of(solid::Kinematics kinematics, const material::Law& law) {
  solid::Section<Dim> section;
  section.kinematics = kinematics;
  section.law = law;
  return section;
}
template <int Dim>
solid::Section<Dim> elastic(double young, double poisson = 0.3) {
  return section_of<Dim>(solid::Kinematics::small, material::LinearElastic{young, poisson});
}
template <int Dim>
solid::Section<Dim> rubber(double young, double poisson = 0.3) {
  return section_of<Dim>(solid::Kinematics::finite, material::NeoHooke{young, poisson});
}

/// A box from `low` to `high`; inner nodes are moved by up to `distortion` of a cell.
struct BlockSpec {
  Vec3 low{0, 0, 0}, high{1, 1, 1};
  std::array<int, 3> n{2, 2, 2};
  double distortion = 0;
  bool quadratic = false;
};

inline void append(mesh::Mesh& mesh, const BlockSpec& b, const std::string& name, Vec2) {
  mesh::BoxSpec box;
  box.name = name;
  box.x = {b.low.x(), b.high.x()};
  box.y = {b.low.z(), b.high.z()};
  box.nx = {b.n[0]};
  box.ny = {b.n[2]};
  box.type = b.quadratic ? cell::CellType::quad8 : cell::CellType::quad4;
  mesh::append_box(mesh, box);
}
inline void append(mesh::Mesh& mesh, const BlockSpec& b, const std::string& name, Vec3) {
  mesh::SolidBoxSpec box;
  box.name = name;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto e = static_cast<Eigen::Index>(d);
    box.breaks[d] = {b.low[e], b.high[e]};
    box.elements[d] = {b.n[d]};
  }
  box.type = b.quadratic ? cell::CellType::hex20 : cell::CellType::hex8;
  mesh::append_solid_box(mesh, box);
}

/// Moves inner nodes of the block, which are those from `first` on.
template <int Dim>
void distort(mesh::Mesh& mesh, std::size_t first, const BlockSpec& b) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec<Dim> low = either<Dim>(b.low), size = either<Dim>(b.high) - low;
  const auto n = either<Dim>(Vec3(b.n[0], b.n[1], b.n[2]));
  for (std::size_t k = first; k < mesh.nodes.size(); ++k) {
    const auto x = mesh.nodes[k].head<Dim>();
    const Vec<Dim> from = x - low, to = low + size - x;
    if (std::min(from.minCoeff(), to.minCoeff()) < 1e-9) continue;
    for (int d = 0; d < Dim; ++d)
      mesh.nodes[k][d] += b.distortion * uniform(generator) * size[d] / n[d];
  }
}

/// Nodes that were added to the mesh. (Frames and points of tools come after all of them.)
template <int Dim>
void take_over(BasicModel<Dim>& m, std::size_t first) {
  if (m.reference.size() != first) throw std::logic_error("there are nodes behind the mesh");
  for (std::size_t k = first; k < m.mesh.nodes.size(); ++k)
    m.reference.push_back(m.mesh.nodes[k].template head<Dim>());
}

/// Appends a block as one section of the same name.
template <int Dim>
void add_block(BasicModel<Dim>& m, const BlockSpec& b, const solid::Section<Dim>& section,
               const std::string& name = "block") {
  const std::size_t first = m.mesh.nodes.size();
  append(m.mesh, b, name, Vec<Dim>{});
  if (b.distortion > 0) distort<Dim>(m.mesh, first, b);
  take_over(m, first);
  m.sections.push_back({name, section, m.mesh.find_set(name)->cells});
}

/// A block and one step.
template <int Dim>
BasicModel<Dim> block(const BlockSpec& b, const solid::Section<Dim>& section) {
  BasicModel<Dim> m;
  add_block(m, b, section);
  m.steps.emplace_back();
  m.steps[0].name = "s";
  return m;
}

template <int Dim>
const std::vector<Index>& nodes_of(const BasicModel<Dim>& m, const std::string& set) {
  return m.mesh.find_set(set)->nodes;
}
/// The node of the meshes next to a place.
template <int Dim>
Index node_at(const BasicModel<Dim>& m, const Vec3& place) {
  const auto distance = [&](const Vec<Dim>& x) { return (x - either<Dim>(place)).norm(); };
  const auto first = m.reference.begin();
  const auto end = first + static_cast<std::ptrdiff_t>(m.mesh.nodes.size());
  const auto nearest = std::min_element(
      first, end, [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return static_cast<Index>(nearest - first);
}
/// The nodes of the meshes with this coordinate.
template <int Dim>
std::vector<Index> nodes_at(const BasicModel<Dim>& m, int axis, double value) {
  std::vector<Index> nodes;
  for (std::size_t n = 0; n < m.mesh.nodes.size(); ++n)
    if (std::abs(m.reference[n][axis] - value) < 1e-9) nodes.push_back(static_cast<Index>(n));
  return nodes;
}

/// Sides of cells that a set names, outward.
template <int Dim>
auto sides_of(const BasicModel<Dim>& m, const std::string& set) {
  const mesh::Set& s = *m.mesh.find_set(set);
  if constexpr (Dim == 2)
    return mesh::surface_of(m.mesh, mesh::edge_table(m.mesh), s).facets;
  else
    return mesh::surface_of(m.mesh, mesh::face_table(m.mesh), s).facets;
}

// ---- supports and loads, of the last step -------------------------------------------------------

template <int Dim>
void prescribe(BasicModel<Dim>& m, const std::vector<Index>& nodes, int direction, double value) {
  for (const Index n : nodes)
    m.steps.back().prescribed.push_back({Dim * n + direction, {0, value, {}}, false});
}
template <int Dim>
void hold(BasicModel<Dim>& m, const std::string& set) {
  for (int d = 0; d < Dim; ++d) prescribe(m, nodes_of(m, set), d, 0);
}

template <int Dim>
void add_pressure(BasicModel<Dim>& m, const std::string& set, double value) {
  PressureLoad load;
  load.ramp = {0, value, {}};
  for (const auto& side : sides_of(m, set))
    load.facets.push_back({0, {side.nodes().begin(), side.nodes().end()}, side.type});
  m.steps.back().pressure.push_back(load);
}

/// Dead loads over the area of a set.
template <int Dim>
void add_traction(BasicModel<Dim>& m, const std::string& set, const Vec<Dim>& traction) {
  DeadLoad load;
  load.ramp = {0, 1, {}};
  for (const auto& side : sides_of(m, set)) {
    const std::vector<double> weights =
        side_weights(m, m.sections[0].section, side.type, side.nodes());
    for (std::size_t k = 0; k < weights.size(); ++k)
      for (int d = 0; d < Dim; ++d)
        load.unit.emplace_back(Dim * side.nodes()[k] + d, weights[k] * traction[d]);
  }
  m.steps.back().dead.push_back(load);
}

template <int Dim>
Dof body_dof(const BasicModel<Dim>& m, Index body, int component) {
  return Dim * static_cast<Dof>(m.reference.size()) + body::motions<Dim> * body + component;
}

/// A rigid body that holds `nodes`.
template <int Dim>
void add_rigid(BasicModel<Dim>& m, const Vec<Dim>& reference, const std::vector<Index>& nodes) {
  m.body_of_node.resize(m.reference.size(), -1);
  for (const Index n : nodes)
    m.body_of_node[static_cast<std::size_t>(n)] = static_cast<Index>(m.rigid.size());
  BasicRigidBody<Dim> body;
  body.name = "tool";
  body.reference = reference;
  body.nodes = nodes;
  m.rigid.push_back(std::move(body));
}

/// Force and moment on the last rigid body. Needs all nodes.
template <int Dim>
void load_body(BasicModel<Dim>& m, const Numbers& forces, double factor = 1) {
  DeadLoad load;
  load.ramp = {0, factor, {}};
  const auto body = static_cast<Index>(m.rigid.size()) - 1;
  for (std::size_t i = 0; i < forces.size(); ++i)
    load.unit.emplace_back(body_dof(m, body, static_cast<int>(i)), forces[i]);
  m.steps.back().dead.push_back(load);
}
/// Prescribes motions of the last rigid body, from `first` on. Needs all nodes.
template <int Dim>
void drive_body(BasicModel<Dim>& m, const Numbers& motion, int first = 0) {
  const auto body = static_cast<Index>(m.rigid.size()) - 1;
  for (std::size_t i = 0; i < motion.size(); ++i)
    m.steps.back().prescribed.push_back(
        {body_dof(m, body, first + static_cast<int>(i)), {0, motion[i], {}}, false});
}

// ---- systems and analyses -----------------------------------------------------------------------

/// Sum of a force on all primary dofs, as seen by a rigid translation of everything.
template <int Dim>
Vec<Dim> resultant(const BasicModel<Dim>& m, const Eigen::VectorXd& force) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  const auto nodes = static_cast<Index>(m.reference.size());
  for (Index n = 0; n < nodes; ++n) sum += force.segment<Dim>(Dim * n);
  for (std::size_t b = 0; b < m.rigid.size(); ++b)
    sum += force.segment<Dim>(body_dof(m, static_cast<Index>(b), 0));
  return sum;
}

/// A converged increment.
template <int Dim>
struct Converged {
  BasicSystem<Dim>& system;
  const BasicModel<Dim>& m;
  const BasicState<Dim>& state;
  const solve::IncrementRecord& record;

  [[nodiscard]] double of_nodes(const std::vector<Index>& nodes, const std::string& what) const {
    return history_value(system, m, state, {"", HistoryRequest::Kind::nodes, -1, nodes, what});
  }
  [[nodiscard]] double of_body(const std::string& what) const {
    return history_value(system, m, state, {"", HistoryRequest::Kind::rigid, 0, {}, what});
  }
  [[nodiscard]] double of_pair(const std::string& what) const {
    return history_value(system, m, state, {"", HistoryRequest::Kind::pair, 0, {}, what});
  }
};

/// Runs all steps; `at_end` sees the last increment.
template <int Dim>
BasicAnalysisResult<Dim> run_to_end(
    const BasicModel<Dim>& m,
    const std::type_identity_t<std::function<void(const Converged<Dim>&)>>& at_end,
    int threads = 1) {
  AnalysisOptions options;
  options.threads = threads;
  int seen = 0;
  BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](BasicSystem<Dim>& system, const BasicState<Dim>& state,
                           const Progress& p, const solve::IncrementRecord* record) {
    if (!record || p.fraction < 1 || p.step + 1 < static_cast<Index>(m.steps.size())) return true;
    ++seen;
    at_end({system, m, state, *record});
    return true;
  };
  BasicAnalysisResult<Dim> result = run(m, options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(seen, 1);
  return result;
}

/// A system in the middle of its first step, displaced at random.
template <int Dim>
struct Probe {
  explicit Probe(const BasicModel<Dim>& m, double amplitude = 0.01) : system(m, 1) {
    start = system.initial_state();
    system.begin_step(m.steps.front(), start);
    base = system.apply(start, random(amplitude), fraction, 1.0);
  }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  BasicSystem<Dim> system;
  BasicState<Dim> start;
  BasicTrial<Dim> base;
  double fraction = 0.5;
  std::mt19937 generator{11};

  Eigen::VectorXd random(double amplitude) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::VectorXd d(system.dofs().unknowns());
    for (Eigen::Index i = 0; i < d.size(); ++i)
      d[i] = system.prescribed(static_cast<Index>(i)) ? 0.0 : amplitude * uniform(generator);
    return d;
  }
  solve::Evaluation at(const BasicTrial<Dim>& state, bool tangent, double when) {
    solve::Evaluation e;
    system.evaluate(start, state, when, tangent, e);
    if (!e.ok) throw std::runtime_error(e.message);
    return e;
  }
  solve::Evaluation at(const BasicTrial<Dim>& state, bool tangent) {
    return at(state, tangent, fraction);
  }
};

/// K d against central differences of the residual, with the longest step that leaves all contact
/// points in their states in one of some directions: short ones see rounding.
template <int Dim>
void expect_second_order(Probe<Dim>& probe, double h = 2e-3) {
  const solve::Evaluation here = probe.at(probe.base, true);
  const la::SparseMatrix k = probe.system.matrix();
  constexpr int directions = 6;
  for (int tried = 0; h > 1e-6; h *= ++tried % directions == 0 ? 0.5 : 1.0) {
    const Eigen::VectorXd d = probe.random(1.0);
    Eigen::VectorXd df = la::multiply(k, d);
    for (Index u = 0; u < df.size(); ++u)
      if (probe.system.prescribed(u)) df[u] = 0;
    bool same = true;
    const auto residual = [&](const Eigen::VectorXd& v) {
      const solve::Evaluation e =
          probe.at(probe.system.apply(probe.base, v, probe.fraction, 1.0), false);
      same = same && e.counts.signature == here.counts.signature;
      return e.residual;
    };
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(d.size());
    const testing::DerivativeReport report = testing::check_derivative(residual, df, zero, d, h);
    if (!same) continue;
    EXPECT_TRUE(report.exact || std::abs(report.order - 2.0) < 0.1)
        << "order " << report.order << ", error " << report.error << ", step " << h;
    return;
  }
  ADD_FAILURE() << "every step changes the state of a contact point";
}

/// What the prediction, residual + K du_prescribed, leaves over is of second order.
template <int Dim>
void expect_first_order_prediction(Probe<Dim>& probe, const BasicState<Dim>& from, double begin) {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(probe.system.dofs().unknowns());
  const auto error = [&](double fraction) {
    solve::Evaluation predicted, moved;
    probe.system.predict(from, fraction, predicted);
    probe.system.evaluate(from, probe.system.apply(from, nothing, fraction, 1.0), fraction, false,
                          moved);
    return (predicted.residual - moved.residual).norm();
  };
  const double rest = error(begin + 2e-3), half = error(begin + 1e-3);
  EXPECT_NEAR(std::log2(rest / half), 2.0, 0.05) << rest << " " << half;
}

}  // namespace osculate::model

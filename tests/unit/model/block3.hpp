#pragma once
// Blocks of hexahedra and systems in space, built by hand.
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "derivative_check.hpp"
#include "osculate/model/analysis.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/system.hpp"

namespace osculate::model {

/// A box of hex8 from `low` to `high` with `n` cells along each axis; inner nodes are moved by up
/// to `distortion` of a cell.
struct BlockSpec {
  Vec3 low{0, 0, 0}, high{1, 1, 1};
  std::array<int, 3> n{2, 2, 2};
  double distortion = 0;
  solid::VolumeSection section{};
};

/// Appends the block to the model as one section; returns its first node.
inline Index add_block(Model3& m, const BlockSpec& b, const std::string& name = "block") {
  const auto first = static_cast<Index>(m.reference.size());
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto at = [&](int i, int j, int k) {
    return first + static_cast<Index>((k * (b.n[1] + 1) + j) * (b.n[0] + 1) + i);
  };
  for (int k = 0; k <= b.n[2]; ++k)
    for (int j = 0; j <= b.n[1]; ++j)
      for (int i = 0; i <= b.n[0]; ++i) {
        const std::array<int, 3> at_node{i, j, k};
        Vec3 x;
        bool inside = true;
        for (std::size_t d = 0; d < 3; ++d) {
          const auto e = static_cast<Eigen::Index>(d);
          x[e] = b.low[e] + (b.high[e] - b.low[e]) * at_node[d] / b.n[d];
          inside = inside && at_node[d] > 0 && at_node[d] < b.n[d];
        }
        for (std::size_t d = 0; inside && d < 3; ++d) {
          const auto e = static_cast<Eigen::Index>(d);
          x[e] += b.distortion * uniform(generator) * (b.high[e] - b.low[e]) / b.n[d];
        }
        m.reference.push_back(x);
      }
  mesh::Block cells{cell::CellType::hex8, {}};
  for (int k = 0; k < b.n[2]; ++k)
    for (int j = 0; j < b.n[1]; ++j)
      for (int i = 0; i < b.n[0]; ++i)
        for (const Index node :
             {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
              at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)})
          cells.connectivity.push_back(node);
  BulkSection3 section{name, b.section, {}};
  const auto block = static_cast<Index>(m.mesh.blocks.size());
  for (Index c = 0; c < cells.size(); ++c) section.cells.push_back({block, c});
  m.mesh.blocks.push_back(std::move(cells));
  m.mesh.nodes = m.reference;
  m.sections.push_back(std::move(section));
  return first;
}

inline std::vector<Index> nodes_where(const Model3& m, const std::function<bool(const Vec3&)>& in) {
  std::vector<Index> nodes;
  for (std::size_t n = 0; n < m.reference.size(); ++n)
    if (in(m.reference[n])) nodes.push_back(static_cast<Index>(n));
  return nodes;
}

/// Quadrilaterals of the top face (highest z) of the last block added.
inline std::vector<std::vector<Index>> top_faces(const Model3& m, double z) {
  std::vector<std::vector<Index>> faces;
  const mesh::Block& cells = m.mesh.blocks.back();
  for (Index c = 0; c < cells.size(); ++c) {
    const Index* n = cells.cell(c);
    if (std::abs(m.reference[static_cast<std::size_t>(n[4])].z() - z) < 1e-12)
      faces.push_back({n[4], n[5], n[6], n[7]});
  }
  return faces;
}

inline void prescribe(Step& step, const std::vector<Index>& nodes, int direction, double value) {
  for (const Index n : nodes) step.prescribed.push_back({3 * n + direction, {0, value, {}}, false});
}

inline Dof body_dof(const Model3& m, Index body, int component) {
  return 3 * static_cast<Dof>(m.reference.size()) + 6 * body + component;
}

/// A rigid body that holds `nodes`.
inline void add_rigid(Model3& m, const Vec3& reference, const std::vector<Index>& nodes) {
  if (m.body_of_node.empty()) m.body_of_node.assign(m.reference.size(), -1);
  m.body_of_node.resize(m.reference.size(), -1);
  for (const Index n : nodes)
    m.body_of_node[static_cast<std::size_t>(n)] = static_cast<Index>(m.rigid.size());
  RigidBody3 body;
  body.name = "tool";
  body.reference = reference;
  body.nodes = nodes;
  m.rigid.push_back(std::move(body));
}

/// A system in the middle of its first step, displaced at random.
struct Probe3 {
  explicit Probe3(const Model3& m, double amplitude = 0.01) : system(m, 1) {
    start = system.initial_state();
    system.begin_step(m.steps.front(), start);
    base = system.apply(start, random(amplitude), fraction, 1.0);
  }
  Probe3(const Probe3&) = delete;
  Probe3& operator=(const Probe3&) = delete;

  System3 system;
  State3 start, base;
  double fraction = 0.5;
  std::mt19937 generator{11};

  Eigen::VectorXd random(double amplitude) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::VectorXd d(system.dofs().unknowns());
    for (Eigen::Index i = 0; i < d.size(); ++i)
      d[i] = system.prescribed(static_cast<Index>(i)) ? 0.0 : amplitude * uniform(generator);
    return d;
  }
  solve::Evaluation at(const State3& state, bool tangent) {
    solve::Evaluation e;
    system.evaluate(start, state, fraction, tangent, e);
    if (!e.ok) throw std::runtime_error(e.message);
    return e;
  }
};

/// K d against central differences of the residual; nothing may change its contact state.
inline testing::DerivativeReport check_tangent(Probe3& probe, double h = 1e-3) {
  const solve::Evaluation here = probe.at(probe.base, true);
  const Eigen::VectorXd d = probe.random(1.0);
  Eigen::VectorXd df = la::multiply(probe.system.matrix(), d);
  for (Index u = 0; u < df.size(); ++u)
    if (probe.system.prescribed(u)) df[u] = 0;
  const auto residual = [&](const Eigen::VectorXd& v) {
    const solve::Evaluation e =
        probe.at(probe.system.apply(probe.base, v, probe.fraction, 1.0), false);
    if (e.counts.signature != here.counts.signature)
      throw std::runtime_error("a contact point changes its state");
    return e.residual;
  };
  return testing::check_derivative(residual, df, Eigen::VectorXd(Eigen::VectorXd::Zero(d.size())),
                                   d, h);
}

}  // namespace osculate::model

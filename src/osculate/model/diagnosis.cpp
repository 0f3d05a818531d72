#include "osculate/model/diagnosis.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <numeric>

namespace osculate::model {
namespace {

/// Connected groups of the nodes used by bulk cells.
std::vector<std::vector<Index>> deformable_bodies(const Model& model) {
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
  for (const BulkSection& section : model.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& block = model.mesh.blocks[static_cast<std::size_t>(ref.block)];
      const Index* const nodes = block.cell(ref.cell);
      for (int k = 0; k < cell::info(block.type).nodes; ++k) {
        used[static_cast<std::size_t>(nodes[k])] = true;
        parent[static_cast<std::size_t>(root(nodes[k]))] = root(nodes[0]);
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

std::string body_name(const Model& model, Index node) {
  for (const BulkSection& section : model.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& block = model.mesh.blocks[static_cast<std::size_t>(ref.block)];
      for (int k = 0; k < cell::info(block.type).nodes; ++k)
        if (block.cell(ref.cell)[k] == node) return section.name;
    }
  return "?";
}

struct Modes {
  Eigen::MatrixXd z;  ///< unknowns x 3
  Vec2 center{0, 0};
  double size = 1;
};

Modes rigid_modes(const System& system, const std::vector<Index>& nodes,
                  const std::vector<Vec2>& x) {
  Modes modes;
  for (const Index n : nodes) modes.center += x[static_cast<std::size_t>(n)];
  modes.center /= static_cast<double>(nodes.size());
  double sum = 0;
  for (const Index n : nodes) sum += (x[static_cast<std::size_t>(n)] - modes.center).squaredNorm();
  modes.size = std::sqrt(sum / static_cast<double>(nodes.size()));
  modes.z = Eigen::MatrixXd::Zero(system.dofs().unknowns(), 3);
  for (const Index n : nodes) {
    const Vec2 turned = turn(x[static_cast<std::size_t>(n)] - modes.center) / modes.size;
    for (int i = 0; i < 2; ++i) {
      const Index u = system.dofs().unknown_of(system.dofs().node_dof(n, i));
      if (u < 0) continue;
      modes.z(u, i) = 1;
      modes.z(u, 2) = turned[i];
    }
  }
  return modes;
}

}  // namespace

std::vector<FreeMotion> free_motions(System& system, const Model& model, const State& state) {
  constexpr double threshold = 1e-6;
  std::vector<FreeMotion> found;
  const std::vector<Vec2> x = system.positions(state);
  const la::SparseMatrix& k = system.matrix();
  double stiffest = 0;
  for (Index row = 0; row < k.n; ++row)
    for (Index e = k.row_start[static_cast<std::size_t>(row)];
         e < k.row_start[static_cast<std::size_t>(row) + 1]; ++e)
      if (k.column[static_cast<std::size_t>(e)] == row && !system.prescribed(row))
        stiffest = std::max(stiffest, std::abs(k.value[static_cast<std::size_t>(e)]));
  for (const std::vector<Index>& nodes : deformable_bodies(model)) {
    const Modes modes = rigid_modes(system, nodes, x);
    Eigen::MatrixXd kz(k.n, 3);
    bool held = false;
    for (Index u = 0; u < k.n; ++u)
      if (system.prescribed(u) && modes.z.row(u).norm() > 0) held = true;
    for (int j = 0; j < 3; ++j) kz.col(j) = la::multiply(k, modes.z.col(j));
    if (held) continue;  // prescribed nodes hold this body; contact alone decides for the others
    const Eigen::Matrix3d g = modes.z.transpose() * kz;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(g, Eigen::ComputeFullU | Eigen::ComputeFullV);
    for (int j = 0; j < 3; ++j) {
      const double ratio = stiffest > 0 ? svd.singularValues()[j] / stiffest : 0.0;
      if (ratio > threshold) continue;
      FreeMotion motion;
      motion.body = body_name(model, nodes.front());
      const Eigen::Vector3d v = svd.matrixV().col(j);
      motion.direction = v.head<2>();
      if (motion.direction.norm() > 1e-6) motion.direction.normalize();
      Eigen::Index largest = 0;
      motion.direction.cwiseAbs().maxCoeff(&largest);
      if (motion.direction[largest] < 0) motion.direction = -motion.direction;
      for (double& component : motion.direction)
        if (std::abs(component) < 1e-9) component = 0.0;
      motion.rotation = std::abs(v[2]) > 1e-6 ? v[2] : 0.0;
      motion.center = modes.center;
      motion.stiffness_ratio = ratio;
      found.push_back(motion);
    }
  }
  return found;
}

std::string free_motion_message(System& system, const Model& model, const State& state) {
  solve::Evaluation unused;
  system.evaluate(state, state, state.fraction, true, unused);
  std::string text;
  for (const FreeMotion& motion : free_motions(system, model, state)) {
    if (!text.empty()) text += "; ";
    text += fmt::format("body '{}' is free to ", motion.body);
    const bool turns = std::abs(motion.rotation) > 0.5;
    if (turns)
      text += fmt::format("turn about ({:.4g}, {:.4g})", motion.center.x(), motion.center.y());
    else
      text +=
          fmt::format("move along ({:.4f}, {:.4f})", motion.direction.x(), motion.direction.y());
    text += fmt::format(" (resistance {:.1e} of its stiffness)", motion.stiffness_ratio);
  }
  return text;
}

}  // namespace osculate::model

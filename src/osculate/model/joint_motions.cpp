#include "osculate/model/joint_motions.hpp"

#include <algorithm>
#include <numeric>

#include "osculate/core/dense.hpp"

namespace osculate::model {
namespace {

constexpr double threshold = 1e-6;

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, const std::vector<Index>& rows) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), all.cols());
  for (std::size_t r = 0; r < rows.size(); ++r)
    out.row(static_cast<Eigen::Index>(r)) = all.row(rows[r]);
  return out;
}

/// An orthonormal basis of the columns, what is small left out.
Eigen::MatrixXd range_of(const Eigen::MatrixXd& columns) {
  constexpr double visible = 1e-3;
  const core::SingularValues svd = core::singular_values(columns);
  Eigen::Index count = 0;
  while (count < svd.values.size() && svd.values[count] > visible) ++count;
  return svd.u.leftCols(count);
}

}  // namespace

CompactModes compact(const Eigen::MatrixXd& z) {
  CompactModes modes;
  for (Eigen::Index u = 0; u < z.rows(); ++u)
    if (!z.row(u).isZero(0)) modes.unknowns.push_back(static_cast<Index>(u));
  modes.z = rows_of(z, modes.unknowns);
  return modes;
}

RigidStiffness::RigidStiffness(const la::SparseMatrix& k, const std::vector<CompactModes>& modes,
                               double stiffest)
    : blocks_(modes.size()), stiffest_(stiffest) {
  for (std::size_t b = 0; b < modes.size(); ++b) {
    Eigen::MatrixXd kz(k.n, modes[b].z.cols());
    for (Eigen::Index j = 0; j < kz.cols(); ++j) {
      Eigen::VectorXd motion = Eigen::VectorXd::Zero(k.n);
      for (std::size_t r = 0; r < modes[b].unknowns.size(); ++r)
        motion[modes[b].unknowns[r]] = modes[b].z(static_cast<Eigen::Index>(r), j);
      kz.col(j) = la::multiply(k, motion);
    }
    for (std::size_t a = 0; a < modes.size(); ++a) {
      const Eigen::MatrixXd block = modes[a].z.transpose() * rows_of(kz, modes[a].unknowns);
      if (a == b || block.cwiseAbs().maxCoeff() > threshold * stiffest) blocks_[b][a] = block;
    }
  }
}

FreeCombinations RigidStiffness::free_of(const std::vector<std::size_t>& bodies) const {
  std::vector<Eigen::Index> start{0};
  for (const std::size_t b : bodies) start.push_back(start.back() + motions(b));
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(start.back(), start.back());
  for (std::size_t j = 0; j < bodies.size(); ++j)
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (const auto found = blocks_[bodies[j]].find(bodies[i]); found != blocks_[bodies[j]].end())
        g.block(start[i], start[j], found->second.rows(), found->second.cols()) = found->second;
  const core::SingularValues svd = core::singular_values(g);
  Eigen::Index first = 0;  // singular values fall
  while (first < g.cols() && svd.values[first] > threshold * stiffest_) ++first;
  const Eigen::Index count = g.cols() - first;
  FreeCombinations free{svd.v.rightCols(count), Eigen::VectorXd::Zero(count)};
  if (stiffest_ > 0) free.ratios = svd.values.tail(count) / stiffest_;
  return free;
}

std::vector<std::vector<std::size_t>> RigidStiffness::tied() const {
  std::vector<std::size_t> group(blocks_.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (const auto& [a, block] : blocks_[b])
      if (const std::size_t from = group[a], to = group[b]; from != to)
        std::replace(group.begin(), group.end(), from, to);
  std::vector<std::vector<std::size_t>> found(blocks_.size());
  for (std::size_t b = 0; b < group.size(); ++b) found[group[b]].push_back(b);
  std::erase_if(found, [](const std::vector<std::size_t>& bodies) { return bodies.size() < 2; });
  return found;
}

std::vector<JointMotions> joint_motions(const RigidStiffness& stiffness) {
  constexpr std::size_t most = 50;  // a dense decomposition of more takes too long
  std::vector<JointMotions> found;
  for (const std::vector<std::size_t>& bodies : stiffness.tied()) {
    if (bodies.size() > most) continue;
    const FreeCombinations together = stiffness.free_of(bodies);
    Eigen::Index alone = 0;
    for (const std::size_t b : bodies) alone += stiffness.free_of({b}).count();
    if (together.count() <= alone) continue;
    JointMotions joint{bodies, {}, together.ratios.maxCoeff()};
    Eigen::Index row = 0;
    for (const std::size_t b : bodies) {
      joint.motions.push_back(range_of(together.columns.middleRows(row, stiffness.motions(b))));
      row += stiffness.motions(b);
    }
    found.push_back(std::move(joint));
  }
  return found;
}

}  // namespace osculate::model

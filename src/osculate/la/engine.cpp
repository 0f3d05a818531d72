#include "osculate/la/engine.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "osculate/la/grouped_rows.hpp"
#include "osculate/la/multigrid.hpp"
#include "osculate/la/mumps.hpp"

namespace osculate::la {

Eigen::MatrixXd rigid_motions(const Places& places, const std::vector<char>& alone) {
  const int dim = places.dimension;
  const auto n = static_cast<Index>(places.node.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : places.place) middle += x / n;
  double size = 0;
  for (const Eigen::Vector3d& x : places.place) size = std::max(size, (x - middle).norm());
  if (!(size > 0)) size = 1;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(n, dim == 3 ? 6 : 3);
  for (Index i = 0; i < n; ++i) {
    if (places.node[as_size(i)] < 0 || alone[as_size(i)] != 0) continue;
    const int k = places.direction[as_size(i)];
    const Eigen::Vector3d x = (places.place[as_size(i)] - middle) / size;
    motions(i, k) = 1;
    for (int axis = dim == 3 ? 0 : 2; axis < 3; ++axis)
      motions(i, dim == 3 ? 3 + axis : 2) = Eigen::Vector3d::Unit(axis).cross(x)[k];
  }
  return motions;
}

namespace {

/// Unknowns of one node that follow each other are a group; those of no node are one each.
GroupStarts groups_of(const Places& places) {
  GroupStarts start{0};
  const auto n = static_cast<Index>(places.node.size());
  for (Index i = 1; i <= n; ++i)
    if (i == n || places.node[as_size(i)] < 0 ||
        places.node[as_size(i)] != places.node[as_size(i - 1)])
      start.push_back(i);
  return start;
}

std::vector<char> standing_alone(const CompressedRows& a) {
  std::vector<char> alone(as_size(static_cast<Index>(a.rows())), 1);
  for (Index i = 0; i < a.rows(); ++i)
    for (CompressedRows::InnerIterator entry(a, i); entry; ++entry)
      if (entry.col() != i) alone[as_size(i)] = 0;
  return alone;
}

/// What is solved for directly: rows and columns of the matrix that are of contact.
class Exact {
 public:
  /// False: singular.
  bool factor(const CompressedRows& a, const Places& places, Symmetry symmetry,
              const MumpsOptions& options) {
    const auto n = static_cast<Index>(a.rows());
    unknowns_.clear();
    std::vector<Index> position(as_size(n), -1);
    for (Index i = 0; i < n; ++i)
      if (places.exact[as_size(i)] != 0 || places.node[as_size(i)] < 0) {
        position[as_size(i)] = static_cast<Index>(unknowns_.size());
        unknowns_.push_back(i);
      }
    if (unknowns_.empty()) return true;
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index i = 0; i < n; ++i)
      for (CompressedRows::InnerIterator entry(a, i); entry; ++entry)
        if (const Index j = position[as_size(entry.col())]; j >= 0)
          entries.emplace_back(i, j, entry.value());
    columns_.resize(n, static_cast<Index>(unknowns_.size()));
    columns_.setFromTriplets(entries.begin(), entries.end());
    SparseMatrix few;
    few.n = static_cast<Index>(unknowns_.size());
    few.row_start = {0};
    for (const Index i : unknowns_) {
      for (CompressedRows::InnerIterator entry(columns_, i); entry; ++entry) {
        few.column.push_back(static_cast<Index>(entry.col()));
        few.value.push_back(entry.value());
      }
      few.row_start.push_back(static_cast<Index>(few.column.size()));
    }
    direct_ = std::make_unique<Mumps>(options);
    return direct_->factor(few, 0, symmetry).status == SolveStatus::ok;
  }
  [[nodiscard]] bool any() const { return !unknowns_.empty(); }
  /// few = K_cc^-1 r_c , and r gets the residual that they leave; false: it cannot be.
  bool apply(int threads, Eigen::VectorXd& r, Eigen::VectorXd& few) {
    few = r(unknowns_);
    if (direct_->solve(few) != SolveStatus::ok) return false;
    Eigen::VectorXd balanced;
    multiply(columns_, few, threads, balanced);
    r -= balanced;
    return true;
  }
  void add(const Eigen::VectorXd& few, Eigen::VectorXd& x) const { x(unknowns_) += few; }
  void forget() {
    direct_.reset();
    unknowns_.clear();
    columns_ = {};
  }

 private:
  std::vector<Index> unknowns_;
  CompressedRows columns_;
  std::unique_ptr<Mumps> direct_;
};

class MultigridEngine final : public Engine {
 public:
  bool build(const SparseMatrix& k, Symmetry symmetry, const Places& places) override {
    a_ = {};
    if (!build(compressed(k, symmetry), symmetry, places)) return false;
    take(compressed(k, symmetry), places);  // not before: the coarser models take most memory
    return true;
  }
  bool refresh(const SparseMatrix& k, Symmetry symmetry, const Places& places) override {
    threads_ = places.threads;
    symmetry_ = symmetry;
    if (!bodies_) return false;
    a_ = {};
    const CompressedRows a = compressed(k, symmetry);
    take(a, places);
    return bodies_->refresh(a) && exact_.factor(a, places, symmetry, {});
  }
  bool build_again(const Places& places) override { return build(a_.as_rows(), symmetry_, places); }
  Nearby solve(const PreconditionedLimits& limits, Eigen::VectorXd& rhs) override {
    return solve_preconditioned(
        [this](const Eigen::VectorXd& x, Eigen::VectorXd& y) { a_.multiply(x, threads_, y); },
        [this](Eigen::VectorXd& r) { return precondition(r); }, limits, rhs);
  }
  [[nodiscard]] Eigen::VectorXd diagonal() const override { return diagonal_; }
  [[nodiscard]] SparseMatrix matrix() const override { return stored(a_.as_rows()); }
  void forget() override {
    exact_.forget();
    bodies_.reset();
    a_ = {};
  }

 private:
  bool build(CompressedRows&& a, Symmetry symmetry, const Places& places) {
    threads_ = places.threads;
    symmetry_ = symmetry;
    if (!exact_.factor(a, places, symmetry, {})) return false;
    bodies_ = std::make_unique<Multigrid>(threads_);
    Eigen::MatrixXd motions = rigid_motions(places, standing_alone(a));
    return bodies_->build(std::move(a), groups_of(places), std::move(motions));
  }
  void take(const CompressedRows& a, const Places& places) {
    a_ = GroupedRows<double>(a, groups_of(places));
    diagonal_ = Eigen::VectorXd(a.diagonal()).cwiseAbs();
  }
  bool precondition(Eigen::VectorXd& r) {
    if (!exact_.any()) return bodies_->apply(r);
    Eigen::VectorXd few;
    if (!exact_.apply(threads_, r, few) || !bodies_->apply(r)) return false;
    exact_.add(few, r);
    return true;
  }

  GroupedRows<double> a_;
  Eigen::VectorXd diagonal_;
  std::unique_ptr<Multigrid> bodies_;
  Exact exact_;
  Symmetry symmetry_ = Symmetry::unsymmetric;
  int threads_ = 1;
};

}  // namespace

std::unique_ptr<Engine> make_multigrid_engine() { return std::make_unique<MultigridEngine>(); }

}  // namespace osculate::la

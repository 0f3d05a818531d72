#include "osculate/la/engine.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "osculate/la/dealt_mumps.hpp"
#include "osculate/la/dealt_rows.hpp"
#include "osculate/la/grouped_rows.hpp"
#include "osculate/la/multigrid.hpp"

namespace osculate::la {

namespace {

/// Where the unknowns of the rows here are.
struct Part {
  Dealt dealt;
  Halo halo;
  std::vector<Index> unknowns;  ///< those here, own ones first; none, where all are

  [[nodiscard]] Index unknown(Index here) const {
    return dealt.ranks ? unknowns[as_size(here)] : here;
  }
  [[nodiscard]] Eigen::VectorXd own(const Eigen::VectorXd& all) const {
    if (dealt.ranks) return all(unknowns).head(halo.own());
    return all;
  }
  [[nodiscard]] Eigen::VectorXd all(Eigen::VectorXd&& own) const {
    if (dealt.ranks) return halo.gathered(own)(dealt.number);
    return std::move(own);
  }
};

/// Own unknowns of one node that follow each other are a group; those of no node are one each.
GroupStarts groups_of(const Places& places, const Part& part) {
  GroupStarts start{0};
  const auto node = [&](Index i) { return places.node[as_size(part.unknown(i))]; };
  for (Index i = 1; i <= part.halo.own(); ++i)
    if (i == part.halo.own() || node(i) < 0 || node(i) != node(i - 1)) start.push_back(i);
  return start;
}

std::vector<char> standing_alone(const CompressedRows& a) {
  std::vector<char> alone(as_size(static_cast<Index>(a.rows())), 1);
  for (Index i = 0; i < a.rows(); ++i)
    for (CompressedRows::InnerIterator entry(a, i); entry; ++entry)
      if (entry.col() != i) alone[as_size(i)] = 0;
  return alone;
}

/// Translations of the nodes of own unknowns, and rotations about the middle of all. Zero of an
/// unknown that has nothing to do with others, as where its motion is prescribed, or of no node.
///
/// Shapes     a row per own unknown, three columns in the plane and six in space
Eigen::MatrixXd own_motions(const CompressedRows& a, const Places& places, const Part& part) {
  const int dim = places.dimension;
  const auto n = static_cast<Index>(places.node.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : places.place) middle += x / n;
  double size = 0;
  for (const Eigen::Vector3d& x : places.place) size = std::max(size, (x - middle).norm());
  if (!(size > 0)) size = 1;
  const std::vector<char> alone = standing_alone(a);
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(a.rows(), dim == 3 ? 6 : 3);
  for (Index i = 0; i < a.rows(); ++i) {
    const std::size_t u = as_size(part.unknown(i));
    if (places.node[u] < 0 || alone[as_size(i)] != 0) continue;
    const int k = places.direction[u];
    const Eigen::Vector3d x = (places.place[u] - middle) / size;
    motions(i, k) = 1;
    for (int axis = dim == 3 ? 0 : 2; axis < 3; ++axis)
      motions(i, dim == 3 ? 3 + axis : 2) = Eigen::Vector3d::Unit(axis).cross(x)[k];
  }
  return motions;
}

/// What is solved for directly: rows and columns of the matrix that are of contact.
class Exact {
 public:
  /// False: singular.
  bool factor(const CompressedRows& a, const Places& places, const Part& part, Symmetry symmetry,
              const MumpsOptions& options) {
    unknowns_.clear();
    own_.clear();
    std::vector<Index> position(places.node.size(), -1);
    for (std::size_t u = 0; u < position.size(); ++u)
      if (places.exact[u] != 0 || places.node[u] < 0) {
        position[u] = static_cast<Index>(unknowns_.size());
        unknowns_.push_back(static_cast<Index>(u));
      }
    if (unknowns_.empty()) return true;
    for (Index i = 0; i < a.rows(); ++i)
      if (const Index j = position[as_size(part.unknown(i))]; j >= 0) own_.push_back({i, j});
    ranks_ = part.dealt.ranks;
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index i = 0; i < a.rows(); ++i)
      for (CompressedRows::InnerIterator entry(a, i); entry; ++entry)
        if (const Index j = position[as_size(part.unknown(static_cast<Index>(entry.col())))];
            j >= 0)
          entries.emplace_back(i, j, entry.value());
    columns_.resize(static_cast<Index>(a.rows()), static_cast<Index>(unknowns_.size()));
    columns_.setFromTriplets(entries.begin(), entries.end());
    direct_ = std::make_unique<DealtMumps>(options);
    return direct_->factor(few_rows(part), 0, symmetry).status == SolveStatus::ok;
  }
  [[nodiscard]] bool any() const { return !unknowns_.empty(); }
  /// K_cc^-1 r_c , of all of them; false: it cannot be.
  bool solve(const Eigen::VectorXd& own, Eigen::VectorXd& few) {
    few = Eigen::VectorXd::Constant(static_cast<Index>(unknowns_.size()), core::Ranks::nothing);
    for (const auto& [i, j] : own_) few[j] = own[i];
    if (ranks_) ranks_->sum({few.data(), unknowns_.size()});
    return direct_->solve(few) == SolveStatus::ok;
  }
  /// What they are balanced by, of own rows.
  void balance(const Eigen::VectorXd& few, int threads, Eigen::VectorXd& own) const {
    Eigen::VectorXd balanced;
    multiply(columns_, few, threads, balanced);
    own -= balanced;
  }
  void add(const Eigen::VectorXd& few, Eigen::VectorXd& own) const {
    for (const auto& [i, j] : own_) own[i] += few[j];
  }

 private:
  [[nodiscard]] SparseMatrix few_rows(const Part& part) const {
    SparseMatrix few;
    few.n = static_cast<Index>(unknowns_.size());
    few.ranks = part.dealt.ranks;
    few.row_start = {0};
    for (const Index u : unknowns_) {
      if (part.dealt.is_here(u)) {
        const Index row = few.ranks ? part.dealt.number[as_size(u)] - part.halo.begin() : u;
        for (CompressedRows::InnerIterator entry(columns_, row); entry; ++entry) {
          few.column.push_back(static_cast<Index>(entry.col()));
          few.value.push_back(entry.value());
        }
      }
      few.row_start.push_back(static_cast<Index>(few.column.size()));
    }
    return few;
  }

  std::vector<Index> unknowns_;
  std::vector<std::pair<Index, Index>> own_;  ///< own unknowns, and which of these each is
  const core::Ranks* ranks_ = nullptr;
  CompressedRows columns_;
  std::unique_ptr<DealtMumps> direct_;
};

class MultigridEngine final : public Engine {
 public:
  explicit MultigridEngine(const MumpsOptions& direct) : direct_(direct) {}

  bool build(const SparseMatrix& k, Symmetry symmetry, const Places& places) override {
    a_ = {};
    part_ = {};
    part_.dealt = dealt_as(k);
    if (!build(take_part(k, symmetry), symmetry, places)) return false;
    take(take_part(k, symmetry), places);  // not before: the coarser models take most memory
    return true;
  }
  bool refresh(const SparseMatrix& k, Symmetry symmetry, const Places& places) override {
    threads_ = places.threads;
    symmetry_ = symmetry;
    if (!bodies_ || !deals(part_.dealt, k)) return false;
    a_ = {};
    const CompressedRows a = take_part(k, symmetry);
    take(a, places);
    return bodies_->refresh(a, part_.halo) && exact_.factor(a, places, part_, symmetry, direct_);
  }
  bool build_again(const Places& places) override { return build(a_.as_rows(), symmetry_, places); }
  Nearby solve(const PreconditionedLimits& limits, Eigen::VectorXd& rhs) override {
    PreconditionedSolutions by(
        [this](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
          if (!part_.dealt.ranks) return a_.multiply(x, threads_, y);
          Eigen::VectorXd here = x;
          here.conservativeResize(part_.halo.here());
          part_.halo.update(here);
          a_.multiply(here, threads_, y);
        },
        [this](Eigen::VectorXd& r) { return precondition(r); }, part_.dealt.ranks);
    Eigen::VectorXd own = part_.own(rhs);
    const Nearby done = by.solve(limits, own);
    if (done.solved) rhs = part_.all(std::move(own));
    return done;
  }
  [[nodiscard]] Eigen::VectorXd diagonal() const override { return diagonal_; }
  [[nodiscard]] SparseMatrix matrix() const override {
    return matrix_of(a_.as_rows(), part_.halo, part_.dealt);
  }

 private:
  /// Rows of this process with columns here.
  CompressedRows take_part(const SparseMatrix& k, Symmetry symmetry) {
    RowsHere rows = rows_here(k, symmetry, part_.dealt);
    part_.halo = std::move(rows.halo);
    part_.unknowns.clear();
    for (Index i = 0; part_.dealt.ranks && i < part_.halo.here(); ++i)
      part_.unknowns.push_back(part_.dealt.unknown[as_size(part_.halo.number_everywhere(i))]);
    return taken(rows.a);
  }
  bool build(CompressedRows&& a, Symmetry symmetry, const Places& places) {
    threads_ = places.threads;
    symmetry_ = symmetry;
    if (!exact_.factor(a, places, part_, symmetry, direct_)) return false;
    bodies_ = std::make_unique<Multigrid>(threads_);
    Eigen::MatrixXd motions = own_motions(a, places, part_);
    return bodies_->build(std::move(a), part_.halo, groups_of(places, part_), std::move(motions));
  }
  void take(const CompressedRows& a, const Places& places) {
    a_ = GroupedRows<double>(a, groups_of(places, part_));
    diagonal_ = part_.all(Eigen::VectorXd(a.diagonal()).cwiseAbs());
  }
  bool precondition(Eigen::VectorXd& own) {
    Eigen::VectorXd few;
    if (exact_.any() && !exact_.solve(own, few)) return false;
    if (exact_.any()) exact_.balance(few, threads_, own);
    if (!bodies_->apply(own)) return false;
    if (exact_.any()) exact_.add(few, own);
    return true;
  }

  MumpsOptions direct_;
  Part part_;
  GroupedRows<double> a_;
  Eigen::VectorXd diagonal_;
  std::unique_ptr<Multigrid> bodies_;
  Exact exact_;
  Symmetry symmetry_ = Symmetry::unsymmetric;
  int threads_ = 1;
};

}  // namespace

std::unique_ptr<Engine> make_multigrid_engine(const MumpsOptions& direct) {
  return std::make_unique<MultigridEngine>(direct);
}

}  // namespace osculate::la

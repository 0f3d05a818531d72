#include "osculate/la/engine.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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
  std::vector<Index> here;      ///< of each unknown, likewise; -1 where it is none of them

  [[nodiscard]] Index unknown(Index here) const {
    return dealt.ranks ? unknowns[as_size(here)] : here;
  }
  /// Calls take(column here, value) for what is not zero in an own row, in the order of the
  /// columns. A column that is not here has the number behind them.
  template <class Take>
  void for_each_in_row(const SparseMatrix& k, Index row, const Take& take) const {
    const std::size_t u = as_size(unknown(row));
    std::vector<std::pair<Index, double>> others;
    for (Index e = k.row_start[u]; e < k.row_start[u + 1]; ++e) {
      const Index column = k.column[as_size(e)];
      const double value = k.value[as_size(e)];
      if (value == 0) continue;
      if (!dealt.ranks)
        take(column, value);
      else if (const Index j = here[as_size(column)]; j >= 0 && j < halo.own())
        take(j, value);
      else
        others.emplace_back(j < 0 ? halo.here() : j, value);
    }
    if (others.empty()) return;
    std::ranges::sort(others, {}, &std::pair<Index, double>::first);
    for (const auto& [j, value] : others) take(j, value);
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

std::vector<char> standing_alone(const GroupedRows& a) {
  std::vector<char> alone(as_size(a.rows()), 1);
  a.for_each([&](Index row, Index column, double) {
    if (column != row) alone[as_size(row)] = 0;
  });
  return alone;
}

/// Translations of the nodes of own unknowns, and rotations about the middle of all. Zero of an
/// unknown that has nothing to do with others, as where its motion is prescribed, or of no node.
///
/// Shapes     a row per own unknown, three columns in the plane and six in space
Eigen::MatrixXd own_motions(const GroupedRows& a, const Places& places, const Part& part) {
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

/// Whether factors of A will do for a preconditioner of B, which may have other places for entries:
/// in the measure of the rows' largest entries no row has changed by more than that, and no entry
/// of the diagonal has lost half of itself.
///
/// Formula    sum_j |A_ij - B_ij| / (s_i s_j) <= 1 , B_ii >= A_ii / 2 , s_i^2 the largest entry of
///            row i of A
bool alike(const SparseMatrix& a, const SparseMatrix& b) {
  constexpr double most = 1, left = 0.5;
  if (a.n != b.n) return false;
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(a.n), row = scale;
  const auto each = [](const SparseMatrix& of, Index i, const auto& take) {
    for (Index e = of.row_start[as_size(i)]; e < of.row_start[as_size(i) + 1]; ++e)
      take(of.column[as_size(e)], of.value[as_size(e)]);
  };
  for (Index i = 0; i < a.n; ++i)
    each(a, i, [&](Index, double v) { scale[i] = std::max(scale[i], std::abs(v)); });
  if (a.ranks) a.ranks->largest({scale.data(), as_size(a.n)});
  for (double& s : scale) s = s > 0 ? std::sqrt(s) : 1.0;
  bool same = true;
  for (Index i = 0; i < a.n; ++i) {
    double change = 0;
    const auto take = [&](Index j, double) {
      change += std::abs(row[j]) / scale[j];
      row[j] = 0;
    };
    each(a, i, [&](Index j, double v) { row[j] = v; });
    const double before = row[i];
    each(b, i, [&](Index j, double v) { row[j] -= v; });
    same = same && std::copysign(row[i], before * row[i]) <= (1 - left) * std::abs(before);
    each(a, i, take);
    each(b, i, take);
    same = same && change <= most * scale[i];
  }
  return same;
}

/// What is solved for directly: rows and columns of the matrix that are of contact.
class Exact {
 public:
  /// `may_keep`: factors of an earlier matrix serve on where that was alike. False: singular.
  bool factor(const GroupedRows& a, const Places& places, const Part& part, Symmetry symmetry,
              const MumpsOptions& options, bool may_keep) {
    kept_ = false;
    take_columns(a, places, part);
    if (unknowns_.empty()) return true;
    SparseMatrix few = few_rows(part);
    kept_ = may_keep && direct_ && symmetry == symmetry_ && alike(factored_, few);
    if (ranks_) kept_ = ranks_->all(kept_);
    if (kept_) return true;
    factored_ = {};  // the factors are gone where an error ends what follows
    if (!direct_) direct_ = std::make_unique<DealtMumps>(options);
    if (direct_->factor(few, 0, symmetry).status != SolveStatus::ok) return false;
    factored_ = std::move(few);
    symmetry_ = symmetry;
    return true;
  }
  [[nodiscard]] bool kept() const { return kept_; }
  [[nodiscard]] bool any() const { return !unknowns_.empty(); }
  /// K_cc^-1 r_c , of all of them; false: it cannot be.
  bool solve(const Eigen::VectorXd& own, Eigen::VectorXd& few) {
    few = Eigen::VectorXd::Constant(static_cast<Index>(unknowns_.size()), core::Ranks::nothing);
    for (const auto& [i, j] : own_) few[j] = own[i];
    if (ranks_) ranks_->sum({few.data(), unknowns_.size()});
    return direct_->solve_once(few) == SolveStatus::ok;
  }
  /// What they are balanced by, of own rows.
  void balance(const Eigen::VectorXd& few, core::Crew& crew, Eigen::VectorXd& own) const {
    Eigen::VectorXd balanced;
    multiply(columns_, few, crew, balanced);
    own -= balanced;
  }
  void add(const Eigen::VectorXd& few, Eigen::VectorXd& own) const {
    for (const auto& [i, j] : own_) own[i] += few[j];
  }

 private:
  void take_columns(const GroupedRows& a, const Places& places, const Part& part) {
    unknowns_.clear();
    own_.clear();
    std::vector<Index> position(places.node.size(), -1);
    for (std::size_t u = 0; u < position.size(); ++u)
      if (places.exact[u] != 0 || places.node[u] < 0) {
        position[u] = static_cast<Index>(unknowns_.size());
        unknowns_.push_back(static_cast<Index>(u));
      }
    if (unknowns_.empty()) return;
    for (Index i = 0; i < a.rows(); ++i)
      if (const Index j = position[as_size(part.unknown(i))]; j >= 0) own_.push_back({i, j});
    ranks_ = part.dealt.ranks;
    std::vector<Eigen::Triplet<double, Index>> entries;
    std::vector<Index> before{0};
    for (Index column = 0; column < part.halo.here(); ++column)
      before.push_back(before.back() + (position[as_size(part.unknown(column))] >= 0 ? 1 : 0));
    a.for_each(before, [&](Index i, Index column, double value) {
      entries.emplace_back(i, position[as_size(part.unknown(column))], value);
    });
    columns_.resize(a.rows(), static_cast<Index>(unknowns_.size()));
    columns_.setFromTriplets(entries.begin(), entries.end());
  }
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
  SparseMatrix factored_;
  bool kept_ = false;  ///< by the last `factor`
  Symmetry symmetry_ = Symmetry::unsymmetric;
};

class MultigridEngine final : public Engine {
 public:
  explicit MultigridEngine(const MumpsOptions& direct) : direct_(direct) {}

  bool build(const SparseMatrix& k, Symmetry symmetry, const Places& places) override {
    call_crew(places.threads);
    a_ = {};
    bodies_.reset();
    part_ = {};
    part_.dealt = dealt_as(k);
    symmetry_ = symmetry;
    take(take_part(k, symmetry), places);
    remember(k);
    return build_again(places);
  }
  bool refresh(const SparseMatrix& k, Symmetry symmetry, const Places& places) override {
    call_crew(places.threads);
    symmetry_ = symmetry;
    if (!bodies_ || !deals(part_.dealt, k)) return false;
    std::vector<char> differs;
    const bool fits = update(k, symmetry, places, differs);
    in_step_ = bodies_->refresh(a_, fits ? &differs : nullptr, part_.halo);
    return in_step_ && exact_.factor(a_, places, part_, symmetry, direct_, true);
  }
  [[nodiscard]] bool keeps_factors() const override { return exact_.kept(); }
  bool build_again(const Places& places) override {
    call_crew(places.threads);
    in_step_ = false;
    if (!exact_.factor(a_, places, part_, symmetry_, direct_, false)) return false;
    bodies_ = std::make_unique<Multigrid>(*crew_);
    in_step_ = bodies_->build(a_, part_.halo, own_motions(a_, places, part_));
    return in_step_;
  }
  Nearby solve(const PreconditionedLimits& limits, Eigen::VectorXd& rhs) override {
    PreconditionedSolutions by(
        [this](const Eigen::VectorXd& x, Eigen::VectorXd& y) { multiply_own(x, y); },
        [this](Eigen::VectorXd& r) { return precondition(r); }, part_.dealt.ranks, crew_.get());
    Eigen::VectorXd own = part_.own(rhs);
    const Nearby done = by.solve(limits, own);
    if (done.solved) rhs = part_.all(std::move(own));
    return done;
  }
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& x) override {
    Eigen::VectorXd own;
    multiply_own(part_.own(x), own);
    return part_.all(std::move(own));
  }
  [[nodiscard]] Eigen::VectorXd diagonal() const override { return diagonal_; }
  [[nodiscard]] SparseMatrix matrix() const override {
    return matrix_of(a_.as_rows(), part_.halo, part_.dealt);
  }

 private:
  void call_crew(int threads) {
    if (crew_ && crew_->threads() == threads) return;
    bodies_.reset();
    crew_ = std::make_unique<core::Crew>(threads);
  }
  /// Rows of this process with columns here.
  CompressedRows take_part(const SparseMatrix& k, Symmetry symmetry) {
    RowsHere rows = rows_here(k, symmetry, part_.dealt, *crew_);
    part_.halo = std::move(rows.halo);
    part_.unknowns.clear();
    if (part_.dealt.ranks) {
      part_.here.assign(as_size(k.n), -1);
      for (Index i = 0; i < part_.halo.here(); ++i) {
        part_.unknowns.push_back(part_.dealt.unknown[as_size(part_.halo.number_everywhere(i))]);
        part_.here[as_size(part_.unknowns.back())] = i;
      }
    }
    return taken(rows.a);
  }
  /// Takes a matrix. False: not as one with the places for entries that the last one had.
  bool update(const SparseMatrix& k, Symmetry symmetry, const Places& places,
              std::vector<char>& differs) {
    const bool may = std::exchange(in_step_, false) && a_.rows() == part_.halo.own() &&
                     (part_.dealt.ranks || a_.rows() == k.n);
    bool fits = false;
    if (symmetry == Symmetry::unsymmetric) {
      const auto rows = [&](Index i, const auto& each) { part_.for_each_in_row(k, i, each); };
      const std::vector<char> near = may ? groups_that_may_differ(k) : std::vector<char>{};
      fits =
          part_.halo.all(may && a_.update(rows, *crew_, differs, near.empty() ? nullptr : &near));
      if (!fits) a_ = {};
      if (!fits) take(take_part(k, symmetry), places);
    } else {
      const std::vector<Index> others = part_.halo.others();
      const CompressedRows a = take_part(k, symmetry);
      const auto rows = [&](Index i, const auto& each) {
        for (CompressedRows::InnerIterator entry(a, i); entry; ++entry)
          each(static_cast<Index>(entry.col()), entry.value());
      };
      fits =
          part_.halo.all(may && others == part_.halo.others() && a_.update(rows, *crew_, differs));
      if (!fits) take(a, places);
    }
    if (fits) take_diagonal(&differs);
    remember(k);
    return fits;
  }
  void remember(const SparseMatrix& k) {
    mark_ = k.mark;
    touched_ = k.touched;
  }
  /// Groups of rows that this matrix or the last one that was taken has touched; nothing, where
  /// that says nothing of the others.
  [[nodiscard]] std::vector<char> groups_that_may_differ(const SparseMatrix& k) const {
    if (k.mark == nullptr || k.mark != mark_) return {};
    const GroupStarts& start = a_.groups();
    std::vector<char> may(start.size() - 1, 0);
    for (const std::vector<Index>* const rows : {&k.touched, &touched_})
      for (const Index u : *rows) {
        const Index row = part_.dealt.ranks ? part_.here[as_size(u)] : u;
        may[as_size(static_cast<Index>(std::ranges::upper_bound(start, row) - start.begin() - 1))] =
            1;
      }
    return may;
  }
  void take(const CompressedRows& a, const Places& places) {
    a_ = {};
    mark_.reset();
    a_ = GroupedRows(a, groups_of(places, part_), *crew_);
    take_diagonal();
  }
  /// `differs`: of the groups, whether there are others than before; null: of all of them.
  void take_diagonal(const std::vector<char>* differs = nullptr) {
    own_diagonal_.resize(a_.rows());
    for (std::size_t g = 0; g + 1 < a_.groups().size(); ++g) {
      if (differs && (*differs)[g] == 0) continue;
      const Eigen::VectorXd of = a_.diagonal_block(g).diagonal().cwiseAbs();
      own_diagonal_.segment(a_.groups()[g], of.size()) = of;
    }
    diagonal_ = part_.all(Eigen::VectorXd(own_diagonal_));
  }
  void multiply_own(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    if (!part_.dealt.ranks) return a_.multiply(x, *crew_, y);
    Eigen::VectorXd here = x;
    here.conservativeResize(part_.halo.here());
    part_.halo.update(here);
    a_.multiply(here, *crew_, y);
  }
  bool precondition(Eigen::VectorXd& own) {
    Eigen::VectorXd few;
    if (exact_.any() && !exact_.solve(own, few)) return false;
    if (exact_.any()) exact_.balance(few, *crew_, own);
    if (!bodies_->apply(own)) return false;
    if (exact_.any()) exact_.add(few, own);
    return true;
  }

  MumpsOptions direct_;
  std::unique_ptr<core::Crew> crew_;  ///< outlives `bodies_`
  Part part_;
  GroupedRows a_;
  std::shared_ptr<const char> mark_{};  ///< of the matrix that was taken last, as it has them
  std::vector<Index> touched_{};
  bool in_step_ = false;  ///< what `bodies_` multiply with has the places and values of `a_`
  Eigen::VectorXd own_diagonal_, diagonal_;
  std::unique_ptr<Multigrid> bodies_;
  Exact exact_;
  Symmetry symmetry_ = Symmetry::unsymmetric;
};

}  // namespace

std::unique_ptr<Engine> make_multigrid_engine(const MumpsOptions& direct) {
  return std::make_unique<MultigridEngine>(direct);
}

}  // namespace osculate::la

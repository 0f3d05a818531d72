#include "osculate/la/multigrid.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "osculate/la/aggregates.hpp"
#include "osculate/la/block_diagonal.hpp"
#include "osculate/la/by_itself.hpp"
#include "osculate/la/compact_rows.hpp"
#include "osculate/la/long_vectors.hpp"
#include "osculate/la/mumps.hpp"
#include "osculate/la/preconditioned.hpp"
#include "osculate/la/sparse_product.hpp"

namespace osculate::la {
namespace {

/// One model. Its products are of entries in two bytes: they are a preconditioner's.
struct Level {
  const GroupedRows* a = nullptr;  ///< for as long as a coarser model is made of it
  GroupedRows kept;                ///< what `a` is, but of the finest one
  Halo halo;
  CompactRows products, p, transposed;  ///< the last two lead to the next coarser one
  GroupStarts start;                    ///< of own unknowns
  Eigen::MatrixXd near_null;            ///< likewise
  BlockDiagonal inverse;
  double largest = 0;        ///< eigenvalue of D^-1 A
  Eigen::VectorXd stiffest;  ///< about its eigenvector
  Eigen::VectorXd r, d, t, of_coarse;

  void take_products(const GroupedRows& matrix, core::Crew& crew);
  void leave() {
    a = nullptr;
    kept = {};
  }
  /// What the smoother needs; false: there are no numbers.
  bool prepare_smoother(core::Crew& crew);
  bool refresh_smoother(const GroupedRows& matrix, const std::vector<char>* differs,
                        core::Crew& crew);
  bool find_largest(int rounds, core::Crew& crew);
  void smooth(Eigen::VectorXd& solution, bool residual_wanted, core::Crew& crew);
};

/// Rounded beside the largest entries of both rows: where contact is stiff, what its unknowns have
/// to do with others is small.
void Level::take_products(const GroupedRows& matrix, core::Crew& crew) {
  Eigen::VectorXd size = matrix.largest_entries().cwiseSqrt();
  size.conservativeResize(halo.here());
  halo.update(size);
  products = CompactRows(matrix, crew, size);
}

bool Level::prepare_smoother(core::Crew& crew) {
  constexpr int rounds = 15;
  products = {};  // gives its memory back before
  take_products(*a, crew);
  inverse = BlockDiagonal(*a, crew);
  stiffest = noise(halo.own()).normalized();
  return find_largest(rounds, crew);
}

bool Level::refresh_smoother(const GroupedRows& matrix, const std::vector<char>* differs,
                             core::Crew& crew) {
  constexpr int rounds = 10;
  if (differs) {
    products.copy(matrix, *differs, crew);
  } else {
    products = {};
    take_products(matrix, crew);
  }
  inverse.update(matrix, differs, crew);
  stiffest.normalize();
  stiffest += noise(halo.own()).normalized();  // contact that has closed may be stiffer, elsewhere
  return find_largest(rounds, crew);
}

/// By the power method from `stiffest`; a little more than it finds. False: there are no numbers.
bool Level::find_largest(int rounds, core::Crew& crew) {
  constexpr double more = 1.05;
  Eigen::VectorXd& v = stiffest;
  Eigen::VectorXd w;
  largest = 0;
  for (int i = 0; i < rounds; ++i) {
    const double size = halo.norm(v);
    if (!(size > 0) || !std::isfinite(size)) break;
    v /= size;
    v.conservativeResize(halo.here());
    halo.update(v);
    products.multiply(v, crew, w);
    inverse.apply(w, crew, v);
    largest = more * halo.norm(v);
  }
  return largest > 0 && std::isfinite(largest);
}

/// Adds to the solution what a Chebyshev polynomial of D^-1 A makes of its residual `r`, which is
/// brought up to date where it is wanted. Both are of own unknowns.
void Level::smooth(Eigen::VectorXd& solution, bool residual_wanted, core::Crew& crew) {
  constexpr int degree = 2;
  constexpr double above = 1.1, part = 10;  // of the spectrum, from the top
  const double high = above * largest, low = high / part;
  const double middle = 0.5 * (high + low), half = 0.5 * (high - low), sigma = middle / half;
  double rho = 1 / sigma;
  const Index own = halo.own();
  inverse.apply(r, crew, t);
  d.resize(halo.here());
  const auto move_by = [&](double before, double fresh) {
    for_vector_pieces(own, &crew, [&](Eigen::Index first, Eigen::Index size) {
      auto step = d.segment(first, size);
      if (before == 0)
        step = fresh * t.segment(first, size);
      else
        step = before * step + fresh * t.segment(first, size);
      solution.segment(first, size) += step;
    });
  };
  move_by(0, 1 / middle);
  for (int i = 1; i < degree || residual_wanted; ++i) {
    halo.update(d);
    products.multiply(d, crew, t);
    for_vector_pieces(own, &crew, [&](Eigen::Index first, Eigen::Index size) {
      r.segment(first, size) -= t.segment(first, size);
    });
    if (i == degree) return;
    const double next = 1 / (2 * sigma - rho);
    inverse.apply(r, crew, t);
    move_by(next * rho, 2 * next / half);
    rho = next;
  }
}

/// Rows of a matrix of bases, in any order.
class Bases {
 public:
  explicit Bases(Eigen::Index rows) : of_row_(static_cast<std::size_t>(rows)) {}
  void add(Index row, Index first_column, const Eigen::RowVectorXd& values) {
    of_row_[as_size(row)] = {first_column, static_cast<Index>(values.size()), value_.size()};
    value_.insert(value_.end(), values.begin(), values.end());
  }
  [[nodiscard]] CompressedRows as_matrix(Index columns) const {
    const auto rows = static_cast<Index>(of_row_.size());
    CompressedRows p(rows, columns);
    p.resizeNonZeros(static_cast<Index>(value_.size()));
    Index next = 0;
    for (Index i = 0; i < rows; ++i) {
      p.outerIndexPtr()[i] = next;
      const Place& of = of_row_[as_size(i)];
      for (Index k = 0; k < of.count; ++k, ++next) {
        p.innerIndexPtr()[next] = of.column + k;
        p.valuePtr()[next] = value_[of.first + as_size(k)];
      }
    }
    p.outerIndexPtr()[rows] = next;
    return p;
  }

 private:
  struct Place {
    Index column = 0, count = 0;
    std::size_t first = 0;
  };
  std::vector<Place> of_row_;
  std::vector<double> value_;
};

/// Orthonormal bases of the near null vectors, aggregate by aggregate, and these in terms of them.
struct Tentative {
  CompressedRows p;
  GroupStarts start{0};
  Eigen::MatrixXd near_null;
};

Tentative tentative(const Level& fine, const Aggregates& aggregates) {
  constexpr double dependent = 1e-8;
  std::vector<std::vector<Index>> members(as_size(aggregates.count));
  for (std::size_t g = 0; g < aggregates.of_group.size(); ++g)
    if (aggregates.of_group[g] >= 0)
      for (Index i = fine.start[g]; i < fine.start[g + 1]; ++i)
        members[as_size(aggregates.of_group[g])].push_back(i);
  const Eigen::Index modes = fine.near_null.cols();
  Bases bases(fine.halo.own());
  Tentative out;
  out.near_null.resize(modes * aggregates.count, modes);
  for (const std::vector<Index>& unknowns : members) {
    const Eigen::MatrixXd of = fine.near_null(unknowns, Eigen::all);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(of.rows(), modes);
    qr.setThreshold(dependent);
    qr.compute(of);
    const Eigen::Index rank = qr.rank();
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(of.rows(), rank);
    const Index begin = out.start.back();
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      bases.add(unknowns[i], begin, q.row(static_cast<Eigen::Index>(i)));
    out.near_null.middleRows(begin, rank) = q.transpose() * of;
    out.start.push_back(begin + static_cast<Index>(rank));
  }
  out.near_null.conservativeResize(out.start.back(), modes);
  out.p = bases.as_matrix(out.start.back());
  return out;
}

/// Consecutive rows that have their columns in common, as those of a coarser model's node have.
GroupStarts groups_alike(const CompressedRows& a) {
  constexpr Index most = 6;
  const auto columns_of = [&](Index i) {
    const Index *const start = a.outerIndexPtr(), *const column = a.innerIndexPtr();
    return std::span(column + start[i], column + start[i + 1]);
  };
  GroupStarts out{0};
  for (Index i = 1; i <= a.rows(); ++i)
    if (i == a.rows() || i - out.back() == most ||
        !std::ranges::equal(columns_of(i), columns_of(out.back())))
      out.push_back(i);
  return out;
}

/// Groups that no coarser model knows.
std::vector<char> left_out(const Level& level) {
  std::vector<char> out(level.start.size() - 1, 0);
  for (std::size_t g = 0; g < out.size(); ++g)
    out[g] =
        level.near_null.middleRows(level.start[g], level.start[g + 1] - level.start[g]).isZero(0);
  return out;
}

}  // namespace

struct Multigrid::Impl {
  core::Crew& crew;
  std::vector<std::unique_ptr<Level>> levels{};
  std::unique_ptr<Mumps> coarsest{};  ///< on every process
  double entries = 0, finest_entries = 1;

  explicit Impl(core::Crew& of) : crew(of) {}

  bool coarsen();
  bool cycle(std::size_t level, const Eigen::VectorXd& b, Eigen::VectorXd& x);
};

/// Adds a coarser model to the last one. False: it would be hardly smaller.
bool Multigrid::Impl::coarsen() {
  constexpr double strength = 0.05, hardly = 0.7, damping = 4.0 / 3;
  Level& fine = *levels.back();
  const core::Ranks* const ranks = fine.halo.ranks();
  const auto times_a = [&](const CompressedRows& b) {
    return ranks ? product(*fine.a, with_rows_of_others(b, fine.halo), crew)
                 : product(*fine.a, b, crew);
  };
  const Aggregates aggregates = aggregate(*fine.a, left_out(fine), strength, crew);
  Tentative next = tentative(fine, aggregates);
  const std::vector<Index> first = dealt_out(ranks, next.start.back());
  const Index unknowns = first.back();
  if (unknowns == 0 || unknowns > hardly * static_cast<double>(fine.halo.everywhere()))
    return false;
  if (ranks) put_everywhere(next.p, first[static_cast<std::size_t>(ranks->rank())], unknowns);
  {
    const CompressedRows spread = times_a(next.p);
    const CompressedRows scaled = product(fine.inverse.as_matrix(crew), spread, crew);
    next.p = next.p - (damping / fine.largest) * scaled;
    next.p.makeCompressed();
  }
  auto coarse = std::make_unique<Level>();
  GroupedRows transposed;
  {
    CompressedRows spread = times_a(next.p);
    fine.leave();
    CompressedRows columns = next.p.transpose();
    transposed = GroupedRows(columns, ranks ? groups_alike(columns) : next.start, crew);
    release(columns);
    CompressedRows all = product(transposed, spread, crew);
    release(spread);
    CompressedRows a = summed_up(all, ranks, first);
    coarse->halo = halo_of(ranks, first, {&a, &next.p});
    coarse->kept = GroupedRows(with_columns_here(a, coarse->halo), next.start, crew);
    coarse->a = &coarse->kept;
  }
  const CompressedRows p = with_columns_here(next.p, coarse->halo);
  if (ranks)
    transposed =
        GroupedRows(CompressedRows(p.transpose()), with_others(next.start, coarse->halo), crew);
  fine.p = CompactRows(GroupedRows(p, fine.start, crew), crew);
  fine.transposed = CompactRows(transposed, crew);
  coarse->start = std::move(next.start);
  coarse->near_null = std::move(next.near_null);
  fine.near_null = {};
  entries += fine.halo.sum(static_cast<double>(coarse->kept.entries()));
  levels.push_back(std::move(coarse));
  return true;
}

Multigrid::Multigrid(core::Crew& crew) : impl_(std::make_unique<Impl>(crew)) {}
Multigrid::~Multigrid() = default;

bool Multigrid::build(const GroupedRows& a, Halo halo, Eigen::MatrixXd near_null) {
  constexpr Index coarsest = 1500, too_many = 10 * coarsest;
  constexpr std::size_t most_levels = 12;
  Impl& s = *impl_;
  forget();
  s.levels.push_back(std::make_unique<Level>());
  s.levels[0]->a = &a;
  s.entries = s.finest_entries = halo.sum(static_cast<double>(a.entries()));
  s.levels[0]->halo = std::move(halo);
  s.levels[0]->start = a.groups();
  s.levels[0]->near_null = std::move(near_null);
  while (s.levels.back()->halo.everywhere() > coarsest && s.levels.size() < most_levels) {
    if (!s.levels.back()->prepare_smoother(s.crew)) return false;
    if (!s.coarsen()) break;
  }
  const Halo& last = s.levels.back()->halo;
  if (last.ranks() && last.everywhere() > too_many) return false;  // all would be on each process
  s.coarsest = std::make_unique<Mumps>();
  const SparseMatrix whole = stored(gathered(s.levels.back()->a->as_rows(), last));
  s.levels.back()->leave();
  const FactorReport report =
      by_itself(last.ranks(), [&] { return s.coarsest->factor(whole, 0, Symmetry::unsymmetric); });
  s.coarsest->keep_factors_alone();
  return last.all(report.status == SolveStatus::ok);
}

bool Multigrid::refresh(const GroupedRows& a, const std::vector<char>* differs, Halo halo) {
  Impl& s = *impl_;
  const bool same = s.coarsest && s.levels.size() > 1 && s.levels[0]->halo.own() == halo.own();
  if (!halo.all(same)) return false;
  s.levels[0]->halo = std::move(halo);
  return s.levels[0]->refresh_smoother(a, differs, s.crew);
}

bool Multigrid::Impl::cycle(std::size_t level, const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  Level& fine = *levels[level];
  if (level + 1 == levels.size()) {
    Eigen::VectorXd all = fine.halo.gathered(b);
    const SolveStatus done =
        by_itself(fine.halo.ranks(), [&] { return coarsest->solve_once(all); });
    if (done != SolveStatus::ok) return false;
    x = all.segment(fine.halo.begin(), fine.halo.own());
    return true;
  }
  const Halo& coarse = levels[level + 1]->halo;
  x.setZero(b.size());
  fine.r = b;
  fine.smooth(x, true, crew);
  Eigen::VectorXd rest;
  fine.transposed.multiply(fine.r, crew, rest);
  coarse.add_up(rest);
  rest.conservativeResize(coarse.own());
  if (!cycle(level + 1, rest, fine.of_coarse)) return false;
  fine.of_coarse.conservativeResize(coarse.here());
  coarse.update(fine.of_coarse);
  fine.p.multiply(fine.of_coarse, crew, fine.d);
  const auto add = [&](const Eigen::VectorXd& from, double factor, Eigen::VectorXd& to) {
    for_vector_pieces(to.size(), &crew, [&](Eigen::Index first, Eigen::Index size) {
      to.segment(first, size) += factor * from.segment(first, size);
    });
  };
  add(fine.d, 1, x);
  fine.d.conservativeResize(fine.halo.here());
  fine.halo.update(fine.d);
  fine.products.multiply(fine.d, crew, fine.t);
  add(fine.t, -1, fine.r);
  fine.smooth(x, false, crew);
  return true;
}

bool Multigrid::apply(Eigen::VectorXd& rhs) {
  Eigen::VectorXd x;
  if (!impl_->coarsest || !impl_->cycle(0, rhs, x)) return false;
  rhs = std::move(x);
  return impl_->levels[0]->halo.all(rhs.allFinite());
}

double Multigrid::complexity() const { return impl_->entries / impl_->finest_entries; }

int Multigrid::levels() const { return static_cast<int>(impl_->levels.size()); }

void Multigrid::forget() {
  impl_->levels.clear();
  impl_->coarsest.reset();
}

}  // namespace osculate::la

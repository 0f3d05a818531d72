#include "osculate/la/iterative.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "osculate/la/condensed.hpp"
#include "osculate/la/multigrid.hpp"
#include "osculate/la/preconditioned.hpp"
#include "osculate/la/timed.hpp"

namespace osculate::la {
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

bool stands_alone(const CompressedRows& a, Index row) {
  for (CompressedRows::InnerIterator entry(a, row); entry; ++entry)
    if (entry.col() != row) return false;
  return true;
}

/// Rigid motions of the nodes: translations, and rotations about the middle of all. Zero where an
/// unknown has nothing to do with others, as where its motion is prescribed.
Eigen::MatrixXd rigid_motions(const Places& places, const CompressedRows& a) {
  const int dim = places.dimension;
  const auto n = static_cast<Index>(places.node.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : places.place) middle += x / n;
  double size = 0;
  for (const Eigen::Vector3d& x : places.place) size = std::max(size, (x - middle).norm());
  if (!(size > 0)) size = 1;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(n, dim == 3 ? 6 : 3);
  for (Index i = 0; i < n; ++i) {
    if (places.node[as_size(i)] < 0 || stands_alone(a, i)) continue;
    const int k = places.direction[as_size(i)];
    const Eigen::Vector3d x = (places.place[as_size(i)] - middle) / size;
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

}  // namespace

struct Iterative::Impl {
  MumpsOptions options;
  Places places;
  Condensed direct;
  std::unique_ptr<Multigrid> bodies;
  Exact exact;
  bool by_multigrid = false;        ///< the last matrix
  bool fresh = false;               ///< the coarser models are those of the last matrix
  bool anew = true;                 ///< those that are there are not to be used
  bool refused = false;             ///< a matrix since `begin_anew` was left to the direct solver
  bool unsound = false;             ///< `sound` has said so since `begin_anew`
  bool tried = false;               ///< with noise, a matrix since `may_come_loose`
  bool trusts = false;              ///< matrices are not tried before somebody asks
  double pace = 0, first_pace = 0;  ///< iterations a digit of the last solution, and the first
  double wanted = 1e-10;
  double seconds = 0;
  std::uint64_t version = 0;
  Symmetry symmetry = Symmetry::unsymmetric;
  IterativeWork work;

  explicit Impl(MumpsOptions of) : options(of), direct(of) {}
  ~Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] bool suits(const SparseMatrix& k) const;
  bool build(CompressedRows&& a);
  bool refresh(const SparseMatrix& k);
  [[nodiscard]] bool resists_all();
  bool iterate(Eigen::VectorXd& rhs);
  [[nodiscard]] bool believable(double force, const Eigen::VectorXd& motion);
  bool precondition(Eigen::VectorXd& r);
  FactorReport factor_directly(const SparseMatrix& k);
  SolveStatus solve(Eigen::VectorXd& rhs);
};

bool Iterative::Impl::suits(const SparseMatrix& k) const {
  constexpr Index fewest = 1500;
  if (k.n < fewest || !places.known(k.n)) return false;
  Index count = 0;
  for (std::size_t i = 0; i < places.node.size(); ++i)
    if (places.exact[i] != 0 || places.node[i] < 0) ++count;
  return 2 * count < k.n && std::ranges::all_of(k.value, [](double v) { return std::isfinite(v); });
}

/// False: the direct solver is to look at the matrix.
bool Iterative::Impl::build(CompressedRows&& a) {
  fresh = true;
  anew = false;
  first_pace = 0;
  pace = 0;
  bodies = std::make_unique<Multigrid>(places.threads);
  if (!exact.factor(a, places, symmetry, options)) return false;
  Eigen::MatrixXd motions = rigid_motions(places, a);
  if (!bodies->build(std::move(a), groups_of(places), std::move(motions))) return false;
  return trusts || resists_all();
}

/// Noise is no force that a singular matrix balances, though the loads may be: without a solution,
/// or with one that says that the matrix has hardly a digit, the direct solver is to look at it.
bool Iterative::Impl::resists_all() {
  constexpr double worst_condition = 1e13;
  const CompressedRows& a = bodies->matrix();
  const Eigen::VectorXd given = noise(a.rows());
  Eigen::VectorXd scaled = given.cwiseProduct(a.diagonal().cwiseAbs().cwiseSqrt());
  const double force = scaled.stableNorm();
  if (!(force > 0)) return false;
  PreconditionedLimits limits;
  const Nearby done = solve_preconditioned(
      [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { multiply(a, x, places.threads, y); },
      [this](Eigen::VectorXd& r) { return precondition(r); }, limits, scaled);
  work.iterations += done.iterations;
  const double motion = scaled.cwiseProduct(a.diagonal().cwiseAbs().cwiseSqrt()).stableNorm();
  tried = done.solved && motion <= worst_condition * given.stableNorm();
  return tried;
}

/// With the coarser models of an earlier matrix. False: they are not there, or worth nothing.
bool Iterative::Impl::refresh(const SparseMatrix& k) {
  constexpr double slower = 1.5;
  if (anew || !by_multigrid || !bodies || pace > slower * first_pace) return false;
  fresh = false;
  return bodies->refresh(k, symmetry) && exact.factor(bodies->matrix(), places, symmetry, options);
}

FactorReport Iterative::Impl::factor_directly(const SparseMatrix& k) {
  by_multigrid = false;
  exact.forget();
  bodies.reset();
  return direct.factor(k, version, symmetry);
}

bool Iterative::Impl::precondition(Eigen::VectorXd& r) {
  if (!exact.any()) return bodies->apply(r);
  Eigen::VectorXd few;
  if (!exact.apply(places.threads, r, few) || !bodies->apply(r)) return false;
  exact.add(few, r);
  return true;
}

/// |D^-1/2 b| , with D the diagonal.
double scaled_force(const CompressedRows& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd root = Eigen::VectorXd(a.diagonal()).cwiseAbs().cwiseSqrt();
  Eigen::VectorXd scaled = b;
  for (Eigen::Index i = 0; i < scaled.size(); ++i) scaled[i] = root[i] > 0 ? b[i] / root[i] : 0;
  return scaled.stableNorm();
}

/// A matrix that is singular to rounding may have a solution all the same, and one that goes far:
/// noise says whether it is one.
///
/// Formula    |D^1/2 x| <= 1e8 |D^-1/2 b| ; slender bodies come to 1e6
bool Iterative::Impl::believable(double force, const Eigen::VectorXd& motion) {
  constexpr double far = 1e8;
  const Eigen::VectorXd diagonal = bodies->matrix().diagonal();
  const double way = motion.cwiseProduct(diagonal.cwiseAbs().cwiseSqrt()).stableNorm();
  return way <= far * force || resists_all();
}

/// False: it does not come to an end, or to one that is to be believed.
bool Iterative::Impl::iterate(Eigen::VectorXd& rhs) {
  const double force = tried ? 0 : scaled_force(bodies->matrix(), rhs);
  PreconditionedLimits limits;
  limits.tolerance = wanted;
  const Nearby done = solve_preconditioned(
      [this](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
        multiply(bodies->matrix(), x, places.threads, y);
      },
      [this](Eigen::VectorXd& r) { return precondition(r); }, limits, rhs);
  work.iterations += done.iterations;
  if (!done.solved || (!tried && !believable(force, rhs))) return false;
  ++work.solutions;
  constexpr double head_start = 2;  // of the first iterations, which gain less
  pace = done.iterations / (head_start - std::log10(wanted));
  if (first_pace == 0) first_pace = pace;
  return true;
}

SolveStatus Iterative::Impl::solve(Eigen::VectorXd& rhs) {
  if (!by_multigrid) return direct.solve(rhs);
  if (rhs.size() != bodies->matrix().rows() || !rhs.allFinite()) return SolveStatus::failed;
  const Eigen::VectorXd given = rhs;
  if (iterate(rhs)) return SolveStatus::ok;
  rhs = given;
  const SparseMatrix k = stored(bodies->matrix());  // both triangles
  if (!fresh && build(compressed(k, Symmetry::unsymmetric)) && iterate(rhs)) return SolveStatus::ok;
  rhs = given;
  ++work.given_up;
  refused = true;
  const FactorReport report = factor_directly(k);
  // What else there is to be said of the matrix `factor` says, if it is asked again.
  if (report.status == SolveStatus::ok && report.condition > 0) return SolveStatus::singular;
  return report.status == SolveStatus::ok ? direct.solve(rhs) : report.status;
}

Iterative::Iterative(MumpsOptions direct) : impl_(std::make_unique<Impl>(direct)) {}
Iterative::~Iterative() = default;

void Iterative::place(Places places) {
  places.threads = std::max(1, places.threads);
  begin_anew();
  impl_->places = std::move(places);
}

void Iterative::may_change(std::vector<Index> unknowns) {
  impl_->direct.may_change(std::move(unknowns));
}

void Iterative::begin_anew() {
  impl_->anew = true;
  impl_->refused = impl_->unsound = impl_->trusts = false;
}

void Iterative::may_come_loose() {
  impl_->tried = false;
  impl_->trusts = true;
  impl_->refused = impl_->unsound;
}

bool Iterative::sound() {
  Impl& s = *impl_;
  const Timed timed(s.seconds);
  if (!s.by_multigrid || s.tried || s.resists_all()) return true;
  // Coarser models of another matrix may be no good for noise.
  if (!s.fresh && s.build(CompressedRows(s.bodies->matrix())) && s.resists_all()) return true;
  s.refused = s.unsound = true;
  return false;
}

void Iterative::aim(double share) {
  constexpr double least = 1e-10, most = 1e-3;
  impl_->wanted = std::clamp(share, least, most);
}

FactorReport Iterative::factor(const SparseMatrix& k, std::uint64_t pattern_version,
                               Symmetry symmetry) {
  Impl& s = *impl_;
  const Timed timed(s.seconds);
  s.version = pattern_version;
  s.symmetry = symmetry;
  s.wanted = 1e-10;
  if (s.refused || !s.suits(k)) return s.factor_directly(k);
  const bool again = s.refresh(k);
  s.by_multigrid = false;
  s.by_multigrid = again || s.build(compressed(k, symmetry));
  if (s.by_multigrid) {
    FactorReport report;
    report.whole = false;
    return report;
  }
  ++s.work.given_up;
  s.refused = true;
  return s.factor_directly(k);
}

SolveStatus Iterative::solve(Eigen::VectorXd& rhs) {
  const Timed timed(impl_->seconds);
  return impl_->solve(rhs);
}

SolveStatus Iterative::solve(Eigen::MatrixXd& rhs) {
  const Timed timed(impl_->seconds);
  if (!impl_->by_multigrid) return impl_->direct.solve(rhs);
  for (Eigen::Index c = 0; c < rhs.cols(); ++c) {
    Eigen::VectorXd x = rhs.col(c);
    if (const SolveStatus status = impl_->solve(x); status != SolveStatus::ok) return status;
    rhs.col(c) = x;
  }
  return SolveStatus::ok;
}

double Iterative::seconds() const { return impl_->seconds; }
IterativeWork Iterative::work() const { return impl_->work; }

std::unique_ptr<LinearSolver> make_iterative_solver() { return std::make_unique<Iterative>(); }

}  // namespace osculate::la

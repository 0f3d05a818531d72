#include "osculate/la/iterative.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "osculate/la/compressed_rows.hpp"
#include "osculate/la/condensed.hpp"
#include "osculate/la/timed.hpp"

namespace osculate::la {

struct Iterative::Impl {
  Places places;
  Condensed direct;
  MumpsOptions options;
  std::unique_ptr<Engine> engine{};
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
  std::shared_ptr<const char> finite_mark{};  ///< of a matrix of numbers

  explicit Impl(const MumpsOptions& of) : direct(of), options(of) {}
  ~Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] bool suits(const SparseMatrix& k);
  [[nodiscard]] bool are_numbers(const SparseMatrix& k);
  bool build(const SparseMatrix& k);
  bool build_again();
  bool begin_build();
  bool refresh(const SparseMatrix& k);
  [[nodiscard]] bool resists_all();
  bool iterate(Eigen::VectorXd& rhs);
  [[nodiscard]] bool believable(double force, const Eigen::VectorXd& motion);
  FactorReport factor_directly(const SparseMatrix& k);
  SolveStatus solve(Eigen::VectorXd& rhs);
};

/// Looks at what may differ from the last matrix of its mark.
bool Iterative::Impl::are_numbers(const SparseMatrix& k) {
  const auto sum = [&](Index begin, Index end) {
    return (0.0 * Eigen::Map<const Eigen::ArrayXd>(k.value.data() + begin, end - begin)).sum();
  };
  double none = 0;
  if (k.mark != nullptr && k.mark == finite_mark)
    for (const Index i : k.touched)
      none += sum(k.row_start[as_size(i)], k.row_start[as_size(i) + 1]);
  else
    none = sum(0, static_cast<Index>(k.value.size()));
  finite_mark = none == 0 ? k.mark : nullptr;
  return none == 0;
}

bool Iterative::Impl::suits(const SparseMatrix& k) {
  constexpr Index fewest = 1500;
  if (k.n < fewest || !places.known(k.n)) return false;
  Index count = 0;
  for (std::size_t i = 0; i < places.node.size(); ++i)
    if (places.exact[i] != 0 || places.node[i] < 0) ++count;
  const bool finite = are_numbers(k);
  return 2 * count < k.n && (k.ranks ? k.ranks->all(finite) : finite);
}

bool Iterative::Impl::begin_build() {
  fresh = true;
  anew = false;
  first_pace = 0;
  pace = 0;
  ++work.factored;
  return trusts;
}

/// False: the direct solver is to look at the matrix.
bool Iterative::Impl::build(const SparseMatrix& k) {
  const bool believes = begin_build();
  if (!engine) engine = make_multigrid_engine(options);
  return engine->build(k, symmetry, places) && (believes || resists_all());
}

bool Iterative::Impl::build_again() {
  const bool believes = begin_build();
  return engine->build_again(places) && (believes || resists_all());
}

/// Noise is no force that a singular matrix balances, though the loads may be: without a solution,
/// or with one that says that the matrix has hardly a digit, the direct solver is to look at it.
///
/// Formula    |D^-1/2 (b - K x)| <= 1e-7 |v| , b = D^1/2 v , v noise: the share of a motion that
///            nothing holds is 1 / sqrt(n) of it, of soft bodies beside stiff ones, too
bool Iterative::Impl::resists_all() {
  constexpr double worst_condition = 1e13, left_of_noise = 1e-7, further = 1e-2;
  constexpr int rounds = 5;
  const Eigen::VectorXd root = engine->diagonal().cwiseSqrt();
  const Eigen::VectorXd given = noise(root.size()), force = given.cwiseProduct(root);
  const double size = given.stableNorm();
  tried = false;
  if (!(force.stableNorm() > 0)) return false;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(force.size()), rest = force;
  PreconditionedLimits limits;
  limits.tolerance = left_of_noise;
  for (int round = 0; round < rounds && !tried; ++round, limits.tolerance = further) {
    Eigen::VectorXd more = rest;
    const Nearby done = engine->solve(limits, more);
    work.iterations += done.iterations;
    if (!done.solved) return false;
    x += more;
    rest = force - engine->times(x);
    double left = 0;
    for (Eigen::Index i = 0; i < rest.size(); ++i)
      if (root[i] > 0) left = std::hypot(left, rest[i] / root[i]);
    if (!(x.cwiseProduct(root).stableNorm() <= worst_condition * size)) return false;
    tried = left <= left_of_noise * size;
  }
  return tried;
}

/// With the coarser models of an earlier matrix. False: they are not there, or worth nothing.
bool Iterative::Impl::refresh(const SparseMatrix& k) {
  constexpr double slower = 1.5;
  if (anew || !by_multigrid || !engine || pace > slower * first_pace) return false;
  fresh = false;
  const bool done = engine->refresh(k, symmetry, places);
  if (done && !engine->keeps_factors()) ++work.factored;
  return done;
}

FactorReport Iterative::Impl::factor_directly(const SparseMatrix& k) {
  by_multigrid = false;
  engine.reset();
  ++work.factored;
  return direct.factor(k, version, symmetry);
}

/// |D^-1/2 b| , with D the diagonal.
double scaled_force(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& b) {
  const Eigen::VectorXd root = diagonal.cwiseSqrt();
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
  const double way = motion.cwiseProduct(engine->diagonal().cwiseSqrt()).stableNorm();
  return way <= far * force || resists_all();
}

/// False: it does not come to an end, or to one that is to be believed.
bool Iterative::Impl::iterate(Eigen::VectorXd& rhs) {
  const double force = tried ? 0 : scaled_force(engine->diagonal(), rhs);
  PreconditionedLimits limits;
  limits.tolerance = wanted;
  const Nearby done = engine->solve(limits, rhs);
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
  if (rhs.size() != static_cast<Eigen::Index>(places.node.size()) || !rhs.allFinite())
    return SolveStatus::failed;
  const Eigen::VectorXd given = rhs;
  if (iterate(rhs)) return SolveStatus::ok;
  rhs = given;
  if (!fresh && build_again() && iterate(rhs)) return SolveStatus::ok;
  rhs = given;
  ++work.given_up;
  refused = true;
  const FactorReport report = factor_directly(engine->matrix());
  // What else there is to be said of the matrix `factor` says, if it is asked again.
  if (report.status == SolveStatus::ok && report.condition > 0) return SolveStatus::singular;
  return report.status == SolveStatus::ok ? direct.solve(rhs) : report.status;
}

Iterative::Iterative(const MumpsOptions& direct) : impl_(std::make_unique<Impl>(direct)) {}
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

bool Iterative::passes() const { return impl_->by_multigrid && !impl_->refused && !impl_->unsound; }

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
  if (!s.fresh && s.build_again() && s.resists_all()) return true;
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
  s.by_multigrid = again || s.build(k);
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

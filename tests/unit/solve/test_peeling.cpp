// Contact that peels: a heavy beam is lifted off a floor at one end.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/la/mumps.hpp"
#include "osculate/solve/newton.hpp"

namespace osculate::solve {
namespace {

/// Deflections of a beam by differences, held by springs where they are below zero; the first one
/// is prescribed, and its neighbour the same: the end does not turn.
struct Beam {
  struct State {
    Eigen::VectorXd w;
    double stiffness = 1;
  };
  using Trial = State;
  static constexpr double bending = 600, weight = 0.4, springs = 1e6, length = 20;
  Index size = 101;
  la::MatrixBuilder builder{size};
  double last_stiffness = 0;

  [[nodiscard]] double h() const { return length / static_cast<double>(size - 1); }
  [[nodiscard]] double lifted(Index i, double time) const { return i < 2 ? time : 0; }
  void predict(const State& s, double time, Evaluation& out) {
    evaluate(s, s, time, true, out);
    Eigen::VectorXd du = Eigen::VectorXd::Zero(size);
    for (Index i = 0; i < 2; ++i) du[i] = lifted(i, time) - s.w[i];
    out.residual += bent(du);
    out.residual.head(2).setZero();
  }
  [[nodiscard]] Eigen::VectorXd bent(const Eigen::VectorXd& w) const {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(size);
    const double k = bending / std::pow(h(), 3);
    for (Index i = 1; i + 1 < size; ++i) {
      const double moment = k * (w[i - 1] - 2 * w[i] + w[i + 1]);
      force[i - 1] += moment;
      force[i] -= 2 * moment;
      force[i + 1] += moment;
    }
    return force;
  }
  void evaluate(const State&, const State& s, double, bool tangent, Evaluation& out) {
    out.ok = true;
    out.residual = bent(s.w);
    out.counts = {};
    last_stiffness = s.stiffness;
    for (Index i = 0; i < size; ++i) {
      const bool closed = s.w[i] < 0;
      out.residual[i] += (weight + (closed ? s.stiffness * springs * s.w[i] : 0)) * h();
      ++(closed ? out.counts.closed : out.counts.open);
      out.counts.signature = 1099511628211u * out.counts.signature + (closed ? 2 : 1);
    }
    out.force_scale = weight * length;
    out.residual.head(2).setZero();
    if (tangent) fill(s);
  }
  void fill(const State& s) {
    builder.clear();
    for (Index i = 0; i < size; ++i) {
      const Eigen::VectorXd column = bent(Eigen::VectorXd::Unit(size, i));
      for (Index j = std::max<Index>(2, i - 2); i > 1 && j <= std::min(size - 1, i + 2); ++j)
        builder.add(j, i, column[j]);
      builder.add(i, i, i < 2 ? 1.0 : s.w[i] < 0 ? s.stiffness * springs * h() : 0.0);
    }
  }
  [[nodiscard]] State apply(const State& s, const Eigen::VectorXd& du, double time,
                            double factor) const {
    State next{s.w + factor * du, s.stiffness};
    for (Index i = 0; i < 2; ++i) next.w[i] = lifted(i, time);
    return next;
  }
  [[nodiscard]] State remember(const State& s) const { return s; }
  [[nodiscard]] const la::SparseMatrix& matrix() { return builder.finish(); }
  [[nodiscard]] std::uint64_t pattern_version() const { return builder.pattern_version(); }
  [[nodiscard]] la::Symmetry symmetry() const { return la::Symmetry::unsymmetric; }
};

struct RelaxingBeam : Beam {
  [[nodiscard]] std::optional<State> relaxed(const State& s) const {
    return State{s.w, s.stiffness / 4096};
  }
  [[nodiscard]] State restored(const State& s, const State& before, double part) const {
    return {s.w, before.stiffness * std::pow(s.stiffness / before.stiffness, part)};
  }
};

template <class B>
NewtonResult<typename B::State> lift(B& beam, double height) {
  la::Mumps solver;
  NewtonOptions options;
  options.max_iterations = 200;
  const typename B::State start{Eigen::VectorXd::Constant(beam.size, -beam.weight / beam.springs)};
  return newton(beam, start, height, options, solver);
}

static_assert(!Relaxes<Beam> && Relaxes<RelaxingBeam>);

TEST(Peeling, TakesFewerIterationsToTheSameSolution) {
  for (const double height : {0.1, 0.3, 1.0}) {
    Beam plain;
    RelaxingBeam relaxing;
    const auto one_by_one = lift(plain, height), at_once = lift(relaxing, height);
    ASSERT_EQ(one_by_one.outcome, Outcome::converged);
    ASSERT_EQ(at_once.outcome, Outcome::converged);
    EXPECT_LT(2 * at_once.iterations.size(), one_by_one.iterations.size());
    EXPECT_LT((one_by_one.trial.w - at_once.trial.w).norm(), 1e-9 * one_by_one.trial.w.norm());
    EXPECT_EQ(at_once.trial.stiffness, 1);
    EXPECT_EQ(relaxing.last_stiffness, 1);
  }
}

/// What the soft contact cannot solve is solved as before.
struct BrokenBeam : RelaxingBeam {
  void evaluate(const State& committed, const State& s, double time, bool tangent,
                Evaluation& out) {
    RelaxingBeam::evaluate(committed, s, time, tangent, out);
    if (s.stiffness == 1 || ++soft < 2) return;
    out.ok = false;
    out.message = "too soft";
  }
  int soft = 0;
};

TEST(Peeling, GoesBackWhereTheSoftContactFails) {
  Beam plain;
  BrokenBeam broken;
  const auto one_by_one = lift(plain, 0.3), back = lift(broken, 0.3);
  ASSERT_EQ(back.outcome, Outcome::converged);
  EXPECT_GT(broken.soft, 1);
  EXPECT_EQ(back.trial.stiffness, 1);
  EXPECT_LT((one_by_one.trial.w - back.trial.w).norm(), 1e-9 * one_by_one.trial.w.norm());
}

}  // namespace
}  // namespace osculate::solve

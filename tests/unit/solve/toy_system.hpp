#pragma once
// Small systems with a dense tangent, written as functions of the unknowns and the time.
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "osculate/solve/increments.hpp"

namespace osculate::solve {

/// Residual and tangent of `size` unknowns; unknown 0 follows `prescribed` where it is given.
struct ToySystem {
  using Vector = Eigen::VectorXd;
  struct State {
    Vector x;
    int commits = 0;
  };
  using Trial = State;

  Index size = 1;
  std::optional<Index> primary{};  ///< unknowns that are displacements; all
  std::function<Vector(const Vector& x, double time)> force;  ///< out-of-balance force
  std::function<Eigen::MatrixXd(const Vector& x)> stiffness;
  std::function<double(const Vector& x, double time)> scale = [](const Vector&, double) {
    return 1.0;
  };
  std::function<std::string(const Vector& x, const Vector& committed)> wrong;  ///< empty = ok
  std::function<double(double time)> prescribed;
  std::function<std::uint64_t(const Vector& x)> states = [](const Vector&) { return 0; };
  std::function<int(const Vector& x)> touching = [](const Vector&) { return 0; };
  double round_off = 0, round_off_in_time = 0;  ///< the estimates
  bool loaded = true;
  std::vector<Vector> evaluated;   ///< every x that `evaluate` saw
  std::vector<bool> with_tangent;  ///< and whether it was asked for the tangent
  std::vector<double> predicted_to;
  la::MatrixBuilder builder{size};

  void fill(const Vector& x) {
    const Eigen::MatrixXd k = stiffness(x);
    builder.clear();
    for (Index i = 0; i < size; ++i)
      for (Index j = 0; j < size; ++j)
        if (!held(i) && !held(j)) builder.add(i, j, k(i, j));
    if (prescribed) builder.add(0, 0, 1.0);
  }
  [[nodiscard]] bool held(Index i) const { return prescribed && i == 0; }

  void predict(const State& state, double time, Evaluation& out) {
    predicted_to.push_back(time);
    evaluate(state, state, time, true, out);
    if (!prescribed) return;
    const double du = prescribed(time) - state.x[0];
    out.led = du != 0;
    out.residual += du * stiffness(state.x).col(0);
    out.residual[0] = 0;
  }
  void evaluate(const State& committed, const State& trial, double time, bool tangent,
                Evaluation& out) {
    evaluated.push_back(trial.x);
    with_tangent.push_back(tangent);
    out.ok = true;
    if (wrong) {
      out.message = wrong(trial.x, committed.x);
      out.ok = out.message.empty();
      if (!out.ok) return;
    }
    out.residual = force(trial.x, time);
    if (prescribed) out.residual[0] = 0;
    out.force_scale = scale(trial.x, time);
    out.round_off = round_off;
    out.round_off_in_time = round_off_in_time;
    out.loaded = loaded;
    out.led = false;
    out.counts.closed = touching(trial.x);
    out.counts.signature = states(trial.x);
    if (tangent) fill(trial.x);
  }
  [[nodiscard]] State apply(const State& state, const Vector& du, double time,
                            double factor) const {
    State next = state;
    next.x += factor * du;
    if (prescribed) next.x[0] = prescribed(time);
    return next;
  }
  [[nodiscard]] State remember(const State& state) const { return state; }
  [[nodiscard]] State commit(const State& state, double) const {
    return {state.x, state.commits + 1};
  }
  const la::SparseMatrix& matrix() { return builder.finish(); }
  [[nodiscard]] std::uint64_t pattern_version() const { return builder.pattern_version(); }
  [[nodiscard]] Index displacements() const { return primary.value_or(size); }
  [[nodiscard]] static la::Symmetry symmetry() { return la::Symmetry::unsymmetric; }
};

inline Eigen::VectorXd vector(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

/// One unknown: residual r(x, t) and its derivative k(x).
inline ToySystem scalar_system(std::function<double(double, double)> r,
                               std::function<double(double)> k) {
  ToySystem system;
  system.force = [r = std::move(r)](const Eigen::VectorXd& x, double t) {
    return vector({r(x[0], t)});
  };
  system.stiffness = [k = std::move(k)](const Eigen::VectorXd& x) {
    return Eigen::MatrixXd::Constant(1, 1, k(x[0]));
  };
  return system;
}

}  // namespace osculate::solve

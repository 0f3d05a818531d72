#pragma once
// Systems assembled from the text of a model file, their tangents and analyses.
#include <random>

#include "deck_test.hpp"
#include "derivative_check.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {

inline Built build_text(const std::string& text) {
  const Description description = parse_model(text, "model.yaml");
  return build(description, load_mesh(description));
}

/// The message that a model text is refused with when it is built.
inline std::string build_refusal(const std::string& text) {
  try {
    (void)build_text(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

/// A system at the beginning of its first step, displaced at random.
struct Probe {
  explicit Probe(const std::string& text, double amplitude = 0.01) : built(build_text(text)) {
    start = system.initial_state();
    system.begin_step(built.model.steps.front(), start);
    base = system.apply(start, random(amplitude), fraction, 1.0);
  }

  Built built;
  model::System system{built.model, 1};
  model::State start;
  model::Trial base;
  double fraction = 0.5;
  std::mt19937 generator{11};

  Eigen::VectorXd random(double amplitude) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::VectorXd d(system.dofs().unknowns());
    for (Eigen::Index i = 0; i < d.size(); ++i)
      d[i] = system.prescribed(static_cast<Index>(i)) ? 0.0 : amplitude * uniform(generator);
    return d;
  }
  solve::Evaluation at(const model::Trial& state, bool tangent, double when) {
    solve::Evaluation e;
    system.evaluate(start, state, when, tangent, e);
    if (!e.ok) throw std::runtime_error(e.message);
    return e;
  }
  solve::Evaluation at(const model::Trial& state, bool tangent) {
    return at(state, tangent, fraction);
  }
};

/// K d against central differences of the residual, with a step that leaves all contact points in
/// their states.
inline testing::DerivativeReport check_tangent_of(Probe& probe) {
  const solve::Evaluation here = probe.at(probe.base, true);
  const la::SparseMatrix k = probe.system.matrix();
  testing::DerivativeReport report{};
  for (double h = 2e-3; h > 1e-5; h /= 4) {
    const Eigen::VectorXd d = probe.random(1.0);
    Eigen::VectorXd df = la::multiply(k, d);
    for (Index u = 0; u < k.n; ++u)
      if (probe.system.prescribed(u)) df[u] = 0;
    bool same = true;
    const auto residual = [&](const Eigen::VectorXd& v) {
      const solve::Evaluation e =
          probe.at(probe.system.apply(probe.base, v, probe.fraction, 1.0), false);
      same = same && e.counts.signature == here.counts.signature;
      return e.residual;
    };
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(d.size());
    report = testing::check_derivative(residual, df, zero, d, h);
    if (same) return report;
  }
  ADD_FAILURE() << "every step changes the state of a contact point";
  return report;
}

inline model::AnalysisResult run_to_end(
    const Built& built, int threads,
    const std::function<void(model::System&, const model::State&)>& at_end) {
  model::AnalysisOptions options = built.options;
  options.threads = threads;
  model::AnalysisObserver observer;
  const auto last = static_cast<Index>(built.model.steps.size()) - 1;
  observer.converged = [&](model::System& system, const model::State& state,
                           const model::Progress& p, const solve::IncrementRecord* record) {
    if (record && p.step == last && p.fraction >= 1) at_end(system, state);
    return true;
  };
  return model::run(built.model, options, observer);
}

/// States and iterations of every increment.
struct Course {
  std::vector<std::uint64_t> states;
  std::vector<int> iterations;
  bool operator==(const Course&) const = default;
};

inline Course course_of(const Built& built) {
  const model::AnalysisResult result = model::run(built.model, built.options, {});
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  Course course;
  for (const model::StepRecord& step : result.steps)
    for (const solve::IncrementRecord& record : step.increments) {
      course.iterations.push_back(static_cast<int>(record.iterations.size()));
      for (const solve::IterationRecord& it : record.iterations)
        course.states.push_back(it.counts.signature);
    }
  return course;
}

}  // namespace osculate::deck

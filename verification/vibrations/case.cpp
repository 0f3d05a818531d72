#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "osculate/contact/law/catalogue.hpp"

namespace osculate::verification {
namespace {

/// Frequencies of the steps that look for them, in the order of the steps.
std::vector<Eigen::VectorXd> frequencies(const model::AnalysisResult& result, int& missing) {
  if (result.outcome != solve::Outcome::converged) throw std::runtime_error(result.message);
  std::vector<Eigen::VectorXd> all;
  for (const model::StepRecord& step : result.steps) {
    if (!step.vibrations) continue;
    missing += std::abs(step.vibrations->missing);
    all.push_back(step.vibrations->omega_squared.unaryExpr(&model::frequency));
  }
  return all;
}

void add_bar(const std::string& folder, CaseResult& result, int& missing) {
  const auto run = [&](const std::function<void(deck::Built&)>& edit) {
    return frequencies(run_model(folder + "/bar.yaml", {}, edit), missing);
  };
  const std::vector<Eigen::VectorXd> spring = run({});
  const std::vector<Eigen::VectorXd> held = run([](deck::Built& built) {
    built.model.pairs[0].definition.normal = contact::NormalPenalty{1e8};
  });
  // E = 100, rho = 1, L = 1, k = 50 A: tan q = -2 q
  const std::array<double, 3> of_spring{2.923035233504107, 7.664651100363113, 12.60038069483587};
  for (int n = 0; n < 3; ++n) {
    const std::string mode = "f" + std::to_string(n + 1);
    result.rows.push_back({"bar, free end: " + mode, spring.at(0)[n], 2.5 * (2 * n + 1),
                           Relation::equal, 2e-5, "wave equation"});
    result.rows.push_back({"bar, end on a closed contact: " + mode, spring.at(1)[n],
                           of_spring[static_cast<std::size_t>(n)], Relation::equal, 2e-5,
                           "tan q = -E A q / k"});
    result.rows.push_back({"bar, end on a stiff contact: " + mode, held.at(1)[n], 5.0 * (n + 1),
                           Relation::equal, 2e-5, "wave equation"});
  }
}

/// Each takes part in a motion of the whole bar by 8 / ((2 n - 1) pi)^2 of its mass.
void add_masses(const std::string& folder, CaseResult& result) {
  const model::AnalysisResult run = run_model(folder + "/bar.yaml", {});
  const model::Vibrations& away = run.steps.at(1).vibrations.value();
  const double mass = 0.1;
  for (int n = 0; n < 3; ++n) {
    const double angle = (2 * n + 1) * std::numbers::pi;
    const double part = away.participation(n, 0);
    result.rows.push_back({"bar, free end: share of the mass in vibration " + std::to_string(n + 1),
                           part * part / mass, 8 / (angle * angle), Relation::equal, 1e-4,
                           "wave equation"});
  }
}

/// Without supports: 3 in the plane.
void add_free_block(const std::string& folder, CaseResult& result, int& missing) {
  const model::AnalysisResult run = run_model(folder + "/free.yaml", {});
  const std::vector<Eigen::VectorXd> all = frequencies(run, missing);
  result.rows.push_back({"free bar: third frequency / fourth",
                         std::abs(all.at(0)[2] / all.at(0)[3]), 1e-4, Relation::at_most, 0,
                         "rigid motions"});
  const model::Vibrations& free = run.steps.back().vibrations.value();
  for (const int k : {0, 1, 5})
    result.rows.push_back(
        {"free bar: mass in all vibrations / mass, motion " + std::to_string(k + 1),
         free.participation.col(k).squaredNorm() / free.moving_mass[k], 1, Relation::equal, 1e-9,
         "rigid motions take it all"});
  result.rows.push_back(
      {"free bar: fourth frequency", all.at(0)[3], 0.5, Relation::at_least, 0, ""});
}

/// Guided, as pinned: f_1 rises by sqrt(1 + T L^2 / (E I pi^2)), T / (E I) = 12 strain / h^2.
void add_strip(const std::string& folder, CaseResult& result, int& missing) {
  const std::vector<Eigen::VectorXd> all =
      frequencies(run_model(folder + "/strip.yaml", {}), missing);
  const double h = 0.02, strain = 1e-3, bending = std::numbers::pi * std::numbers::pi;
  const double expected = std::sqrt(1 + 12 * strain / (h * h) / bending);
  result.rows.push_back({"strip under tension: f1 / f1 without", all.at(1)[1] / all.at(0)[1],
                         expected, Relation::equal, 5e-3, "Timoshenko, Young, Weaver 1974"});
  const double f1 = std::numbers::pi / 2 * std::sqrt(1000.0 / 12) * h;
  result.rows.push_back({"strip: f1", all.at(0)[1], f1, Relation::equal, 5e-3, "Euler's beam"});
}

/// A bar that turns about its own axis and shears: w_n^2 = ((2 n - 1) pi / (2 L))^2 G / rho - W^2.
void add_turning_bar(const std::string& folder, CaseResult& result, int& missing) {
  const std::vector<Eigen::VectorXd> all =
      frequencies(run_model(folder + "/turning.yaml", {}), missing);
  for (int n = 0; n < 3; ++n) {
    const double q = (2 * n + 1) * std::numbers::pi / 2, omega_squared = q * q * 50 - 50;
    result.rows.push_back({"bar turning about its axis: f" + std::to_string(n + 1), all.at(0)[n],
                           model::frequency(omega_squared), Relation::equal, 5e-5,
                           "wave equation in a frame that turns"});
  }
}

}  // namespace

CaseResult vibrations(const CaseContext& context) {
  CaseResult result;
  int missing = 0;
  add_bar(context.folder, result, missing);
  add_masses(context.folder, result);
  add_free_block(context.folder, result, missing);
  add_strip(context.folder, result, missing);
  add_turning_bar(context.folder, result, missing);
  result.rows.push_back({"vibrations that are missing", static_cast<double>(missing), 0,
                         Relation::equal, 0, "law of inertia"});
  return result;
}

}  // namespace osculate::verification

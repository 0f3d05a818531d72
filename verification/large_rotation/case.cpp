#include <algorithm>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

struct DragRun {
  int iterations = 0;
  bool converged = false;
  double rotation = 0;         ///< of the master under the tip, degrees
  std::vector<double> orders;  ///< one per increment of the drag, the first one left out
  Curve residuals{"residuals", {"increment", "iteration", "log10_residual"}, {}};
};

/// Order of convergence from the last three residuals of an increment.
double observed_order(const std::vector<solve::IterationRecord>& it) {
  if (it.size() < 3) return 0;
  const std::size_t i = it.size() - 1;
  return std::log(it[i].residual / it[i - 1].residual) /
         std::log(it[i - 1].residual / it[i - 2].residual);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

DragRun drag(const std::string& path, bool consistent) {
  DragRun run;
  const auto look = [&](const Snapshot& s) {
    for (const auto& p : s.system.contact()[0].points)
      if (p.status != contact::Status::open)
        run.rotation = std::max(
            run.rotation, std::atan2(std::abs(p.frame.col(0).y()), std::abs(p.frame.col(0).x())) *
                              180 / std::numbers::pi);
    if (!s.record || s.progress.step != 1) return;
    if (s.progress.increment > 1) {
      run.orders.push_back(observed_order(s.record->iterations));
      run.iterations += static_cast<int>(s.record->iterations.size());
    }
    int number = 0;
    for (const auto& it : s.record->iterations)
      run.residuals.rows.push_back({static_cast<double>(s.progress.increment),
                                    static_cast<double>(++number),
                                    std::log10(std::max(it.residual, 1e-16))});
  };
  const model::AnalysisResult result = run_model(path, look, [&](deck::Built& built) {
    built.model.pairs[0].definition.tangent.consistent = consistent;
  });
  run.converged = result.outcome == solve::Outcome::converged;
  return run;
}

}  // namespace

CaseResult large_rotation(const CaseContext& context) {
  CaseResult result;
  const DragRun exact = drag(context.folder + "/strip.yaml", true);
  const DragRun covariant = drag(context.folder + "/strip.yaml", false);
  result.rows.push_back(
      {"consistent: finished", exact.converged ? 1.0 : 0.0, 1, Relation::equal, 0, ""});
  result.rows.push_back(
      {"rotation of the master [degrees]", exact.rotation, 20, Relation::at_least, 0, "model"});
  result.rows.push_back({"consistent: order of convergence (median)", median(exact.orders), 1.8,
                         Relation::at_least, 0, "Newton"});
  result.rows.push_back(
      {"consistent: iterations", static_cast<double>(exact.iterations), 0, Relation::info, 0, ""});
  result.rows.push_back({"covariant: iterations", static_cast<double>(covariant.iterations), 0,
                         Relation::info, 0, covariant.converged ? "" : "stopped before the end"});
  result.rows.push_back({"iterations covariant / consistent",
                         static_cast<double>(covariant.iterations) / exact.iterations, 1.2,
                         Relation::at_least, 0, "docs/errata.md"});
  result.curves = {exact.residuals, covariant.residuals};
  result.curves[1].name = "residuals_covariant";
  return result;
}

}  // namespace osculate::verification

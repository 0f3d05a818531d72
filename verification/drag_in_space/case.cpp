#include <algorithm>
#include <cmath>

#include "../cases.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::verification {
namespace {

struct DragRun {
  bool converged = false;
  int iterations = 0;          ///< of both steps, those of dropped attempts included
  int slipping = 0;            ///< points at the end
  double force = 0;            ///< shear force at the end
  std::vector<double> orders;  ///< of each increment of the drag
};

/// Order of convergence from the last three residuals above rounding; 0 if there are not three.
double observed_order(const std::vector<solve::IterationRecord>& it) {
  std::size_t last = it.size();
  while (last > 0 && it[last - 1].residual < 1e-13) --last;
  if (last < 3) return 0;
  const double a = it[last - 3].residual, b = it[last - 2].residual, c = it[last - 1].residual;
  return std::log(c / b) / std::log(b / a);
}

DragRun drag(const std::string& path, const contact::TangentForm& tangent) {
  deck::Built3 built = std::get<deck::Built3>(deck::build_any_file(path));
  built.model.pairs[0].definition.tangent = tangent;
  DragRun run;
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3& system, const model::State3&,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    if (!record) return true;
    run.iterations += static_cast<int>(record->iterations.size()) + record->wasted_iterations;
    if (progress.step == 1) run.orders.push_back(observed_order(record->iterations));
    Vec3 shear = Vec3::Zero();
    run.slipping = 0;
    for (const pairing::PointResult<3>& point : system.contact()[0].points) {
      shear += point.weight * point.shear();
      run.slipping += point.status == contact::Status::slip ? 1 : 0;
    }
    run.force = shear.norm();
    return true;
  };
  run.converged =
      model::run(built.model, built.options, observer).outcome == solve::Outcome::converged;
  return run;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

CaseResult drag_in_space(const CaseContext& context) {
  const std::string path = context.folder + "/drag.yaml";
  const auto parts = [&](bool consistent, bool rotational, bool curvature) {
    contact::TangentForm form;
    form.consistent = consistent;
    form.rotational = rotational;
    form.curvature = curvature;
    return drag(path, form);
  };
  const DragRun exact = parts(true, true, true);
  const DragRun all = parts(false, true, true);
  const DragRun main_curvature = parts(false, false, true);
  const DragRun main_only = parts(false, false, false);
  CaseResult result;
  const auto info = [&](const char* name, double value) {
    result.rows.push_back({name, value, 0, Relation::info, 0, ""});
  };
  result.rows.push_back(
      {"consistent: finished", exact.converged ? 1.0 : 0.0, 1, Relation::equal, 0, ""});
  result.rows.push_back({"consistent: order of convergence (median)", median(exact.orders), 1.8,
                         Relation::at_least, 0, "Newton"});
  info("points that slip at the end, of 16", exact.slipping);
  info("consistent: iterations", exact.iterations);
  info("covariant, all parts: iterations", all.iterations);
  info("covariant, main and curvature: iterations", main_curvature.iterations);
  info("covariant, main: iterations", main_only.iterations);
  result.rows.push_back({"iterations covariant, all parts / consistent",
                         static_cast<double>(all.iterations) / exact.iterations, 1.2,
                         Relation::at_least, 0, "docs/errata.md"});
  for (const auto& [name, run] : {std::pair{"shear force, all parts", &all},
                                  {"shear force, main and curvature", &main_curvature},
                                  {"shear force, main", &main_only}})
    result.rows.push_back({name, run->force, exact.force, Relation::equal, 1e-7,
                           "same equilibrium, consistent tangent"});
  return result;
}

}  // namespace osculate::verification

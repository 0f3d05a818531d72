#include <fmt/format.h>

#include "../cases.hpp"
#include "problems.hpp"

namespace osculate::verification {
namespace {

constexpr const char* promise = "all finish but those without a solution, and these say so";

void add_rows(const HardProblem& problem, const HardOutcome& outcome, CaseResult& result) {
  const auto info = [&](const char* what, double value) {
    result.rows.push_back(
        {fmt::format("{}: {}", problem.name, what), value, 0, Relation::info, 0, ""});
  };
  const char* what = problem.cause.empty() ? "finished" : "stopped with the right cause";
  result.rows.push_back({fmt::format("{}: {}", problem.name, what),
                         as_required(problem, outcome) ? 1.0 : 0.0, 1, Relation::equal, 0,
                         promise});
  info("increments", outcome.increments);
  info("iterations", outcome.iterations);
  info("cut-backs", outcome.cutbacks);
}

struct Remedy {
  const char* name;
  void (*without)(model::AnalysisOptions&);
};

constexpr Remedy remedies[] = {
    {"predictor",
     [](model::AnalysisOptions& o) { o.increments.newton.predictor = solve::Predictor::tangent; }},
    {"snaps and paths",
     [](model::AnalysisOptions& o) { o.increments.arc_length.use = solve::PathControl::off; }},
    {"line search",
     [](model::AnalysisOptions& o) { o.increments.newton.line_search = solve::LineSearch::off; }},
};

/// What each remedy is worth: problems that finish without it, and iterations of those that finish
/// both with and without.
void add_remedies(const CaseContext& context, const std::vector<HardOutcome>& with,
                  CaseResult& result) {
  const std::vector<HardProblem>& problems = hard_problems_list();
  for (const Remedy& remedy : remedies) {
    int required = 0, both = 0, before = 0, after = 0;
    for (std::size_t i = 0; i < problems.size(); ++i) {
      const HardOutcome without =
          run_hard(context.folder, problems[i], context.workers, remedy.without);
      if (as_required(problems[i], without)) ++required;
      if (!with[i].finished || !without.finished) continue;
      ++both;
      before += without.iterations;
      after += with[i].iterations;
    }
    const auto info = [&](const char* what, double value) {
      result.rows.push_back(
          {fmt::format("without {}: {}", remedy.name, what), value, 0, Relation::info, 0, ""});
    };
    info("as required", required);
    info("mean iterations of those that finish", both ? double(before) / both : 0.0);
    info("the same with it", both ? double(after) / both : 0.0);
  }
}

void add_units(CaseResult& result) {
  const UnitsOutcome reference = run_in_units(1, 1);
  struct Units {
    const char* name;
    double length, force;
  };
  for (const Units& units : {Units{"N-m", 1e-3, 1}, Units{"kN-cm", 0.1, 1e-3}}) {
    const UnitsOutcome other = run_in_units(units.length, units.force);
    const bool same = reference.finished && other.finished &&
                      other.iterations == reference.iterations && other.states == reference.states;
    result.rows.push_back(
        {fmt::format("two blocks in {}: states and iterations of N-mm", units.name),
         same ? 1.0 : 0.0, 1, Relation::equal, 0, "units are the user's"});
  }
}

CaseResult run_selection(const CaseContext& context, bool all) {
  CaseResult result;
  std::vector<HardOutcome> outcomes;
  int required = 0;
  for (const HardProblem& problem : hard_problems_list()) {
    if (!all && !problem.quick) continue;
    outcomes.push_back(run_hard(context.folder, problem, context.workers));
    add_rows(problem, outcomes.back(), result);
    if (as_required(problem, outcomes.back())) ++required;
  }
  result.rows.push_back({"problems as required", double(required), double(outcomes.size()),
                         Relation::equal, 0, promise});
  add_units(result);
  if (all) add_remedies(context, outcomes, result);
  return result;
}

}  // namespace

CaseResult hard_problems(const CaseContext& context) { return run_selection(context, false); }
CaseResult hard_problems_all(const CaseContext& context) {
  CaseContext here = context;
  const std::string own = "hard_problems_all";
  if (here.folder.ends_with(own)) here.folder.resize(here.folder.size() - 4);
  return run_selection(here, true);
}

}  // namespace osculate::verification

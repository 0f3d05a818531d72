#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../cases.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::verification {
namespace {

constexpr double pi = std::numbers::pi;

/// Description of a model whose parameters have other values.
deck::Description described(const std::string& path, const std::vector<deck::Setting>& values) {
  return deck::read_model(path, values);
}

/// Runs it to its end; counts the factors that are missing, or may be.
template <int Dim>
model::BasicAnalysisResult<Dim> answer(deck::BasicBuilt<Dim>& built, int& missing) {
  model::BasicAnalysisResult<Dim> result = model::run(built.model, built.options, {});
  if (result.outcome != solve::Outcome::converged) throw std::runtime_error(result.message);
  for (const model::StepRecord& step : result.steps)
    if (step.buckling) missing += std::abs(step.buckling->missing);  // -1: not known
  return result;
}
model::AnalysisResult answer_of(const deck::Description& d, int& missing) {
  deck::Built built = deck::build(d, deck::load_mesh(d));
  return answer(built, missing);
}
Eigen::VectorXd factors_of(const deck::Description& d, int& missing) {
  if (deck::dimension(d) == 2) return answer_of(d, missing).steps.back().buckling->factors;
  deck::Built3 built = deck::build3(d, deck::load_mesh(d));
  return answer(built, missing).steps.back().buckling->factors;
}

/// Which motions of the ends are free, and sqrt(P / (E I)) L.
struct Ends {
  std::string name;
  bool foot_turns, head_turns, head_slides;
  double root;
};

/// P_cr of the column, over Euler's.
double column(const std::string& folder, const Ends& ends, double height, int& missing) {
  deck::Description d = described(folder + "/column.yaml", {{"height", std::to_string(height)}});
  const auto free = [&](const char* on, deck::Component of) {
    deck::Release release = d.steps[0].release[0];
    release.on.value = on;
    release.of = {};
    release.of[static_cast<std::size_t>(of)] = true;
    d.steps[0].release.push_back(release);
  };
  if (ends.foot_turns) free("foot", deck::Component::rz);
  if (ends.head_turns) free("head", deck::Component::rz);
  if (ends.head_slides) free("head", deck::Component::uy);
  const double stiffness = 1.2e7 * height * height * height / 12;
  return factors_of(d, missing)[0] / (ends.root * ends.root * stiffness);
}

void add_columns(const std::string& folder, CaseResult& result, int& missing) {
  const std::vector<Ends> all{{"clamped and free", false, true, true, pi / 2},
                              {"hinged", true, true, false, pi},
                              {"clamped and guided", false, false, true, pi},
                              {"clamped and hinged", false, true, false, 4.493409457909064},
                              {"clamped", false, false, false, 2 * pi}};
  for (const Ends& ends : all) {
    const double thick = column(folder, ends, 0.04, missing),
                 thin = column(folder, ends, 0.02, missing);
    // shear and shortening: of the order of (h / L)^2
    result.rows.push_back({"column " + ends.name + ": P / Euler's, h / L to 0",
                           (4 * thin - thick) / 3, 1, Relation::equal, 1e-4, "Euler 1744"});
    result.rows.push_back({"column " + ends.name + ": order of the difference by h / L",
                           std::log2((1 - thick) / (1 - thin)), 2, Relation::equal, 2e-2, "shear"});
  }
}

void add_plate(const std::string& folder, CaseResult& result, int& missing) {
  const auto factors = [&](double thickness) -> Eigen::VectorXd {
    const double bending = 1e6 * thickness * thickness * thickness / 12 / (1 - 0.09);
    const double classical = 4 * pi * pi * bending / thickness;
    return factors_of(described(folder + "/plate.yaml", {{"thickness", std::to_string(thickness)}}),
                      missing) /
           classical;
  };
  // sides that let their normals turn along them: of the order of t / b
  const Eigen::VectorXd thick = factors(0.01), thin = factors(0.005);
  const Eigen::VectorXd limit = 2 * thin - thick;
  const char* const source = "Bryan 1891";
  result.rows.push_back({"square plate: stress / (4 pi^2 D / (b^2 t)), t / b to 0", limit[0], 1,
                         Relation::equal, 1e-3, source});
  result.rows.push_back(
      {"square plate: of two half-waves", limit[1], 25.0 / 16, Relation::equal, 1e-3, source});
  result.rows.push_back(
      {"square plate: of three half-waves", limit[2], 25.0 / 9, Relation::equal, 2e-3, source});
}

void add_ring(const std::string& folder, CaseResult& result, int& missing) {
  const auto factor = [&](double thickness) {
    const double bending = 1e6 * thickness * thickness * thickness / 12;
    return factors_of(described(folder + "/ring.yaml", {{"thickness", std::to_string(thickness)}}),
                      missing)[0] /
           (4 * bending);
  };
  // the load acts on the outer side: of the order of h / R
  result.rows.push_back({"ring under dead pressure: p / (4 E I / R^3), h / R to 0",
                         2 * factor(0.005) - factor(0.01), 1, Relation::equal, 1e-4,
                         "Bodner 1958"});
}

/// Guided strips: the shape of the vibration is that of buckling, f^2 = f0^2 (1 + P / P_cr).
void add_strip(const std::string& folder, CaseResult& result, int& missing) {
  const auto add = [&](const std::string& name, double height, double way, double tolerance) {
    const model::AnalysisResult run =
        answer_of(described(folder + "/strip.yaml",
                            {{"height", std::to_string(height)}, {"way", std::to_string(way)}}),
                  missing);
    const double rest = 1e-5 * run.steps[3].buckling->factors[0],
                 whole = 1e-5 * run.steps[4].buckling->factors[0];
    const double square = run.steps[5].vibrations->omega_squared[1];
    result.rows.push_back({name + ": what is left to buckle it", (rest - way) / whole, 1,
                           Relation::equal, tolerance, "P_cr - P"});
    result.rows.push_back({name + ": f^2 / f0^2",
                           square / run.steps[1].vibrations->omega_squared[1] / (1 + way / whole),
                           1, Relation::equal, tolerance, "1 + P / P_cr"});
    if (way < 0) return;
    const double string = pi * pi * 1000 * way, bending = pi * pi * height * height / 12 / way;
    result.rows.push_back({name + ": f^2 / that of a string", square / string, 1 + bending,
                           Relation::equal, 2e-3, "wave equation, and bending"});
  };
  add("strip that is pressed", 0.02, -1.6e-4, 1e-4);
  add("strip that is pulled", 0.02, 1e-3, 1e-4);
  add("string", 0.002, 1e-3, 1e-3);
}

}  // namespace

CaseResult buckling(const CaseContext& context) {
  CaseResult result;
  int missing = 0;
  add_columns(context.folder, result, missing);
  add_plate(context.folder, result, missing);
  add_ring(context.folder, result, missing);
  add_strip(context.folder, result, missing);
  result.rows.push_back({"factors that are missing", static_cast<double>(missing), 0,
                         Relation::equal, 0, "law of inertia"});
  return result;
}

}  // namespace osculate::verification

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "../run_space.hpp"
#include "osculate/model/fields.hpp"

namespace osculate::verification {
namespace {

constexpr double length = 2;  ///< of the block, which is 1 high and 1 thick

/// A block on a rigid line; `contact` are the keys of its law, `steps` the list of steps.
std::string block_text(double young, const std::string& contact, const std::string& steps) {
  return fmt::format(R"(osculate: 1
title: Block on a rigid line
mesh: {{generate: {{block: {{box: {{x: [0, {}], y: [0, 1], elements: [4, 2]}}}}}}}}
materials: {{s: {{linear_elastic: {{E: {}, nu: 0}}}}}}
sections: [{{on: block, material: s, element: plane_strain}}]
rigid: {{floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: block.bottom, {}}}]
steps: {}
{}
)",
                     length, young, contact, steps,
                     young > 1e6 ? "" : "solver: {tolerance: {residual: 1.0e-13}}");
}

/// What the points of a contact carry together, and their least and largest gap.
struct Sum {
  double normal = 0, shear = 0, slid = 0, area = 0;
  double least = 1e300, largest = -1e300;
  double apart = 0;  ///< largest of |distance slid - way along the floor| of sliding points
  std::vector<std::array<double, 2>> sliding;  ///< T / N and distance slid, point by point
};

Sum sum_of(const Snapshot& now) {
  Sum sum;
  for (const pairing::PointResult<2>& p : now.system.contact()[0].points) {
    sum.normal -= p.weight * p.normal_traction;
    sum.shear += p.weight * std::abs(p.shear_traction[0]);
    sum.area += p.weight;
    sum.slid += p.weight * p.history.slid;
    sum.least = std::min(sum.least, p.gap);
    sum.largest = std::max(sum.largest, p.gap);
    if (p.status != contact::Status::slip) continue;
    sum.apart = std::max(sum.apart, std::abs(p.history.slid - std::abs(p.history.slip[0])));
    sum.sliding.push_back({std::abs(p.shear_traction[0] / p.normal_traction), p.history.slid});
  }
  sum.slid /= sum.area;
  return sum;
}

/// All converged increments of a model; none where it did not come to its end.
std::vector<Sum> history_of(const std::string& text) {
  std::vector<Sum> all;
  const model::AnalysisResult result = run_text(text, [&](const Snapshot& now) {
    if (now.record) all.push_back(sum_of(now));
  });
  if (result.outcome != solve::Outcome::converged) all.clear();
  return all;
}

Sum end_of(const std::string& text) {
  const std::vector<Sum> all = history_of(text);
  return all.empty() ? Sum{} : all.back();
}

void add(CaseResult& out, std::string what, double computed, double reference, double tolerance,
         const char* source) {
  out.rows.push_back({std::move(what), computed, reference, Relation::equal, tolerance, source});
}

// ---- pressure over gap --------------------------------------------------------------------------

/// The gap at which the law p_0 / (e - 1) x (exp(x) - 1), x = 1 - gap / c_0, gives a pressure.
double exponential_gap(double pressure, double p0, double c0) {
  double low = 0, high = 7;
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * (low + high);
    const double p = p0 / (std::numbers::e - 1) * x * (std::exp(x) - 1);
    (p < pressure ? low : high) = x;
  }
  return c0 * (1 - low);
}

void add_gap(CaseResult& out, const std::string& what, const std::string& law, double load,
             double gap) {
  const std::string steps = fmt::format(
      "[{{name: load, increments: 4, pressure: [{{on: block.top, value: {}}}], prescribe: [{{on: "
      "block.left, ux: 0}}]}}]",
      load);
  const Sum end = end_of(block_text(1000, law, steps));
  add(out, what + ": gap / analytic, least", end.least / gap, 1, 1e-10, "p(gap) = load");
  add(out, what + ": gap / analytic, largest", end.largest / gap, 1, 1e-10, "p(gap) = load");
}

void add_normal_laws(CaseResult& out) {
  const std::string exponential = "normal: {exponential: {pressure: 12, clearance: 0.01}}";
  for (const double load : {2.0, 12.5, 80.0})
    add_gap(out, fmt::format("exponential, load {:g}", load), exponential, load,
            exponential_gap(load, 12, 0.01));
  const std::string table = "normal: {table: [[-0.01, 0], [0.01, 10], [0.02, 60]]}";
  add_gap(out, "table, first piece, open", table, 3, 0.004);
  add_gap(out, "table, last piece", table, 35, -0.015);
  add_gap(out, "table, beyond its end", table, 110, -0.03);
  add_gap(out, "penalty at an offset", "normal: {penalty: 1000}, offset: {master: 0.1, slave: 0.2}",
          5, -0.005);
}

/// Pressed, and then pulled as much.
void add_no_separation(CaseResult& out) {
  const auto step = [](const char* name, int value) {
    return fmt::format(
        "{{name: {}, increments: 2, pressure: [{{on: block.top, value: {}}}], "
        "prescribe: [{{on: block.left, ux: 0}}]}}",
        name, value);
  };
  const Sum end = end_of(block_text(1000, "normal: {penalty: 1.0e4, separation: no_separation}",
                                    fmt::format("[{}, {}]", step("press", 3), step("pull", -3))));
  add(out, "no separation: force after pulling / load", end.normal / (-3 * length), 1, 1e-10,
      "statics");
  add(out, "no separation: gap / (load / penalty)", end.largest / 3e-4, 1, 1e-10, "statics");
}

// ---- friction -----------------------------------------------------------------------------------

/// Pressed by `press`, then moved along by `way`.
std::string dragged(double young, const std::string& friction, double press, double way,
                    int increments, double duration, const std::string& enforcement = "penalty") {
  const std::string steps = fmt::format(
      "[{{name: press, increments: 1, duration: 1, prescribe: [{{on: block.top, uy: {0}, ux: "
      "0}}]}}, "
      "{{name: drag, increments: {1}, duration: {2}, prescribe: [{{on: block.top, uy: {0}, ux: "
      "{3}}}]}}]",
      -press, increments, duration, way);
  return block_text(
      young, "normal: {penalty: 1.0e4}, friction: " + friction + ", enforcement: " + enforcement,
      steps);
}

void add_limits(CaseResult& out) {
  for (const double press : {0.01, 0.02}) {
    const Sum tresca =
        end_of(dragged(1000, "{tresca: {limit: 1.5, penalty: 1.0e4}}", press, 0.2, 10, 1));
    add(out, fmt::format("Tresca, pressed by {:g}: sliding force / (tau A)", press),
        tresca.shear / (1.5 * length), 1, 1e-12, "definition");
    const Sum capped =
        end_of(dragged(1000, "{coulomb: {mu: 0.4, penalty: 1.0e4, cap: 1.5}}", press, 0.2, 10, 1));
    add(out, fmt::format("cap, pressed by {:g}: sliding force / (cap A)", press),
        capped.shear / (1.5 * length), 1, 1e-12, "definition");
  }
  const Sum rough = end_of(dragged(1000, "{rough: {penalty: 1.0e3}}", 0.01, 0.005, 10, 1));
  add(out, "rough: distance slid", rough.slid, 0, 1e-15, "definition");
}

constexpr double mu_s = 0.5, mu_k = 0.2, scale = 0.02, eps_t = 1000, stiff = 1e7;

double coefficient(double a) { return mu_k + (mu_s - mu_k) * std::exp(-a / scale); }

/// mu(s) of a spring eps_T that is pulled by `way` under the pressure p: way = mu(s) p / eps_T + s.
double coefficient_at(double way, double p) {
  double low = 0, high = way;
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high);
    (coefficient(s) * p / eps_t + s < way ? low : high) = s;
  }
  return coefficient(low);
}

/// A block stiff against its contact: all of it slides at once.
void add_static_and_kinetic(CaseResult& out) {
  constexpr double press = 1e-3, way = 0.2;
  const std::string law =
      fmt::format("{{coulomb: {{mu: {}, kinetic: {}, decay: {{distance: {}}}, penalty: {}}}}}",
                  mu_s, mu_k, scale, eps_t);
  const std::vector<Sum> all = history_of(dragged(stiff, law, press, way, 400, 1));
  double peak = 0, worst = 0, analytic = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double ratio = all[i].shear / all[i].normal, p = all[i].normal / length;
    peak = std::max(peak, ratio);
    if (!(all[i].slid > 0)) continue;
    for (const auto& [mu, slid] : all[i].sliding)
      worst = std::max(worst, std::abs(mu - coefficient(slid)));
    const double moved = way * static_cast<double>(i) / 400;
    analytic = std::max(analytic, std::abs(ratio - coefficient_at(moved, p)));
  }
  const double last = all.empty() ? 0 : all.back().shear / all.back().normal;
  add(out, "static to kinetic: peak of T / N over mu_s", peak / mu_s, 1, 0.01, "definition");
  add(out, "static to kinetic: T / N at the end over mu_k", last / mu_k, 1, 1e-3, "definition");
  add(out, "static to kinetic: largest error of T / N = mu(distance slid)", worst, 0, 1e-12,
      "definition");
  add(out, "static to kinetic: largest error along the way", analytic, 0, 1e-4,
      "u = mu(s) p / eps_T + s");
}

void add_speed(CaseResult& out) {
  const std::string law =
      fmt::format("{{coulomb: {{mu: {}, kinetic: {}, decay: {{speed: {}}}, penalty: {}}}}}", mu_s,
                  mu_k, 0.3, eps_t);
  for (const double duration : {0.1, 1.0, 10.0}) {
    constexpr double way = 0.2;
    const Sum end = end_of(dragged(stiff, law, 1e-3, way, 20, duration));
    const double mu = mu_k + (mu_s - mu_k) * std::exp(-way / duration / 0.3);
    add(out, fmt::format("speed {:g}: T / N over mu(speed)", way / duration),
        end.shear / end.normal / mu, 1, 1e-7, "definition");
  }
}

/// The same where the tractions are unknowns or corrected: no elastic slip is left, and what the
/// penalty is makes no difference.
void add_enforced(CaseResult& out) {
  struct Method {
    const char *name, *key;
    double elastic;  ///< slip that an increment may leave
  };
  constexpr double young = 1000, press = 0.002, way = 0.2, target = 1e-7;
  const auto law = [](double kinetic, const std::string& decay, double penalty) {
    return fmt::format("{{coulomb: {{mu: {}, kinetic: {}, decay: {{{}}}, penalty: {}}}}}", mu_s,
                       kinetic, decay, penalty);
  };
  const std::string by_distance = fmt::format("distance: {}", scale);
  for (const Method& m : {Method{"multipliers", "lagrange_multiplier", 1e-12},
                          Method{"augmented", "{augmented_lagrange: {target: 1.0e-7}}", target}})
    for (const double penalty : {10.0, 1e4}) {
      const std::string what = fmt::format("{}, penalty {:g}: ", m.name, penalty);
      const std::vector<Sum> all =
          history_of(dragged(young, law(mu_k, by_distance, penalty), press, way, 20, 1, m.key));
      double worst = all.empty() ? 1 : 0, apart = worst;
      for (const Sum& now : all) {
        apart = std::max(apart, now.apart);
        for (const auto& [mu, slid] : now.sliding)
          worst = std::max(worst, std::abs(mu - coefficient(slid)));
      }
      add(out, what + "largest error of T / N = mu(distance slid)", worst, 0, 1e-12, "definition");
      add(out, what + "distance slid - way along the floor", apart, 0, 20 * m.elastic,
          "no elastic slip");
      const Sum fast =
          end_of(dragged(young, law(mu_k, "speed: 0.3", penalty), press, way, 20, 1, m.key));
      add(out, what + "T / N over mu(speed 0.2)",
          fast.shear / fast.normal / (mu_k + (mu_s - mu_k) * std::exp(-way / 0.3)), 1, 1e-7,
          "definition");
      const Sum tresca =
          end_of(dragged(young, fmt::format("{{tresca: {{limit: 0.5, penalty: {}}}}}", penalty),
                         press, way, 20, 1, m.key));
      add(out, what + "Tresca, sliding force / (tau A)", tresca.shear / (0.5 * length), 1, 1e-12,
          "definition");
    }
}

// ---- tied patches -------------------------------------------------------------------------------

/// Largest deviation of the nodal stresses from a uniform state; 1 where the analysis failed.
template <class Fields>
double deviation(const Fields& fields, std::size_t component, double value) {
  double worst = 0;
  for (const auto& stress : fields.stress)
    for (std::size_t i = 0; i < stress.size(); ++i)
      worst = std::max(worst, std::abs(stress[i] - (i == component ? value : 0.0)));
  return worst;
}

std::string patch_text(const std::string& type, const std::string& sampling, bool shear) {
  const char* const pull =
      "pressure: [{on: up.top, value: -1}], prescribe: [{on: low.bottom, uy: 0}, {on: low.left, "
      "ux: 0}, {on: up.left, ux: 0}]";
  const char* const slide =
      "traction: [{on: up.top, tx: 1}, {on: up.right, ty: 1}, {on: low.right, ty: 1}, {on: "
      "up.left, "
      "ty: -1}, {on: low.left, ty: -1}], prescribe: [{on: low.bottom, ux: 0, uy: 0}]";
  return fmt::format(R"(osculate: 1
title: Tied patch
mesh:
  generate:
    low: {{box: {{x: [0, 0.7, 1.9, 3], y: [0, 1], elements: [[1, 2, 2], 2], type: {0}}}}}
    up: {{box: {{x: [0, 1.3, 3], y: [1, 2], elements: [[3, 1], 2], type: {0}}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: low, material: s, element: plane_strain}}, {{on: up, material: s, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: up.bottom, sampling: {1},
  normal: {{penalty: 1.0e4, separation: tied}}}}]
steps: [{{name: load, increments: 1, {2}}}]
solver: {{tolerance: {{residual: 1.0e-13}}}}
)",
                     type, sampling, shear ? slide : pull);
}

double patch_error(const std::string& type, const std::string& sampling, bool shear) {
  const deck::Description d =
      deck::parse_model(patch_text(type, sampling, shear), "generated.yaml");
  const deck::Built built = deck::build(d, deck::load_mesh(d));
  double worst = 1;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record)
      worst = deviation(model::nodal_fields(system, built.model, state), shear ? 3 : 1, 1.0);
    return true;
  };
  const auto result = model::run(built.model, built.options, observer);
  return result.outcome == solve::Outcome::converged ? worst : 1.0;
}

double patch_error3(const std::string& low, const std::string& up, bool shear, int threads) {
  const char* const pull =
      "pressure: [{on: up.top, value: -1}], prescribe: [{on: low.bottom, uz: 0}, {on: low.left, "
      "ux: "
      "0}, {on: up.left, ux: 0}, {on: low.front, uy: 0}, {on: up.front, uy: 0}]";
  const char* const slide =
      "traction: [{on: up.top, tx: 1}, {on: up.right, tz: 1}, {on: low.right, tz: 1}, {on: "
      "up.left, "
      "tz: -1}, {on: low.left, tz: -1}], prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}]";
  const std::string text = fmt::format(R"(osculate: 1
title: Tied patch in space
mesh:
  generate:
    low: {{box: {{x: [0, 3], y: [0, 3], z: [0, 1], elements: [2, 2, 1], type: {0}}}}}
    up: {{box: {{x: [0, 3], y: [0, 3], z: [1, 2], elements: [3, 3, 1], type: {1}}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: low, material: s, element: solid}}, {{on: up, material: s, element: solid}}]
contact: [{{name: c, master: low.top, slave: up.bottom, sampling: mortar,
  normal: {{penalty: 1.0e4, separation: tied}}}}]
steps: [{{name: load, increments: 1, {2}}}]
solver: {{tolerance: {{residual: 1.0e-13}}}}
)",
                                       low, up, shear ? slide : pull);
  double worst = 1;
  const auto result = run_text3(text, threads, [&](const Snapshot3& now) {
    if (!now.record) return;
    const auto fields = model::nodal_fields(now.system, now.model, now.state);
    worst = deviation(fields, shear ? 5 : 2, 1.0);
  });
  return result.outcome == solve::Outcome::converged ? worst : 1.0;
}

void add_patches(CaseResult& out, int threads) {
  for (const bool shear : {false, true}) {
    const char* const what = shear ? "shear" : "tension";
    for (const char* const type : {"quad4", "quad8", "quad9", "tri6"})
      add(out, fmt::format("tied patch, mortar, {}, {}: largest error", type, what),
          patch_error(type, "mortar", shear), 0, 1e-10, "uniform stress");
    for (const char* const sampling : {"nodes", "{gauss: 3}"})
      out.rows.push_back({fmt::format("tied patch, {}, quad4, {}: largest error", sampling, what),
                          patch_error("quad4", sampling, shear), 0, Relation::info, 0,
                          "uniform stress"});
    for (const auto& [low, up] :
         {std::pair("hex8", "hex8"), std::pair("hex8", "tet4"), std::pair("hex20", "hex27")})
      add(out, fmt::format("tied patch, mortar, {} and {}, {}: largest error", low, up, what),
          patch_error3(low, up, shear, threads), 0, 1e-10, "uniform stress");
  }
}

}  // namespace

CaseResult contact_laws(const CaseContext& context) {
  CaseResult out;
  add_normal_laws(out);
  add_no_separation(out);
  add_limits(out);
  add_static_and_kinetic(out);
  add_speed(out);
  add_enforced(out);
  add_patches(out, context.threads);
  return out;
}

}  // namespace osculate::verification

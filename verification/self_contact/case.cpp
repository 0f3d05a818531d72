#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "../run_space.hpp"
#include "clip.hpp"

namespace osculate::verification {
namespace {

// ---- clips whose lips close -------------------------------------------------------------------

const char* name_of(ClipKind kind) {
  switch (kind) {
    case ClipKind::own:
      return "surface against itself";
    case ClipKind::all:
      return "contact: all";
    case ClipKind::sides:
      return "inner sides";
    case ClipKind::half:
      return "half on a plane";
  }
  return "";
}

constexpr const char* mirror = "lower half on a rigid plane";

ClipOutcome checked_run(const Clip& clip, const ClipStudy& study, const Workers& workers) {
  ClipOutcome out = run_clip(clip, study, workers);
  const double none = std::numeric_limits<double>::infinity();
  if (!out.converged) out.closing = out.contact = out.area = none;
  return out;
}

/// Lips that stay flat and whose nodes meet: nothing is left of the mesh.
void add_columns(bool space, const Workers& workers, CaseResult& result) {
  const Clip clip = clip_with_columns();
  const double force = column_force(clip), area = clip.to - clip.from;
  const ClipOutcome half = checked_run(clip, {ClipKind::half, space}, workers);
  for (const ClipKind kind : {ClipKind::half, ClipKind::own, ClipKind::all, ClipKind::sides}) {
    const ClipOutcome out = checked_run(clip, {kind, space}, workers);
    const std::string what =
        fmt::format("flat lips in {}, {}: ", space ? "space" : "the plane", name_of(kind));
    result.rows.push_back({what + "contact force", out.contact, force, Relation::equal, 1e-8,
                           "column in uniaxial stress"});
    result.rows.push_back(
        {what + "contact area", out.area, area, Relation::equal, 1e-8, "of the columns' ends"});
    if (kind != ClipKind::half)
      result.rows.push_back({what + "force that closes the clip", out.closing, half.closing,
                             Relation::equal, 1e-8, mirror});
  }
}

/// Rounded lips on finer and finer meshes.
void add_refined(ClipKind kind, const std::array<ClipOutcome, 3>& half, const Workers& workers,
                 CaseResult& result) {
  const std::string what = fmt::format("rounded lips in the plane, {}: ", name_of(kind));
  std::array<double, 3> closing{}, contact{}, area{};
  for (std::size_t i = 0; i < half.size(); ++i) {
    const ClipOutcome out = checked_run(Clip{}, {kind, false, 1 << i}, workers);
    closing[i] = std::abs(out.closing / half[i].closing - 1);
    contact[i] = std::abs(out.contact / half[i].contact - 1);
    area[i] = std::abs(out.area / half[i].area - 1);
  }
  const auto order = [](const std::array<double, 3>& e) { return 0.5 * std::log2(e[0] / e[2]); };
  const std::string at = " off on the finest of three meshes";
  result.rows.push_back({what + "order, force that closes the clip", order(closing), 1.8,
                         Relation::at_least, 0, mirror});
  result.rows.push_back(
      {what + "order, contact force", order(contact), 1.8, Relation::at_least, 0, mirror});
  result.rows.push_back(
      {what + "force that closes the clip," + at, closing[2], 1e-3, Relation::at_most, 0, mirror});
  result.rows.push_back(
      {what + "contact force," + at, contact[2], 1e-3, Relation::at_most, 0, mirror});
  result.rows.push_back({what + "contact area, off on any of them",
                         *std::max_element(area.begin(), area.end()), 1e-8, Relation::at_most, 0,
                         mirror});
}

void add_rounded_in_plane(const Workers& workers, CaseResult& result) {
  std::array<ClipOutcome, 3> half;
  for (std::size_t i = 0; i < half.size(); ++i)
    half[i] = checked_run(Clip{}, {ClipKind::half, false, 1 << i}, workers);
  for (const ClipKind kind : {ClipKind::own, ClipKind::sides})
    add_refined(kind, half, workers, result);
}

/// One-sided pairs in space need a finer mesh, and friction.
void add_one_sided_in_space(const ClipOutcome& half, const Workers& workers, CaseResult& result) {
  const auto run = [&](ClipKind kind, int refine) {
    return checked_run(Clip{}, {kind, true, refine, 0.3}, workers);
  };
  const ClipOutcome coarse = run(ClipKind::sides, 1), fine = run(ClipKind::sides, 2);
  const ClipOutcome half_fine = run(ClipKind::half, 2);
  const double first = std::abs(coarse.closing / half.closing - 1);
  const double second = std::abs(fine.closing / half_fine.closing - 1);
  const std::string what = "rounded lips in space, inner sides, friction: ";
  result.rows.push_back({what + "order, force that closes the clip", std::log2(first / second), 1.8,
                         Relation::at_least, 0, mirror});
  result.rows.push_back({what + "force that closes the clip, off on the finer mesh", second, 1e-2,
                         Relation::at_most, 0, mirror});
  result.rows.push_back({what + "contact area on the finer mesh", fine.area, half_fine.area,
                         Relation::equal, 1e-8, mirror});
}

/// In space on a coarse mesh, with friction that holds the lips on each other.
void add_rounded_in_space(const Workers& workers, CaseResult& result) {
  const ClipOutcome half = checked_run(Clip{}, {ClipKind::half, true}, workers);
  const auto add = [&](ClipKind kind, double mu, Relation force, Relation area) {
    const ClipOutcome out = checked_run(Clip{}, {kind, true, 1, mu}, workers);
    const std::string what =
        fmt::format("rounded lips in space, {}{}: ", name_of(kind),
                    mu > 0 ? fmt::format(", friction {}", mu) : ", no friction");
    const auto limit = [](Relation r, double of) { return r == Relation::info ? 0 : of; };
    result.rows.push_back({what + "force that closes the clip", out.closing, half.closing, force,
                           limit(force, 1e-3), mirror});
    result.rows.push_back(
        {what + "contact area", out.area, half.area, area, limit(area, 1e-8), mirror});
  };
  add(ClipKind::own, 0, Relation::equal, Relation::info);  // rounding decides: see the README
  add(ClipKind::own, 0.03, Relation::equal, Relation::equal);
  add(ClipKind::own, 0.3, Relation::equal, Relation::equal);
  add(ClipKind::all, 0.3, Relation::equal, Relation::equal);
  add(ClipKind::sides, 0, Relation::info, Relation::info);
  add_one_sided_in_space(half, workers, result);
}

// ---- three blocks on top of each other --------------------------------------------------------

std::string row_text(const std::string& contact, bool space) {
  const auto box = [&](double from, double to, int n, int level) {
    const std::string side = fmt::format("[{}, {}]", from, to);
    const std::string up = fmt::format("[{}, {}]", level, level + 1);
    return space ? fmt::format("{{box: {{x: {0}, y: {0}, z: {1}, elements: [{2}, {2}, 1]}}}}", side,
                               up, n)
                 : fmt::format("{{box: {{x: {}, y: {}, elements: [{}, 2]}}}}", side, up, n);
  };
  const int n = space ? 2 : 1;
  return fmt::format(
      R"(osculate: 1
mesh: {{generate: {{low: {}, mid: {}, top: {}}}}}
materials: {{h: {{linear_elastic: {{E: 300, nu: 0.3}}}}, m: {{linear_elastic: {{E: 200, nu: 0.3}}}},
  s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: h, element: {}}}, {{on: mid, material: m, element: {}}},
  {{on: top, material: s, element: {}}}]
contact: {}
steps: [{{name: press, increments: 4, prescribe: [{{on: top.top, ux: 0.05, {}: -0.1}},
  {{on: low.bottom, ux: 0, uy: 0{}}}]}}]
solver: {{tolerance: {{residual: 1.0e-12}}}}
)",
      box(0, 4, 8 / n, 0), box(0.5, 3.5, 7 / n, 1), box(1, 3, 5 / n, 2),
      space ? "solid" : "plane_strain", space ? "solid" : "plane_strain",
      space ? "solid" : "plane_strain", contact, space ? "uy: 0, uz" : "uy",
      space ? ", uz: 0" : "");
}

/// Two plates of one outline: the nodes of both rims lie on each other.
std::string stack_text(const std::string& contact, bool space) {
  const auto box = [&](double from, int cells) {
    const std::string up = fmt::format("[{}, {}]", from, from + 0.4);
    return space ? fmt::format("{{box: {{x: [0, 4], y: [0, 3], z: {}, elements: [5, 4, 1]}}}}", up)
                 : fmt::format("{{box: {{x: [0, 4], y: {}, elements: [{}, 1]}}}}", up, cells);
  };
  return fmt::format(
      R"(osculate: 1
mesh: {{generate: {{low: {}, top: {}}}}}
materials: {{m: {{neo_hooke: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: m, element: {}}}, {{on: top, material: m, element: {}}}]
contact: {}
steps: [{{name: press, increments: 2, prescribe: [{{on: top.top, ux: 0, {}: -0.01}},
  {{on: low.bottom, ux: 0, uy: 0{}}}]}}]
solver: {{tolerance: {{residual: 1.0e-12}}}}
)",
      box(0, 8), box(0.4, 7), space ? "solid" : "plane_strain", space ? "solid" : "plane_strain",
      contact, space ? "uy: 0, uz" : "uy", space ? ", uz: 0" : "");
}

template <int Dim>
Eigen::VectorXd displacements(const std::string& text) {
  const deck::Description d = deck::parse_model(text, "row.yaml");
  const auto built = std::get<deck::BasicBuilt<Dim>>(deck::build_any(d, deck::load_mesh(d)));
  Eigen::VectorXd u;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>&, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord*) {
    u = state.u;
    return true;
  };
  const auto result = model::run(built.model, built.options, observer);
  if (result.outcome != solve::Outcome::converged) u.resize(0);
  return u;
}

/// Largest difference of any displacement, over the largest displacement.
double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.size() == 0 || a.size() != b.size()) return 1;
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

template <int Dim>
double row_difference() {
  const std::string laws =
      "normal: {penalty: 1.0e4}, friction: {coulomb: {mu: 0.3, penalty: 1.0e3}}";
  const std::string all = fmt::format("{{all: {{{}}}}}", laws);
  const std::string pairs = fmt::format(
      "[{{name: a, master: low.top, slave: mid.bottom, two_pass: true, {0}}}, "
      "{{name: b, master: mid.top, slave: top.bottom, two_pass: true, {0}}}]",
      laws);
  return difference(displacements<Dim>(row_text(all, Dim == 3)),
                    displacements<Dim>(row_text(pairs, Dim == 3)));
}

template <int Dim>
double stack_difference() {
  const std::string law = "normal: {penalty: 4000}";
  const std::string all = fmt::format("{{all: {{{}}}}}", law);
  const std::string pair =
      fmt::format("[{{name: a, master: low.top, slave: top.bottom, two_pass: true, {}}}]", law);
  return difference(displacements<Dim>(stack_text(all, Dim == 3)),
                    displacements<Dim>(stack_text(pair, Dim == 3)));
}

}  // namespace

CaseResult self_contact(const CaseContext& context) {
  CaseResult result;
  add_columns(false, context.workers, result);
  add_columns(true, context.workers, result);
  add_rounded_in_plane(context.workers, result);
  add_rounded_in_space(context.workers, result);
  const char* const source = "the same with two explicit pairs of two passes";
  result.rows.push_back({"three blocks in the plane, contact: all: displacements",
                         row_difference<2>(), 1e-12, Relation::at_most, 0, source});
  result.rows.push_back({"three blocks in space, contact: all: displacements", row_difference<3>(),
                         1e-12, Relation::at_most, 0, source});
  const char* const one = "the same with an explicit pair of two passes";
  result.rows.push_back({"two plates of one outline in the plane, contact: all: displacements",
                         stack_difference<2>(), 1e-12, Relation::at_most, 0, one});
  result.rows.push_back({"two plates of one outline in space, contact: all: displacements",
                         stack_difference<3>(), 1e-12, Relation::info, 0, one});
  return result;
}

}  // namespace osculate::verification

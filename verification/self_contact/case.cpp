#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "../run_space.hpp"

namespace osculate::verification {
namespace {

// ---- a clip whose lips close ------------------------------------------------------------------

/// Two arms with a bulge towards each other, joined by half a ring; built as a straight strip (s
/// along it, r from its inner side) and bent in the mesh. Symmetric about the plane between the
/// arms. Loaded on the outer side, above and below the bulges.
struct Clip {
  double arm = 4, inner = 0.5, thick = 0.25, top = 3, bulge = 0.3, width = 0.6;
  [[nodiscard]] double bend() const { return std::numbers::pi * (inner + 0.5 * thick); }

  /// Place of a point of the strip; the lower arm comes first.
  [[nodiscard]] Vec2 at(double s, double r) const {
    const double out = inner + r;
    const auto in = [&](double x) { return bulge * std::exp(-std::pow((x - top) / width, 2)); };
    if (s <= arm) return {arm - s, in(arm - s) - out};
    if (s >= arm + bend()) return {s - arm - bend(), out - in(s - arm - bend())};
    const double angle = 1.5 * std::numbers::pi - (s - arm) / bend() * std::numbers::pi;
    return {out * std::cos(angle), out * std::sin(angle)};
  }
};

enum class Kind {
  own,    ///< the whole surface against itself
  all,    ///< contact: all
  sides,  ///< the inner side of one arm against that of the other
  half    ///< the lower half against a rigid plane in the middle, of twice the stiffness: the gap
          ///< there is half of that between the arms
};

constexpr double penalty = 4000;

std::string contact_text(Kind kind) {
  if (kind == Kind::all) return fmt::format("{{all: {{normal: {{penalty: {}}}}}}}", penalty);
  const char* const master = kind == Kind::own ? "strip" : kind == Kind::sides ? "up" : "middle";
  const char* const slave = kind == Kind::own     ? "strip"
                            : kind == Kind::sides ? "low"
                                                  : "strip.bottom";
  return fmt::format("[{{name: all, master: {}, slave: {}, normal: {{penalty: {}}}}}]", master,
                     slave, kind == Kind::half ? 2 * penalty : penalty);
}

std::string clip_text(const Clip& clip, Kind kind, bool space) {
  const bool half = kind == Kind::half;
  const double b = clip.bend(), a = clip.arm;
  const std::string s = half ? fmt::format("[0, {}, {}]", a, a + b / 2)
                             : fmt::format("[0, {}, {}, {}, {}]", a, a + b / 2, a + b, 2 * a + b);
  const int along = space ? 20 : 40, round = space ? 6 : 10;
  const std::string numbers = half ? fmt::format("[{}, {}]", along, round)
                                   : fmt::format("[{0}, {1}, {1}, {0}]", along, round);
  const std::string box =
      space ? fmt::format("x: {}, y: [0, 1], z: [0, {}], elements: [{}, 3, 1]", s, clip.thick,
                          numbers)
            : fmt::format("x: {}, y: [0, {}], elements: [{}, 2]", s, clip.thick, numbers);
  const std::string up = space ? "uz" : "uy", across = space ? ", uy: 0" : "";
  return fmt::format(
      R"(osculate: 1
title: Clip
mesh: {{generate: {{strip: {{box: {{{}}}}}}}}}
materials: {{m: {{neo_hooke: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: strip, material: m, element: {}, formulation: enhanced}}]
{}contact: {}
steps: [{{name: close, increments: 10, prescribe: [{{on: load_low, ux: 0{}, {}: 0.26}}{}]}}]
solver: {{tolerance: {{residual: 1.0e-10}}}}
output: {{history: [{{on: load_low, of: rf{}}}, {{on: all, of: normal_force}},
  {{on: all, of: area}}, {{on: all, of: max_penetration}}]}}
)",
      box, space ? "solid" : "plane_strain",
      half ? fmt::format("rigid: {{middle: {{{}: {{point: [0, 0{}], normal: [0, {}-1]}}}}}}\n",
                         space ? "plane" : "line", space ? ", 0" : "", space ? "0, " : "")
           : "",
      contact_text(kind), across, up,
      half ? fmt::format(", {{on: strip.right, {}: 0}}", up)
           : fmt::format(", {{on: load_up, ux: 0{}, {}: -0.26}}", across, up),
      up.back());
}

/// Nodes on the outer side over the bulges.
void add_loaded(mesh::Mesh& mesh, const Clip& clip, bool space) {
  const double low = clip.arm - clip.top, up = 2 * clip.arm + clip.bend() - low;
  for (const auto& entry : {std::pair("load_low", low), std::pair("load_up", up)}) {
    mesh::Set set;
    set.name = entry.first;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Vec3& x = mesh.nodes[n];
      const double r = space ? x.z() : x.y();
      if (std::abs(x.x() - entry.second) < 1e-6 && std::abs(r - clip.thick) < 1e-6)
        set.nodes.push_back(static_cast<Index>(n));
    }
    if (!set.nodes.empty()) mesh.sets.push_back(std::move(set));
  }
}

/// Bends the strip and names both halves of its inner side.
void bend(mesh::Mesh& mesh, const Clip& clip, bool space) {
  const mesh::Set inner = *mesh.find_set("strip.bottom");
  std::array<mesh::Set, 2> sides;
  for (const mesh::CellRef& ref : inner.cells) {
    const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    const Index* const nodes = block.cell(ref.cell);
    const double s = mesh.nodes[static_cast<std::size_t>(nodes[0])].x() +
                     mesh.nodes[static_cast<std::size_t>(nodes[1])].x();
    const bool up = s > 2 * clip.arm + clip.bend();
    if (std::abs(s - (2 * clip.arm + clip.bend())) < clip.bend()) continue;  // the ring
    mesh::Set& side = sides[up ? 1 : 0];
    side.cells.push_back(ref);
    side.nodes.insert(side.nodes.end(), nodes, nodes + cell::info(block.type).nodes);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    mesh::Set& side = sides[i];
    side.name = i == 0 ? "low" : "up";
    side.dimension = inner.dimension;
    std::sort(side.nodes.begin(), side.nodes.end());
    side.nodes.erase(std::unique(side.nodes.begin(), side.nodes.end()), side.nodes.end());
    if (!side.cells.empty()) mesh.sets.push_back(side);
  }
  add_loaded(mesh, clip, space);
  for (Vec3& x : mesh.nodes) {
    const Vec2 p = clip.at(x.x(), space ? x.z() : x.y());
    x = space ? Vec3(p.x(), x.y(), p.y()) : Vec3(p.x(), p.y(), 0);
  }
}

/// What the end of the run shows: force at the loaded corner, of the contact, area, penetration.
struct Outcome {
  bool converged = false;
  int iterations = 0;
  std::vector<double> history;
};

template <int Dim>
Outcome run_clip(Kind kind, int threads) {
  const Clip clip;
  const deck::Description d = deck::parse_model(clip_text(clip, kind, Dim == 3), "clip.yaml");
  mesh::Mesh mesh = deck::load_mesh(d);
  bend(mesh, clip, Dim == 3);
  auto built = std::get<deck::BasicBuilt<Dim>>(deck::build_any(d, std::move(mesh)));
  built.options.threads = threads;
  Outcome out;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord* record) {
    out.history.clear();
    if (record) out.iterations += static_cast<int>(record->iterations.size());
    for (const model::HistoryRequest& request : built.history)
      out.history.push_back(model::history_value(system, built.model, state, request));
    return true;
  };
  out.converged =
      model::run(built.model, built.options, observer).outcome == solve::Outcome::converged;
  return out;
}

template <int Dim>
void add_clip(const std::string& where, int threads, CaseResult& result) {
  const Outcome half = run_clip<Dim>(Kind::half, threads), own = run_clip<Dim>(Kind::own, threads);
  const Outcome all = run_clip<Dim>(Kind::all, threads),
                sides = run_clip<Dim>(Kind::sides, threads);
  const auto value = [](const Outcome& o, std::size_t i, double otherwise) {
    return o.converged ? o.history[i] : otherwise;
  };
  const char* const same = "surface against itself";
  const char* const mirror = "lower half on a rigid plane";
  const std::array<const char*, 3> names{"force that closes the clip", "contact force",
                                         "contact area"};
  for (std::size_t i = 0; i < names.size(); ++i)
    result.rows.push_back({fmt::format("{}, contact: all: {}", where, names[i]), value(all, i, 0),
                           value(own, i, 1), Relation::equal, 1e-12, same});
  for (const auto& [outcome, name] :
       {std::pair(&own, "surface against itself"), std::pair(&sides, "inner sides")})
    for (std::size_t i = 0; i < names.size(); ++i)
      result.rows.push_back({fmt::format("{}, {}: {}", where, name, names[i]),
                             value(*outcome, i, 0), value(half, i, 1), Relation::info, 0, mirror});
  result.rows.push_back({where + ", surface against itself: iterations",
                         static_cast<double>(own.iterations), static_cast<double>(half.iterations),
                         Relation::info, 0, mirror});
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

template <int Dim>
Eigen::VectorXd row_displacements(const std::string& contact) {
  const deck::Description d = deck::parse_model(row_text(contact, Dim == 3), "row.yaml");
  const auto built = std::get<deck::BasicBuilt<Dim>>(deck::build_any(d, deck::load_mesh(d)));
  Eigen::VectorXd u;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>&, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord*) {
    u = state.u;
    return true;
  };
  const auto result = model::run(built.model, built.options, observer);
  if (result.outcome != solve::Outcome::converged) u.setConstant(1);
  return u;
}

/// Largest difference of any displacement, over the largest displacement.
template <int Dim>
double row_difference() {
  const std::string laws =
      "normal: {penalty: 1.0e4}, friction: {coulomb: {mu: 0.3, penalty: 1.0e3}}";
  const Eigen::VectorXd all = row_displacements<Dim>(fmt::format("{{all: {{{}}}}}", laws));
  const Eigen::VectorXd pairs = row_displacements<Dim>(fmt::format(
      "[{{name: a, master: low.top, slave: mid.bottom, {0}}}, {{name: b, master: mid.top, slave: "
      "top.bottom, {0}}}]",
      laws));
  return (all - pairs).cwiseAbs().maxCoeff() / pairs.cwiseAbs().maxCoeff();
}

}  // namespace

CaseResult self_contact(const CaseContext& context) {
  CaseResult result;
  add_clip<2>("plane", context.threads, result);
  add_clip<3>("space", context.threads, result);
  const char* const source = "the same with two explicit pairs";
  result.rows.push_back({"three blocks in the plane, contact: all: displacements",
                         row_difference<2>(), 1e-12, Relation::at_most, 0, source});
  result.rows.push_back({"three blocks in space, contact: all: displacements", row_difference<3>(),
                         1e-12, Relation::at_most, 0, source});
  return result;
}

}  // namespace osculate::verification

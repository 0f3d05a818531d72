#include "clip.hpp"

#include <fmt/format.h>

#include <array>

#include "../run_model.hpp"
#include "../run_space.hpp"

namespace osculate::verification {

Vec2 Clip::at(double s, double r) const {
  const double out = inner + r;
  const auto in = [&](double x) { return bulge * std::exp(-std::pow((x - top) / width, 2)); };
  if (s <= arm) return {arm - s, in(arm - s) - out};
  if (s >= arm + bend()) return {s - arm - bend(), out - in(s - arm - bend())};
  const double angle = 1.5 * std::numbers::pi - (s - arm) / bend() * std::numbers::pi;
  return {out * std::cos(angle), out * std::sin(angle)};
}

Clip clip_with_columns() {
  Clip clip;
  clip.arm = 2;
  clip.inner = 0.2;
  clip.thick = 0.75;
  clip.bulge = 0;
  clip.column = 0.5;
  clip.from = 0.4;
  clip.to = 1.2;
  clip.poisson = 0;
  return clip;
}

double column_force(const Clip& clip) {
  double low = 0.5, high = 1;  // of the stretch
  for (int i = 0; i < 100; ++i) {
    const double l = 0.5 * (low + high);
    const double gap = 2 * (clip.inner - clip.close + (1 - l) * clip.column);
    const bool stiffer = 0.5 * clip.young * (1 / l - l) > -clip.penalty * gap;
    (stiffer ? low : high) = l;
  }
  return (clip.to - clip.from) * 0.5 * clip.young * (1 / low - low);
}

namespace {

std::string contact_text(const Clip& clip, const ClipStudy& study) {
  const std::string friction = study.mu > 0 && study.kind != ClipKind::half
                                   ? fmt::format(", friction: {{coulomb: {{mu: {}, penalty: {}}}}}",
                                                 study.mu, 0.5 * clip.penalty)
                                   : "";
  if (study.kind == ClipKind::all)
    return fmt::format("{{all: {{normal: {{penalty: {}}}{}}}}}", clip.penalty, friction);
  const bool own = study.kind == ClipKind::own, half = study.kind == ClipKind::half;
  return fmt::format("[{{name: all, master: {}, slave: {}, normal: {{penalty: {}}}{}}}]",
                     own    ? "strip"
                     : half ? "middle"
                            : "up",
                     own ? "strip" : "low", half ? 2 * clip.penalty : clip.penalty, friction);
}

std::string box_text(const Clip& clip, const ClipStudy& study) {
  const double b = clip.bend(), a = clip.arm;
  const bool columns = clip.column > 0;
  const int n = study.refine;
  const int along = n * (columns ? 10 : study.space ? 20 : 40);
  const int round = n * (columns || study.space ? 6 : 10), depth = n * (columns ? 2 : 3);
  const bool half = study.kind == ClipKind::half;
  const std::string s = half ? fmt::format("[0, {}, {}]", a, a + b / 2)
                             : fmt::format("[0, {}, {}, {}, {}]", a, a + b / 2, a + b, 2 * a + b);
  const std::string pieces = half ? fmt::format("[{}, {}]", along, round)
                                  : fmt::format("[{0}, {1}, {1}, {0}]", along, round);
  const std::string r = columns ? fmt::format("[0, {}, {}]", clip.column, clip.thick)
                                : fmt::format("[0, {}]", clip.thick);
  const std::string layers =
      columns ? fmt::format("[{}, {}]", 2 * n, n) : std::to_string(study.space ? n : 2 * n);
  return study.space ? fmt::format("x: {}, y: [0, 1], z: {}, elements: [{}, {}, {}]", s, r, pieces,
                                   depth, layers)
                     : fmt::format("x: {}, y: {}, elements: [{}, {}]", s, r, pieces, layers);
}

std::string clip_text(const Clip& clip, const ClipStudy& study) {
  const bool half = study.kind == ClipKind::half, space = study.space;
  const std::string up = space ? "uz" : "uy", across = space ? ", uy: 0" : "";
  const std::string plane = space ? "plane: {point: [0, 0, 0], normal: [0, 0, -1]}"
                                  : "line: {point: [0, 0], normal: [0, -1]}";
  return fmt::format(
      R"(osculate: 1
title: Clip
mesh: {{generate: {{strip: {{box: {{{}}}}}}}}}
materials: {{m: {{neo_hooke: {{E: {}, nu: {}}}}}}}
sections: [{{on: strip, material: m, element: {}, formulation: enhanced}}]
{}contact: {}
steps: [{{name: close, increments: 10, prescribe: [{{on: load_low, ux: 0{}, {}: {}}}{}]}}]
solver: {{tolerance: {{residual: 1.0e-11}}}}
output: {{history: [{{on: load_low, of: rf{}}}, {{on: all, of: normal_force}}, {{on: all, of: area}}]}}
)",
      box_text(clip, study), clip.young, clip.poisson, space ? "solid" : "plane_strain",
      half ? fmt::format("rigid: {{middle: {{{}}}}}\n", plane) : "", contact_text(clip, study),
      across, up, clip.close,
      half ? fmt::format(", {{on: strip.right, {}: 0}}", up)
           : fmt::format(", {{on: load_up, ux: 0{}, {}: {}}}", across, up, -clip.close),
      up.back());
}

/// s and r of a node before the strip is bent.
Vec2 strip_place(const Vec3& x, bool space) { return {x.x(), space ? x.z() : x.y()}; }

/// Leaves of the inner layers only the columns; nodes without cells go.
void cut_columns(mesh::Mesh& mesh, const Clip& clip, bool space) {
  if (!(clip.column > 0)) return;
  constexpr double tiny = 1e-9;
  const auto outside = [&](Index n) {
    const Vec2 p = strip_place(mesh.nodes[static_cast<std::size_t>(n)], space);
    const double s = std::min(p.x(), clip.length() - p.x());
    return p.y() < clip.column - tiny && (s < clip.from - tiny || s > clip.to + tiny);
  };
  std::vector<Index> number(mesh.nodes.size(), -1);
  std::vector<Vec3> nodes;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (outside(static_cast<Index>(n))) continue;
    number[n] = static_cast<Index>(nodes.size());
    nodes.push_back(mesh.nodes[n]);
  }
  const auto gone = [&](Index n) { return number[static_cast<std::size_t>(n)] < 0; };
  std::vector<std::vector<Index>> cell(mesh.blocks.size());
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    mesh::Block& block = mesh.blocks[b];
    const int count = cell::info(block.type).nodes;
    mesh::Block left{block.type, {}};
    for (Index c = 0; c < block.size(); ++c) {
      const Index* const of = block.cell(c);
      const bool out = std::any_of(of, of + count, gone);
      cell[b].push_back(out ? -1 : left.size());
      for (int k = 0; k < count && !out; ++k)
        left.connectivity.push_back(number[static_cast<std::size_t>(of[k])]);
    }
    block = std::move(left);
  }
  for (mesh::Set& set : mesh.sets) {
    for (mesh::CellRef& ref : set.cells)
      ref.cell = cell[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)];
    std::erase_if(set.cells, [](const mesh::CellRef& ref) { return ref.cell < 0; });
    for (Index& n : set.nodes) n = number[static_cast<std::size_t>(n)];
    std::erase_if(set.nodes, [](Index n) { return n < 0; });
  }
  mesh.nodes = std::move(nodes);
}

/// The loaded nodes: on the outer side over the bulges, or all from the foot of the columns
/// outwards.
void add_loaded(mesh::Mesh& mesh, const Clip& clip, bool space) {
  constexpr double tiny = 1e-6;
  const bool columns = clip.column > 0;
  const double from = columns ? clip.from : clip.arm - clip.top, to = columns ? clip.to : from;
  const double inner = columns ? clip.column : clip.thick;
  for (const bool up : {false, true}) {
    mesh::Set set;
    set.name = up ? "load_up" : "load_low";
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Vec2 p = strip_place(mesh.nodes[n], space);
      const double s = up ? clip.length() - p.x() : p.x();
      if (s > from - tiny && s < to + tiny && p.y() > inner - tiny)
        set.nodes.push_back(static_cast<Index>(n));
    }
    if (!set.nodes.empty()) mesh.sets.push_back(std::move(set));
  }
}

/// Names both halves of the inner side.
void add_sides(mesh::Mesh& mesh, const Clip& clip) {
  const mesh::Set inner = *mesh.find_set("strip.bottom");
  std::array<mesh::Set, 2> sides;
  for (const mesh::CellRef& ref : inner.cells) {
    const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    const Index* const nodes = block.cell(ref.cell);
    const double s = mesh.nodes[static_cast<std::size_t>(nodes[0])].x() +
                     mesh.nodes[static_cast<std::size_t>(nodes[1])].x();
    if (std::abs(s - clip.length()) < clip.bend()) continue;  // the ring
    mesh::Set& side = sides[s > clip.length() ? 1 : 0];
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
}

template <int Dim>
ClipOutcome run_in(const Clip& clip, const ClipStudy& study, const Workers& workers) {
  const deck::Description d = deck::parse_model(clip_text(clip, study), "clip.yaml");
  mesh::Mesh mesh = deck::load_mesh(d);
  cut_columns(mesh, clip, study.space);
  add_sides(mesh, clip);
  add_loaded(mesh, clip, study.space);
  for (Vec3& x : mesh.nodes) {
    const Vec2 flat = strip_place(x, study.space), p = clip.at(flat.x(), flat.y());
    x = study.space ? Vec3(p.x(), x.y(), p.y()) : Vec3(p.x(), p.y(), 0);
  }
  auto built = std::get<deck::BasicBuilt<Dim>>(deck::build_any(d, std::move(mesh)));
  workers.work_on(built.options);
  ClipOutcome out;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord*) {
    std::vector<double> values;
    for (const model::HistoryRequest& request : built.history)
      values.push_back(model::history_value(system, built.model, state, request));
    out.closing = values[0];
    out.contact = values[1];
    out.area = values[2];
    return true;
  };
  out.converged =
      model::run(built.model, built.options, observer).outcome == solve::Outcome::converged;
  return out;
}

}  // namespace

ClipOutcome run_clip(const Clip& clip, const ClipStudy& study, const Workers& workers) {
  return study.space ? run_in<3>(clip, study, workers) : run_in<2>(clip, study, workers);
}

}  // namespace osculate::verification

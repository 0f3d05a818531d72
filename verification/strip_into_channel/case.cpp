#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::verification {
namespace {

constexpr double stiffness = 2.1e5, corner = 6.5, half_length = 12, height = 0.5;
constexpr const char* source = "KS2D section 7.2";

/// How the corner meets the strip.
enum class Roles { corner_is_slave, strip_is_slave, two_pass };

struct Variant {
  double mu = 0, increment = 0.02, lip = 0.02;
  const char* sampling = "nodes";
  const char* history = "continuous";
  const char* smoothing = "none";
  Roles roles = Roles::corner_is_slave;
};

/// Half of the strip on the channel's corner. The corner is a node, or two orthogonal segments (the
/// lip). The side of the channel guides the strip's nodes from 0.02 below the corner on: there the
/// corner still holds the strip's end.
std::string model_text(const Variant& v, double depth) {
  const std::string friction =
      v.mu > 0 ? fmt::format(", friction: {{coulomb: {{mu: {}, penalty: {}}}}}", v.mu, stiffness)
               : "";
  const bool node = std::string(v.sampling) == "nodes" && v.roles == Roles::corner_is_slave;
  const bool strip = v.roles == Roles::strip_is_slave;
  return fmt::format(
      R"(osculate: 1
title: Strip drawn into a channel with sharp corners
mesh:
  generate:
    strip: {{box: {{x: [0, {0}], y: [0, {1}], elements: [12, 1]}}}}
    side: {{line: {{points: [[{2}, -1], [{2}, 0]], elements: 1}}}}
    lip: {{line: {{points: [[{2}, -{3}], [{2}, 0], [{4}, 0]], elements: [1, 1]}}}}
materials: {{s: {{st_venant_kirchhoff: {{E: 2.1e4, nu: 0.3}}}}}}
sections: [{{on: strip, material: s, element: plane_strain, formulation: enhanced}}]
rigid:
  block: {{set: {5}}}
  channel: {{polyline: {{points: [[{2}, -30], [{2}, -0.04], [{2}, -0.02]]}}}}
contact:
  - {{name: corner, master: {6}, slave: {7}, sampling: {8}, weight: {9}, history: {10},
     two_pass: {11}, smoothing: {16}, normal: {{penalty: {12}}}{13}}}
  - {{name: side, master: channel, slave: strip.bottom, weight: node, history: {10},
     search: {{depth: 0.3}}, normal: {{penalty: {12}}}{13}}}
steps: [{{name: draw, increments: {14}, prescribe: [{{on: strip.left, ux: 0, uy: -{15}}}]}}]
solver: {{tolerance: {{residual: 1.0e-8}}, max_iterations: 30}}
)",
      half_length, height, corner, v.lip, corner + v.lip, node ? "side.end" : "lip",
      strip ? "block" : "strip.bottom", strip ? "strip.bottom" : "block", v.sampling,
      node ? "node" : "reference_area", v.history, v.roles == Roles::two_pass, stiffness, friction,
      std::lround(depth / v.increment), depth, v.smoothing);
}

/// One converged increment.
struct Moment {
  double v = 0, force = 0, on_corner = 0, on_side = 0;
  Index facet = -1;  ///< of the strip, over the corner
};

struct Draw {
  bool finished = false;
  int iterations = 0, cutbacks = 0;
  std::vector<Moment> moments;
  std::vector<io::PlotCurve> shapes;  ///< outlines of the strip
};

/// Outline of the strip: along the lower side and back along the upper one.
io::PlotCurve outline(const model::Model& model, const model::State& state, double v) {
  io::PlotCurve curve{fmt::format("v = {:.1f}", v), {}, {}, io::PlotStyle::line};
  const auto add = [&](const std::string& set, bool forward) {
    std::vector<Index> nodes = model.mesh.find_set(set)->nodes;
    std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) {
      const double difference = model.reference[static_cast<std::size_t>(a)].x() -
                                model.reference[static_cast<std::size_t>(b)].x();
      return forward ? difference < 0 : difference > 0;
    });
    for (const Index n : nodes) {
      const Vec2 x = model.reference[static_cast<std::size_t>(n)] + state.u.segment<2>(2 * n);
      curve.x.push_back(x.x());
      curve.y.push_back(x.y());
    }
  };
  add("strip.bottom", true);
  add("strip.top", false);
  return curve;
}

Moment moment_of(const model::Model& model, const Snapshot& now) {
  using Kind = model::HistoryRequest::Kind;
  const auto value = [&](Kind kind, Index pair, const char* quantity) {
    const std::vector<Index> nodes =
        kind == Kind::nodes ? model.mesh.find_set("strip.left")->nodes : std::vector<Index>{};
    return model::history_value(now.system, model, now.state, {"", kind, pair, nodes, quantity});
  };
  Moment m;
  m.v = -value(Kind::nodes, 0, "uy");
  m.force = -value(Kind::nodes, 0, "rfy");
  const auto last = static_cast<Index>(model.pairs.size()) - 1;
  for (Index p = 0; p < last; ++p) m.on_corner += value(Kind::pair, p, "normal_force");
  m.on_side = value(Kind::pair, last, "normal_force");
  for (const pairing::PointResult<2>& p : now.system.contact()[0].points)
    if (p.status != contact::Status::open) m.facet = p.history.facet;
  return m;
}

Draw draw(const Variant& variant, double depth, const std::vector<double>& pictured = {}) {
  const deck::Description d = deck::parse_model(model_text(variant, depth), "strip.yaml");
  const deck::Built built = deck::build(d, deck::load_mesh(d));
  Draw out;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    const Moment m = moment_of(built.model, {system, state, progress, record});
    for (const double v : pictured)
      if (std::abs(m.v - v) < 0.5 * variant.increment)
        out.shapes.push_back(outline(built.model, state, v));
    if (record) {
      out.iterations += static_cast<int>(record->iterations.size()) + record->wasted_iterations;
      out.cutbacks += record->cutbacks;
    }
    out.moments.push_back(m);
    return true;
  };
  out.finished =
      model::run(built.model, built.options, observer).outcome == solve::Outcome::converged;
  return out;
}

// ---- what the curves show -----------------------------------------------------------------------

/// Change of the force's slope at moment k, times the increment.
double kink(const Draw& d, std::size_t k) {
  return std::abs(d.moments[k + 1].force - 2 * d.moments[k].force + d.moments[k - 1].force);
}

/// Increments in which the corner leaves a facet of the strip for the next one.
std::vector<std::size_t> edge_contacts(const Draw& d) {
  std::vector<std::size_t> out;
  for (std::size_t k = 2; k + 3 < d.moments.size(); ++k)
    if (d.moments[k].on_corner > 0 && d.moments[k - 1].on_corner > 0 &&
        d.moments[k].facet != d.moments[k - 1].facet)
      out.push_back(k);
  return out;
}

/// Largest kink beside the crossing of border `number`, over the force there.
double jump(const Draw& d, std::size_t number) {
  const std::vector<std::size_t> at = edge_contacts(d);
  if (number >= at.size()) return 0;
  double largest = 0;
  for (std::size_t k = at[number] - 1; k <= at[number] + 2; ++k)
    largest = std::max(largest, kink(d, k));
  return largest / d.moments[at[number]].force;
}

/// Largest kink of the whole curve over the largest force.
double largest_jump(const Draw& d) {
  double largest = 0, force = 0;
  for (std::size_t k = 2; k + 1 < d.moments.size(); ++k) {
    largest = std::max(largest, kink(d, k));
    force = std::max(force, d.moments[k].force);
  }
  return largest / force;
}

/// Largest difference of two curves while the corner holds the strip, over the largest force:
/// above (sign 1) or below (sign -1) the reference.
double departure(const Draw& d, const Draw& reference, double sign) {
  double largest = 0, force = 0;
  for (std::size_t k = 0; k < std::min(d.moments.size(), reference.moments.size()); ++k) {
    const Moment &a = d.moments[k], &b = reference.moments[k];
    force = std::max(force, b.force);
    if (!(a.on_corner > 0) || !(b.on_corner > 0)) continue;
    largest = std::max(largest, sign * (a.force - b.force));
  }
  return largest / force;
}

io::PlotCurve curve_of(const Draw& d, std::string label) {
  io::PlotCurve curve{std::move(label), {}, {}, io::PlotStyle::line};
  for (const Moment& m : d.moments) {
    curve.x.push_back(m.v);
    curve.y.push_back(m.force);
  }
  return curve;
}

Picture load_picture(std::string name, std::string title) {
  Picture picture{std::move(name), {}};
  picture.plot.title = std::move(title);
  picture.plot.x.label = "displacement v of the centre";
  picture.plot.y.label = "force";
  return picture;
}

void add(CaseResult& out, std::string quantity, double computed, double reference,
         Relation relation, double tolerance = 0, const char* from = source) {
  out.rows.push_back({std::move(quantity), computed, reference, relation, tolerance, from});
}

/// To its end, and with how many iterations.
void add_run(CaseResult& out, const std::string& name, const Draw& d, Relation relation) {
  add(out, name + ": drawn in to v", d.moments.back().v, 11, relation, 1e-9);
  add(out, name + ": iterations", d.iterations, 0, Relation::info);
}

constexpr const char* two_points = "{lobatto: 2, subdomains: 2}";
constexpr double full_depth = 11;

void add_frictionless(CaseResult& out, double increment) {
  using enum Relation;
  Variant v;
  v.increment = increment;
  Picture picture = load_picture("frictionless", "Strip drawn into a channel without friction");
  double work = 0, peak = 0;
  for (const char* const sampling : {"nodes", two_points, "{lobatto: 5}"}) {
    v.sampling = sampling;
    const Draw d = draw(v, full_depth, {0, 3, 6, 9, 11});
    const std::string name = fmt::format("frictionless, {}", sampling);
    add_run(out, name, d, equal);
    double sum = 0;
    for (std::size_t k = 1; k < d.moments.size(); ++k) {
      sum += 0.5 * (d.moments[k].force + d.moments[k - 1].force) *
             (d.moments[k].v - d.moments[k - 1].v);
      peak = std::max(peak, d.moments[k].force);
    }
    for (std::size_t b = 0; b < 3; ++b)
      add(out, fmt::format("{}: jump at border {} / force", name, b + 1), jump(d, b), 0, info);
    add(out, name + ": force when drawn in / largest force",
        std::abs(d.moments.back().force) / peak, 1e-9, at_most, 0, "nothing holds it");
    picture.plot.curves.push_back(curve_of(d, sampling));
    if (v.sampling == std::string("nodes")) {
      work = sum;
      Picture shapes{"sequence", {}};
      shapes.plot.title = "The strip on its way";
      shapes.plot.x.label = "x";
      shapes.plot.y.label = "y";
      shapes.plot.curves = d.shapes;
      shapes.plot.curves.push_back(
          {"channel", {corner, corner, half_length}, {-12, 0, 0}, io::PlotStyle::line});
      out.pictures.push_back(std::move(shapes));
      continue;
    }
    add(out, name + ": work of drawing it in / that of the node", sum / work, 1, equal, 0.01,
        "the strip ends in the same state");
  }
  v.sampling = "nodes";
  v.smoothing = "hermite";
  const Draw smooth = draw(v, full_depth);
  add_run(out, "frictionless, nodes, smoothed strip", smooth, equal);
  for (std::size_t b = 0; b < 3; ++b)
    add(out, fmt::format("frictionless, nodes, smoothed strip: jump at border {} / force", b + 1),
        jump(smooth, b), 2e-4, at_most);
  picture.plot.curves.push_back(curve_of(smooth, "nodes, smoothed strip"));
  out.pictures.push_back(std::move(picture));
}

void add_friction(CaseResult& out, double increment) {
  using enum Relation;
  Picture picture = load_picture("friction", "Strip drawn into a channel with friction");
  Picture segments = load_picture("segments", "Segment to segment with mu = 0.2");
  Variant v;
  v.increment = increment;
  Draw whole;
  for (const double mu : {0.1, 0.2, 0.3}) {
    v.mu = mu;
    v.history = "continuous";
    const Draw d = draw(v, full_depth);
    const std::string name = fmt::format("mu = {}", mu);
    add_run(out, name + ", continuous", d, equal);
    const Moment& end = d.moments.back();
    add(out, name + ", continuous: straight end, force / (mu N)", end.force / (mu * end.on_side), 1,
        equal, 1e-6, "Coulomb");
    add(out, name + ", continuous: jump at border 1 / force", jump(d, 0), 0, info);
    picture.plot.curves.push_back(curve_of(d, name));
    v.history = "per_facet";
    add_run(out, name + ", per facet", draw(v, full_depth), info);
    // With longer increments it comes over the first borders, and the jump can be seen.
    v.increment = 0.01;
    const Draw bad = draw(v, full_depth);
    v.increment = increment;
    add_run(out, name + ", per facet, increments of 0.01", bad, info);
    add(out,
        name +
            ", per facet, increments of 0.01: jump at border 1 / that of the continuous "
            "history",
        jump(bad, 0) / jump(d, 0), 5, at_least);
    if (mu != 0.2) continue;
    picture.plot.curves.push_back(curve_of(bad, name + ", per facet, increments of 0.01"));
    whole = d;
  }
  v.mu = 0.2;
  for (const char* const sampling : {"{lobatto: 5}", "{lobatto: 10}"})
    for (const char* const history : {"continuous", "per_facet"}) {
      v.sampling = sampling;
      v.history = history;
      const Draw d = draw(v, full_depth);
      const bool continuous = history == std::string("continuous");
      const std::string name = fmt::format("mu = 0.2, {}, {}", sampling, history);
      add_run(out, name, d, continuous ? equal : info);
      add(out, name + ": above the node's curve / largest force", departure(d, whole, 1), 0.02,
          at_most);
      add(out, name + ": below the node's curve / largest force", departure(d, whole, -1),
          continuous ? 0.02 : 0.05, continuous ? at_most : at_least);
      segments.plot.curves.push_back(curve_of(d, fmt::format("{}, {}", sampling, history)));
    }
  out.pictures.push_back(std::move(picture));
  out.pictures.push_back(std::move(segments));
}

/// The strip's nodes against the corner, and both ways: what does not help.
void add_other_roles(CaseResult& out, double increment) {
  Variant v;
  v.mu = 0.2;
  v.increment = increment;
  v.roles = Roles::strip_is_slave;
  const Draw turned = draw(v, full_depth);
  add_run(out, "mu = 0.2, the strip's nodes are slaves", turned, Relation::info);
  add(out, "mu = 0.2, the strip's nodes are slaves: largest jump / largest force",
      largest_jump(turned), 0.1, Relation::at_least);
  v.roles = Roles::two_pass;
  const Draw both = draw(v, full_depth);
  add_run(out, "mu = 0.2, two passes", both, Relation::info);
  add(out, "mu = 0.2, two passes: jump at border 1 / force", jump(both, 0), 0, Relation::info);
  v.history = "per_facet";
  const Draw bad = draw(v, full_depth);
  add_run(out, "mu = 0.2, two passes, per facet", bad, Relation::info);
  add(out, "mu = 0.2, two passes, per facet: jump at border 1 / force", jump(bad, 0), 0.1,
      Relation::at_least);
}

}  // namespace

CaseResult strip_into_channel(const CaseContext&) {
  CaseResult out;
  add_frictionless(out, 0.005);
  add_friction(out, 0.0025);
  add_other_roles(out, 0.0025);
  return out;
}

}  // namespace osculate::verification

// The beam on refined meshes over a smooth cylinder, against the inextensible elastica.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "beam.hpp"
#include "elastica.hpp"

namespace osculate::verification {
namespace {

constexpr double limit = 0.005;
constexpr const char* source = "inextensible elastica over a circle";

/// A cross-section: its node at the bottom and the one above it, at y = 0.
struct Station {
  double s = 0;
  std::size_t bottom = 0, top = 0;
};

std::vector<Station> stations(const model::Model3& m) {
  std::vector<Station> list;
  for (std::size_t bottom = 0; bottom < m.reference.size(); ++bottom) {
    const Vec3& x = m.reference[bottom];
    if (m.body_of_node[bottom] >= 0 || x.y() != 0 || x.z() != 0) continue;
    for (std::size_t top = 0; top < m.reference.size(); ++top)
      if ((m.reference[top] - x - Vec3(0, 0, beam_height)).norm() < 1e-9)
        list.push_back({x.x(), bottom, top});
  }
  std::sort(list.begin(), list.end(), [](const Station& a, const Station& b) { return a.s < b.s; });
  return list;
}

ElasticaSetUp elastica_set_up() {
  const double half = 0.5 * beam_height;
  const double inertia = beam_width * beam_height * beam_height * beam_height / 12;
  ElasticaSetUp set_up;
  set_up.length = beam_length;
  set_up.stiffness = beam_modulus * inertia;
  set_up.offset = half;
  set_up.radius = cylinder_radius;
  set_up.start = {0, half};
  set_up.centre = {0.5 * beam_length, -cylinder_radius};
  return set_up;
}

/// The beam beside the elastica at one pull.
struct Level {
  double pull = 0, force = 0, rotation = 0;
  double distance = 0;  ///< largest one of a section's middle from its place on the elastica
  Elastica reference;
  std::vector<Vec2> line, elastica;  ///< places of the sections' middles
};

void measure_line(const ElasticaSetUp& set_up, const std::vector<Station>& line,
                  const std::vector<Vec3>& x, Level& level) {
  for (const Station& s : line) {
    const Vec3 middle = 0.5 * (x[s.bottom] + x[s.top]);
    const ElasticaPoint there = elastica_point(set_up, level.reference.unknowns, s.s);
    level.line.emplace_back(middle.x(), middle.z());
    level.elastica.push_back(there.x);
    level.distance = std::max(level.distance, (level.line.back() - there.x).norm());
  }
  const Vec3 up = x[line.back().top] - x[line.back().bottom];
  level.rotation = std::atan2(-up.x(), up.z());
}

constexpr int levels = 3, increments = 5 * levels;

/// The part of the cylinder that the beam can touch, so finely divided that its chords do not
/// count.
BeamModel fine_cylinder(int elements, double poisson) {
  BeamModel o;
  o.elements = elements;
  o.poisson = poisson;
  o.from = -0.1;
  o.to = 1;
  o.chords = 220;
  o.increments = increments;
  return o;
}

/// At a third, two thirds and all of the pull; empty levels where the run did not get there.
std::vector<Level> run_beam(const CaseContext& context, const BeamModel& beam) {
  const model::Model3 m = beam_model(beam);
  const std::vector<Station> line = stations(m);
  const ElasticaSetUp set_up = elastica_set_up();
  model::AnalysisOptions options;
  context.workers.work_on(options);
  std::vector<Level> out;
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3& system, const model::BasicState<3>& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    const double reached = levels * progress.fraction;
    if (!record || std::abs(reached - std::round(reached)) > 1e-9) return true;
    Level level;
    level.pull = tip_pull * progress.fraction;
    level.reference = pull_elastica(set_up, level.pull, increments);
    const model::Forces& f = system.forces();
    for (const model::PrescribedDof& p : m.steps[0].prescribed)
      if (p.ramp.target != 0) level.force -= f.internal[p.dof] + f.contact[p.dof];
    measure_line(set_up, line, system.positions(state), level);
    out.push_back(level);
    return true;
  };
  (void)model::run(m, options, observer);
  out.resize(levels);
  return out;
}

void add_row(CaseResult& result, std::string quantity, double computed, double reference,
             Relation relation, double tolerance) {
  result.rows.push_back({std::move(quantity), computed, reference, relation, tolerance, source});
}

/// The elastica against the linear beam, its own energy, its own error of integration.
void add_own_checks(CaseResult& result) {
  const ElasticaSetUp set_up = elastica_set_up();
  constexpr double small = 1e-4, lever = 0.5 * beam_length;
  // clamped, on a support at half the length: w = P l^3 / (3 EI) + P l^3 / (4 EI)
  const double linear = small * set_up.stiffness / (lever * lever * lever * (1.0 / 3 + 1.0 / 4));
  add_row(result, "elastica: force at pull 1e-4 over that of the linear beam",
          pull_elastica(set_up, small, 1).force / linear, 1, Relation::equal, 1e-5);
  constexpr int parts = 90;
  Elastica now;
  now.unknowns[3] = lever;
  double work = 0;
  for (int i = 1; i <= parts; ++i) {  // Simpson
    const double before = now.force;
    const Elastica middle = solve_elastica(set_up, tip_pull * (i - 0.5) / parts, now.unknowns);
    now = solve_elastica(set_up, tip_pull * i / parts, middle.unknowns);
    work += tip_pull / parts * (before + 4 * middle.force + now.force) / 6;
  }
  add_row(result, "elastica: work of the force over energy of bending", work / now.energy, 1,
          Relation::equal, 1e-6);
  add_row(result, "elastica: largest violation of its conditions", now.residual, 1e-10,
          Relation::at_most, 0);
  const Elastica finer = solve_elastica(set_up, tip_pull, now.unknowns, 800);
  add_row(result, "elastica: change of force with steps of half the size",
          std::abs(finer.force / now.force - 1), 1e-10, Relation::at_most, 0);
  const double contact = now.unknowns[3];
  add_row(result, "elastica: curvature at contact times radius (below 1: one point)",
          -elastica_point(set_up, now.unknowns, contact).moment / set_up.stiffness *
              (set_up.radius + set_up.offset),
          1, Relation::at_most, 0);
}

/// How far a beam that stretches and shears is from the elastica.
void add_compliant(CaseResult& result) {
  ElasticaSetUp set_up = elastica_set_up();
  const double area = beam_width * beam_height;
  set_up.axial = 1 / (beam_modulus * area);
  set_up.shear = 1 / (5.0 / 6 * beam_modulus / 2 * area);
  for (int i = 1; i <= levels; ++i) {
    const double pull = tip_pull * i / levels;
    const Elastica stiff = pull_elastica(elastica_set_up(), pull, increments);
    const Elastica soft = pull_elastica(set_up, pull, increments);
    add_row(result, fmt::format("beam theory with extension and shear, pull {:g}: force", pull),
            soft.force, stiff.force, Relation::equal, limit);
  }
}

std::string name_of(const BeamModel& beam) {
  return fmt::format("{} {} elements, nu = {:g}", beam.elements,
                     beam.quadratic ? "quadratic" : "linear", beam.poisson);
}

/// Computed over reference; a level that was not reached gives 0.
double error(double computed, double reference) {
  return reference != 0 ? computed / reference - 1 : -1;
}

void add_levels(const BeamModel& beam, const std::vector<Level>& reached, CaseResult& result) {
  for (int i = 1; i <= levels; ++i) {
    const Level& l = reached[static_cast<std::size_t>(i) - 1];
    const std::string what = fmt::format("{}, pull {:g}: ", name_of(beam), tip_pull * i / levels);
    add_row(result, what + "force / elastica", 1 + error(l.force, l.reference.force), 1,
            Relation::equal, limit);
    add_row(result, what + "rotation of the tip / elastica",
            1 + error(l.rotation, l.reference.rotation), 1, Relation::equal, limit);
    add_row(result, what + "largest distance from the elastica / pull",
            l.pull > 0 ? l.distance / l.pull : 1, limit, Relation::at_most, 0);
  }
}

io::PlotCurve plot_curve(const std::string& label, const std::vector<Vec2>& points,
                         std::size_t every, io::PlotStyle style) {
  io::PlotCurve curve{label, {}, {}, style};
  for (std::size_t i = 0; i < points.size(); i += every) {
    curve.x.push_back(points[i].x());
    curve.y.push_back(points[i].y());
  }
  return curve;
}

void plot_shapes(const BeamModel& beam, const std::vector<Level>& reached, CaseResult& result) {
  Picture picture{"elastica_shape",
                  {"Beam bent over a cylinder", {"x", false, {}}, {"z", false, {}}, {}, {}}};
  for (const Level& l : reached)
    picture.plot.curves.push_back(
        plot_curve(fmt::format("elastica, pull {:g}", l.pull), l.elastica, 1, io::PlotStyle::line));
  for (const Level& l : reached)
    picture.plot.curves.push_back(plot_curve(fmt::format("{}, pull {:g}", name_of(beam), l.pull),
                                             l.line, 8, io::PlotStyle::marks));
  result.pictures.push_back(std::move(picture));
}

void plot_convergence(const Curve& curve, CaseResult& result) {
  io::LinePlot plot{"Beam bent over a cylinder: deviation from the elastica at full pull",
                    {"elements", true, {}},
                    {"relative deviation", true, {}},
                    {},
                    {{"limit", limit}}};
  for (std::size_t k = 1; k < curve.columns.size(); ++k) {
    plot.curves.push_back({curve.columns[k], {}, {}, io::PlotStyle::line_and_marks});
    for (const std::vector<double>& row : curve.rows) {
      if (k == 1) plot.x.ticks.push_back(row[0]);
      plot.curves.back().x.push_back(row[0]);
      plot.curves.back().y.push_back(std::abs(row[k]));
    }
  }
  result.pictures.push_back({"elastica_convergence", std::move(plot)});
}

}  // namespace

void add_elastica(const CaseContext& context, CaseResult& result) {
  constexpr int fine = 192;
  add_own_checks(result);
  add_compliant(result);
  Curve curve{"elastica_convergence", {"elements", "force", "rotation", "distance"}, {}};
  for (const int elements : {24, 48, 96, fine}) {
    const BeamModel beam = fine_cylinder(elements, 0.3);
    const std::vector<Level> reached = run_beam(context, beam);
    const Level& last = reached.back();
    const double force = error(last.force, last.reference.force);
    const double rotation = error(last.rotation, last.reference.rotation);
    const double distance = last.pull > 0 ? last.distance / last.pull : 1;
    curve.rows.push_back({static_cast<double>(elements), force, rotation, distance});
    if (elements < fine) {
      add_row(result, fmt::format("{}, pull 9: largest deviation", name_of(beam)),
              std::max({std::abs(force), std::abs(rotation), distance}), limit, Relation::info, 0);
      continue;
    }
    add_levels(beam, reached, result);
    plot_shapes(beam, reached, result);
  }
  plot_convergence(curve, result);
  result.curves.push_back(std::move(curve));
  const BeamModel plain = fine_cylinder(fine, 0);
  add_levels(plain, run_beam(context, plain), result);
}

}  // namespace osculate::verification

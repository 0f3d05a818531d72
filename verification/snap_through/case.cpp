#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

/// Force in a bar of neo-Hooke with nu = 0 and stretch `stretch`, `area` and Young's modulus 1.
double bar_force(double area, double stretch) { return 0.5 * area * (stretch - 1 / stretch); }

/// The zero of an increasing or falling function between two places with different signs.
template <class F>
double zero(const F& f, double low, double high) {
  const bool rises = f(high) > f(low);
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) < 0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// One point of a path: where the loaded body is, and the force on it.
struct Place {
  double x = 0, force = 0;
  int closed = 0;
};

struct Path {
  bool finished = false;
  std::vector<Place> places;
};

/// Runs a model of this folder; `body` is the loaded one, `axis` that of the force.
Path path_of(const std::string& path, int body, int axis, double force,
             solve::PathControl use = solve::PathControl::always) {
  Path out;
  const model::AnalysisResult result = run_model(
      path,
      [&](const Snapshot& s) {
        if (!s.record) return;
        Place place{s.state.rigid[static_cast<std::size_t>(body)].translation[axis],
                    force * s.record->fraction};
        for (const auto& pair : s.system.contact())
          for (const pairing::PointResult<2>& p : pair.points)
            place.closed += p.status != contact::Status::open ? 1 : 0;
        out.places.push_back(place);
      },
      [&](deck::Built& built) { built.options.increments.arc_length.use = use; });
  out.finished = result.outcome == solve::Outcome::converged;
  return out;
}

// ---- two-bar truss ------------------------------------------------------------------------------

struct Truss {
  static constexpr double length = 10, area = 3, young = 1e3, load = -40;
  double foot = length * std::cos(std::numbers::pi / 12);
  double rise = length * std::sin(std::numbers::pi / 12);
  /// Vertical force on the apex of half a truss that has moved up by v.
  [[nodiscard]] double force(double v) const {
    const double now = std::hypot(foot, rise + v);
    return young * bar_force(area, now / length) * (rise + v) / now;
  }
};

// ---- roller over a detent -----------------------------------------------------------------------

struct Roller {
  static constexpr double start = -0.3, height = 0.98, radius = 1, penalty = 1e5, load = 1.2;
  static constexpr double column = 0.4, column_area = 0.2, hard = 1e3;
  static constexpr double bar = 6, bar_area = 1.6, soft = 5.625;

  /// Sum of the forces of the roller at x on the nodes of the column, whose end has moved by v.
  [[nodiscard]] static std::array<double, 2> on_column(double x, double v) {
    std::array<double, 2> sum{};
    for (const double node : {-0.1, 0.0, 0.1}) {
      const double dx = node - x, dy = v - height, r = std::hypot(dx, dy);
      const double force = penalty * std::max(0.0, radius - r);
      sum[0] += force * dx / r;
      sum[1] += force * dy / r;
    }
    return sum;
  }
  /// Horizontal force on a roller that has moved by u.
  [[nodiscard]] static double force(double u) {
    const double x = start + u;
    const double v = zero(
        [&](double w) {
          return hard * bar_force(column_area, 1 + w / column) - on_column(x, w)[1];
        },
        -0.1, 0.1);
    const double end =
        zero([&](double w) { return penalty * (u - w) + soft * bar_force(bar_area, 1 - w / bar); },
             -0.1, 3);
    return on_column(x, v)[0] + penalty * (u - end);
  }
};

// ---- rows ---------------------------------------------------------------------------------------

/// Largest difference from the curve, over `scale`.
template <class F>
double difference(const Path& path, const F& force, double scale) {
  double largest = 0;
  for (const Place& p : path.places)
    largest = std::max(largest, std::abs(force(p.x) - p.force) / scale);
  return largest;
}

/// How often the force turns on the way.
int turns(const Path& path) {
  int count = 0;
  for (std::size_t i = 2; i < path.places.size(); ++i) {
    const double before = path.places[i - 1].force - path.places[i - 2].force;
    if (before * (path.places[i].force - path.places[i - 1].force) < 0) ++count;
  }
  return count;
}

void row(CaseResult& out, std::string what, double computed, double reference, double tolerance,
         const char* source, Relation relation = Relation::equal) {
  out.rows.push_back({std::move(what), computed, reference, relation, tolerance, source});
}

constexpr const char* statics = "equilibrium of straight bars";

void truss(const CaseContext& context, CaseResult& out) {
  const Truss truss;
  double top = 0;
  for (double v = 0; v > -truss.rise; v -= 1e-4) top = std::max(top, -truss.force(v));
  const std::string file = context.folder + "/truss.yaml";
  const auto force = [&](double v) { return truss.force(v); };
  const double end = zero([&](double v) { return truss.force(v) - Truss::load; }, -4 * truss.rise,
                          -2 * truss.rise);
  const Path path = path_of(file, 1, 1, Truss::load);
  row(out, "truss: the path comes to its end", path.finished, 1, 0, statics);
  row(out, "truss: largest difference from the curve / limit load", difference(path, force, top),
      1e-8, 0, statics, Relation::at_most);
  row(out, "truss: times the load turns", turns(path), 2, 0, statics);
  double highest = 0, lowest = 0;
  for (const Place& p : path.places) {
    if (p.x > -truss.rise) highest = std::max(highest, -p.force / top);
    lowest = std::min(lowest, -p.force / top);
  }
  row(out, "truss: largest load before the snap / limit load", highest, 1, 0, statics,
      Relation::info);
  row(out, "truss: largest load held back / limit load", -lowest, 1, 0, statics, Relation::info);
  row(out, "truss: displacement at the end", path.places.empty() ? 0 : path.places.back().x, end,
      1e-8, statics);
  const Path jump = path_of(file, 1, 1, Truss::load, solve::PathControl::last_resort);
  row(out, "truss: the same by load control, which jumps",
      jump.places.empty() || !jump.finished ? 0 : jump.places.back().x, end, 1e-8, statics);
}

void roller(const CaseContext& context, CaseResult& out) {
  const Path path = path_of(context.folder + "/roller.yaml", 0, 0, Roller::load);
  row(out, "roller: the path comes to its end", path.finished, 1, 0, statics);
  row(out, "roller: largest difference from the curve / load",
      difference(path, Roller::force, Roller::load), 1e-8, 0, statics, Relation::at_most);
  row(out, "roller: times the load turns (three nodes, one after the other)", turns(path), 6, 0,
      statics);
  const auto changes = [&] {
    int count = 0;
    for (std::size_t i = 1; i < path.places.size(); ++i)
      count += path.places[i].closed != path.places[i - 1].closed ? 1 : 0;
    return count;
  }();
  row(out, "roller: increments that change the number of closed points", changes, 0, 0, statics,
      Relation::info);
  row(out, "roller: increments", static_cast<double>(path.places.size()), 0, 0, statics,
      Relation::info);
}

}  // namespace

CaseResult snap_through(const CaseContext& context) {
  CaseResult result;
  truss(context, result);
  roller(context, result);
  return result;
}

}  // namespace osculate::verification

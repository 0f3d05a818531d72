#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "model.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "d'Alembert: rho c v, 2 L / c, restitution 1";

struct Hit {
  bool finished = false;
  double impulse = 0;           ///< of the wall: the change of momentum
  double begins = 0, ends = 0;  ///< first and last moment with a force
  double force = 0;             ///< mean over the middle 80 % of the contact
  double speed = 0;             ///< of the centre of mass at the end, away from the wall
  double stopped = 0;           ///< largest way of the free end towards the wall
  double gained = 0;            ///< largest energy over the one at the start, relative
  double kept = 0;              ///< energy at the end, relative
  double left = 0;              ///< largest of what the ledger of energies leaves, relative
};

Hit hit(const ImpactBar& b, int cells, const std::string& dynamics, double courant) {
  const double h = courant * b.length / cells / wave_speed(b);
  const double duration = touch_time(b) + 1.6 * contact_duration(b);
  const auto increments = static_cast<int>(std::ceil(duration / h));
  Hit out;
  const double begin = touch_time(b), lasts = contact_duration(b);
  double start = 0, count = 0;
  const auto look = [&](const Snapshot& now) {
    const model::Rates& rates = now.state.rates;
    if (rates.empty()) return;
    const int columns = cells + 1;  // the nodes of the bar are the first of the model
    double mean = 0, end = 0;       // the ends of the bar stand for half a cell
    for (int n = 0; n < 2 * columns; ++n) {
      const bool half = n % columns == 0 || n % columns == columns - 1;
      mean += (half ? 0.5 : 1.0) * rates.velocity[2 * n] / (2 * cells);
      end = std::min(end, now.state.u[2 * n]);
    }
    const model::Energies& e = rates.energies;
    const double energy = e.kinetic + e.strain + e.contact;
    if (start == 0) start = energy;
    double force = 0;
    for (const auto& p : now.system.contact()[0].points) force -= p.weight * p.normal_traction;
    if (force > 0 && out.begins == 0) out.begins = e.elapsed;
    if (force > 0) out.ends = e.elapsed;
    if (e.elapsed > begin + 0.1 * lasts && e.elapsed < begin + 0.9 * lasts) {
      out.force += force;
      count += 1;
    }
    out.speed = mean;
    out.stopped = std::max(out.stopped, -end);
    out.gained = std::max(out.gained, energy / start - 1);
    out.kept = energy / start;
    out.left = std::max(out.left, std::abs(start - e.numerical - e.damping - energy) / start);
  };
  const model::AnalysisResult result =
      run_text(bar_model(b, cells, dynamics, increments, increments * h), look);
  out.finished = result.outcome == solve::Outcome::converged;
  out.force /= std::max(1.0, count);
  out.impulse = b.density * b.area * b.length * (out.speed + b.speed);
  return out;
}

void add_bar(CaseResult& out, const ImpactBar& b, const std::string& name, int cells,
             const std::string& dynamics, bool checked) {
  const Hit r = hit(b, cells, dynamics, 0.5);
  const auto row = [&](const char* what, double computed, double reference, double tolerance) {
    if (checked)
      expect(out, name + what, computed, reference, tolerance, source);
    else
      inform(out, name + what, computed, reference, source);
  };
  row(": finished", r.finished, 1, 0);
  row(": mean force / (A rho c v)", r.force / (b.area * contact_pressure(b)), 1, 0.02);
  row(": duration of the contact / (2 L / c)", (r.ends - r.begins) / contact_duration(b), 1, 0.05);
  row(": speed of the rebound / v", r.speed / b.speed, 1, 0.02);
  row(": impulse / (2 m v)", r.impulse / contact_impulse(b), 1, 0.01);
  row(": way of the free end / (gap + v L / c)",
      r.stopped / (b.gap + b.speed * b.length / wave_speed(b)), 1, 0.02);
  row(": energy at the end / at the start", r.kept, 1, 0.02);
  out.rows.push_back({name + ": largest gain of energy, relative", r.gained, 1e-9,
                      checked ? Relation::at_most : Relation::info, 0, "energy"});
  out.rows.push_back({name + ": largest gap of the ledger, relative", r.left, 1e-3,
                      checked ? Relation::at_most : Relation::info, 0, "conservation of energy"});
}

}  // namespace

CaseResult bar_impact(const CaseContext&) {
  CaseResult out;
  const ImpactBar bar{10, 0.5, 100, 0.01, 0.1, 0.005};  // c = 100, contact 0.2
  add_bar(out, bar, "dissipative, 200 cells", 200, "{impact: dissipative}", true);
  for (const int cells : {25, 100})
    add_bar(out, bar, fmt::format("dissipative, {} cells", cells), cells, "{impact: dissipative}",
            false);
  add_bar(out, bar, "dissipative, radius 0.8, 100 cells", 100,
          "{impact: dissipative, scheme: {generalized_alpha: {radius: 0.8}}}", false);
  add_bar(out, bar, "average, 100 cells", 100, "{impact: average}", false);
  return out;
}

}  // namespace osculate::verification

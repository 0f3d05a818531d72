#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "model.hpp"

namespace osculate::verification {
namespace {

constexpr const char* spring = "piecewise: free fall and a spring that only pushes";
constexpr const char* scheme = "property of the scheme";

/// Twenty bounces and the way up to the highest point after them.
struct Bounces {
  bool finished = false;
  double top = 0;        ///< highest point after the last bounce, over the first height
  double late = 0;       ///< when it is there, against the exact time, over a bounce's period
  double deepest = 0;    ///< largest penetration
  double gained = 0;     ///< largest energy over the one at the start, relative
  double left = 0;       ///< largest of what the ledger of energies leaves, relative
  double free_fall = 0;  ///< largest error of the height before the first touch, over the height
};

Bounces bounce(const SpringBall& b, const std::string& dynamics, int steps_a_contact) {
  constexpr int bounces = 20;
  const double period = bounce_period(b), h = contact_duration(b) / steps_a_contact;
  const auto increments = static_cast<int>(std::ceil((bounces + 0.3) * period / h));
  Bounces out;
  double highest = -1;
  const double whole = b.mass * b.gravity * b.height;
  for (const PathPoint& p : body_path(ball_model(b, dynamics, increments, increments * h))) {
    out.finished = true;
    const double height = b.height + p.translation.y();
    out.deepest = std::max(out.deepest, -height);
    const model::Energies& e = p.energies;
    const double energy = e.kinetic + e.contact + b.mass * b.gravity * height;
    out.gained = std::max(out.gained, energy / whole - 1);
    out.left = std::max(out.left, std::abs(e.start + b.mass * b.gravity * (b.height - height) -
                                           e.damping - e.numerical - e.kinetic - e.contact) /
                                      whole);
    if (p.time < 0.9 * std::sqrt(2 * b.height / b.gravity))
      out.free_fall = std::max(out.free_fall, std::abs(height - ball_at(b, p.time).height));
    if (p.time < (bounces - 0.3) * period || height < highest) continue;
    highest = height;
    // exact between the increments: the speed that is left says how far the top is
    out.top = (height + 0.5 * p.velocity.y() * p.velocity.y() / b.gravity) / b.height;
    out.late = (p.time + p.velocity.y() / b.gravity) / period - bounces;
  }
  out.free_fall /= b.height;
  return out;
}

void add_resolved(CaseResult& out) {
  const SpringBall b{0.05, 9.81, 2, 5e4};
  const Bounces fine = bounce(b, "{impact: average}", 30);
  expect(out, "average, 30 increments a contact: finished", fine.finished, 1, 0, spring);
  expect(out, "free fall: largest error / height", fine.free_fall, 0, 1e-10, spring);
  expect(out, "average: height after 20 bounces / first", fine.top, 1, 0.01, spring);
  expect(out, "average: delay after 20 bounces / period", fine.late, 0, 0.01, spring);
  expect(out, "average: largest penetration / exact", fine.deepest / deepest(b), 1, 0.005, spring);
  for (const int steps : {15, 60}) {
    const Bounces other = bounce(b, "{impact: average}", steps);
    const std::string name = fmt::format("average, {} increments a contact: ", steps);
    inform(out, name + "height after 20 bounces / first", other.top, 1, spring);
    inform(out, name + "delay after 20 bounces / period", other.late, 0, spring);
  }
}

void add_dissipative(CaseResult& out) {
  const SpringBall b{0.05, 9.81, 2, 5e4};
  for (const int steps : {3, 15}) {
    const Bounces soft = bounce(b, "{impact: dissipative}", steps);
    const std::string name = fmt::format("dissipative, {} increments a contact: ", steps);
    expect(out, name + "finished", soft.finished, 1, 0, scheme);
    out.rows.push_back({name + "largest gain of energy, relative", soft.gained, 1e-9,
                        Relation::at_most, 0, scheme});
    inform(out, name + "height after 20 bounces / first", soft.top, 1, spring);
  }
}

/// No scheme gains energy from contact forces that dissipate, and nothing is lost without a name:
/// of the work, only that of gravity is taken from the heights.
void add_schemes(CaseResult& out) {
  const SpringBall b{0.05, 9.81, 2, 5e4};
  for (const std::string scheme_of :
       {"newmark", "{hht: {alpha: 0.05}}", "{hht: {alpha: 0.3}}",
        "{generalized_alpha: {radius: 0}}", "{generalized_alpha: {radius: 0.8}}",
        "{generalized_alpha: {radius: 1}}"}) {
    const Bounces soft = bounce(b, "{impact: dissipative, scheme: " + scheme_of + "}", 10);
    expect(out, scheme_of + ", dissipative: finished", soft.finished, 1, 0, scheme);
    out.rows.push_back({scheme_of + ", dissipative: largest gain of energy, relative", soft.gained,
                        1e-9, Relation::at_most, 0, scheme});
    out.rows.push_back({scheme_of + ", dissipative: largest gap of the ledger, relative", soft.left,
                        1e-3, Relation::at_most, 0, "conservation of energy"});
  }
  const Bounces whole = bounce(b, "{impact: average}", 30);
  out.rows.push_back({"average: largest gap of the ledger, relative", whole.left, 1e-3,
                      Relation::at_most, 0, "conservation of energy"});
}

/// A floor so stiff that the increments are blind for it: the restitution is that of the scheme.
void add_stiff(CaseResult& out) {
  const SpringBall b{0.2, 9.81, 2, 1e10};
  constexpr int increments = 297;
  const double fall = std::sqrt(2 * b.height / b.gravity), h = 1.5 * fall / increments;
  const double speed = b.gravity * fall;
  for (const std::string impact : {"plastic", "dissipative"}) {
    double fastest = 0, up = 0, lowest = 0;
    const std::vector<PathPoint> path =
        body_path(ball_model(b, "{impact: " + impact + "}", increments, 1.5 * fall));
    expect(out, impact + ", blind increments: finished", !path.empty(), 1, 0, scheme);
    for (const PathPoint& p : path) {
      lowest = std::min(lowest, b.height + p.translation.y());
      if (p.time < fall + 2 * h) continue;
      fastest = std::max(fastest, std::abs(p.velocity.y()));
      up = std::max(up, p.velocity.y());
    }
    if (impact == "plastic") {
      out.rows.push_back({"plastic, blind increments: largest speed after the impact / (g h)",
                          fastest / (b.gravity * h), 1, Relation::at_most, 0, "restitution 0"});
    } else {
      inform(out, "dissipative, blind increments: restitution", up / speed, 1, scheme);
    }
    expect(out, impact + ", blind increments: largest penetration / height", -lowest / b.height, 0,
           1e-5, scheme);
  }
}

}  // namespace

CaseResult bouncing_ball(const CaseContext&) {
  CaseResult out;
  add_resolved(out);
  add_dissipative(out);
  add_schemes(out);
  add_stiff(out);
  return out;
}

}  // namespace osculate::verification

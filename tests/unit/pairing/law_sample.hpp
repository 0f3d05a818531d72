#pragma once
// Every law of contact, each with a state in one of its branches.
#include <cmath>
#include <vector>

#include "osculate/contact/law/catalogue.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {

/// A law, and a state in one of its branches.
struct Law {
  const char* name;
  contact::NormalLaw normal;
  std::optional<contact::FrictionLaw> friction;
  contact::Status status;
  double depth = 0.05;  ///< penetration
  double carried = 7;   ///< shear traction of the last increment
  pairing::Separation separation = pairing::Separation::allowed;
  double offset = 0, rest = 0;
  std::optional<contact::DampingLaw> damping{};
  double from = 0, deepest = 0;  ///< of damping: gaps of the last increments
};

/// A penalty with damping.
inline Law damping_law(const char* name, const contact::NormalLaw& normal,
                       const contact::DampingLaw& damping, double from, double deepest,
                       std::optional<contact::FrictionLaw> friction = {}) {
  Law law{name, normal, std::move(friction), contact::Status::slip};
  law.damping = damping;
  law.from = from;
  law.deepest = deepest;
  return law;
}

inline contact::Coulomb changing(double mu, double kinetic, contact::FrictionChange::By by,
                                 double scale) {
  return {mu, 80.0, std::numeric_limits<double>::infinity(),
          contact::FrictionChange{kinetic, scale, by}};
}

inline const contact::NormalTable table{{{-0.08, 0}, {-0.012, 20}, {0.2, 400}}};

inline const std::vector<Law>& laws() {
  static const std::vector<Law> all{
      {"exponential closed", contact::NormalExponential{20, 0.04}, {}, contact::Status::slip},
      {"exponential within the clearance",
       contact::NormalExponential{20, 0.12},
       {},
       contact::Status::slip,
       -0.04},
      {"exponential beyond 6 c0", contact::NormalExponential{20, 0.003}, {}, contact::Status::slip},
      {"exponential and stick", contact::NormalExponential{20, 0.12}, contact::Coulomb{10, 80},
       contact::Status::stick, -0.04},
      {"exponential and slip", contact::NormalExponential{20, 0.12}, contact::Coulomb{0.01, 80},
       contact::Status::slip, -0.04},
      {"table, first piece", table, {}, contact::Status::slip, -0.06},
      {"table, last piece", table, contact::Coulomb{0.01, 80}, contact::Status::slip},
      {"capped, sticks", contact::NormalPenalty{1000}, contact::Coulomb{10, 80, 500},
       contact::Status::stick},
      {"capped, slips", contact::NormalPenalty{1000}, contact::Coulomb{10, 80, 0.5},
       contact::Status::slip},
      {"friction falls with distance", contact::NormalPenalty{1000},
       changing(0.02, 0.005, contact::FrictionChange::By::distance, 0.1), contact::Status::slip},
      {"friction grows with distance", contact::NormalPenalty{1000},
       changing(0.01, 0.05, contact::FrictionChange::By::distance, 0.3), contact::Status::slip},
      {"friction falls with distance, sticks", contact::NormalPenalty{1000},
       changing(10, 9.9, contact::FrictionChange::By::distance, 0.1), contact::Status::stick},
      {"friction falls steeply with distance", contact::NormalPenalty{1000},
       changing(0.02, 0.005, contact::FrictionChange::By::distance, 0.001), contact::Status::slip},
      {"friction falls with speed", contact::NormalPenalty{1000},
       changing(0.02, 0.005, contact::FrictionChange::By::speed, 0.2), contact::Status::slip},
      {"Tresca sticks", contact::NormalPenalty{1000}, contact::Tresca{500, 80},
       contact::Status::stick},
      {"Tresca slips", contact::NormalPenalty{1000}, contact::Tresca{0.3, 80},
       contact::Status::slip, 0.05, -7},
      {"rough", contact::NormalPenalty{1000}, contact::Rough{80}, contact::Status::stick},
      {"no separation, pulled",
       contact::NormalPenalty{1000},
       {},
       contact::Status::slip,
       -0.06,
       0,
       pairing::Separation::no_separation},
      {"no separation, pulled, Coulomb", contact::NormalPenalty{1000}, contact::Coulomb{0.3, 80},
       contact::Status::slip, -0.06, 7, pairing::Separation::no_separation},
      {"no separation, pulled, rough", contact::NormalPenalty{1000}, contact::Rough{80},
       contact::Status::stick, -0.06, 7, pairing::Separation::no_separation},
      {"tied in the normal direction, pulled", contact::NormalPenalty{1000},
       contact::Tresca{0.3, 80}, contact::Status::slip, -0.06, 7, pairing::Separation::tied_normal,
       0, 0.01},
      {"tied in the normal direction, pressed", contact::NormalPenalty{1000},
       contact::Coulomb{0.01, 80}, contact::Status::slip, -0.02, 7,
       pairing::Separation::tied_normal, 0.01, 0.2},
      {"offset", contact::NormalPenalty{1000}, contact::Coulomb{0.01, 80}, contact::Status::slip,
       -0.03, 7, pairing::Separation::allowed, 0.12},
      damping_law("viscous, touches", contact::NormalPenalty{1000}, contact::Viscous{100}, 0.4, 0),
      damping_law("viscous, closes, Coulomb", contact::NormalPenalty{1000}, contact::Viscous{100},
                  -0.01, 0, contact::Coulomb{0.01, 80}),
      damping_law("viscous, opens, table", table, contact::Viscous{20}, -0.2, 0),
      damping_law("restitution, loads", contact::NormalPenalty{1000}, contact::Restitution{0.5},
                  -0.01, 0.1),
      damping_law("restitution, unloads, Coulomb", contact::NormalPenalty{1000},
                  contact::Restitution{0.99}, -0.01, -0.07, contact::Coulomb{0.01, 80}),
      damping_law("restitution, unloads, exponential", contact::NormalExponential{20, 0.12},
                  contact::Restitution{0.99}, -0.01, -0.07),
      {"offset, sticks", contact::NormalPenalty{1000}, contact::Coulomb{10, 80},
       contact::Status::stick, -0.03, 7, pairing::Separation::allowed, 0.12},
  };
  return all;
}

/// What must not change between two probes of a derivative: statuses, features, facets, pieces of
/// the laws.
template <int Dim>
std::vector<int> branches(const pairing::PairDefinition<Dim>& pair, const Law& law,
                          const pairing::PairEvaluation<Dim>& e, double duration) {
  std::vector<int> out;
  for (const pairing::PointResult<Dim>& p : e.points) {
    int piece = p.normal_traction > 0 ? 100 : 0;
    const double gap = p.history.gap - pair.offset;
    if (const auto* const t = law.normal.as<contact::NormalTable>())
      for (const auto& point : t->points) piece += -gap > point[0] ? 1 : 0;
    if (const auto* const x = law.normal.as<contact::NormalExponential>())
      piece += gap < -6 * x->clearance ? 1 : 0;
    piece += gap > p.history.deepest ? 1000 : 0;
    double steady = 1;
    if (law.friction) {
      steady = contact::steadying(*law.friction, p.normal_traction, duration);
      if (const auto* const c = law.friction->as<contact::Coulomb>())
        piece += p.shear_traction.norm() > (1 - 1e-9) * c->cap ? 10 : 0;
    }
    out.insert(out.end(), {static_cast<int>(p.status), static_cast<int>(p.history.feature),
                           static_cast<int>(pair.mortar ? 0 : p.history.facet), piece,
                           static_cast<int>(std::log10(steady) + 0.5)});
  }
  return out;
}

/// Gives the pair its law, and a last place a little behind.
template <int Dim>
void set_law(const Law& law, ContactSample<Dim>& s) {
  s.pair.normal = law.normal;
  s.pair.friction = law.friction;
  s.pair.separation = law.separation;
  s.pair.offset = law.offset;
  s.pair.damping = law.damping;
  std::vector<Vec<Dim>> before = s.x;
  Vec<Dim> shift = Vec<Dim>::Constant(0.01);
  shift[0] = 0.04;
  for (const Index n : s.pair.slave.nodes) before[static_cast<std::size_t>(n)] -= shift;
  s.committed = pairing::initial_state<Dim>(s.pair, before);
  for (contact::PointHistory<Dim>& h : s.committed.points) {
    if (h.facet < 0) continue;
    h.active = true;
    h.traction.setZero();
    h.traction[0] = law.carried;
    h.slid = 0.03;
    h.held = law.separation == pairing::Separation::tied_normal;
    h.rest = law.rest;
    if (!law.damping) continue;
    h.gap = law.from;
    if (law.damping->as<contact::Restitution>()) h.deepest = law.deepest;
  }
}

}  // namespace osculate::testing

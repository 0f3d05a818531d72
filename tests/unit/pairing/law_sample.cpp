#include "law_sample.hpp"

#include <limits>

#include "osculate/contact/law/catalogue.hpp"

namespace osculate::testing {
namespace {

/// A penalty with damping.
Law damping_law(const char* name, const contact::NormalLaw& normal,
                const contact::DampingLaw& damping, double from, double deepest,
                std::optional<contact::FrictionLaw> friction = {}) {
  Law law{name, normal, std::move(friction), contact::Status::slip};
  law.damping = damping;
  law.from = from;
  law.deepest = deepest;
  return law;
}

const contact::NormalTable table{{{-0.08, 0}, {-0.012, 20}, {0.2, 400}}};

}  // namespace

contact::FrictionLaw changing(double mu, double kinetic, ChangeBy by, double scale,
                              double stiffness) {
  contact::Coulomb law{mu, stiffness, std::numeric_limits<double>::infinity(), kinetic};
  (by == ChangeBy::distance ? law.distance : law.speed) = scale;
  return law;
}

contact::FrictionLaw rough(double stiffness) { return contact::Rough{stiffness}; }

// A table, hence its length.
const std::vector<Law>& laws() {
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
      {"decaying and slip", contact::NormalDecaying{20, 0.12}, contact::Coulomb{0.01, 80},
       contact::Status::slip, -0.04},
      {"tensile, pulled", contact::NormalTensile{100, 2, 0.12}, contact::Coulomb{0.01, 80},
       contact::Status::slip, -0.04},
      {"tensile, pressed", contact::NormalTensile{100, 2, 0.12}, {}, contact::Status::slip},
      {"table, first piece", table, {}, contact::Status::slip, -0.06},
      {"table, last piece", table, contact::Coulomb{0.01, 80}, contact::Status::slip},
      {"capped, sticks", contact::NormalPenalty{1000}, contact::Coulomb{10, 80, 500},
       contact::Status::stick},
      {"capped, slips", contact::NormalPenalty{1000}, contact::Coulomb{10, 80, 0.5},
       contact::Status::slip},
      {"friction falls with distance", contact::NormalPenalty{1000},
       changing(0.02, 0.005, ChangeBy::distance, 0.1), contact::Status::slip},
      {"friction grows with distance", contact::NormalPenalty{1000},
       changing(0.01, 0.05, ChangeBy::distance, 0.3), contact::Status::slip},
      {"friction falls with distance, sticks", contact::NormalPenalty{1000},
       changing(10, 9.9, ChangeBy::distance, 0.1), contact::Status::stick},
      {"friction falls steeply with distance", contact::NormalPenalty{1000},
       changing(0.02, 0.005, ChangeBy::distance, 0.001), contact::Status::slip},
      {"friction falls with speed", contact::NormalPenalty{1000},
       changing(0.02, 0.005, ChangeBy::speed, 0.2), contact::Status::slip},
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
       pairing::NeverPart{}},
      {"no separation, pulled, Coulomb", contact::NormalPenalty{1000}, contact::Coulomb{0.3, 80},
       contact::Status::slip, -0.06, 7, pairing::NeverPart{}},
      {"no separation, pulled, rough", contact::NormalPenalty{1000}, contact::Rough{80},
       contact::Status::stick, -0.06, 7, pairing::NeverPart{}},
      {"tied in the normal direction, pulled", contact::NormalPenalty{1000},
       contact::Tresca{0.3, 80}, contact::Status::slip, -0.06, 7, pairing::TiedNormal{}, 0, 0.01},
      {"tied in the normal direction, pressed", contact::NormalPenalty{1000},
       contact::Coulomb{0.01, 80}, contact::Status::slip, -0.02, 7, pairing::TiedNormal{}, 0.01,
       0.2},
      {"offset", contact::NormalPenalty{1000}, contact::Coulomb{0.01, 80}, contact::Status::slip,
       -0.03, 7, pairing::MayPart{}, 0.12},
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
       contact::Status::stick, -0.03, 7, pairing::MayPart{}, 0.12},
  };
  return all;
}

int piece_of(const Law& law, double gap, double normal_traction, double shear_traction) {
  int piece = normal_traction > 0 ? 100 : 0;
  if (const auto* const t = law.normal.as<contact::NormalTable>())
    for (const auto& point : t->points) piece += -gap > point[0] ? 1 : 0;
  if (const auto* const x = law.normal.as<contact::NormalExponential>())
    piece += gap < -6 * x->clearance ? 1 : 0;
  if (!law.friction) return piece;
  if (const auto* const c = law.friction->as<contact::Coulomb>())
    piece += shear_traction > (1 - 1e-9) * c->cap ? 10 : 0;
  return piece;
}

}  // namespace osculate::testing

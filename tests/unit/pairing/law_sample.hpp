#pragma once
// Every law of contact, each with a state in one of its branches.
#include <cmath>
#include <vector>

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
  std::variant<pairing::MayPart, pairing::NeverPart, pairing::TiedNormal> separation{};
  double offset = 0, rest = 0;
  std::optional<contact::DampingLaw> damping{};
  double from = 0, deepest = 0;  ///< of damping: gaps of the last increments
};

/// The laws there are, in law_sample.cpp: a new one compiles that source.
const std::vector<Law>& laws();

/// Coulomb's law with a coefficient that changes by the distance slid or by its speed.
enum class ChangeBy { distance, speed };
contact::FrictionLaw changing(double mu, double kinetic, ChangeBy by, double scale,
                              double stiffness = 80);

contact::FrictionLaw rough(double stiffness);

/// The pieces of its laws a point is on.
int piece_of(const Law& law, double gap, double normal_traction, double shear_traction);

/// What must not change between two probes of a derivative: statuses, features, facets, pieces of
/// the laws.
template <int Dim>
std::vector<int> branches(const pairing::PairDefinition<Dim>& pair, const Law& law,
                          const pairing::PairEvaluation<Dim>& e, double duration) {
  std::vector<int> out;
  for (const pairing::PointResult<Dim>& p : e.points) {
    const double gap = p.history.gap - pair.offset;
    int piece = piece_of(law, gap, p.normal_traction, p.shear_traction.norm());
    piece += gap > p.history.deepest ? 1000 : 0;
    double steady = 1;
    if (law.friction) steady = contact::steadying(*law.friction, p.normal_traction, duration);
    out.insert(out.end(), {static_cast<int>(p.status), static_cast<int>(p.history.feature),
                           static_cast<int>(pairing::by_mortar(pair) ? 0 : p.history.facet), piece,
                           static_cast<int>(std::log10(steady) + 0.5)});
  }
  return out;
}

/// Gives the pair its law, and a last place a little behind.
template <int Dim>
void set_law(const Law& law, ContactSample<Dim>& s) {
  s.pair.normal = law.normal;
  s.pair.friction = law.friction;
  std::visit([&](const auto& kind) { s.pair.separation = kind; }, law.separation);
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
    h.held = pairing::is<pairing::TiedNormal>(law.separation);
    h.rest = law.rest;
    if (!law.damping) continue;
    h.gap = law.from;
    if (!contact::needs_duration(*law.damping)) h.deepest = law.deepest;  // a restitution
  }
}

}  // namespace osculate::testing

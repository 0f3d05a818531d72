#pragma once
#include <memory>
#include <string>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

// The laws as everything sees them that does not ask which one it is. Which laws there are stands
// in catalogue.hpp alone: a new or changed one compiles the catalogue, not the code. What a law
// need not have, and what it means if it has it:
//   augmentable = true   normal: a multiplier may replace its traction
//   holds = true         normal: it goes on where a held point is pulled
//   stiffness            normal: it is linear, with this eps_N
//   parting()            friction: the law of points that may part, where it is another
//   remembered(slid, sliding)  friction: what it keeps at a point that has slid so far in the
//                        increment, for the next one (LawMemory)
//   fall(p, duration)    friction: how steeply its limit falls while a point slides
//   damper()             damping: the coefficient of a damper that may be treated by itself
//   fault()              what is wrong with parameters that are in their ranges

struct NormalLaws;    ///< the variant of all normal laws, complete in catalogue.hpp
struct FrictionLaws;  ///< of all friction laws
struct DampingLaws;   ///< of all laws of damping

/// One law of a catalogue, with a factor of its penalty. Copies share the law.
template <class Laws>
class Law {
 public:
  Law();  ///< the first of the catalogue, with its defaults
  /// From a law of the catalogue.
  template <class Value>
  requires requires { Value::key; }
  Law(const Value& law) : law_(made(law)) {}

  [[nodiscard]] const Laws& all() const { return *law_; }
  [[nodiscard]] double factor() const { return factor_; }
  /// The law, if it is this one; the factor is not in it.
  template <class Value>
  [[nodiscard]] const Value* as() const {
    return found<Value>(*law_);
  }
  /// The same law with another penalty: eps_N of a linear law (others have none), eps_T.
  [[nodiscard]] Law stiffened(double factor) const {
    Law law = *this;
    law.factor_ *= factor;
    return law;
  }

  // For the laws of the catalogue; instantiated there.
  template <class Value>
  [[nodiscard]] static std::shared_ptr<const Laws> made(const Value& law);
  template <class Value>
  [[nodiscard]] static const Value* found(const Laws& law);

 private:
  std::shared_ptr<const Laws> law_;
  double factor_ = 1;
};

using NormalLaw = Law<NormalLaws>;
using FrictionLaw = Law<FrictionLaws>;
using DampingLaw = Law<DampingLaws>;

/// The two laws most contacts have, for those who need no other: NormalPenalty{eps_N} and
/// Coulomb{mu, eps_T}.
[[nodiscard]] NormalLaw penalty(double stiffness);
[[nodiscard]] FrictionLaw coulomb(double mu, double stiffness);

/// What a law of damping may ask beside the gap; all gaps are those that the normal law sees.
struct Closing {
  double from = 0;                                           ///< gap at the last converged state
  double deepest = std::numeric_limits<double>::infinity();  ///< NormalResponse::deepest there
  double duration = 0;  ///< of the increment; 0: not known, or `from` is not
};

/// Normal traction at a gap; with `held` also of a point that is pulled, where the law allows it.
[[nodiscard]] NormalResponse response(const NormalLaw& law, double gap, bool held = false);
/// Mean traction over the gaps within way / 2 of this one: that of a time step that passes them at
/// constant speed. A law that begins within the step counts from when it begins on.
///
/// Formula    (U(gap + way/2) - U(gap - way/2)) / way ; the law itself where it is linear there
/// Requires   way > 0
/// Tested by  tests/unit/contact/test_normal_laws.cpp
[[nodiscard]] NormalResponse mean_response(const NormalLaw& law, double gap, double way);
/// Work that the normal traction has taken up at a gap, per weight: -dU/dgap = pressure.
///
/// Tested by  tests/unit/contact/test_normal_laws.cpp
[[nodiscard]] double stored_energy(const NormalLaw& law, double gap, bool held = false);
/// The normal law with damping.
[[nodiscard]] NormalResponse damped(const DampingLaw& damping, const NormalLaw& law, double gap,
                                    const Closing& closing);
/// Largest gap with contact.
[[nodiscard]] double onset_gap(const NormalLaw& law);
/// Whether the law is a means to an end (no penetration) that a multiplier serves better.
[[nodiscard]] bool augmentable(const NormalLaw& law);
/// Whether the law goes on where a held point is pulled.
[[nodiscard]] bool holds(const NormalLaw& law);
/// eps_N of a linear law; 0: the law has none.
[[nodiscard]] double penalty_of(const NormalLaw& law);
/// The same law with this eps_N, if it has one.
[[nodiscard]] NormalLaw with_stiffness(const NormalLaw& law, double stiffness);

/// What is wrong with the numbers of a law; empty: nothing. Ranges are those of its parameters.
///
/// Tested by  tests/unit/contact/test_normal_laws.cpp, test_friction_laws.cpp,
/// test_damping.cpp
[[nodiscard]] std::string fault(const NormalLaw& law);
[[nodiscard]] std::string fault(const FrictionLaw& law);
[[nodiscard]] std::string fault(const DampingLaw& law);

/// The law and its numbers in a few words, for summaries.
[[nodiscard]] std::string text(const NormalLaw& law);
[[nodiscard]] std::string text(const FrictionLaw& law);

/// Coefficient of the damper that the law is; 0: it is none.
[[nodiscard]] double damper(const DampingLaw& law);
/// Largest slope of the pressure of a penalty with damping.
[[nodiscard]] double stiffest(const DampingLaw& law, double penalty, double duration);
/// eps_T
[[nodiscard]] double stiffness(const FrictionLaw& law);
/// The same law with this eps_T.
[[nodiscard]] FrictionLaw with_stiffness(const FrictionLaw& law, double stiffness);
/// The law of points that may part, as against those that are held.
[[nodiscard]] FrictionLaw parting(const FrictionLaw& law);
/// The tangential traction at an elastic predictor.
template <int Dim>
[[nodiscard]] TangentialResponse<Dim> response(const FrictionLaw& law, const Vec<Dim - 1>& trial,
                                               double normal_traction, const Sliding& sliding);
/// At which limit a sliding point is expected to go on, before the first iteration.
[[nodiscard]] SlipLimit predicted_limit(const FrictionLaw& law, double trial,
                                        double normal_traction, const Sliding& sliding);
/// What eps_T is multiplied by around a multiplier, so that a limit that falls while the point
/// slides never falls as steeply as the elastic predictor rises. A point that slides by s has the
/// multiplier t = L(s), hence the trial L(s) + eps_T s; were that below L(0) it would be taken for
/// sticking, and no iteration could end. eps_T is a means there, the answer does not depend on it.
///
/// Formula    the least power of ten with factor eps_T >= 2 max |dL/ds| ,
///            max |dL/ds| as the law says (Coulomb::fall). It is constant but for jumps, and so it
///            has no derivative
/// Tested by  tests/unit/contact/test_friction_laws.cpp,
/// tests/unit/pairing/test_multiplier_laws.cpp
[[nodiscard]] double steadying(const FrictionLaw& law, double normal_traction, double duration);
/// What the law keeps at a point that slides by `slid` in the increment; nothing, of laws without a
/// memory of their own.
///
/// Tested by  tests/unit/contact/test_rate_and_state.cpp
[[nodiscard]] LawMemory remembered(const FrictionLaw& law, double slid, const Sliding& sliding);
/// Whether the law asks how long an increment lasts.
[[nodiscard]] bool needs_duration(const FrictionLaw& law);
[[nodiscard]] bool needs_duration(const DampingLaw& law);

}  // namespace osculate::contact

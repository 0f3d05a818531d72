#pragma once
#include <optional>

#include "osculate/model/inertia.hpp"
#include "osculate/model/state.hpp"
#include "osculate/model/terms/assembly.hpp"

namespace osculate::model {

/// What acts from outside during a step: pressures, centrifugal forces, dead loads, gravity.
///
/// Tested by  tests/unit/model/test_system.cpp, test_dynamics.cpp
template <int Dim>
struct LoadTerm {
  const BasicModel<Dim>& model;
  std::optional<BasicInertia<Dim>> resting{};  ///< for gravity in steps without inertia

  /// Pressures and centrifugal forces.
  void add_following(const Step& step, const BasicState<Dim>& trial, double fraction,
                     LoadPlaces places, Assembly<Dim>& to) const {
    add_pressure(step, trial, fraction, to);
    add_centrifugal(step, trial, fraction, places, to);
  }
  void add_pressure(const Step& step, const BasicState<Dim>& trial, double fraction,
                    Assembly<Dim>& to) const;
  void add_centrifugal(const Step& step, const BasicState<Dim>& trial, double fraction,
                       LoadPlaces places, Assembly<Dim>& to) const;
  /// What pressures on bodies of small strain do as these turn with a small motion about a state,
  /// in the tangent; forces are none. Those on other bodies are in `add_pressure`.
  void add_turning_pressure(const Step& step, double fraction, Assembly<Dim>& to) const;
  void add_dead_loads(const Step& step, double fraction, Forces& forces) const;
  /// `inertia` of the running step, or null.
  void add_gravity(const Step& step, double fraction, const BasicInertia<Dim>* inertia,
                   Forces& forces);
};

extern template struct LoadTerm<2>;
extern template struct LoadTerm<3>;

}  // namespace osculate::model

#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/solve/central_differences.hpp"

namespace osculate::deck {
namespace {

using D = DynamicsDescription;
using Keys = BoundKeys<D>;

/// A scheme with its numbers.
BoundKey<D> numbered(const char* name, SchemeWord scheme, const Keys& numbers, std::string doc) {
  return {optional(name, numbers.spec(std::move(doc))), [=](D& d, const Value& v) {
            d.scheme = scheme;
            numbers.read(v, d);
          }};
}

BoundKey<D> mass_scaling_key() {
  using M = D::MassScaling;
  const BoundKeys<M> keys(
      {may(&M::stable_step, "stable_step",
           number("Stable step that every cell reaches: the mass of those that would not is "
                  "multiplied by the square of what they lack.")
               .in("time")
               .above(0)
               .such_as("1e-6")),
       may(&M::factor, "factor",
           number("Factor of the mass of all cells, before that; for slow processes, whose motion "
                  "has little energy.")
               .at_least(1)
               .otherwise("1")
               .such_as("100"))});
  return {optional("mass_scaling",
                   keys.spec("Mass that cells get so that time steps can be longer. It has no "
                             "weight.")
                       .with(Group::Rule::at_least_one, {"stable_step", "factor"})
                       .otherwise_as("masses as they are")
                       .such_as("{stable_step: 1e-6}")),
          [keys](D& d, const Value& v) { d.mass_scaling = keys.read(v); }};
}

BoundKey<D> scheme_key() {
  const Keys hht({need(&D::parameter, "alpha",
                       number("Dissipation, from 0 (none) to 1/3 (most).")
                           .at_least(0)
                           .at_most(1.0 / 3)
                           .such_as("0.05"))});
  const Keys alpha({need(&D::parameter, "radius",
                         number("Spectral radius at infinitely high "
                                "frequencies: 1 no dissipation, 0 most.")
                             .at_least(0)
                             .at_most(1)
                             .such_as("0.8"))});
  const Keys central(
      {may(&D::safety, "safety",
           number("Share of the longest stable step that is taken; "
                  "above 1 nothing promises stability.")
               .above(0)
               .at_most(2)
               .otherwise("0.9")),
       may(&D::step, "step", number("Longest time step.").in("time").above(0).such_as("1e-7")),
       mass_scaling_key()});
  const Keys schemes(
      {numbered("hht", SchemeWord::hht, hht, "Hilber, Hughes and Taylor's."),
       numbered("generalized_alpha", SchemeWord::generalized_alpha, alpha, "Chung and Hulbert's."),
       numbered("central_differences", SchemeWord::central_differences, central,
                "Explicit: many short time steps in each increment, none of which solves a "
                "system.")});
  Spec spec =
      either("The time integration.",
             {choice("Scheme.", {word("newmark", SchemeWord::newmark,
                                      "Newmark's average acceleration: no dissipation"),
                                 word("central_differences", SchemeWord::central_differences,
                                      "explicit, with stable time steps and lumped masses")}),
              schemes.spec("A scheme with numbers: dissipation of high frequencies, or time steps.")
                  .with(Group::Rule::exactly_one,
                        {"hht", "generalized_alpha", "central_differences"})})
          .otherwise("newmark")
          .such_as("{generalized_alpha: {radius: 0.8}}");
  return {optional("scheme", std::move(spec)), [schemes](D& d, const Value& v) {
            if (v.alternative == 1) return schemes.read(v, d);
            d.safety = solve::CentralDifferences{}.safety;
            store(d.scheme, v);
          }};
}

BoundKey<D> time_steps_key() {
  using T = D::TimeSteps;
  const BoundKeys<T> keys({may(&T::error, "error",
                               number("Largest error of the displacement in a time step, over the "
                                      "time step and the largest change of the velocity so far: "
                                      "about the relative error of the period of a vibration.")
                                   .above(0)
                                   .at_most(0.1)
                                   .otherwise("1e-3")),
                           may(&T::smallest, "smallest",
                               number("Time step that is not shortened for its error any more.")
                                   .in("time")
                                   .above(0)
                                   .otherwise_as("1/1000 of a nominal increment")
                                   .such_as("1e-6"))});
  return {optional("time_steps",
                   keys.spec("Time steps as long as their errors allow, within the nominal "
                             "increments, whose ends are kept; implicit schemes only.")
                       .otherwise_as("the nominal increments")
                       .such_as("{error: 1e-3}")),
          [keys](D& d, const Value& v) { d.time_steps = keys.read(v); }};
}

BoundKey<D> damping_key() {
  const Keys keys({may(&D::damping_mass, "mass",
                       number("Factor of the mass.").in("1/time").at_least(0).otherwise("0")),
                   may(&D::damping_stiffness, "stiffness",
                       number("Factor of the stiffness of the cells, as it is at the "
                              "beginning of an increment.")
                           .in("time")
                           .at_least(0)
                           .otherwise("0")
                           .such_as("1e-4"))});
  return below(keys, optional("damping", keys.spec("Rayleigh damping: both numbers times mass and "
                                                   "stiffness give the damping.")
                                             .otherwise("{}")
                                             .such_as("{stiffness: 1e-4}")));
}

Keys dynamics_keys() {
  return {
      {scheme_key(),
       may(&D::impact, "impact",
           choice("How contact forces enter the time integration.",
                  {word("dissipative", ImpactWord::dissipative,
                        "by their value at the end of each increment: energy does not grow"),
                   word("average", ImpactWord::average,
                        "as all other forces; increments must resolve the contact's stiffness"),
                   word("plastic", ImpactWord::plastic,
                        "as dissipative, but what has hit does not bounce within the increment")})
               .otherwise("dissipative")
               .such_as("average")),
       may(&D::impact_times, "impact_times",
           choice("Impacts that increments end at (the nominal ends of increments are kept as "
                  "well).",
                  {word("auto", ImpactTimesWord::automatic,
                        "of points of rigid bodies with a mass, unless `impact` is average"),
                   word("all", ImpactTimesWord::all, "of all contact points"),
                   word("off", ImpactTimesWord::off, "of none")})
               .otherwise("auto")
               .such_as("all")),
       may(&D::mass, "mass",
           choice("Distribution of the mass of cells.",
                  {word("consistent", MassWord::consistent, "by the shape functions"),
                   word("lumped", MassWord::lumped, "at the nodes")})
               .otherwise("consistent")
               .such_as("lumped")),
       damping_key(), time_steps_key()}};
}

/// What central differences do not do.
void check_explicit(const Value& v, const DynamicsDescription& d) {
  if (v.at("mass").given && d.mass == MassWord::consistent)
    throw core::InputError(
        v.at("mass").mark,
        "central differences need masses at the nodes: lumped, which is what they "
        "have without this key");
  for (const char* const key : {"impact", "impact_times"})
    if (v.at(key).given)
      throw core::InputError(v.at(key).mark,
                             "is of the implicit schemes; central differences take contact as any "
                             "other force");
  if (d.time_steps)
    throw core::InputError(
        d.time_steps->mark,
        "is of the implicit schemes; central differences take their stable step, "
        "or less by `scheme: {central_differences: {step}}`");
  if (d.damping_stiffness > 0)
    throw core::InputError(v.at("damping").at("stiffness").mark,
                           "damping by the stiffness makes the stable step of central differences "
                           "far shorter; they take damping by the mass only");
}

}  // namespace

Spec dynamics_spec() {
  return dynamics_keys()
      .spec("Inertia: the step is an integration in time, over its duration.")
      .such_as("{scheme: {generalized_alpha: {radius: 0.8}}}");
}

DynamicsDescription parse_dynamics(const Value& v) {
  D d = dynamics_keys().read(v);
  if (d.scheme == SchemeWord::central_differences) check_explicit(v, d);
  return d;
}

Spec gravity_spec() {
  return list(
             "Acceleration of gravity, which acts on everything with a mass from the beginning of "
             "a step with inertia (in other steps it is ramped); it persists.",
             number("One component.").in("length/time^2"))
      .count(2, 3)
      .such_as("[0, -9.81]");
}

}  // namespace osculate::deck

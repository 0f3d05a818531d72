#include "osculate/deck/description.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Spec scheme_spec() {
  const Spec hht = map("Hilber, Hughes and Taylor's.",
                       {required("alpha", number("Dissipation, from 0 (none) to 1/3 (most).")
                                              .at_least(0)
                                              .at_most(1.0 / 3)
                                              .such_as("0.05"))});
  const Spec alpha =
      map("Chung and Hulbert's.",
          {required("radius", number("Spectral radius at infinitely high frequencies: 1 no "
                                     "dissipation, 0 most.")
                                  .at_least(0)
                                  .at_most(1)
                                  .such_as("0.8"))});
  const Spec central =
      map("Explicit: many short time steps in each increment, none of which solves a system.",
          {optional("safety", number("Share of the longest stable step that is taken; above 1 "
                                     "nothing promises stability.")
                                  .above(0)
                                  .at_most(2)
                                  .otherwise("0.9")),
           optional("step", number("Longest time step.").in("time").above(0).such_as("1e-7"))});
  return either("The time integration.",
                {choice("Scheme.", {word("newmark", SchemeWord::newmark,
                                         "Newmark's average acceleration: no dissipation"),
                                    word("central_differences", SchemeWord::central_differences,
                                         "explicit, with stable time steps and lumped masses")}),
                 map("A scheme with numbers: dissipation of high frequencies, or time steps.",
                     {optional("hht", hht), optional("generalized_alpha", alpha),
                      optional("central_differences", central)})
                     .with(Group::Rule::exactly_one,
                           {"hht", "generalized_alpha", "central_differences"})})
      .otherwise("newmark")
      .such_as("{generalized_alpha: {radius: 0.8}}");
}

}  // namespace

Spec dynamics_spec() {
  const Spec impact =
      choice("How contact forces enter the time integration.",
             {word("dissipative", ImpactWord::dissipative,
                   "by their value at the end of each increment: energy does not grow"),
              word("average", ImpactWord::average,
                   "as all other forces; increments must resolve the contact's stiffness"),
              word("plastic", ImpactWord::plastic,
                   "as dissipative, but what has hit does not bounce within the increment")})
          .otherwise("dissipative")
          .such_as("average");
  const Spec times =
      choice("Impacts that increments end at (the nominal ends of increments are kept as well).",
             {word("auto", ImpactTimesWord::automatic,
                   "of points of rigid bodies with a mass, unless `impact` is average"),
              word("all", ImpactTimesWord::all, "of all contact points"),
              word("off", ImpactTimesWord::off, "of none")})
          .otherwise("auto")
          .such_as("all");
  const Spec mass = choice("Distribution of the mass of cells.",
                           {word("consistent", MassWord::consistent, "by the shape functions"),
                            word("lumped", MassWord::lumped, "at the nodes")})
                        .otherwise("consistent")
                        .such_as("lumped");
  const Spec damping =
      map("Rayleigh damping: both numbers times mass and stiffness give the damping.",
          {optional("mass", number("Factor of the mass.").in("1/time").at_least(0).otherwise("0")),
           optional("stiffness", number("Factor of the stiffness of the cells, as it is at the "
                                        "beginning of an increment.")
                                     .in("time")
                                     .at_least(0)
                                     .otherwise("0")
                                     .such_as("1e-4"))})
          .otherwise("{}")
          .such_as("{stiffness: 1e-4}");
  const Spec time_steps =
      map("Time steps as long as their errors allow, within the nominal increments, whose ends are "
          "kept; implicit schemes only.",
          {optional("error", number("Largest error of the displacement in a time step, over the "
                                    "time step and the largest change of the velocity so far: "
                                    "about the relative error of the period of a vibration.")
                                 .above(0)
                                 .at_most(0.1)
                                 .otherwise("1e-3")),
           optional("smallest", number("Time step that is not shortened for its error any more.")
                                    .in("time")
                                    .above(0)
                                    .otherwise_as("1/1000 of a nominal increment")
                                    .such_as("1e-6"))})
          .otherwise_as("the nominal increments")
          .such_as("{error: 1e-3}");
  return map("Inertia: the step is an integration in time, over its duration.",
             {optional("scheme", scheme_spec()), optional("impact", impact),
              optional("impact_times", times), optional("mass", mass), optional("damping", damping),
              optional("time_steps", time_steps)})
      .such_as("{scheme: {generalized_alpha: {radius: 0.8}}}");
}

Spec gravity_spec() {
  return list(
             "Acceleration of gravity, which acts on everything with a mass from the beginning of "
             "a step with inertia (in other steps it is ramped); it persists.",
             number("One component.").in("length/time^2"))
      .count(2, 3)
      .such_as("[0, -9.81]");
}

Spec initial_velocity_spec() {
  const auto component = [](const char* name, const char* doc, const char* unit) {
    return optional(name, number(doc).in(unit).such_as("-2"));
  };
  return list("Velocities at the beginning of the first step with inertia.",
              map("One velocity.",
                  {required("on", text("Set of nodes or cells, or rigid body.").such_as("ball")),
                   component("vx", "Velocity in x.", "length/time"),
                   component("vy", "Velocity in y.", "length/time"),
                   component("vz", "Velocity in z (models in space).", "length/time"),
                   component("wx", "Angular velocity of a rigid body, x (models in space).",
                             "radians/time"),
                   component("wy", "Angular velocity of a rigid body, y (models in space).",
                             "radians/time"),
                   component("wz", "Angular velocity of a rigid body, positive from x to y.",
                             "radians/time")})
                  .with(Group::Rule::at_least_one, {"vx", "vy", "vz", "wx", "wy", "wz"}))
      .otherwise("[]")
      .such_as("[{on: ball, vy: -2}]");
}

}  // namespace osculate::deck

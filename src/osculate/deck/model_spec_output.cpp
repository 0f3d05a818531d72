#include "osculate/deck/description.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Spec quantity_spec() {
  using Q = Quantity;
  return choice(
             "What to record: displacements and reactions of sets and rigid bodies, or a quantity "
             "of a contact pair.",
             {word("ux", Q::ux, "average displacement in x"),
              word("uy", Q::uy, "average displacement in y"),
              word("uz", Q::uz, "average displacement in z (models in space)"),
              word("rx", Q::rx, "rotation vector of a rigid body, x (models in space)"),
              word("ry", Q::ry, "rotation vector of a rigid body, y (models in space)"),
              word("rz", Q::rz, "rotation of a rigid body; in space its rotation vector, z"),
              word("vx", Q::vx, "average velocity in x (steps with inertia)"),
              word("vy", Q::vy, "average velocity in y (steps with inertia)"),
              word("vz", Q::vz, "average velocity in z (models in space)"),
              word("wx", Q::wx, "angular velocity of a rigid body, x (models in space)"),
              word("wy", Q::wy, "angular velocity of a rigid body, y (models in space)"),
              word("wz", Q::wz, "angular velocity of a rigid body, positive from x to y"),
              word("rfx", Q::rfx, "sum of the reactions in x"),
              word("rfy", Q::rfy, "sum of the reactions in y"),
              word("rfz", Q::rfz, "sum of the reactions in z (models in space)"),
              word(
                  "rmx", Q::rmx,
                  "reaction moment of a rigid body about its reference point, x (models in space)"),
              word(
                  "rmy", Q::rmy,
                  "reaction moment of a rigid body about its reference point, y (models in space)"),
              word("rmz", Q::rmz,
                   "reaction moment of a rigid body about its reference point, in space z"),
              word("force_x", Q::force_x, "contact force on the slave in x"),
              word("force_y", Q::force_y, "contact force on the slave in y"),
              word("force_z", Q::force_z, "contact force on the slave in z (models in space)"),
              word("normal_force", Q::normal_force,
                   "sum of the normal forces, positive in contact"),
              word("shear_force", Q::shear_force, "sum of the tangential forces"),
              word("max_pressure", Q::max_pressure, "largest contact pressure"),
              word("max_penetration", Q::max_penetration, "largest penetration"),
              word("stick", Q::stick, "number of sticking points"),
              word("slipping", Q::slipping, "number of sliding points"),
              word("closed", Q::closed, "number of points in contact, with friction or without"),
              word("slip", Q::slip,
                   "largest distance that a point in contact has slid since it touched the master"),
              word("open", Q::open, "number of open points"),
              word("area", Q::area, "area of the points in contact"),
              word("friction_work", Q::friction_work,
                   "work that sliding has dissipated since the beginning")})
      .such_as("normal_force");
}

Spec plots_spec() {
  const Spec column =
      text("A column of history.csv: step, increment, time or one of `history`.").such_as("time");
  return list("Diagrams of the report.",
              map("One diagram.",
                  {optional("title", text("Title.").such_as("Pull-out force")),
                   required("x", column),
                   required("y", either("Column of the ordinate, or a list of several.",
                                        {column, list("Columns.", column).count(1)})
                                     .such_as("[top.rfx, top.rfy]"))}))
      .otherwise("[]")
      .such_as("[{x: time, y: floor.normal_force}]");
}

Spec arc_length_spec() {
  return choice(
             "Follow the path of equilibria where it turns back (snap-through, buckling): the "
             "fraction of the step is an unknown too, and may fall. In steps without inertia.",
             {word("auto", ArcLength::automatic,
                   "where an increment fails for good and bodies do not come to rest "
                   "behind a snap, until its end is reached"),
              word("always", ArcLength::always,
                   "after the first increment of each step, to its end"),
              word("off", ArcLength::off,
                   "never, nor are snaps passed: load control ends at a limit point")})
      .otherwise("auto");
}

}  // namespace

Spec solver_spec() {
  const Spec tolerance =
      map("When an increment has converged; giving only one of the two makes that one decide "
          "alone.",
          {optional("energy", number("Energy of the last correction over that of the first.")
                                  .above(0)
                                  .below(1)
                                  .otherwise("1e-12")),
           optional("residual",
                    number("Out-of-balance force over the largest force of the problem.")
                        .above(0)
                        .below(1)
                        .otherwise("1e-9"))})
          .otherwise("{}")
          .such_as("{energy: 1e-12, residual: 1e-9}");
  return map("How increments are solved.",
             {optional("tolerance", tolerance),
              optional("max_iterations", integer("Iterations before an increment is cut.")
                                             .at_least(1)
                                             .at_most(100'000)
                                             .otherwise("25")),
              optional("line_search", choice("Shorten corrections that overshoot.",
                                             {word("auto", LineSearch::automatic, "when it helps"),
                                              word("off", LineSearch::off, "never")})
                                          .otherwise("auto")),
              optional("cutbacks", integer("How often in a row an increment may be cut.")
                                       .at_least(0)
                                       .at_most(60)
                                       .otherwise("8")),
              optional("minimum_fraction", number("Smallest part of a step that is still tried.")
                                               .above(0)
                                               .at_most(1)
                                               .otherwise_as("decided by cutbacks")
                                               .such_as("1e-6")),
              optional("predictor", choice("First guess of an increment.",
                                           {word("auto", Predictor::automatic,
                                                 "tangent, or where increments follow each other "
                                                 "smoothly the extrapolation of the last ones"),
                                            word("tangent", Predictor::tangent,
                                                 "prescribed motions act through the tangent")})
                                        .otherwise("auto")),
              optional("stabilisation",
                       map("Viscous help until contact closes.", {}).not_available()),
              optional("arc_length", arc_length_spec())})
      .otherwise("{}")
      .such_as("{max_iterations: 40, line_search: off}");
}

Spec output_spec() {
  const Spec fields =
      either("When ParaView fields are written.",
             {integer("Every n-th increment.").at_least(1),
              choice("A word.", {word("every", FieldTimes::every, "after every increment"),
                                 word("last", FieldTimes::last,
                                      "at the end of every step that comes to its end"),
                                 word("none", FieldTimes::none, "never")})})
          .otherwise("every")
          .such_as("10");
  const Spec checkpoint =
      either("When a checkpoint is written, from which `osculate run --restart` goes on.",
             {integer("Every n-th increment, and at the end of every step.").at_least(1),
              choice("A word.", {word("none", FieldTimes::none, "never")})})
          .otherwise("1")
          .such_as("10");
  const Spec request =
      map("One column of history.csv.",
          {required("on", text("Contact pair, rigid body or set.").such_as("floor")),
           required("of", quantity_spec()),
           optional("name", text("Heading of the column.")
                                .as(TextRule::column)
                                .otherwise_as("`on` and `of` joined by a dot")
                                .such_as("pull"))});
  return map("What is written.",
             {optional("fields", fields),
              optional("history", list("Columns of history.csv, one row per increment.", request)
                                      .otherwise("[]")
                                      .such_as("[{on: floor, of: normal_force}]")),
              optional("report", boolean("Write report.html.").otherwise("true")),
              optional("compress", boolean("Compress field files.").otherwise("true")),
              optional("contact_points", boolean("Write the contact points of every field file as "
                                                 "a table too, contact0_00012.csv: node, place "
                                                 "and all contact fields.")
                                             .otherwise("false")),
              optional("checkpoint", checkpoint), optional("plots", plots_spec())})
      .otherwise("{}")
      .such_as("{fields: last, history: [{on: floor, of: normal_force}]}");
}

}  // namespace osculate::deck

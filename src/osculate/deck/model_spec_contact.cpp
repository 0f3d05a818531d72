#include "osculate/deck/description.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

constexpr const char* stiffness_unit = "force/length^3 (force/length with weight: node)";

Spec sampling_spec() {
  const Spec points = integer("Points per direction of a facet.").at_most(20);
  const Spec parts = integer("Equal parts per direction of a facet, each with its own points.")
                         .at_least(1)
                         .at_most(50)
                         .otherwise("1")
                         .such_as("2");
  return either(
             "Where the slave side is tested for contact.",
             {choice(
                  "Points of the slave side.",
                  {word("auto", SamplingRule::automatic,
                        "with normal: {penalty: auto}, where the master has a mesh or nodes would "
                        "scatter: Gauss points, 2 per direction, 3 on second-order facets; "
                        "else, with two passes, edges, weight: node, explicit dynamics "
                        "and tractions that are corrected or unknown: nodes"),
                   word("nodes", SamplingRule::nodes, "the slave nodes"),
                   word("mortar", SamplingRule::mortar,
                        "integrals over the overlaps of slave and master facets, "
                        "weighted by dual functions of the slave's nodes")}),
              map("Points of a quadrature rule on the slave facets (segment to segment).",
                  {optional("gauss", Spec(points).at_least(1).such_as("2")),
                   optional("lobatto", Spec(points).at_least(2).such_as("5")),
                   optional("subdomains", parts)})
                  .with(Group::Rule::exactly_one, {"gauss", "lobatto"})})
      .otherwise("auto")
      .such_as("{lobatto: 5, subdomains: 2}");
}

/// A stiffness, or that of the cells behind the contact times a factor.
Spec penalty_spec(std::string doc, const char* of) {
  return either(std::move(doc),
                {number("Stiffness.").in(stiffness_unit).above(0),
                 choice("From the stiffness of the bodies.",
                        {Choice{"auto",
                                std::string("ten times the stiffness against ") + of +
                                    " of the cells behind the contact; points "
                                    "with much stiffer or softer cells have more "
                                    "or less; the normal one follows the pressure in statics",
                                0, true}})})
      .otherwise("auto")
      .such_as("2.1e6");
}

/// What holds points together that are pulled apart.
std::vector<Key> holding_keys() {
  return {
      optional("separation",
               choice("Whether points that touch may part again.",
                      {word("allowed", SeparationWord::allowed, "they part when they are pulled"),
                       word("no_separation", SeparationWord::no_separation,
                            "a point that was in contact at the end of an increment stays so; it "
                            "slides as the friction law says"),
                       word("tied_normal", SeparationWord::tied_normal,
                            "points near the master at the start keep their gap and slide as the "
                            "friction law says; no others come into contact"),
                       word("tied", SeparationWord::tied,
                            "points near the master at the start stick to their places, pulled and "
                            "pressed; no others come into contact")})
                   .otherwise("allowed")
                   .such_as("no_separation")),
      optional("tolerance", number("Gap at the start up to which points are tied.")
                                .in("length")
                                .above(0)
                                .otherwise_as("a twentieth of the mean size of the master's facets")
                                .such_as("0.01")),
      optional("initial_gap",
               choice("What becomes of the gaps of tied points.",
                      {word("keep", InitialGap::keep, "they stay as they are, without a force"),
                       word("close", InitialGap::close,
                            "they are closed in the first increment, which strains the bodies")})
                   .otherwise("keep")
                   .such_as("close"))};
}

/// What an impact loses.
Spec damping_spec() {
  const Spec viscous =
      number(
          "A damper beside the spring: pressure per closing speed; every step needs a "
          "duration.")
          .in("force time/length^3 (force time/length with weight: node)")
          .at_least(0)
          .such_as("0.5");
  const Spec restitution =
      number(
          "Speed after an impact over that before: unloading gives back the share e^2 of the "
          "work of the pressure. Below 0.02 it acts as 0.02.")
          .at_least(0)
          .at_most(1)
          .such_as("0.5");
  return map("Damping in the normal direction, which never pulls.",
             {optional("viscous", viscous), optional("restitution", restitution)})
      .with(Group::Rule::exactly_one, {"viscous", "restitution"})
      .otherwise_as("none")
      .such_as("{restitution: 0.5}");
}

Spec normal_spec() {
  const Spec exponential =
      map("Pressure that grows exponentially: p = p0 / (e - 1) x (exp(x) - 1), x = 1 - gap / "
          "clearance.",
          {required("pressure",
                    number("Pressure p0 at zero gap.").in("force/length^2").above(0).such_as("12")),
           required("clearance",
                    number("Gap at which it begins.").in("length").above(0).such_as("0.01"))});
  const Spec point = list("One point [overclosure, pressure].", number("Length, or pressure."))
                         .count(2, 2)
                         .such_as("[0.01, 12]");
  const Spec table =
      list(
          "Pressure over overclosure, straight between the points and beyond the last one; the "
          "first pressure is 0.",
          point)
          .count(2)
          .such_as("[[0, 0], [0.01, 12], [0.02, 40]]");
  std::vector<Key> keys{
      optional("penalty", penalty_spec("Stiffness against penetration, unless there is another "
                                       "law.",
                                       "compression")),
      optional("exponential", exponential), optional("table", table),
      optional("damping", damping_spec())};
  for (Key& key : holding_keys()) keys.push_back(std::move(key));
  return map("Law in the normal direction: a penalty, or one of exponential and table.",
             std::move(keys))
      .otherwise("{}")
      .such_as("{penalty: 2.1e6}");
}

Spec coulomb_spec(const Spec& penalty) {
  const Spec decay =
      map("How the coefficient goes from mu to kinetic: mu(a) = kinetic + (mu - kinetic) exp(-a / "
          "scale).",
          {optional("distance", number("Scale of the distance slid since the point touched.")
                                    .in("length")
                                    .above(0)
                                    .such_as("0.01")),
           optional("speed", number("Scale of the sliding speed; every step needs a duration.")
                                 .in("length/time")
                                 .above(0)
                                 .such_as("0.5"))});
  return map("Coulomb's law with an elastic stick range.",
             {required("mu", number("Coefficient of friction.").at_least(0).such_as("0.3")),
              optional("penalty", penalty),
              optional("kinetic", number("Coefficient of friction after sliding, or at speed.")
                                      .at_least(0)
                                      .otherwise_as("mu")
                                      .such_as("0.2")),
              optional("decay", Spec(decay)
                                    .with(Group::Rule::exactly_one, {"distance", "speed"})
                                    .such_as("{distance: 0.01}")),
              optional("cap", number("Largest shear traction, whatever the pressure.")
                                  .in("force/length^2 (force with weight: node)")
                                  .above(0)
                                  .otherwise_as("none")
                                  .such_as("40"))});
}

Spec friction_spec() {
  const Spec penalty = penalty_spec("Stiffness against sliding while the point sticks.", "shear");
  const Spec tresca = map("One shear traction for every pressure, with an elastic stick range.",
                          {required("limit", number("Shear traction while sliding.")
                                                 .in("force/length^2 (force with weight: node)")
                                                 .at_least(0)
                                                 .such_as("40")),
                           optional("penalty", penalty)});
  const Spec rough = map("No sliding while in contact.", {optional("penalty", penalty)});
  return either("Law in the tangential direction.",
                {choice("No friction.", {Choice{"none", "no friction", 0, true}}),
                 map("A law of friction.", {optional("coulomb", coulomb_spec(penalty)),
                                            optional("tresca", tresca), optional("rough", rough)})
                     .with(Group::Rule::exactly_one, {"coulomb", "tresca", "rough"})})
      .otherwise("none")
      .such_as("{coulomb: {mu: 0.3, penalty: 2.1e6}}");
}

/// Half thicknesses of shells.
Spec offset_spec() {
  const auto side = [](const char* doc) {
    return number(doc).in("length").at_least(0).otherwise("0").such_as("0.5");
  };
  return map("Distance at which the sides touch: half thicknesses of shells, which are taken off "
             "the gap.",
             {optional("master", side("Of the master.")), optional("slave", side("Of the slave."))})
      .otherwise("{}")
      .such_as("{master: 0.5, slave: 0.25}");
}

Spec tangent_spec() {
  const auto part = [](std::string doc) { return boolean(std::move(doc)).otherwise("true"); };
  return either("Derivative of the contact forces that Newton's method uses.",
                {choice("A complete tangent.", {word("consistent", TangentKind::consistent,
                                                     "the exact derivative of the residual"),
                                                word("covariant", TangentKind::covariant,
                                                     "all parts of the covariant one")}),
                 map("Parts of the covariant tangent, to study what each is worth.",
                     {optional("main", part("The part that is left on a flat facet without slip.")),
                      optional("rotational", part("The part with the rotation of the facet.")),
                      optional("curvature", part("The part with the curvature of the facet."))})})
      .otherwise("consistent")
      .such_as("consistent");
}

Spec weight_spec() {
  return choice("What the traction of a contact point is multiplied by.",
                {word("node", ContactWeight::node, "one: the penalty is a force per length"),
                 word("reference_area", ContactWeight::reference_area,
                      "the undeformed area of the slave point"),
                 word("current_area", ContactWeight::current_area,
                      "the deformed area of the slave point")})
      .otherwise("reference_area")
      .such_as("node");
}

Spec enforcement_spec() {
  const Spec options =
      map("Correction of the penalty's tractions.",
          {optional("target", number("Largest gap and elastic slip that are left.")
                                  .in("length")
                                  .above(0)
                                  .otherwise_as("1e-4 of the mean length of the facets' edges, and "
                                                "no more than 1e-3 of the deepest initial overlap")
                                  .such_as("1e-5")),
           optional("loop",
                    choice("When the tractions are corrected.",
                           {word("uzawa", AugmentLoop::uzawa, "after each solution"),
                            word("single", AugmentLoop::single, "after each iteration near one")})
                        .otherwise("uzawa")
                        .such_as("single"))});
  return either("How the contact conditions are imposed.",
                {choice("Method.",
                        {word("penalty", EnforcementWord::penalty, "by the stiffnesses alone"),
                         word("augmented_lagrange", EnforcementWord::augmented_lagrange,
                              "by repeated correction of the penalty's tractions"),
                         word("lagrange_multiplier", EnforcementWord::lagrange_multiplier,
                              "exactly, by unknown tractions")}),
                 map("Augmented Lagrangian with its options.",
                     {required("augmented_lagrange", options)})})
      .otherwise("penalty")
      .such_as("augmented_lagrange");
}

Spec residual_spec() {
  return choice("Form of the contact forces.",
                {word("surface", Residual::surface,
                      "as published, with the gap set to zero on the tangent plane"),
                 word("full", Residual::full, "work-conjugate to gap and slip; moments balance")})
      .otherwise("surface")
      .such_as("full");
}

Spec history_spec() {
  return choice("How friction remembers over borders of facets.",
                {word("continuous", HistoryKind::continuous,
                      "the traction is carried along, slip is measured along the surface"),
                 word("chord", HistoryKind::chord,
                      "as published: slip is the straight line between the places, projected"),
                 word("per_facet", HistoryKind::per_facet,
                      "as published: slip is the difference of the facets' coordinates, which "
                      "jumps at their borders")})
      .otherwise("continuous")
      .such_as("continuous");
}

Spec smoothing_spec() {
  const Choice hermite = word("hermite", SmoothingWord::hermite,
                              "cubic pieces with one normal where facets meet"),
               nurbs = word("nurbs", SmoothingWord::nurbs,
                            "in the plane: pieces of degree 5 with one curvature too, a spline "
                            "with the nodes as knots");
  const Spec angle = number("Corners and edges of the master with a larger angle stay sharp.")
                         .in("degrees")
                         .at_least(0)
                         .below(180)
                         .otherwise("30")
                         .such_as("40");
  return either(
             "A smooth surface through the nodes of a master of first-order facets.",
             {choice("With sharp corners above 30 degrees.",
                     {word("none", SmoothingWord::none, "the facets as they are"), hermite, nurbs}),
              map("With another angle.",
                  {required("kind", choice("Pieces.", {hermite, nurbs}).such_as("hermite")),
                   optional("angle", angle)})})
      .otherwise("none")
      .such_as("hermite");
}

Spec initial_spec() {
  const Spec tolerance =
      number("Initial gaps up to this are closed too.").in("length").at_least(0).such_as("0.01");
  return either("What becomes of slave points that are inside the master from the beginning.",
                {choice("One of these.",
                        {word("ignore", InitialWord::ignore, "they are pushed out at once"),
                         word("ramp", InitialWord::ramp,
                              "the overlap is let in over the first step, as for a press fit"),
                         word("keep", InitialWord::keep,
                              "the overlap never counts: gaps are measured from it"),
                         word("adjust", InitialWord::adjust,
                              "the slave nodes are moved onto the master without strain, before "
                              "anything is computed")}),
                 map("Adjust with a tolerance.", {required("adjust", tolerance)})})
      .otherwise("ignore")
      .such_as("ramp");
}

Spec edges_spec() {
  const Spec angle = number("Edges are sharp where the normals of their facets differ by more.")
                         .in("degrees")
                         .above(5)
                         .below(180)
                         .otherwise("30")
                         .such_as("40");
  return either("In space: contact also where a sharp edge of the slave crosses one of the master.",
                {boolean("Switches it on."), map("Switches it on.", {optional("angle", angle)})})
      .otherwise("false")
      .such_as("true");
}

/// The keys that a pair and all pairs together have in common.
std::vector<Key> law_keys() {
  const Spec depth = number("Points deeper inside the master than this are not in contact with it.")
                         .in("length")
                         .above(0)
                         .otherwise_as("no limit")
                         .such_as("0.5");
  return {optional("sampling", sampling_spec()),
          optional("normal", normal_spec()),
          optional("friction", friction_spec()),
          optional("offset", offset_spec()),
          optional("enforcement", enforcement_spec()),
          optional("weight", weight_spec()),
          optional("residual", residual_spec()),
          optional("tangent", tangent_spec()),
          optional("history", history_spec()),
          optional("initial", initial_spec()),
          optional("two_pass", boolean("Both sides are slaves in turn, each with half of the "
                                       "traction; contact: all does so with "
                                       "two deformable bodies.")
                                   .otherwise("false")
                                   .such_as("true")),
          optional("edges", edges_spec()),
          optional("search", map("Where contact is looked for.", {optional("depth", depth)}))};
}

Spec with_laws(std::string doc, std::vector<Key> keys) {
  for (Key& key : law_keys()) keys.push_back(std::move(key));
  return map(std::move(doc), std::move(keys));
}

Spec pairs_spec() {
  return list(
      "Contact pairs.",
      with_laws(
          "One contact pair.",
          {required("name", text("Name of the pair; begins its columns in history.csv.")
                                .as(TextRule::name)
                                .such_as("floor")),
           required("master", set_or_sets("Rigid body, or set of boundary facets, that the contact "
                                          "points are projected onto.",
                                          "bottom")),
           optional("smoothing", smoothing_spec()),
           required("slave", set_or_sets("Meshed rigid body, or set, whose points are projected; "
                                         "the set that is master, for contact with itself.",
                                         "base"))}));
}

Spec all_spec() {
  const Spec body = text("Number of a body, set of a section, or rigid body.").such_as("base");
  return with_laws(
      "All bodies with each other, with the rigid ones and with themselves; pairs are called "
      "NAME.A-B, bodies are numbered in the order of the mesh.",
      {optional("name", text("Begins the names of the pairs, and stands for all of them in "
                             "output.history.")
                            .as(TextRule::name)
                            .otherwise("all")
                            .such_as("all")),
       optional("exclude", list("Pairs of bodies that do not touch; the same body twice: not "
                                "itself.",
                                list("Two bodies.", body).count(2, 2))
                               .otherwise("[]")
                               .such_as("[[1, 1], [2, base]]"))});
}

}  // namespace

Spec contact_spec() {
  return either("Who touches whom.",
                {pairs_spec(),
                 map("Contact of everything with everything.", {required("all", all_spec())}),
                 choice("The same, for short.",
                        {Choice{"all", "all bodies, with the default of every key", 0, true}})})
      .otherwise("[]")
      .such_as("[{name: floor, master: bottom, slave: base, normal: {penalty: 2.1e6}}]");
}

}  // namespace osculate::deck

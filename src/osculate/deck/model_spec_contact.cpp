#include <fmt/format.h>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/core/text.hpp"
#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/pairing/combinations.hpp"

namespace osculate::deck {
namespace {

BoundKey<NormalDescription> tied_tolerance_key() {
  Spec spec =
      either("Which points are tied.",
             {number("Those whose gap at the start is no larger.")
                  .in("length")
                  .above(0)
                  .such_as("0.01"),
              choice("By their place.",
                     {Choice{"any",
                             "whatever their gap, those that lie over the master, not beside "
                             "its edges, and face it",
                             0}})})
          .otherwise_as("a twentieth of the mean size of the master's facets")
          .such_as("0.01");
  return {optional("tolerance", std::move(spec)), [](NormalDescription& n, const Value& v) {
            n.tolerance = {v.alternative == 0 ? v.number : pairing::any_gap, v.mark};
          }};
}

/// What holds points together that are pulled apart.
BoundKeys<NormalDescription> holding_keys() {
  using N = NormalDescription;
  return {{may(&N::auto_factor, "auto_factor",
               number("So many times the stiffness that `auto` takes from the cells behind both "
                      "sides.")
                   .above(0)
                   .otherwise_as("1")
                   .such_as("10")),
           may(&N::separation, "separation",
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
                            "pressed, along the master with the penalty of `friction: rough` if "
                            "there is one; no others come into contact")})
                   .otherwise("allowed")
                   .such_as("no_separation")),
           tied_tolerance_key(),
           may(&N::initial_gap, "initial_gap",
               choice("What becomes of the gaps of tied points.",
                      {word("keep", InitialGap::keep, "they stay as they are, without a force"),
                       word("close", InitialGap::close,
                            "they are closed in the first increment, which strains the bodies")})
                   .otherwise("keep")
                   .such_as("close"))}};
}

/// What an impact loses.
Spec damping_spec() {
  const std::vector<Key> laws = damping_law_keys();
  return map("Damping in the normal direction, which never pulls.", laws)
      .with(Group::Rule::exactly_one, names_of(laws))
      .otherwise_as("none")
      .such_as("{restitution: 0.5}");
}

/// What begins in a step has no memory of where a contact began.
Spec changed_damping_spec() {
  std::vector<Key> laws = damping_law_keys();
  std::erase_if(laws, [](const Key& key) { return key.name != contact::Viscous::key; });
  return either(
             "Damping in the normal direction from now on, in place of `normal: damping` of the "
             "pair.",
             {choice("No damping.", {Choice{"none", "no damping", 0, true}}),
              map("A law of damping.", laws).with(Group::Rule::exactly_one, names_of(laws))})
      .such_as("{viscous: 0.5}");
}

Spec normal_spec() {
  std::vector<Key> keys = normal_law_keys();
  std::vector<std::string> others = names_of(keys);
  const std::string usual = others.front();
  others.erase(others.begin());
  std::string doc = fmt::format("Law in the normal direction: a {}, or one of {}.", usual,
                                core::join_with(others, "and"));
  keys.push_back(optional("damping", damping_spec()));
  const Spec holding = holding_keys().spec({});
  keys.insert(keys.end(), holding.keys.begin(), holding.keys.end());
  return map(std::move(doc), std::move(keys)).otherwise("{}").such_as("{penalty: 2.1e6}");
}

Spec friction_spec() {
  const std::vector<Key> laws = friction_law_keys();
  return either("Law in the tangential direction.",
                {choice("No friction.", {Choice{"none", "no friction", 0, true}}),
                 map("A law of friction.", laws).with(Group::Rule::exactly_one, names_of(laws))})
      .otherwise("none")
      .such_as("{coulomb: {mu: 0.3, penalty: 2.1e6}}");
}

/// Damping acts on points that come and go, beside the springs of a penalty or another law.
void read_damping(const Value& v, NormalDescription& n) {
  const Value* const damping = v.find("damping");
  if (!damping) return;
  n.damping = damping_law_of(*damping);
  if (n.separation.value != SeparationWord::allowed)
    throw core::InputError(damping->mark, std::string(pairing::why_not(pairing::Trait::damping,
                                                                       pairing::Trait::held)));
}

void read_normal(const Value& v, NormalDescription& n) {
  n.law = normal_law_of(v);
  holding_keys().read(v, n);
  if (n.auto_factor && !n.law.automatic)
    throw core::InputError(n.auto_factor->mark,
                           "auto_factor goes with a law whose stiffness is `auto`");
  if (!contact::holds(n.law.law) && n.separation.value != SeparationWord::allowed)
    throw core::InputError(n.separation.mark, std::string(pairing::why_not(
                                                  pairing::Trait::held, pairing::Trait::gap_law)));
  const bool tied = n.separation.value == SeparationWord::tied;
  if (n.tolerance && !tied && n.separation.value != SeparationWord::tied_normal)
    throw core::InputError(n.tolerance->mark,
                           "tolerance says what is tied: it goes with separation: tied or "
                           "tied_normal");
  read_damping(v, n);
  if (n.initial_gap.value == InitialGap::close && !tied)
    throw core::InputError(n.initial_gap.mark, "closing gaps goes with separation: tied only");
}

void read_friction(Contact& c, const Value& v) {
  if (v.alternative != 0) c.friction = friction_law_of(v);
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

BoundKey<Contact> tangent_key() {
  using T = Tangent;
  const auto part = [](bool T::*member, const char* name, const char* doc) {
    return may(member, name, boolean(doc).otherwise("true"));
  };
  const BoundKeys<T> parts(
      {part(&T::main, "main", "The part that is left on a flat facet without slip."),
       part(&T::rotational, "rotational", "The part with the rotation of the facet."),
       part(&T::curvature, "curvature", "The part with the curvature of the facet.")});
  Spec spec =
      either("Derivative of the contact forces that Newton's method uses.",
             {choice("A complete tangent.",
                     {word("consistent", TangentKind::consistent,
                           "the exact derivative of the residual"),
                      word("covariant", TangentKind::covariant, "all parts of the covariant one")}),
              parts.spec("Parts of the covariant tangent, to study what each is worth.")})
          .otherwise("consistent")
          .such_as("consistent");
  return {optional("tangent", std::move(spec)), [parts](Contact& c, const Value& v) {
            c.tangent.mark = v.mark;
            if (v.alternative == 0) return store(c.tangent.value.kind, v);
            c.tangent.value.kind = TangentKind::covariant;
            parts.read(v, c.tangent.value);
          }};
}

BoundKey<Contact> weight_key() {
  Spec area =
      either("Area of each slave node, also of those without facets.",
             {number("The same for all.").in("length^2").above(0).such_as("0.25"),
              choice("Of its surroundings.",
                     {word("around", AreaWord::around,
                           "its share of the free faces that it is a "
                           "corner of"),
                      word("middles", AreaWord::middles,
                           "of its facets; of second order nearly all to "
                           "the middles of edges, as in CalculiX"),
                      word("master", AreaWord::master, "that of the master's facet below it")})})
          .otherwise_as("that of its facets")
          .such_as("0.25");
  const BoundKeys<Contact> given(
      {{optional("area", std::move(area)), [](Contact& c, const Value& v) {
          if (v.alternative == 1) c.area_by = static_cast<AreaWord>(v.code);
          if (v.alternative == 0) c.area = v.number;
        }}});
  Spec spec =
      either("What the traction of a contact point is multiplied by.",
             {choice("One of these.",
                     {word("node", ContactWeight::node, "one: the penalty is a force per length"),
                      word("reference_area", ContactWeight::reference_area,
                           "the undeformed area of the slave point"),
                      word("current_area", ContactWeight::current_area,
                           "the deformed area of the slave point")}),
              given.spec("A given area.").with(Group::Rule::exactly_one, {"area"})})
          .otherwise("reference_area")
          .such_as("node");
  return {optional("weight", std::move(spec)), [given](Contact& c, const Value& v) {
            c.weight = {ContactWeight::reference_area, v.mark};
            if (v.alternative == 1) return given.read(v, c);
            store(c.weight, v);
          }};
}

BoundKey<Contact> enforcement_key() {
  using E = Enforcement;
  const BoundKeys<E> options(
      {may(&E::target, "target",
           number("Largest gap and elastic slip that are left.")
               .in("length")
               .above(0)
               .otherwise_as("1e-4 of the mean length of the facets' edges, and "
                             "no more than 1e-3 of the deepest initial overlap")
               .such_as("1e-5")),
       may(&E::loop, "loop",
           choice("When the tractions are corrected.",
                  {word("uzawa", AugmentLoop::uzawa, "after each solution"),
                   word("single", AugmentLoop::single, "after each iteration near one")})
               .otherwise("uzawa")
               .such_as("single"))});
  Spec spec =
      either(
          "How the contact conditions are imposed.",
          {choice("Method.", {word("penalty", EnforcementWord::penalty, "by the stiffnesses alone"),
                              word("augmented_lagrange", EnforcementWord::augmented_lagrange,
                                   "by repeated correction of the penalty's tractions"),
                              word("lagrange_multiplier", EnforcementWord::lagrange_multiplier,
                                   "exactly, by unknown tractions")}),
           map("Augmented Lagrangian with its options.",
               {required("augmented_lagrange",
                         options.spec("Correction of the penalty's tractions."))})})
          .otherwise("penalty")
          .such_as("augmented_lagrange");
  return {optional("enforcement", std::move(spec)), [options](Contact& c, const Value& v) {
            c.enforcement.mark = v.mark;
            if (v.alternative == 0) return store(c.enforcement.value.kind, v);
            c.enforcement.value.kind = EnforcementWord::augmented_lagrange;
            options.read(v.at("augmented_lagrange"), c.enforcement.value);
          }};
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

BoundKey<Contact> smoothing_key() {
  using S = MasterSmoothing;
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
  const BoundKeys<S> keys(
      {need(&S::kind, "kind", choice("Pieces.", {hermite, nurbs}).such_as("hermite")),
       may(&S::angle, "angle", angle)});
  Spec spec =
      either("A smooth surface through the nodes of a master of first-order facets.",
             {choice("With sharp corners above 30 degrees.",
                     {word("none", SmoothingWord::none, "the facets as they are"), hermite, nurbs}),
              keys.spec("With another angle.")})
          .otherwise("none")
          .such_as("hermite");
  return {optional("smoothing", std::move(spec)), [keys](Contact& c, const Value& v) {
            c.smoothing.mark = v.mark;
            v.alternative == 0 ? store(c.smoothing.value.kind, v) : keys.read(v, c.smoothing.value);
          }};
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

std::optional<Number> edges_of(const Value& v) {
  constexpr double usual = 30;
  if (v.alternative == 1) return number_of(v.at("angle"));
  if (v.code == 0) return std::nullopt;
  return Number{usual, v.mark};
}

/// The keys that a pair and all pairs together have in common.
BoundKeys<Contact> with_laws(std::vector<BoundKey<Contact>> keys) {
  using C = Contact;
  const BoundKeys<C> search(
      {may(&C::search_depth, "depth",
           number("Points deeper inside the master than this are not in contact with it.")
               .in("length")
               .above(0)
               .otherwise_as("no limit")
               .such_as("0.5"))});
  const std::vector<BoundKey<C>> laws{
      sampling_key(),
      {optional("normal", normal_spec()), [](C& c, const Value& v) { read_normal(v, c.normal); }},
      {optional("friction", friction_spec()), read_friction},
      {optional("offset", offset_spec()),
       [](C& c, const Value& v) { c.offset = v.at("master").number + v.at("slave").number; }},
      enforcement_key(),
      weight_key(),
      may(&C::residual, "residual", residual_spec()),
      tangent_key(),
      may(&C::history, "history", history_spec()),
      initial_gaps_key(),
      {optional("two_pass", boolean("Both sides are slaves in turn, each with half of the "
                                    "traction; contact: all does so with "
                                    "two deformable bodies.")
                                .otherwise("false")
                                .such_as("true")),
       [](C& c, const Value& v) {
         if (v.code != 0) c.two_pass = v.mark;
       }},
      {optional("edges", edges_spec()), [](C& c, const Value& v) { c.edges = edges_of(v); }},
      below(search, optional("search", search.spec("Where contact is looked for.")))};
  keys.insert(keys.end(), laws.begin(), laws.end());
  return keys;
}

BoundKeys<Contact> pair_keys() {
  using C = Contact;
  return with_laws({need(&C::name, "name",
                         text("Name of the pair; begins its columns in history.csv.")
                             .as(TextRule::name)
                             .such_as("floor")),
                    need(&C::master, "master",
                         set_or_sets("Rigid body, or set of boundary facets, that the contact "
                                     "points are projected onto.",
                                     "bottom")),
                    smoothing_key(),
                    need(&C::slave, "slave",
                         set_or_sets("Meshed rigid body, or set, whose points are projected; "
                                     "the set that is master, for contact with itself.",
                                     "base"))});
}

BoundKeys<Contact> all_keys() {
  using C = Contact;
  const Spec body = text("Number of a body, set of a section, or rigid body.").such_as("base");
  return with_laws(
      {may(&C::name, "name",
           text("Begins the names of the pairs, and stands for all of them in "
                "output.history.")
               .as(TextRule::name)
               .otherwise("all")
               .such_as("all")),
       {optional("exclude", list("Pairs of bodies that do not touch; the same body twice: not "
                                 "itself.",
                                 list("Two bodies.", body).count(2, 2))
                                .otherwise("[]")
                                .such_as("[[1, 1], [2, base]]")),
        [](C& c, const Value& v) {
          for (const Value& item : v.items)
            c.exclude.push_back({name_of(item.items[0]), name_of(item.items[1])});
        }},
       {optional("exclude_surfaces",
                 list("Pairs of sets, of facets or nodes, that do not touch, whichever is slave; "
                      "the same set twice: not itself. Beside them those of `pairs` and of `ties`.",
                      list("Two sets.", text("Set.").such_as("low.top")).count(2, 2))
                     .otherwise("[]")
                     .such_as("[[low.top, high.bottom]]")),
        [](C& c, const Value& v) {
          for (const Value& item : v.items)
            c.exclude_surfaces.push_back({name_of(item.items[0]), name_of(item.items[1])});
        }}});
}

Contact all_of(const Value& v) {
  Contact c = all_keys().read(v);
  c.all = true;
  return c;
}

std::vector<Contact> contacts_of(const Value& v) {
  if (v.alternative == 0) return pair_keys().read_all(v);
  if (v.alternative == 1) {
    std::vector<Contact> out = pair_keys().read_all(v.at("pairs"));
    out.push_back(all_of(v.at("all")));
    return out;
  }
  SourceNode nothing;  // `all` alone is `{all: {}}`
  nothing.kind = SourceNode::Kind::map;
  nothing.line = v.mark.line;
  return {all_of(check(all_keys().spec(""), nothing, v.mark.file, v.mark.key + ".all"))};
}

BoundKeys<ContactChange> change_keys() {
  using C = ContactChange;
  return {{need(&C::pair, "pair", text("Name of the pair.").such_as("floor")),
           may(&C::active, "active",
               boolean("Whether its sides see each other; they do from the beginning. Points that "
                       "do again begin without shear.")
                   .such_as("false")),
           {optional("normal", normal_spec()),
            [](C& c, const Value& v) {
              if (v.given) read_normal(v, c.normal.emplace());
            }},
           {optional("friction", friction_spec()),
            [](C& c, const Value& v) {
              if (!v.given) return;
              c.friction.emplace();
              if (v.alternative != 0) *c.friction = friction_law_of(v);
            }},
           {optional("damping", changed_damping_spec()), [](C& c, const Value& v) {
              if (!v.given) return;
              c.damping.emplace();
              if (v.alternative != 0) *c.damping = damping_law_of(v);
            }}}};
}

}  // namespace

BoundKey<Step> contact_changes_key() {
  const BoundKeys<ContactChange> keys = change_keys();
  return {optional("contact",
                   list("What changes of contact pairs when the step begins, and stays so.",
                        keys.spec("Change of one pair.")
                            .with(Group::Rule::at_least_one,
                                  {"active", "normal", "friction", "damping"}))
                       .otherwise("[]")
                       .such_as("[{pair: floor, friction: {coulomb: {mu: 0.1, penalty: 2e6}}}]")),
          [keys](Step& s, const Value& v) { s.contact = keys.read_all(v); }};
}

BoundKey<Description> contact_key() {
  return {
      optional(
          "contact",
          either("Who touches whom.",
                 {list("Contact pairs.", pair_keys().spec("One contact pair.")),
                  map("Contact of everything with everything.",
                      {required("all",
                                all_keys().spec(
                                    "All bodies with each other, with the rigid ones and with "
                                    "themselves; pairs are called NAME.A-B, bodies are numbered "
                                    "in the order of the mesh.")),
                       optional("pairs",
                                list("Contact pairs with keys of their own. Their sides do not "
                                     "touch each other by `all` as well, and what `ties` hold "
                                     "together does not either.",
                                     pair_keys().spec("One contact pair."))
                                    .otherwise("[]"))})
                      .or_else("; in a list of pairs each begins with `- `"),
                  choice("The same, for short.",
                         {Choice{"all", "all bodies, with the default of every key", 0, true}})})
              .otherwise("[]")
              .such_as("[{name: floor, master: bottom, slave: base, normal: {penalty: 2.1e6}}]")),
      [](Description& d, const Value& v) { d.contact = contacts_of(v); }};
}

}  // namespace osculate::deck

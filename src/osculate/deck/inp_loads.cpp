// Loads of a deck that are spread over surfaces and bodies: pressures, weights, rotation.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_steps.hpp"
#include "osculate/io/inp/loaded_sets.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// Pressures follow the surface, with NLGEOM.
void check_follower(const InpModel& m, const Card& card) {
  if (m.finite && option_of(card, "FOLLOWER") == "NO")
    io::inp::fail(m.deck, card,
                  "FOLLOWER=NO is not supported with NLGEOM: pressures turn with their surface");
}

/// A line of `*DLOAD`: of which card, on which elements.
struct LoadLine {
  const Line& line;
  Fields& fields;
  const InpSaid& said;
  std::string elements;
};

/// In a later step the same load is replaced, but others would add to what is there.
void note_gravity(const InpReading& r, const Fields& fields, const std::string& part,
                  const InpGravity& now) {
  std::vector<InpGravity>& all = r.acting.gravity[part];
  const bool before = std::any_of(all.begin(), all.end(),
                                  [&](const InpGravity& one) { return one.step < now.step; });
  if (before && (all.size() > 1 || all[0].set != now.set || all[0].direction != now.direction))
    fields.fail(
        "GRAV of another set or direction than in a step before is not supported: write "
        "OP=NEW and all of it");
  if (before) all.clear();
  all.push_back(now);
}

/// The weight of a point mass, which acts with body forces, not with the forces of `*CLOAD`.
void weigh(const InpReading& r, const std::string& node, const Vec3& weight, const LoadLine& on) {
  const InpModel& m = r.m;
  const InpProcedure& now = r.procedure;
  if (now.factors > 0 || now.modes > 0 || now.is("STEADYSTATEDYNAMICS") || now.is("MODALDYNAMIC"))
    io::inp::fail(m.deck, on.line.at,
                  fmt::format("GRAV on masses is not supported with *{}", now.card->keyword));
  if (m.transformed.contains(only_node(m, node)))
    io::inp::fail(m.deck, on.line.at,
                  fmt::format("GRAV on a mass at '{}', which has a *TRANSFORM, is not supported",
                              printable(node)));
  for (int k = 0; k < inp_dimension(m); ++k)
    for (const InpPlace& place : inp_places(m, node, k + 1))
      if (weight[k] != 0)
        set_condition(m, r.acting.parts[0].weights, {place.on, place.direction},
                      place.sign * weight[k], on.said, on.line);
}

void read_gravity(const InpReading& r, const LoadLine& load, Conditions& body_forces) {
  Fields& fields = load.fields;
  const double size = fields.real("the acceleration");
  Vec3 direction = Vec3::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) direction[k] = fields.real_or_zero("a direction");
  if (!(direction.norm() > 0)) fields.fail("expected the direction of gravity");
  const std::string name = io::inp::element_set_name(load.elements);
  const std::vector<InpMass> masses = inp_masses(r.m, name);
  for (const InpMass& one : masses)
    weigh(r, one.node, Vec3(one.mass * size * direction.normalized()), load);
  if (!masses.empty() && !r.m.sets.contains({SetKind::elements, io::inp::capitals(name)})) return;
  const std::string& on = set_of(r.m, load.line.at, name, {SetKind::elements});
  const std::vector<InpDensity> parts = densities_on(r.m, on);
  if (parts.empty())
    fields.fail(fmt::format("GRAV acts on elements that have a section, not on {}",
                            io::inp::shown(load.elements)));
  direction.normalize();
  for (const InpDensity& part : parts) {
    if (!(part.density > 0))
      fields.fail(fmt::format("the material of {} has no *DENSITY", io::inp::shown(part.on)));
    note_gravity(r, fields, part.on, {on, direction, r.steps});
    for (int k = 0; k < inp_dimension(r.m); ++k)
      if (direction[k] != 0)
        set_condition(r.m, body_forces, {part.on, k + 1}, part.density * size * direction[k],
                      load.said, load.line);
  }
}

void read_centrifugal(const InpReading& r, const LoadLine& load) {
  const double speed = load.fields.real("the square of the angular velocity");
  std::array<double, 6> axis{};
  for (double& c : axis) c = load.fields.real_or_zero("a point or direction of the axis");
  for (std::size_t k = 3; k < 6; ++k) axis[k] += axis[k - 3];
  std::vector<std::array<double, 6>>& axes = r.acting.axes;
  auto known = std::find(axes.begin(), axes.end(), axis);
  if (known == axes.end()) known = axes.insert(axes.end(), axis);
  const std::string& on =
      set_of(r.m, load.line.at, io::inp::element_set_name(load.elements), {SetKind::elements});
  set_condition(r.m, r.acting.parts[0].centrifugal, {on, static_cast<int>(known - axes.begin())},
                speed, load.said, load.line);
}

void read_distributed(const InpReading& r, const Card& card) {
  InpConditions& part = part_of(r, card);
  // one card of OP=NEW removes pressures and body forces
  const InpSaid said = begin_card(r, card, part.pressures);
  (void)begin_card(r, card, part.body_forces);
  if (option_of(card, "OP") == "NEW") r.acting.gravity.clear();
  (void)begin_card(r, card, r.acting.parts[0].weights);
  (void)begin_card(r, card, r.acting.parts[0].centrifugal);
  for (const Line& line : io::inp::lines_of(r.m.deck, card)) {
    Fields fields(r.m.deck, line);
    const LoadLine one{line, fields, said, io::inp::name_of(fields.next().value_or(""))};
    const std::string load = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
    if (io::inp::is_side_load(load)) {
      const std::string& on =
          set_of(r.m, line.at, io::inp::side_set_name(load, one.elements), {SetKind::surface});
      set_condition(r.m, part.pressures, {on, 1}, fields.real("the pressure"), said, line);
    } else if (load == "GRAV") {
      read_gravity(r, one, part.body_forces);
    } else if (load == "CENTRIF") {
      if (option_of(card, "LOADCASE") == "2")
        fields.fail("CENTRIF with LOAD CASE=2 is not supported");
      read_centrifugal(r, one);
    } else {
      fields.fail(
          fmt::format("load {} is not supported: P1 to P6, GRAV or CENTRIF", io::inp::shown(load)));
    }
  }
}

void read_on_surfaces(const InpReading& r, const Card& card) {
  Conditions& pressures = part_of(r, card).pressures;
  const InpSaid said = begin_card(r, card, pressures);
  for (const Line& line : io::inp::lines_of(r.m.deck, card)) {
    Fields fields(r.m.deck, line);
    const std::string surface = io::inp::name_of(fields.next().value_or(""));
    const std::string& on = set_of(r.m, line.at, surface, {SetKind::surface});
    const std::string load = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
    if (load != "P") fields.fail(fmt::format("load {} is not supported: P", io::inp::shown(load)));
    set_condition(r.m, pressures, {on, 1}, fields.real("the pressure"), said, line);
  }
}

}  // namespace

void read_load(const InpReading& r, const Card& card) {
  if (card.keyword != "DLOAD" && card.keyword != "DSLOAD") return;
  check_follower(r.m, card);
  if (card.keyword == "DLOAD")
    read_distributed(r, card);
  else
    read_on_surfaces(r, card);
}

}  // namespace osculate::deck

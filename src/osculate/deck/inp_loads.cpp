// Loads of a deck that are spread over surfaces and bodies: pressures, weights, rotation.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "osculate/deck/inp_steps.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// Pressures follow the surface, with NLGEOM.
void check_follower(const InpModel& m, const Card& card) {
  if (m.finite && option_of(card, "FOLLOWER") == "NO" &&
      option_of(card, "CONSTANTRESULTANT") != "YES")
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

/// The set that a GRAV on a part of the bodies acts on. CalculiX replaces that of the same set and
/// direction and adds others: these have sets of their own, of the same nodes or elements, and so
/// have the weights of masses (`beside`: forces of *CLOAD) unless they are rigid bodies.
std::string gravity_set(const InpReading& r, const LoadLine& load, const std::string& part,
                        const InpGravity& now, bool beside) {
  std::vector<InpGravity>& all = r.acting.gravity[part];
  const auto same = [&](const InpGravity& one) {
    return one.set == now.set && one.direction == now.direction;
  };
  const auto known = std::ranges::find_if(all, same);
  const auto number = known - all.begin();
  if (known == all.end()) all.push_back(now);
  const bool is_body = !r.m.mesh.mesh.find_set(part) && !find(r.m.new_sets, part);
  if (number == 0 && (is_body || !beside)) return part;
  if (is_body)
    load.fields.fail(
        fmt::format("'{}' is a rigid body: GRAV of several sets or directions on its masses is not "
                    "supported",
                    part));
  std::string name = plain_name(fmt::format("{} gravity {}", part, number + 1));
  if (find(r.m.new_sets, name)) return name;
  SourceNode& set = put(r.m.new_sets, name, inp_map(line_of(load.line.at)));
  put(set, "of", inp_text(part, set.line));
  put(set, "within", inp_list(set.line)).items = {inp_text(part, set.line)};
  return name;
}

/// The weight of a point mass, which acts with body forces, not with the forces of `*CLOAD`.
void weigh(const InpReading& r, const InpMass& mass, const Vec3& acceleration,
           const InpGravity& now, const LoadLine& load) {
  const InpModel& m = r.m;
  const InpProcedure& step = r.procedure;
  if (step.factors > 0 || step.modes > 0 || step.is("STEADYSTATEDYNAMICS") ||
      step.is("MODALDYNAMIC"))
    io::inp::fail(m.deck, load.line.at,
                  fmt::format("GRAV on masses is not supported with *{}", step.card->keyword));
  const Vec3 weight =
      mass.mass * axes_of_node(m, only_node(m, mass.node)).transpose() * acceleration;
  for (int k = 0; k < inp_dimension(m); ++k)
    for (const InpPlace& place : inp_places(m, mass.node, k + 1))
      if (weight[k] != 0)
        set_condition(m, r.acting.parts[0].weights,
                      {gravity_set(r, load, place.on, now, true), place.direction},
                      place.sign * weight[k], load.said, load.line, true);
}

void read_gravity(const InpReading& r, const LoadLine& load, Conditions& body_forces) {
  Fields& fields = load.fields;
  const double size = fields.real("the acceleration");
  Vec3 direction = Vec3::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) direction[k] = fields.real_or_zero("a direction");
  if (!(direction.norm() > 0)) fields.fail("expected the direction of gravity");
  const std::string name = io::inp::element_set_name(load.elements);
  direction.normalize();
  const std::vector<InpMass> masses = inp_masses(r.m, name);
  for (const InpMass& one : masses) weigh(r, one, Vec3(size * direction), {name, direction}, load);
  if (!masses.empty() && !r.m.sets.contains({SetKind::elements, io::inp::capitals(name)})) return;
  const std::string& on = set_of(r.m, load.line.at, name, {SetKind::elements});
  const std::vector<InpDensity> parts = densities_on(r.m, on);
  if (parts.empty())
    fields.fail(fmt::format("GRAV acts on elements that have a section, not on {}",
                            io::inp::shown(load.elements)));
  for (const InpDensity& part : parts) {
    if (!(part.density > 0))
      fields.fail(fmt::format("the material of {} has no *DENSITY", io::inp::shown(part.on)));
    const std::string acts_on = gravity_set(r, load, part.on, {on, direction}, false);
    for (int k = 0; k < inp_dimension(r.m); ++k)
      if (direction[k] != 0)
        set_condition(r.m, body_forces, {acts_on, k + 1}, part.density * size * direction[k],
                      load.said, load.line, true);
  }
}

std::set<std::pair<Index, Index>> cells_of_set(const InpModel& m, const std::string& set) {
  std::set<std::pair<Index, Index>> cells;
  if (const mesh::Set* const known = m.mesh.mesh.find_set(set))  // else the node of a mass
    for (const mesh::CellRef& ref : known->cells) cells.insert({ref.block, ref.cell});
  return cells;
}

/// Of CENTRIF of several sets or axes on an element Abaqus takes the sum, CalculiX one.
void tell_of_several(const InpReading& r, const LoadLine& load, const std::string& on, int axis) {
  const auto cells = cells_of_set(r.m, on);
  for (const auto& [key, value] : r.acting.parts[0].centrifugal) {
    if (value.size == 0 || key == std::pair{on, axis}) continue;
    const auto others = cells_of_set(r.m, key.first);
    if (std::ranges::none_of(others, [&](const auto& cell) { return cells.contains(cell); }))
      continue;
    r.m.notes.push_back(
        fmt::format("line {}: elements of '{}' have the CENTRIF of line {}, too: both act, as in "
                    "Abaqus; CalculiX takes one of them",
                    load.line.at.line, on, value.line));
    return;
  }
}

/// CENTRIF of a set about one of the axes; that of a step before about another one is replaced.
void turn(const InpReading& r, const LoadLine& load, const std::string& on, int axis,
          double speed_squared) {
  for (auto& [key, value] : r.acting.parts[0].centrifugal)
    if (key.first == on && key.second != axis && !value.fresh) release(value);
  set_condition(r.m, r.acting.parts[0].centrifugal, {on, axis}, speed_squared, load.said, load.line,
                true);
}

/// Where CalculiX' vibrations about a state are those of other rotations.
void tell_of_vibrations(const InpReading& r, const LoadLine& load, bool on_masses) {
  const auto tell = [&](const char* what) {
    r.m.notes.push_back(fmt::format("line {}: {}", load.line.at.line, what));
  };
  const auto vibrates = [](const Card& card) { return card.keyword == "FREQUENCY"; };
  if (on_masses && std::ranges::any_of(r.m.deck.cards, vibrates))
    tell(
        "CENTRIF on masses softens vibrations about a state, as that on elements does; in CalculiX "
        "it does not");
  if (r.procedure.modes > 0)
    tell(
        "CENTRIF of a step with *FREQUENCY does not count in it: those of the steps before soften "
        "its vibrations; in CalculiX this one does");
}

void read_centrifugal(const InpReading& r, const LoadLine& load) {
  const double speed = load.fields.real("the square of the angular velocity");
  std::array<double, 6> axis{};
  for (double& c : axis) c = load.fields.real_or_zero("a point or direction of the axis");
  for (std::size_t k = 3; k < 6; ++k) axis[k] += axis[k - 3];
  std::vector<std::array<double, 6>>& axes = r.acting.axes;
  auto known = std::find(axes.begin(), axes.end(), axis);
  if (known == axes.end()) known = axes.insert(axes.end(), axis);
  const int axis_number = static_cast<int>(known - axes.begin());
  const std::string name = io::inp::element_set_name(load.elements);
  const std::vector<InpMass> masses = inp_masses(r.m, name);
  // The load acts on all masses of a node: where some are not named, as much as is theirs.
  std::map<std::string, double> named, all;
  for (const InpMass& one : masses) named[one.node] += one.mass;
  for (const InpMass& one : inp_masses(r.m, io::inp::every_element)) all[one.node] += one.mass;
  for (const auto& [node, mass] : named)
    turn(r, load, node, axis_number, speed * mass / all.at(node));
  tell_of_vibrations(r, load, !masses.empty());
  if (!masses.empty() && !r.m.sets.contains({SetKind::elements, io::inp::capitals(name)})) return;
  const std::string& on = set_of(r.m, load.line.at, name, {SetKind::elements});
  turn(r, load, on, axis_number, speed);
  tell_of_several(r, load, on, axis_number);
}

/// The one thickness of shells, whose edges are faces of solids.
double shell_thickness(const InpModel& m, const LoadLine& load) {
  const std::string name = io::inp::element_set_name(load.elements);
  const auto loaded = cells_of_set(m, set_of(m, load.line.at, name, {SetKind::elements}));
  std::set<double> found;
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "SHELLSECTION") continue;
    const std::string& on = set_of(m, card.at, value_of(m, card, "ELSET"), {SetKind::elements});
    const auto cells = cells_of_set(m, on);
    if (std::ranges::none_of(cells, [&](const auto& cell) { return loaded.contains(cell); }))
      continue;
    double thickness = 0;
    for (const Line& line : io::inp::lines_of(m.deck, card)) {
      thickness += Fields(m.deck, line).real("the thickness");
      if (!io::inp::is_layered(card)) break;
    }
    found.insert(io::inp::find_parameter(card, "NODALTHICKNESS") ? 0 : thickness);
  }
  if (found.size() != 1 || !(*found.begin() > 0))
    load.fields.fail("EDNOR needs shells of one thickness, which their *SHELL SECTION gives");
  return *found.begin();
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
      set_on_parts(r, part.pressures, {on, 1}, fields.real("the pressure"), said, line, true);
    } else if (io::inp::is_edge_load(load)) {
      const std::string& on =
          set_of(r.m, line.at, io::inp::side_set_name(load, one.elements), {SetKind::surface});
      const double force = fields.real("the force per length");
      set_on_parts(r, part.pressures, {on, 1}, force / shell_thickness(r.m, one), said, line, true);
    } else if (load == "GRAV") {
      read_gravity(r, one, part.body_forces);
    } else if (load == "CENTRIF") {
      if (option_of(card, "LOADCASE") == "2")
        fields.fail("CENTRIF with LOAD CASE=2 is not supported");
      read_centrifugal(r, one);
    } else if (load == "BX" || load == "BY" || load == "BZ") {
      const int direction = load[1] - 'X' + 1;
      if (direction > inp_dimension(r.m)) fields.fail("the force points out of the plane");
      const std::string& on =
          set_of(r.m, line.at, io::inp::element_set_name(one.elements), {SetKind::elements});
      set_condition(r.m, part.body_forces, {on, direction}, fields.real("the force per volume"),
                    said, line, true);
    } else {
      fields.fail(fmt::format(
          "load {} is not supported: P1 to P6, EDNOR1 to EDNOR4, GRAV, CENTRIF, BX, BY or "
          "BZ",
          io::inp::shown(load)));
    }
  }
}

/// A traction of constant direction: its size, and a vector along it. With NLGEOM that of a model
/// file neither turns with the surface nor grows with it.
void read_traction(const InpReading& r, const Card& card, const LoadLine& load,
                   const std::string& on, Conditions& tractions) {
  if (r.m.finite &&
      !(option_of(card, "FOLLOWER") == "NO" && option_of(card, "CONSTANTRESULTANT") == "YES"))
    io::inp::fail(r.m.deck, card,
                  "TRVEC with NLGEOM needs FOLLOWER=NO and CONSTANT RESULTANT=YES: tractions act "
                  "per undeformed area, in constant directions");
  const double size = load.fields.real("the traction");
  Vec3 direction = Vec3::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) direction[k] = load.fields.real_or_zero("a direction");
  if (!(direction.norm() > 0)) load.fields.fail("expected the direction of the traction");
  direction.normalize();
  for (int k = 0; k < 3; ++k) {
    const auto along = [&](const auto& one) { return one.first.second == k + 1; };
    // that of a step before is replaced, its other components, too
    if (direction[k] == 0 && std::ranges::none_of(tractions, along)) continue;
    if (k >= inp_dimension(r.m)) load.fields.fail("the traction points out of the plane");
    set_on_parts(r, tractions, {on, k + 1}, size * direction[k], load.said, load.line, true);
  }
}

void read_on_surfaces(const InpReading& r, const Card& card) {
  InpConditions& part = part_of(r, card);
  const InpSaid said = begin_card(r, card, part.pressures);
  (void)begin_card(r, card, part.tractions);
  for (const Line& line : io::inp::lines_of(r.m.deck, card)) {
    Fields fields(r.m.deck, line);
    const std::string surface = io::inp::name_of(fields.next().value_or(""));
    const std::string& on = set_of(r.m, line.at, surface, {SetKind::surface});
    const std::string load = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
    if (load == "TRVEC") {
      read_traction(r, card, {line, fields, said, surface}, on, part.tractions);
      continue;
    }
    if (load != "P")
      fields.fail(fmt::format("load {} is not supported: P or TRVEC", io::inp::shown(load)));
    if (option_of(card, "CONSTANTRESULTANT") == "YES")
      io::inp::fail(r.m.deck, card, "CONSTANT RESULTANT=YES goes with TRVEC");
    set_on_parts(r, part.pressures, {on, 1}, fields.real("the pressure"), said, line, true);
  }
}

}  // namespace

Conditions with_weights(const InpWriting& w, const InpConditions& part) {
  Conditions all = part.forces;
  // An amplitude over the time of a step before has come to its end.
  const auto has_ended = [&](const Condition& value) {
    return !value.fresh && !value.amplitude.empty() && !w.tables.at(value.amplitude).of_total_time;
  };
  for (const auto& [place, weight] : part.weights) {
    const auto [found, is_new] = all.try_emplace(place, weight);
    if (is_new) continue;
    Condition& force = found->second;
    if (force.size != 0 && weight.size != 0 &&
        (force.amplitude != weight.amplitude || has_ended(force) != has_ended(weight)))
      throw core::InputError({w.m.deck.files[0], 0, ""},
                             fmt::format("'{}' has GRAV on a mass (line {}) and a force of *CLOAD "
                                         "with another amplitude, which is not supported",
                                         place.first, weight.line));
    if (force.size == 0) force.amplitude = weight.amplitude;
    force.fresh = force.fresh || force.released || weight.fresh || weight.released;
    force.released = false;
    force.size += weight.size;
  }
  return all;
}

void read_load(const InpReading& r, const Card& card) {
  if (card.keyword != "DLOAD" && card.keyword != "DSLOAD") return;
  check_follower(r.m, card);
  if (card.keyword == "DLOAD")
    read_distributed(r, card);
  else
    read_on_surfaces(r, card);
}

}  // namespace osculate::deck

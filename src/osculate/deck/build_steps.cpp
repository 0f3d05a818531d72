#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/deck/build_displacements.hpp"
#include "osculate/deck/load_totals.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/solid/mass.hpp"

namespace osculate::deck {
namespace {

using model::Dof;

/// Channel of a load: same kind, same place, same component, same axis.
struct ChannelKey {
  int kind;
  std::string on;
  int component;
  std::array<double, 6> axis{};
  auto operator<=>(const ChannelKey&) const = default;
};

struct Channel {
  double value = 0;  ///< at the end of the last step
  std::vector<std::pair<Dof, double>> unit;
  std::vector<model::PressureLoad::Facet> facets;
  Resultant resultant;  ///< of the value 1
};

/// What is in force from step to step.
struct Running {
  std::map<Dof, core::SourceMark> prescribed;
  std::map<ChannelKey, Channel> channels;
  std::optional<Masses> masses;  ///< where there is gravity
};

template <int Dim>
model::Amplitude amplitude_of(const BuildContext<Dim>& c, const std::optional<Name>& name) {
  if (!name) return {};
  return c.description.find_amplitude(name->value)->points;
}

template <int Dim>
void apply_releases(const BuildContext<Dim>& c, const deck::Step& step, Running& running) {
  for (const Release& release : step.release)
    for_each_displacement(c, release, [&](const OneDisplacement& d, std::size_t i) {
      if (running.prescribed.erase(d.dof) == 0)
        throw core::InputError(release.mark,
                               fmt::format("'{}.{}' is not prescribed, so it cannot be released",
                                           release.on.value, component_names[i]));
    });
}

/// What is held stays where it is, like what an earlier step has prescribed.
template <int Dim>
void apply_holds(const BuildContext<Dim>& c, const deck::Step& step, Running& running) {
  for (const Release& hold : step.hold)
    for_each_displacement(c, hold, [&](const OneDisplacement& d, std::size_t) {
      running.prescribed[d.dof] = hold.mark;
    });
}

/// Two prescriptions of one dof: the same, or a contradiction.
void check_agreement(const Prescription& first, double one, const Prescription& second,
                     double other, const Number& two, std::size_t i) {
  if (one != other)
    throw core::InputError(
        two.mark, fmt::format("'{}' and '{}' share a node and prescribe different {} ({} and {})",
                              first.on.value, second.on.value, component_names[i], one, other));
  const auto name = [](const Prescription& p) {
    return p.amplitude ? p.amplitude->value : std::string{};
  };
  if (name(first) != name(second))
    throw core::InputError(two.mark,
                           fmt::format("'{}' and '{}' share a node and prescribe {} with different "
                                       "amplitudes",
                                       first.on.value, second.on.value, component_names[i]));
}

/// The diagonal of the box round all nodes.
double size_of(const mesh::Mesh& mesh) {
  if (mesh.nodes.empty()) return 0;
  Vec3 low = mesh.nodes.front(), high = low;
  for (const Vec3& x : mesh.nodes) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).norm();
}

/// A length in other units than the mesh of this size, most likely.
template <int Dim>
void warn_of_far(const BuildContext<Dim>& c, const deck::Step& step, const Prescription& p,
                 std::size_t component, double size) {
  constexpr double far = 10;
  if (component >= 3) return;
  const double way = std::abs(p.values[component]->value);
  if (!(size > 0) || !(way > far * size)) return;
  c.built.warnings.push_back(fmt::format(
      "step '{}' moves '{}' by {} = {:g}, {:.2g} times the size of the mesh ({:.3g}): is it in the "
      "units of the mesh?",
      step.name.value, p.on.value, component_names[component], p.values[component]->value,
      way / size, size));
}

template <int Dim>
void apply_prescriptions(const BuildContext<Dim>& c, const deck::Step& step, Running& running,
                         model::Step& out) {
  std::set<Dof> eliminated;
  for (const model::Equation& equation : c.model().equations)
    eliminated.insert(equation.terms.front().dof);
  std::map<Dof, std::pair<const Prescription*, double>> here;
  const double size_of_mesh = size_of(c.model().mesh);
  for (const Prescription& p : step.prescribe)
    for (std::size_t i = 0; i < component_count; ++i) {
      const std::optional<Number>& value = p.values[i];
      if (!value) continue;
      warn_of_far(c, step, p, i, size_of_mesh);
      for (const auto& [d, sign] :
           displacements(c, p.on, static_cast<Component>(i), Idle::left_out)) {
        if (eliminated.contains(d))
          throw core::InputError(
              value->mark,
              fmt::format("{} of a node of '{}' already follows from `equations` or `equal`",
                          component_names[i], p.on.value));
        const double size = sign * value->value;
        const auto [at, fresh] = here.emplace(d, std::pair(&p, size));
        if (!fresh) check_agreement(*at->second.first, at->second.second, p, size, *value, i);
        if (!fresh) continue;
        running.prescribed[d] = p.mark;
        out.prescribed.push_back({d, {0, size, amplitude_of(c, p.amplitude)}, false});
      }
    }
  for (const auto& entry : running.prescribed)
    if (!here.contains(entry.first)) out.prescribed.push_back({entry.first, {}, true});
}

/// Force per node on a set, or force and moment on a rigid body.
template <int Dim>
std::vector<std::pair<Dof, double>> force_unit(const BuildContext<Dim>& c, const Load& load,
                                               Component i) {
  std::vector<std::pair<Dof, double>> unit;
  if (const auto rigid = c.rigid_index.find(load.on.value); rigid != c.rigid_index.end())
    return {{body_dof(c.model(), rigid->second, i), 1.0}};
  for (const Index node : moving_nodes(c, load.on, Idle::refused, motion_of<Dim>(i))) {
    const Vec<Dim> direction = direction_of(c, node, i);
    for (int k = 0; k < Dim; ++k)
      if (direction[k] != 0.0) unit.emplace_back(Dim * node + k, direction[k]);
  }
  return unit;
}

/// What one side of a body is called in messages.
template <int Dim>
struct SideWords {
  static constexpr const char* side = Dim == 2 ? "edge" : "face";
  static constexpr const char* cells = Dim == 2 ? "line" : "area";
};

/// Boundary sides of bulk cells that a set names, outward, with the section they belong to.
template <int Dim>
std::vector<model::PressureLoad::Facet> loaded_sides(const BuildContext<Dim>& c, const Name& on) {
  using Words = SideWords<Dim>;
  const mesh::Set& set = c.set(on);
  if (set.dimension != Dim - 1)
    throw core::InputError(on.mark, fmt::format("set '{}' has no boundary {}s: a load on {} {} "
                                                "needs a set of {} cells",
                                                on.value, Words::side, Dim == 2 ? "an" : "a",
                                                Words::side, Words::cells));
  std::vector<model::PressureLoad::Facet> facets;
  for (const Side<Dim>& side : oriented_facets(c, on)) {
    if (!side.has_parent())
      throw core::InputError(
          on.mark, fmt::format("the {} at {} of set '{}' is no boundary of a section", Words::side,
                               mesh::describe_node(c.model().mesh, side.nodes()[0]), on.value));
    model::PressureLoad::Facet facet;
    facet.nodes.assign(side.nodes().begin(), side.nodes().end());
    facet.section = c.section_of_cell.at({side.parent.block, side.parent.cell});
    facet.type = side.type;
    facets.push_back(std::move(facet));
  }
  return facets;
}

template <int Dim>
std::vector<std::pair<Dof, double>> traction_unit(const BuildContext<Dim>& c, const Load& load,
                                                  int direction) {
  std::vector<std::pair<Dof, double>> unit;
  for (const model::PressureLoad::Facet& facet : loaded_sides(c, load.on)) {
    const auto& section = c.model().sections[static_cast<std::size_t>(facet.section)].section;
    const std::vector<double> weights =
        model::side_weights(c.model(), section, facet.type, facet.nodes);
    for (std::size_t k = 0; k < facet.nodes.size(); ++k)
      unit.emplace_back(Dim * facet.nodes[k] + direction, weights[k]);
  }
  return unit;
}

template <int Dim>
std::vector<std::pair<Dof, double>> body_force_unit(const BuildContext<Dim>& c, const Load& load,
                                                    int direction) {
  const mesh::Set& set = c.set(load.on);
  std::set<std::pair<Index, Index>> wanted;
  for (const mesh::CellRef& ref : set.cells) wanted.emplace(ref.block, ref.cell);
  std::vector<std::pair<Dof, double>> unit;
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells) {
      if (!wanted.contains({ref.block, ref.cell})) continue;
      const mesh::Block& block = c.model().mesh.blocks[static_cast<std::size_t>(ref.block)];
      const std::vector<double> weights = model::cell_weights(c.model(), section, ref);
      for (std::size_t k = 0; k < weights.size(); ++k)
        unit.emplace_back(Dim * block.cell(ref.cell)[k] + direction, weights[k]);
    }
  if (unit.empty())
    throw core::InputError(load.on.mark,
                           fmt::format("set '{}' has no bulk cells with a section", load.on.value));
  return unit;
}

/// Shares of the nodes of a set in one force on all of it: by area, by volume, or equal ones.
template <int Dim>
std::vector<std::pair<Dof, double>> total_force_unit(const BuildContext<Dim>& c, const Load& load,
                                                     int direction) {
  const mesh::Set& set = c.set(load.on);
  std::vector<std::pair<Dof, double>> unit;
  if (set.dimension == Dim - 1 && !set.cells.empty())
    unit = traction_unit(c, load, direction);
  else if (set.dimension == Dim && !set.cells.empty())
    unit = body_force_unit(c, load, direction);
  else
    unit = force_unit(c, load, static_cast<Component>(direction));
  double sum = 0;
  for (const auto& entry : unit) sum += entry.second;
  for (auto& entry : unit) entry.second /= sum;
  return unit;
}

/// Centrifugal forces of the cells of a set, of the square 1 of the angular velocity.
///
/// Formula    f_i = rho sum_j M_ij (1 - e e^T) (X_j - X_0) , e along the axis, M = int N N dV
template <int Dim>
std::vector<std::pair<Dof, double>> centrifugal_unit(const BuildContext<Dim>& c, const Load& load) {
  const Vec3 axis = load.to - load.from;
  if (!(axis.norm() > 0)) throw core::InputError(load.mark, "the points of the axis coincide");
  const Vec3 e = axis.normalized();
  const mesh::Set& set = c.set(load.on);
  std::set<std::pair<Index, Index>> wanted;
  for (const mesh::CellRef& ref : set.cells) wanted.emplace(ref.block, ref.cell);
  std::vector<std::pair<Dof, double>> unit;
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells) {
      if (!wanted.contains({ref.block, ref.cell})) continue;
      const double density = material::density(section.section.law);
      if (!(density > 0))
        throw core::InputError(load.on.mark,
                               fmt::format("the material of '{}' has no density", section.name));
      const model::CellNodes cell = model::cell_nodes(c.model().mesh, ref);
      const solid::NodeMass mass = solid::consistent_mass<Dim>(
          section.section, cell.type, model::reference_of(c.model(), cell.nodes));
      for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
        Vec3 force = Vec3::Zero();
        for (std::size_t j = 0; j < cell.nodes.size(); ++j) {
          const Vec3 arm =
              c.model().mesh.nodes[static_cast<std::size_t>(cell.nodes[j])] - load.from;
          force += density * mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                   (arm - arm.dot(e) * e);
        }
        for (int k = 0; k < Dim; ++k) unit.emplace_back(Dim * cell.nodes[i] + k, force[k]);
      }
    }
  if (unit.empty())
    throw core::InputError(load.on.mark,
                           fmt::format("set '{}' has no bulk cells with a section", load.on.value));
  return unit;
}

enum Kind { force, total_force, traction, body_force, centrifugal, pressure };
constexpr int kind_count = 6;

struct KindWords {
  const char* key;
  std::array<const char*, component_count> components;
};
constexpr std::array<KindWords, kind_count> kind_words{
    {{"forces", {"fx", "fy", "fz", "mx", "my", "mz"}},
     {"total_force", {"fx", "fy", "fz"}},
     {"traction", {"tx", "ty", "tz"}},
     {"body_force", {"fx", "fy", "fz"}},
     {"centrifugal", {"speed_squared"}},
     {"pressure", {"value"}}}};

template <int Dim>
Channel new_channel(const BuildContext<Dim>& c, int kind, const Load& load, int i) {
  Channel channel;
  if (kind == force) channel.unit = force_unit(c, load, static_cast<Component>(i));
  if (kind == total_force) channel.unit = total_force_unit(c, load, i);
  if (kind == traction) channel.unit = traction_unit(c, load, i);
  if (kind == body_force) channel.unit = body_force_unit(c, load, i);
  if (kind == centrifugal) channel.unit = centrifugal_unit(c, load);
  if (kind == pressure) channel.facets = loaded_sides(c, load.on);
  channel.resultant = channel.facets.empty() ? resultant(c.model(), channel.unit)
                                             : resultant(c.model(), channel.facets);
  return channel;
}

/// A load as the step gives it.
struct Given {
  model::Ramp ramp;
  std::string amplitude;
};

void add_times(Resultant& sum, double factor, const Resultant& part) {
  sum.force += factor * part.force;
  sum.moment += factor * part.moment;
}

/// Components of one load follow each other. `given` is nullptr where an earlier step's load stays.
void add_total(const ChannelKey& key, const Channel& channel, const Given* given,
               std::vector<LoadTotal>& out) {
  if (!given && channel.value == 0) return;
  const KindWords& words = kind_words[static_cast<std::size_t>(key.kind)];
  const std::string amplitude = given ? given->amplitude : std::string{};
  const bool same = !out.empty() && out.back().kind == words.key && out.back().on == key.on &&
                    out.back().amplitude == amplitude && out.back().kept == !given;
  if (!same) out.push_back({words.key, key.on, {}, amplitude, !given, {}, {}});
  LoadTotal& total = out.back();
  const double value = given ? given->ramp.target : channel.value;
  total.values += fmt::format("{}{} {:g}", same ? ", " : "",
                              words.components[static_cast<std::size_t>(key.component)], value);
  add_times(total.whole, value, channel.resultant);
  add_times(total.end, given ? given->ramp.value(1.0) : value, channel.resultant);
}

template <int Dim>
void apply_loads(const BuildContext<Dim>& c, const deck::Step& step, Running& running,
                 model::Step& out) {
  std::map<ChannelKey, Given> givens;
  const std::array<const std::vector<Load>*, kind_count> kinds{&step.forces,      &step.total_force,
                                                               &step.traction,    &step.body_force,
                                                               &step.centrifugal, &step.pressure};
  for (int kind = 0; kind < kind_count; ++kind)
    for (const Load& load : *kinds[static_cast<std::size_t>(kind)])
      for (int i = 0; i < static_cast<int>(component_count); ++i) {
        const std::optional<Number>& value = load.values[static_cast<std::size_t>(i)];
        if (!value) continue;
        const ChannelKey key{
            kind,
            load.on.value,
            i,
            {load.from[0], load.from[1], load.from[2], load.to[0], load.to[1], load.to[2]}};
        if (!running.channels.contains(key))
          running.channels.emplace(key, new_channel(c, kind, load, i));
        if (kind == force && c.rigid_index.contains(load.on.value))
          running.prescribed.erase(
              body_dof(c.model(), c.rigid_index.at(load.on.value), static_cast<Component>(i)));
        const double start = running.channels[key].value;
        const double end = step.buckling ? start + value->value : value->value;
        givens[key] = {{start, end, amplitude_of(c, load.amplitude)},
                       load.amplitude ? load.amplitude->value : std::string{}};
      }
  for (auto& entry : running.channels) {
    Channel& channel = entry.second;
    const auto given = givens.find(entry.first);
    add_total(entry.first, channel, given != givens.end() ? &given->second : nullptr,
              c.built.loads.back());
    const model::Ramp r =
        given != givens.end() ? given->second.ramp : model::Ramp{channel.value, channel.value, {}};
    if (channel.facets.empty())
      out.dead.push_back({channel.unit, r});
    else
      out.pressure.push_back({channel.facets, r});
    channel.value = r.value(1.0);
  }
}

/// The weight of all masses, where there is gravity.
template <int Dim>
void add_weight(const BuildContext<Dim>& c, const deck::Step& step, const model::Step& built,
                Running& running) {
  if (built.gravity.empty()) return;
  if (!running.masses) running.masses = masses(c.model());
  Vec3 gravity = Vec3::Zero();
  std::string values;
  for (std::size_t i = 0; i < built.gravity.size(); ++i) {
    gravity[static_cast<Eigen::Index>(i)] = built.gravity[i].target;
    values += fmt::format("{}{:g}", i ? ", " : "", built.gravity[i].target);
  }
  const Resultant all = weight(*running.masses, gravity);
  c.built.loads.back().push_back({"gravity", {}, values, {}, !step.gravity, all, all});
}

}  // namespace

namespace {

/// Bodies without mass move only as they are told.
template <int Dim>
bool held_from_the_beginning(const model::BasicRigidBody<Dim>& body, Component component) {
  if (Dim == 2 && !is_planar(component)) return false;
  return !(body.mass > 0);
}

}  // namespace

namespace {

/// Nothing acts in a step of vibrations about the start.
template <int Dim>
void unload(const BuildContext<Dim>& c, model::Step& step) {
  step.pressure.clear();
  step.dead.clear();
  step.gravity.clear();
  step.temperature = {c.model().initial_temperature, {}};
}

}  // namespace

namespace {

/// What acts before motions along vibrations and buckling, which leave nothing behind.
struct Aside {
  std::map<ChannelKey, double> values;
  std::vector<double> gravity;
};
void set_aside(const deck::Step& step, Running& running, std::vector<double>& gravity,
               std::optional<Aside>& aside) {
  if (!step.modal && aside) {
    gravity = aside->gravity;
    for (auto& [key, channel] : running.channels)
      channel.value = aside->values.contains(key) ? aside->values.at(key) : 0.0;
    aside.reset();
  }
  if (aside || (!step.modal && !step.buckling)) return;
  aside.emplace().gravity = gravity;
  for (const auto& [key, channel] : running.channels) aside->values[key] = channel.value;
}

}  // namespace

template <int Dim>
void build_steps(BuildContext<Dim>& c) {
  Running running;
  std::optional<Aside> aside;
  std::vector<double> gravity, temperatures = c.model().initial_temperature;
  for (std::size_t b = 0; b < c.model().rigid.size(); ++b)
    for (std::size_t i = 0; i < component_count; ++i)
      if (held_from_the_beginning(c.model().rigid[b], static_cast<Component>(i)))
        running
            .prescribed[body_dof(c.model(), static_cast<Index>(b), static_cast<Component>(i))] = {};
  bool first = true, about_start = false;  // the last vibrations are about the latter
  for (const deck::Step& step : c.description.steps) {
    model::Step out;
    out.name = step.name.value;
    out.increments = step.increments.value;
    const bool unloaded = step.about == ModesAbout::start;
    if (step.modes) out.frequencies = model::Frequencies{step.modes->value, unloaded};
    if (step.modal) build_modal(step, out);
    if (step.duration) out.duration = step.duration->value;
    out.equation_start = first ? 0.0 : 1.0;
    first = false;
    set_aside(step, running, gravity, aside);
    build_dynamics(c, step, gravity, out);
    apply_releases(c, step, running);
    c.built.loads.emplace_back();
    add_weight(c, step, out, running);
    const std::size_t held = running.prescribed.size();
    apply_loads(c, step, running, out);  // forces on a rigid body free its dof
    if (step.modal && running.prescribed.size() != held)
      throw core::InputError(step.modal->mark,
                             "a force on a rigid body sets it free, but the vibrations were found "
                             "with it held: `release` it in the step with `modes`");
    std::vector<double> passing = temperatures;
    if (step.buckling) build_buckling(c, step, passing, out);
    build_temperatures(c, step, step.buckling ? passing : temperatures, out);
    apply_holds(c, step, running);
    const std::size_t of_vibrations = running.prescribed.size();
    apply_prescriptions(c, step, running, out);
    if (step.modal && running.prescribed.size() != of_vibrations)
      throw core::InputError(step.prescribe.front().mark,
                             "prescribes what the vibrations leave free: hold it by `prescribe` "
                             "with 0 in the step with `modes`");
    add_to_standing(step, out);
    if (unloaded && step.modes) {
      unload(c, out);
      c.built.loads.back().clear();
    }
    if (step.modes) about_start = unloaded;
    if (step.modal && about_start) out.temperature = {c.model().initial_temperature, {}};
    c.model().steps.push_back(std::move(out));
  }
}

template void build_steps(BuildContext<2>&);
template void build_steps(BuildContext<3>&);

}  // namespace osculate::deck

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "osculate/deck/build_loads.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

using model::Dof;

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

/// Those that hold in the step that is built.
template <int Dim>
const std::vector<model::Equation>& running_equations(const model::BasicModel<Dim>& m) {
  const std::vector<model::Equation>* running = &m.equations;
  for (const model::BasicBodyChange<Dim>& change : m.body_changes)
    if (change.step <= m.steps.size() && change.equations) running = &*change.equations;
  return *running;
}

template <int Dim>
void apply_prescriptions(const BuildContext<Dim>& c, const deck::Step& step, Running& running,
                         LoadPart part, model::Step& out) {
  std::set<Dof> eliminated;
  for (const model::Equation& equation : running_equations(c.model()))
    eliminated.insert(equation.terms.front().dof);
  std::map<Dof, std::pair<const Prescription*, double>> here;
  const double size_of_mesh = size_of(c.model().mesh);
  for (const Prescription& p : step.prescribe)
    for (std::size_t i = 0; i < component_count; ++i) {
      const std::optional<Number>& value = p.values[i];
      const double share = share_of(p, part);
      if (!value || share == 0) continue;
      if (!step.harmonic) warn_of_far(c, step, p, i, size_of_mesh);
      for (const auto& [d, sign] :
           displacements(c, p.on, static_cast<Component>(i), Idle::left_out)) {
        if (eliminated.contains(d))
          throw core::InputError(
              value->mark,
              fmt::format("{} of a node of '{}' already follows from `equations` or `equal`",
                          component_names[i], p.on.value));
        const double size = share * sign * value->value;
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
  const LoadWords& words = load_words[static_cast<std::size_t>(key.kind)];
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

/// Loads that swing: these, and none of the steps before.
template <int Dim>
void apply_swinging_loads(const BuildContext<Dim>& c, const deck::Step& step, Running& running,
                          LoadPart part, model::Step& out) {
  std::vector<LoadTotal> totals;
  const auto kinds = loads_of(step);
  for (int kind = 0; kind < load_kinds; ++kind)
    for (const Load& load : *kinds[static_cast<std::size_t>(kind)])
      for (int i = 0; i < static_cast<int>(component_count); ++i) {
        const std::optional<Number>& value = load.values[static_cast<std::size_t>(i)];
        const double share = share_of(load, part);
        if (!value || share == 0) continue;
        if (kind == LoadKind::force && c.rigid_index.contains(load.on.value) &&
            running.prescribed.contains(
                body_dof(c.model(), c.rigid_index.at(load.on.value), static_cast<Component>(i))))
          throw core::InputError(value->mark,
                                 "the vibrations were found with this held: `release` it in the "
                                 "step with `modes`");
        const Channel channel = new_channel(c, kind, load, i, c.model().steps.size());
        const double size = share * value->value;
        const Given given{{size, size, amplitude_of(c, load.amplitude)},
                          load.amplitude ? load.amplitude->value : std::string{}};
        add_total(channel_key(kind, load, i), channel, &given, totals);
        act(channel, given.ramp, out);
      }
  for (LoadTotal& total : totals) {
    if (part == LoadPart::imaginary) total.values += " (imaginary part)";
    c.built.loads.back().push_back(std::move(total));
  }
}

/// Loads of steps before, on what is there now.
template <int Dim>
void put_on_what_is_left(const BuildContext<Dim>& c, Running& running) {
  const std::size_t s = c.model().steps.size();
  if (s == 0 || c.removed_cells[s] == c.removed_cells[s - 1]) return;
  for (auto& [key, channel] : running.channels) {
    const double value = channel.value;
    channel = new_channel(c, key.kind, Load(channel.load), key.component, s);
    channel.value = value;
  }
}

template <int Dim>
void apply_loads(const BuildContext<Dim>& c, const deck::Step& step, Running& running,
                 model::Step& out) {
  std::map<ChannelKey, Given> givens;
  put_on_what_is_left(c, running);
  const auto kinds = loads_of(step);
  for (int kind = 0; kind < load_kinds; ++kind)
    for (const Load& load : *kinds[static_cast<std::size_t>(kind)])
      for (int i = 0; i < static_cast<int>(component_count); ++i) {
        const std::optional<Number>& value = load.values[static_cast<std::size_t>(i)];
        if (!value) continue;
        const ChannelKey key = channel_key(kind, load, i);
        const auto known = running.channels.find(key);
        if (known == running.channels.end() || known->second.load.places != load.places) {
          const double value = known == running.channels.end() ? 0 : known->second.value;
          Channel& channel = running.channels[key];
          channel = new_channel(c, kind, load, i, c.model().steps.size());
          channel.value = value;
        }
        if (kind == LoadKind::force && c.rigid_index.contains(load.on.value))
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
    act(channel, r, out);
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

/// Bodies without mass move only as they are told.
template <int Dim>
void hold_bodies(const BuildContext<Dim>& c, Running& running) {
  const auto& bodies = c.model().rigid;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t i = 0; i < component_count; ++i) {
      const auto component = static_cast<Component>(i);
      if (bodies[b].mass > 0 || (Dim == 2 && !is_planar(component))) continue;
      running.prescribed[body_dof(c.model(), static_cast<Index>(b), component)] = {};
    }
}

/// What it looks for, its increments and duration.
template <int Dim>
model::Step step_without_loads(const BuildContext<Dim>& c, const deck::Step& step) {
  model::Step out;
  out.name = step.name.value;
  out.increments = step.increments.value;
  if (step.modes)
    out.frequencies = model::Frequencies{step.modes->value, step.about == ModesAbout::start, {}};
  for (const Marked<int>& k : step.diameters) out.frequencies->diameters.push_back(k.value);
  if (step.lowest || step.highest)
    c.built.listed_frequencies[static_cast<Index>(c.model().steps.size())] = {
        step.lowest ? step.lowest->value : -std::numeric_limits<double>::infinity(),
        step.highest ? step.highest->value : std::numeric_limits<double>::infinity()};
  if (step.modal) build_modal(*step.modal, out.modal.emplace());
  if (step.duration) out.duration = step.duration->value;
  out.at_once = step.at_once;
  out.equation_start = c.model().steps.empty() ? 0.0 : 1.0;
  return out;
}

/// Nothing acts in a step of vibrations about the start.
template <int Dim>
void unload(const BuildContext<Dim>& c, model::Step& step) {
  step.pressure.clear();
  step.centrifugal.clear();
  step.dead.clear();
  step.gravity.clear();
  step.temperature = {c.model().initial_temperature, {}};
}

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

/// The imaginary parts of loads and supports.
template <int Dim>
void add_imaginary(const BuildContext<Dim>& c, const deck::Step& step, Running& running,
                   model::Step& out) {
  model::Step imaginary;
  imaginary.name = out.name;
  imaginary.temperature = out.temperature;
  apply_swinging_loads(c, step, running, LoadPart::imaginary, imaginary);
  apply_prescriptions(c, step, running, LoadPart::imaginary, imaginary);
  out.harmonic->imaginary = std::make_shared<const model::Step>(std::move(imaginary));
}

}  // namespace

template <int Dim>
void build_steps(BuildContext<Dim>& c) {
  Running running;
  std::optional<Aside> aside;
  std::vector<double> gravity, temperatures = c.model().initial_temperature;
  hold_bodies(c, running);
  bool about_start = false;  // the last vibrations are
  for (const deck::Step& step : c.description.steps) {
    model::Step out = step_without_loads(c, step);
    const bool unloaded = step.about == ModesAbout::start;
    if (step.harmonic) begin_harmonic(c, step, temperatures, about_start, out);
    set_aside(step, running, gravity, aside);
    if (!step.harmonic) build_dynamics(c, step, gravity, out);
    apply_releases(c, step, running);
    c.built.loads.emplace_back();
    add_weight(c, step, out, running);
    const std::size_t held = running.prescribed.size();
    if (step.harmonic)
      apply_swinging_loads(c, step, running, LoadPart::real, out);
    else
      apply_loads(c, step, running, out);  // forces on a rigid body free its dof
    if (step.modal && running.prescribed.size() != held)
      throw core::InputError(step.modal->mark,
                             "a force on a rigid body sets it free, but the vibrations were found "
                             "with it held: `release` it in the step with `modes`");
    std::vector<double> passing = temperatures;
    if (step.buckling) build_buckling(c, step, passing, out);
    if (!step.harmonic) build_temperatures(c, step, step.buckling ? passing : temperatures, out);
    apply_holds(c, step, running);
    const std::size_t of_vibrations = running.prescribed.size();
    apply_prescriptions(c, step, running, LoadPart::real, out);
    if (step.harmonic) add_imaginary(c, step, running, out);
    if ((step.modal || step.harmonic) && running.prescribed.size() != of_vibrations)
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

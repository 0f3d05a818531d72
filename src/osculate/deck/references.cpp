#include <fmt/format.h>

#include <map>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

/// Throws when a name is already taken.
void add_unique(std::map<std::string, int>& lines, const std::string& name,
                const core::SourceMark& mark, const std::string& what) {
  const auto [at, fresh] = lines.emplace(name, mark.line);
  if (!fresh)
    throw core::InputError(mark, fmt::format("{} {} is given twice, first on line {}", what,
                                             quoted(name), at->second));
}

void check_rigid_sets(const Description& d) {
  std::map<std::string, int> sets;
  for (const Rigid& rigid : d.rigid)
    if (const auto* const shape = std::get_if<SetShape>(&rigid.shape))
      add_unique(sets, shape->set.value, shape->set.mark, "set");
}

void check_contact_names(const Description& d) {
  std::map<std::string, int> names;
  for (const Contact& c : d.contact) {
    add_unique(names, c.name.value, c.name.mark, "contact");
    if (const Rigid* const rigid = d.find_rigid(c.name.value))
      throw core::InputError(
          c.name.mark, fmt::format("the name '{}' already belongs to the rigid body on line {}",
                                   c.name.value, rigid->name.mark.line));
  }
}

void check_sides(const Description& d) {
  for (const Contact& c : d.contact) {
    if (c.all) continue;
    const Rigid* const slave = d.find_rigid(c.slave.value);
    if (slave && !slave->meshed())
      throw core::InputError(c.slave.mark,
                             fmt::format("rigid body '{}' is an analytic shape, which can only be "
                                         "master",
                                         c.slave.value));
  }
}

constexpr std::array<const char*, component_count> force_names{"fx", "fy", "fz", "mx", "my", "mz"};

/// Rotations and moments are for rigid bodies.
void require_rigid(const Description& d, const Name& on, const core::SourceMark& mark,
                   std::string_view component) {
  if (d.find_rigid(on.value)) return;
  std::vector<std::string> bodies;
  for (const Rigid& rigid : d.rigid) bodies.push_back(rigid.name.value);
  throw core::InputError(
      mark, fmt::format("'{}' needs a rigid body: {}", component,
                        core::unknown_name_message("rigid body", printable(on.value), bodies)));
}

void check_constraints(const Description& d) {
  for (const Equation* const equation : d.all_equations())
    for (const EquationTerm& term : equation->terms)
      if (is_rotation(term.of))
        require_rigid(d, term.on, term.on.mark, component_names[static_cast<std::size_t>(term.of)]);
  for (const Spring& spring : d.springs)
    for (const EquationTerm& term : spring.terms)
      if (is_rotation(term.of))
        require_rigid(d, term.on, term.on.mark, component_names[static_cast<std::size_t>(term.of)]);
  for (const Coupling& coupling : d.coupling)
    require_rigid(d, coupling.rigid, coupling.rigid.mark, "rigid");
  std::map<std::string, int> equal;
  for (const Equal& e : d.equal) {
    if (d.find_rigid(e.on.value))
      throw core::InputError(e.on.mark, fmt::format("'{}' is a rigid body; its nodes already move "
                                                    "as one",
                                                    e.on.value));
    const char* const component = component_names[static_cast<std::size_t>(e.of)];
    add_unique(equal, e.on.value + "." + component, e.mark, "equal");
  }
}

/// What one step does with the displacements: every set and component at most once.
class StepChecker {
 public:
  explicit StepChecker(const Description& d) : d_(d) {}

  void check(const Step& step) {
    check_diameters(step);
    check_rest(step);
    if (step.buckling && !d_.cyclic_symmetry.empty())
      throw core::InputError(step.buckling->mark,
                             "a sector of a cyclic symmetry buckles otherwise than the whole: what "
                             "differs between sectors would be missing");
    std::map<std::string, int> seen;
    for (const Prescription& p : step.prescribe) check_prescription(p, seen);
    for (const Release& r : step.release) check_release(r, seen);
    for (const Release& hold : step.hold) check_hold(hold, seen);
    for (const Prescription& p : step.prescribe)
      for (std::size_t i = 0; i < component_count; ++i)
        prescribed_[i] = prescribed_[i] || p.values[i];
    check_loads(step.forces, force_names, true);
    check_loads(step.total_force, {"fx", "fy", "fz"}, false);
    check_loads(step.pressure, {"value"}, false);
    check_loads(step.traction, {"tx", "ty", "tz"}, false);
    check_loads(step.body_force, {"fx", "fy", "fz"}, false);
    check_loads(step.temperature, {"value", "gradient", "gradient_1"}, false);
    check_loads(step.centrifugal, {"speed_squared"}, false);
    for (const Load& force : step.forces) check_loaded_dof(step, force);
    for (const Load& force : step.total_force) check_loaded_dof(step, force);
  }

 private:
  void require_amplitude(const std::optional<Name>& amplitude) const {
    if (!amplitude || d_.find_amplitude(amplitude->value)) return;
    std::vector<std::string> known;
    for (const Amplitude& a : d_.amplitudes) known.push_back(a.name.value);
    throw core::InputError(amplitude->mark, core::unknown_name_message(
                                                "amplitude", printable(amplitude->value), known));
  }

  void check_prescription(const Prescription& p, std::map<std::string, int>& seen) const {
    require_amplitude(p.amplitude);
    for (std::size_t i = 0; i < component_count; ++i)
      if (p.values[i] && is_rotation(static_cast<Component>(i)))
        require_rigid(d_, p.on, p.values[i]->mark, component_names[i]);
    for (std::size_t i = 0; i < component_count; ++i)
      if (p.values[i])
        add_unique(seen, p.on.value + "." + component_names[i] + phase_text(p), p.values[i]->mark,
                   "prescription of");
  }

  /// What buckles is a state of equilibrium.
  void check_rest(const Step& step) {
    if (step.buckling && step.about == ModesAbout::last && moving_)
      throw core::InputError(
          step.buckling->mark,
          fmt::format("step '{}' leaves the bodies in motion, which is no state that buckles: a "
                      "step without `dynamics` between them, or `about: start`",
                      *moving_));
    if (step.dynamics)
      moving_ = step.name.value;
    else if (!step.modes && !step.buckling && !step.modal && !step.harmonic)
      moving_.reset();
  }

  void check_diameters(const Step& step) const {
    if (step.modes && step.diameters.empty() && !d_.cyclic_symmetry.empty())
      throw core::InputError(step.modes->mark,
                             "a sector of a cyclic symmetry has not the free vibrations of the "
                             "whole: say which nodal `diameters` they have, {count: 10, diameters: "
                             "[0, 1, 2]}");
    if (step.diameters.empty()) return;
    if (d_.cyclic_symmetry.empty())
      throw core::InputError(step.diameters.front().mark,
                             "only a sector with `cyclic_symmetry` has nodal diameters");
    const int sectors = d_.cyclic_symmetry.front().sectors.value;
    for (const CyclicSymmetry& other : d_.cyclic_symmetry)
      if (other.sectors.value != sectors)
        throw core::InputError(other.sectors.mark,
                               fmt::format("with nodal diameters all parts have as many sectors, "
                                           "the first has {}",
                                           sectors));
    std::set<int> seen;
    for (const Marked<int>& k : step.diameters) {
      if (2 * k.value > sectors)
        throw core::InputError(k.mark, fmt::format("{} sectors have at most {} nodal diameters",
                                                   sectors, sectors / 2));
      if (!seen.insert(k.value).second)
        throw core::InputError(k.mark, fmt::format("{} is given twice", k.value));
    }
  }

  /// Rigid bodies are held from the beginning, so that releasing them always makes sense.
  void check_release(const Release& r, std::map<std::string, int>& seen) const {
    const bool rigid = d_.find_rigid(r.on.value) != nullptr;
    for (std::size_t i = 0; i < component_count; ++i) {
      if (!r.of[i]) continue;
      const char* const component = component_names[i];
      if (is_rotation(static_cast<Component>(i))) require_rigid(d_, r.on, r.mark, component);
      const std::string name = r.on.value + "." + component;
      const auto [at, fresh] = seen.emplace(name, r.mark.line);
      if (!fresh)
        throw core::InputError(r.mark, fmt::format("{} is already prescribed or released in this "
                                                   "step, on line {}",
                                                   quoted(name), at->second));
      if (!rigid && !prescribed_[i])
        throw core::InputError(r.mark, fmt::format("no earlier step prescribes {}, so it cannot be "
                                                   "released",
                                                   component));
    }
  }

  void check_hold(const Release& hold, std::map<std::string, int>& seen) {
    for (std::size_t i = 0; i < component_count; ++i) {
      if (!hold.of[i]) continue;
      if (is_rotation(static_cast<Component>(i)))
        require_rigid(d_, hold.on, hold.mark, component_names[i]);
      add_unique(seen, hold.on.value + "." + component_names[i], hold.mark, "prescription of");
      prescribed_[i] = true;
    }
  }

  void check_loads(const std::vector<Load>& loads,
                   const std::array<const char*, component_count>& components,
                   bool on_rigid) const {
    std::map<std::string, int> seen;
    for (const Load& load : loads) {
      require_amplitude(load.amplitude);
      if (!on_rigid && d_.find_rigid(load.on.value))
        throw core::InputError(
            load.on.mark,
            fmt::format("'{}' is a rigid body; only forces act on it directly", load.on.value));
      for (std::size_t i = 0; on_rigid && i < component_count; ++i)
        if (load.values[i] && is_rotation(static_cast<Component>(i)))
          require_rigid(d_, load.on, load.values[i]->mark, force_names[i]);
      for (std::size_t i = 0; i < component_count; ++i)
        if (load.values[i])
          add_unique(seen, load.on.value + "." + components[i] + phase_text(load) + axis_text(load),
                     load.values[i]->mark, "load on");
    }
  }

  static std::string phase_text(const Load& load) {
    return load.phase ? fmt::format(" (phase {:g})", load.phase->value) : std::string{};
  }

  /// Of centrifugal loads, whose axes may be others.
  static std::string axis_text(const Load& load) {
    if (load.from == Load{}.from && load.to == Load{}.to) return {};
    return fmt::format(" (axis from {:g}, {:g}, {:g} to {:g}, {:g}, {:g})", load.from[0],
                       load.from[1], load.from[2], load.to[0], load.to[1], load.to[2]);
  }

  /// A displacement cannot be prescribed while the force that belongs to it is given.
  static void check_loaded_dof(const Step& step, const Load& force) {
    for (const Prescription& p : step.prescribe)
      for (std::size_t i = 0; i < component_count; ++i)
        if (p.on.value == force.on.value && p.values[i] && force.values[i])
          throw core::InputError(
              force.values[i]->mark,
              fmt::format("a force cannot be given where line {} prescribes {} of {}",
                          p.values[i]->mark.line, component_names[i], quoted(p.on.value)));
  }

  const Description& d_;
  std::array<bool, component_count> prescribed_{};  ///< by an earlier step, anywhere
  std::optional<std::string> moving_{};             ///< the step that has left the bodies in motion
};

}  // namespace

void check_references(const Description& d) {
  std::map<std::string, int> sections;
  for (const Section& section : d.sections)
    add_unique(sections, section.on.value, section.on.mark, "section on");
  check_rigid_sets(d);
  check_contact_names(d);
  check_sides(d);
  check_constraints(d);
}

void check_steps(const Description& d) {
  std::map<std::string, int> names;
  StepChecker checker(d);
  for (const Step& step : d.steps) {
    add_unique(names, step.name.value, step.name.mark, "step");
    checker.check(step);
  }
  check_modal_steps(d);
}

}  // namespace osculate::deck

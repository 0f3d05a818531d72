#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {

namespace {

/// Whether a shape exists in the plane and in space.
struct Lives {
  bool plane = true, space = true;
};
struct LivesOf {
  Lives operator()(const SetShape&) const { return {true, true}; }
  Lives operator()(const CircleShape&) const { return {true, false}; }
  Lives operator()(const ArcShape&) const { return {true, false}; }
  Lives operator()(const PolylineShape&) const { return {true, false}; }
  Lives operator()(const HalfPlaneShape&) const { return {true, false}; }
  Lives operator()(const NurbsShape&) const { return {true, false}; }
  Lives operator()(const CompositeShape&) const { return {true, false}; }
  template <class SpaceShape>
  Lives operator()(const SpaceShape&) const {
    return {false, true};
  }
};

bool any_in_space(const Load& load) {
  for (std::size_t i = 0; i < component_count; ++i)
    if (load.values[i] && !is_planar(static_cast<Component>(i))) return true;
  return false;
}

/// Rigid bodies, their velocities and gravity tell where a model without sections lives.
bool has_something_in_space(const Description& d) {
  for (const Rigid& rigid : d.rigid) {
    if (!std::visit(LivesOf{}, rigid.shape).plane) return true;
    if (rigid.reference && rigid.reference->value.size() == 3) return true;
  }
  if (std::any_of(d.initial_velocity.begin(), d.initial_velocity.end(), any_in_space)) return true;
  return std::any_of(d.steps.begin(), d.steps.end(), [](const Step& step) {
    return (step.gravity && step.gravity->value.size() == 3) ||
           std::any_of(step.forces.begin(), step.forces.end(), any_in_space) ||
           std::any_of(step.prescribe.begin(), step.prescribe.end(), any_in_space);
  });
}

}  // namespace

int dimension(const Description& description) {
  for (const Section& section : description.sections)
    if (is_space(section.element.value)) return 3;
  return description.sections.empty() && has_something_in_space(description) ? 3 : 2;
}

core::InputError only_in_space(const core::SourceMark& mark, std::string_view word) {
  return {mark,
          fmt::format("'{}' exists in space only, and this model is plane: no section has the "
                      "element solid or solid_shell",
                      word)};
}

namespace {

void check_sections(const Description& d) {
  for (const Section& section : d.sections)
    if (is_space(section.element.value) != is_space(d.sections.front().element.value))
      throw core::InputError(
          section.element.mark,
          fmt::format(
              "the sections on '{}' and '{}' exclude each other: one is plane, one in space",
              d.sections.front().on.value, section.on.value));
}

void check_rigid(const Rigid& rigid, int dimension) {
  const Lives lives = std::visit(LivesOf{}, rigid.shape);
  if (dimension == 2 && !lives.plane) throw only_in_space(rigid.name.mark, rigid.kind);
  if (dimension == 3 && !lives.space)
    throw core::InputError(
        rigid.name.mark,
        fmt::format("'{}' is a shape of the plane, and this model is in space: a section has the "
                    "element solid or solid_shell",
                    rigid.kind));
  if (rigid.reference && rigid.reference->value.size() != static_cast<std::size_t>(dimension))
    throw core::InputError(
        rigid.reference->mark,
        fmt::format("expected {} values, because the model is {}, got {}", dimension,
                    dimension == 3 ? "in space" : "plane", rigid.reference->value.size()));
}

void refuse(Component component, const core::SourceMark& mark) {
  if (!is_planar(component))
    throw only_in_space(mark, component_names[static_cast<std::size_t>(component)]);
}

/// Components of a load that the plane does not have.
void refuse_loads(const std::vector<Load>& loads,
                  const std::array<const char*, component_count>& names) {
  for (const Load& load : loads)
    for (std::size_t i = 0; i < component_count; ++i)
      if (load.values[i] && !is_planar(static_cast<Component>(i)))
        throw only_in_space(load.values[i]->mark, names[i]);
}

void check_planar_step(const Step& step) {
  for (const Prescription& p : step.prescribe)
    for (std::size_t i = 0; i < component_count; ++i)
      if (p.values[i]) refuse(static_cast<Component>(i), p.values[i]->mark);
  for (const auto* const list : {&step.release, &step.hold})
    for (const Release& r : *list)
      for (std::size_t i = 0; i < component_count; ++i)
        if (r.of[i]) refuse(static_cast<Component>(i), r.mark);
  refuse_loads(step.forces, {"fx", "fy", "fz", "mx", "my", "mz"});
  refuse_loads(step.total_force, {"fx", "fy", "fz"});
  refuse_loads(step.traction, {"tx", "ty", "tz"});
  refuse_loads(step.body_force, {"fx", "fy", "fz"});
}

}  // namespace

void check_dimension(const Description& d) {
  check_sections(d);
  const int dim = dimension(d);
  for (const Rigid& rigid : d.rigid) check_rigid(rigid, dim);
  if (dim == 3) return;
  for (const Contact& contact : d.contact)
    if (contact.edges) throw only_in_space(contact.edges->mark, "edges");
  for (const Equation* const equation : d.all_equations())
    for (const EquationTerm& term : equation->terms) refuse(term.of, term.on.mark);
  for (const Spring& spring : d.springs)
    for (const EquationTerm& term : spring.terms) refuse(term.of, term.on.mark);
  for (const Equal& equal : d.equal) refuse(equal.of, equal.mark);
  for (const Step& step : d.steps) check_planar_step(step);
}

}  // namespace osculate::deck

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::deck {
namespace {

using model::Dof;

constexpr std::array<const char*, 3> component_names{"ux", "uy", "rz"};

Dof body_dof(const model::Model& m, Index body, int component) {
  return 2 * static_cast<Dof>(m.reference.size()) + 3 * body + component;
}

/// Channel of a load: same kind, same place, same component.
struct ChannelKey {
  int kind;
  std::string on;
  int component;
  auto operator<=>(const ChannelKey&) const = default;
};

struct Channel {
  double value = 0;  ///< at the end of the last step
  std::vector<std::pair<Dof, double>> unit;
  std::vector<model::PressureLoad::Edge> edges;
};

/// What is in force from step to step.
struct Running {
  std::map<Dof, core::SourceMark> prescribed;
  std::map<ChannelKey, Channel> channels;
};

model::Amplitude amplitude_of(const BuildContext& c, const std::optional<Name>& name) {
  if (!name) return {};
  return c.description.find_amplitude(name->value)->points;
}

/// What happens to nodes of a set that take no part in the analysis.
enum class Idle { refused, left_out };

/// Primary dofs that `on` names for one displacement component.
std::vector<Dof> displacement_dofs(const BuildContext& c, const Name& on, int component,
                                   Idle idle) {
  const auto rigid = c.rigid_index.find(on.value);
  if (rigid != c.rigid_index.end()) return {body_dof(c.model(), rigid->second, component)};
  if (component == 2)
    throw core::InputError(on.mark,
                           fmt::format("rz needs a rigid body, and '{}' is a set", on.value));
  std::vector<Dof> dofs;
  for (const Index node : c.set(on).nodes) {
    const Index body = c.model().body_of_node[static_cast<std::size_t>(node)];
    if (body >= 0)
      throw core::InputError(
          on.mark, fmt::format("set '{}' has nodes of the rigid body '{}'; name "
                               "the rigid body instead",
                               on.value, c.model().rigid[static_cast<std::size_t>(body)].name));
    if (c.takes_part(node))
      dofs.push_back(2 * node + component);
    else if (idle == Idle::refused)
      throw c.idle_node(on, node);
  }
  if (!dofs.empty()) return dofs;
  if (!c.set(on).nodes.empty()) throw c.idle_node(on, c.set(on).nodes.front());
  throw core::InputError(on.mark, fmt::format("set '{}' has no nodes", on.value));
}

void apply_releases(const BuildContext& c, const deck::Step& step, Running& running) {
  for (const Release& release : step.release)
    for (int i = 0; i < 3; ++i)
      if (release.of[static_cast<std::size_t>(i)])
        for (const Dof d : displacement_dofs(c, release.on, i, Idle::left_out))
          if (running.prescribed.erase(d) == 0)
            throw core::InputError(
                release.mark,
                fmt::format("'{}.{}' is not prescribed, so it cannot be released", release.on.value,
                            component_names[static_cast<std::size_t>(i)]));
}

/// Two prescriptions of one dof: the same, or a contradiction.
void check_agreement(const Prescription& first, const Prescription& second, int component) {
  const auto i = static_cast<std::size_t>(component);
  const Number& one = *first.values[i];
  const Number& two = *second.values[i];
  if (one.value != two.value)
    throw core::InputError(
        two.mark,
        fmt::format("'{}' and '{}' share a node and prescribe different {} ({} and {})",
                    first.on.value, second.on.value, component_names[i], one.value, two.value));
  const auto name = [](const Prescription& p) {
    return p.amplitude ? p.amplitude->value : std::string{};
  };
  if (name(first) != name(second))
    throw core::InputError(two.mark,
                           fmt::format("'{}' and '{}' share a node and prescribe {} with different "
                                       "amplitudes",
                                       first.on.value, second.on.value, component_names[i]));
}

void apply_prescriptions(const BuildContext& c, const deck::Step& step, Running& running,
                         model::Step& out) {
  std::set<Dof> eliminated;
  for (const model::Equation& equation : c.model().equations)
    eliminated.insert(equation.terms.front().dof);
  std::map<Dof, const Prescription*> here;
  for (const Prescription& p : step.prescribe)
    for (int i = 0; i < 3; ++i) {
      const std::optional<Number>& value = p.values[static_cast<std::size_t>(i)];
      if (!value) continue;
      for (const Dof d : displacement_dofs(c, p.on, i, Idle::left_out)) {
        if (eliminated.contains(d))
          throw core::InputError(
              value->mark,
              fmt::format("{} of a node of '{}' already follows from `equations` or `equal`",
                          component_names[static_cast<std::size_t>(i)], p.on.value));
        const auto [at, fresh] = here.emplace(d, &p);
        if (!fresh) check_agreement(*at->second, p, i);
        if (!fresh) continue;
        running.prescribed[d] = p.mark;
        out.prescribed.push_back({d, {0, value->value, amplitude_of(c, p.amplitude)}, false});
      }
    }
  for (const auto& entry : running.prescribed)
    if (!here.contains(entry.first)) out.prescribed.push_back({entry.first, {}, true});
}

/// Force per node on a set, or force and moment on a rigid body.
std::vector<std::pair<Dof, double>> force_unit(const BuildContext& c, const Load& load, int i) {
  std::vector<std::pair<Dof, double>> unit;
  for (const Dof d : displacement_dofs(c, load.on, i, Idle::refused)) unit.emplace_back(d, 1.0);
  return unit;
}

/// Boundary edges of bulk cells that a set names, outward, with the section they belong to.
std::vector<model::PressureLoad::Edge> loaded_edges(const BuildContext& c, const Name& on) {
  const mesh::Set& set = c.set(on);
  if (set.dimension != 1)
    throw core::InputError(on.mark, fmt::format("set '{}' has no boundary edges: a load on an edge "
                                                "needs a set of line cells",
                                                on.value));
  std::vector<model::PressureLoad::Edge> edges;
  for (const mesh::BoundaryFacet& facet : oriented_facets(c, on)) {
    if (!facet.has_parent())
      throw core::InputError(
          on.mark, fmt::format("the edge at {} of set '{}' is no boundary of a section",
                               mesh::describe_node(c.model().mesh, facet.nodes()[0]), on.value));
    model::PressureLoad::Edge edge;
    edge.nodes.assign(facet.nodes().begin(), facet.nodes().end());
    edge.section = c.section_of_cell.at({facet.parent.block, facet.parent.cell});
    edges.push_back(std::move(edge));
  }
  return edges;
}

std::vector<std::pair<Dof, double>> traction_unit(const BuildContext& c, const Load& load, int i) {
  std::vector<std::pair<Dof, double>> unit;
  for (const model::PressureLoad::Edge& edge : loaded_edges(c, load.on)) {
    const solid::Section& section =
        c.model().sections[static_cast<std::size_t>(edge.section)].section;
    const std::vector<double> weights = model::edge_weights(c.model(), section, edge.nodes);
    for (std::size_t k = 0; k < edge.nodes.size(); ++k)
      unit.emplace_back(2 * edge.nodes[k] + i, weights[k]);
  }
  return unit;
}

std::vector<std::pair<Dof, double>> body_force_unit(const BuildContext& c, const Load& load,
                                                    int i) {
  const mesh::Set& set = c.set(load.on);
  std::set<std::pair<Index, Index>> wanted;
  for (const mesh::CellRef& ref : set.cells) wanted.emplace(ref.block, ref.cell);
  std::vector<std::pair<Dof, double>> unit;
  for (const model::BulkSection& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells) {
      if (!wanted.contains({ref.block, ref.cell})) continue;
      const mesh::Block& block = c.model().mesh.blocks[static_cast<std::size_t>(ref.block)];
      const std::vector<double> weights = model::cell_weights(c.model(), section, ref);
      for (std::size_t k = 0; k < weights.size(); ++k)
        unit.emplace_back(2 * block.cell(ref.cell)[k] + i, weights[k]);
    }
  if (unit.empty())
    throw core::InputError(load.on.mark,
                           fmt::format("set '{}' has no bulk cells with a section", load.on.value));
  return unit;
}

enum Kind { force, traction, body_force, pressure };

Channel new_channel(const BuildContext& c, int kind, const Load& load, int i) {
  Channel channel;
  if (kind == force) channel.unit = force_unit(c, load, i);
  if (kind == traction) channel.unit = traction_unit(c, load, i);
  if (kind == body_force) channel.unit = body_force_unit(c, load, i);
  if (kind == pressure) channel.edges = loaded_edges(c, load.on);
  return channel;
}

void apply_loads(const BuildContext& c, const deck::Step& step, Running& running,
                 model::Step& out) {
  std::map<ChannelKey, model::Ramp> ramps;
  const std::array<const std::vector<Load>*, 4> kinds{&step.forces, &step.traction,
                                                      &step.body_force, &step.pressure};
  for (int kind = 0; kind < 4; ++kind)
    for (const Load& load : *kinds[static_cast<std::size_t>(kind)])
      for (int i = 0; i < 3; ++i) {
        const std::optional<Number>& value = load.values[static_cast<std::size_t>(i)];
        if (!value) continue;
        const ChannelKey key{kind, load.on.value, i};
        if (!running.channels.contains(key))
          running.channels.emplace(key, new_channel(c, kind, load, i));
        if (kind == force && c.rigid_index.contains(load.on.value))
          running.prescribed.erase(body_dof(c.model(), c.rigid_index.at(load.on.value), i));
        ramps[key] = {running.channels[key].value, value->value, amplitude_of(c, load.amplitude)};
      }
  for (auto& entry : running.channels) {
    Channel& channel = entry.second;
    const auto ramp = ramps.find(entry.first);
    const model::Ramp r =
        ramp != ramps.end() ? ramp->second : model::Ramp{channel.value, channel.value, {}};
    if (channel.edges.empty())
      out.dead.push_back({channel.unit, r});
    else
      out.pressure.push_back({channel.edges, r});
    channel.value = r.value(1.0);
  }
}

}  // namespace

void build_steps(BuildContext& c) {
  Running running;
  for (std::size_t b = 0; b < c.model().rigid.size(); ++b)
    for (int i = 0; i < 3; ++i)
      running.prescribed[body_dof(c.model(), static_cast<Index>(b), i)] = {};
  bool first = true;
  for (const deck::Step& step : c.description.steps) {
    model::Step out;
    out.name = step.name.value;
    out.increments = step.increments.value;
    out.equation_start = first ? 0.0 : 1.0;
    first = false;
    apply_releases(c, step, running);
    apply_loads(c, step, running, out);  // forces on a rigid body free its dof
    apply_prescriptions(c, step, running, out);
    c.model().steps.push_back(std::move(out));
  }
}

namespace {

/// Adds a term; a displacement named before gets the sum of its factors.
void add_term(model::Equation& equation, Dof dof, double factor) {
  for (model::Equation::Term& term : equation.terms)
    if (term.dof == dof) {
      term.factor += factor;
      return;
    }
  equation.terms.push_back({dof, factor});
}

}  // namespace

void build_equations(BuildContext& c) {
  std::set<Dof> eliminated, used;
  // A dof is eliminated at most once and only in favour of dofs that stay: no chains, no cycles.
  const auto add = [&](model::Equation equation, const core::SourceMark& mark) {
    for (const model::Equation::Term& term : equation.terms)
      if (eliminated.contains(term.dof))
        throw core::InputError(mark,
                               fmt::format("{} of {} already follows from another equation",
                                           component_names[static_cast<std::size_t>(term.dof % 2)],
                                           mesh::describe_node(c.model().mesh, term.dof / 2)));
    const auto lead = std::find_if(
        equation.terms.begin(), equation.terms.end(), [&](const model::Equation::Term& term) {
          return term.factor != 0.0 && !used.contains(term.dof) &&
                 term.dof < 2 * static_cast<Dof>(c.model().reference.size());
        });
    if (lead == equation.terms.end())
      throw core::InputError(mark,
                             "no displacement of a node can be eliminated: all are used by other "
                             "equations, have the factor 0 or belong to rigid bodies");
    std::iter_swap(equation.terms.begin(), lead);
    eliminated.insert(equation.terms[0].dof);
    for (const model::Equation::Term& term : equation.terms) used.insert(term.dof);
    c.model().equations.push_back(std::move(equation));
  };
  for (const deck::Equation& e : c.description.equations) {
    model::Equation equation;
    equation.value = e.value.value;
    for (const EquationTerm& term : e.terms)
      for (const Dof d : displacement_dofs(c, term.on, static_cast<int>(term.of), Idle::refused))
        add_term(equation, d, term.factor.value);
    add(std::move(equation), e.mark);
  }
  for (const Equal& equal : c.description.equal) {
    const std::vector<Dof> dofs =
        displacement_dofs(c, equal.on, static_cast<int>(equal.of), Idle::refused);
    for (std::size_t i = 1; i < dofs.size(); ++i)
      add({{{dofs[i], 1.0}, {dofs[0], -1.0}}, 0.0}, equal.mark);
  }
}

}  // namespace osculate::deck

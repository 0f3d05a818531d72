#include "osculate/deck/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/core/memory.hpp"
#include "osculate/core/text.hpp"
#include "osculate/deck/build_ties.hpp"
#include "osculate/deck/linear_choice.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/parse_parts.hpp"
#include "osculate/deck/pretension.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::deck {

template <int Dim>
const mesh::Set& BuildContext<Dim>::set(const Name& on) const {
  const mesh::Set* const found = model().mesh.find_set(on.value);
  if (!found) throw unknown_set(on, set_names);
  return *found;
}

template <int Dim>
bool BuildContext<Dim>::takes_part(Index node) const {
  const auto n = static_cast<std::size_t>(node);
  return (n < section_of_node.size() && section_of_node[n] >= 0) || model().body_of_node[n] >= 0 ||
         control_nodes.contains(node);
}

template <int Dim>
bool BuildContext<Dim>::takes_part(Index node, int direction) const {
  if (takes_part(node)) return true;
  const auto dof = static_cast<std::size_t>(Dim * node + direction);
  return dof < related.size() && related[dof];
}

template <int Dim>
core::InputError BuildContext<Dim>::idle_node(const Name& on, Index node) const {
  return {on.mark, fmt::format("{} of '{}' belongs to no section and to no rigid body",
                               mesh::describe_node(model().mesh, node), on.value)};
}

template struct BuildContext<2>;
template struct BuildContext<3>;

namespace {

model::AnalysisOptions analysis_options(const Solver& solver) {
  model::AnalysisOptions options;
  solve::NewtonOptions& newton = options.increments.newton;
  newton.energy = solver.energy.value;
  newton.residual = solver.residual.value;
  newton.max_iterations = solver.max_iterations.value;
  newton.line_search =
      solver.line_search == LineSearch::off ? solve::LineSearch::off : solve::LineSearch::automatic;
  newton.predictor = solver.predictor == Predictor::tangent ? solve::Predictor::tangent
                                                            : solve::Predictor::automatic;
  options.increments.max_cutbacks = solver.cutbacks.value;
  options.increments.arc_length.use = solver.arc_length == ArcLength::off ? solve::PathControl::off
                                      : solver.arc_length == ArcLength::always
                                          ? solve::PathControl::always
                                          : solve::PathControl::last_resort;
  return options;
}

void need_duration(const Step& step, const core::SourceMark& mark, std::string_view what) {
  if (!step.duration && !step.modes && !step.buckling && !step.harmonic)
    throw core::InputError(
        mark, fmt::format("{} needs the duration of every step, and step '{}' has none", what,
                          step.name.value));
}

}  // namespace

void check_durations(const Description& description, const Material& material) {
  if (!material::needs_duration(material.law.value)) return;
  for (const Step& step : description.steps)
    if (!step.at_once)
      need_duration(step, material.law.mark,
                    fmt::format("material '{}', which depends on time,", material.name.value));
}

void check_durations(const Description& description, const std::optional<core::SourceMark>& timed,
                     std::string_view what, const StepRange& acts) {
  if (!timed) return;
  const std::size_t end = std::min(acts.end, description.steps.size());
  for (const Step& step :
       std::span(description.steps).first(end).subspan(std::min(acts.first, end)))
    need_duration(step, *timed, what);
}

void require_in_plane(const mesh::Mesh& mesh, const core::SourceMark& mark) {
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(mesh.nodes[n].z()) > 1e-12 * (1 + mesh.nodes[n].norm()))
      throw core::InputError(
          mark, fmt::format("node {} has z = {:g}; plane problems need z = 0",
                            mesh::node_number(mesh, static_cast<Index>(n)), mesh.nodes[n].z()));
}

namespace {

/// A plane model needs z = 0; where its sections are of volume cells, that is the mistake.
void check_planar(const Description& description, const mesh::Mesh& mesh) {
  for (const Section& section : description.sections) {
    const mesh::Set* const set = mesh.find_set(section.on.value);
    if (set && set->dimension == 3) return;  // build_sections says so
  }
  require_in_plane(mesh, description.mesh.mark);
}

model::HistoryRequest::Kind kind_of(HistoryTarget target) {
  if (target == HistoryTarget::contact) return model::HistoryRequest::Kind::pair;
  if (target == HistoryTarget::rigid) return model::HistoryRequest::Kind::rigid;
  return model::HistoryRequest::Kind::nodes;
}

/// One pair, or all that were made for one `all`.
template <int Dim>
void set_pairs(const BuildContext<Dim>& c, const Name& on, model::HistoryRequest& out) {
  std::vector<std::string> names;
  for (std::size_t p = 0; p < c.model().pairs.size(); ++p) {
    const model::BasicContactPair<Dim>& pair = c.model().pairs[p];
    names.push_back(pair.name);
    const bool second_pass = pair.reversed && pair.name == on.value + ".reversed";
    if (pair.name != on.value && pair.group != on.value && !second_pass) continue;
    if (out.target < 0)
      out.target = static_cast<Index>(p);
    else
      out.group.push_back(static_cast<Index>(p));
  }
  if (out.target < 0)
    throw core::InputError(on.mark, core::unknown_name_message("contact pair", on.value, names));
}

}  // namespace

template <int Dim>
void build_history(BuildContext<Dim>& c) {
  for (const HistoryRequest& request : c.description.output.history) {
    model::HistoryRequest out;
    out.name = request.column;
    const bool remembered = request.of.value >= Quantity::remembered;
    out.quantity = remembered ? remembered_number(request.of.value).name
                              : quantity_names[static_cast<std::size_t>(request.of.value)];
    out.kind = remembered ? model::HistoryRequest::Kind::remembered : kind_of(request.target);
    if (request.target == HistoryTarget::contact) {
      set_pairs(c, request.on, out);
    } else if (request.target == HistoryTarget::rigid) {
      out.target = c.rigid_index.at(request.on.value);
    } else {
      out.nodes = c.set(request.on).nodes;
      if (out.nodes.empty())
        throw core::InputError(request.on.mark,
                               fmt::format("set '{}' has no nodes", request.on.value));
    }
    const bool swings = has_imaginary_column(request, c.description);
    c.built.history.push_back(out);
    if (!swings) continue;
    out.name += model::imaginary_suffix;
    out.imaginary = true;
    c.built.history.push_back(std::move(out));
  }
  build_answers(c);
  const std::vector<std::string> columns = energy_columns(c.description);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    model::HistoryRequest out;
    out.name = columns[i];
    constexpr std::string_view of_energy = "energy.";
    out.quantity = columns[i].substr(columns[i].starts_with(of_energy) ? of_energy.size() : 0);
    out.kind = model::HistoryRequest::Kind::whole;
    c.built.history.push_back(std::move(out));
  }
}

namespace {

/// Nodes of the sets that a model names one by one: of springs, masses, equations.
std::vector<bool> nodes_of(const std::vector<std::string>& sets, const mesh::Mesh& mesh) {
  std::vector<bool> out(mesh.nodes.size());
  for (const std::string& name : sets)
    if (const mesh::Set* const set = mesh.find_set(name))
      for (const Index node : set->nodes) out[static_cast<std::size_t>(node)] = true;
  return out;
}

/// What sets the model names that need no cells, and those of one node: who names one means it.
std::vector<std::string> sets_without_cells(const Description& description,
                                            const mesh::Mesh& mesh) {
  std::vector<std::string> names;
  for (const mesh::Set& set : mesh.sets)
    if (set.nodes.size() == 1) names.push_back(set.name);
  const auto add = [&names](const Name& on) { names.push_back(on.value); };
  for (const Spring& spring : description.springs) {
    std::ranges::for_each(spring.between, add);
    for (const EquationTerm& term : spring.terms) add(term.on);
  }
  for (const PointMass& one : description.masses) add(one.on);
  for (const Equation* const equation : description.all_equations())
    for (const EquationTerm& term : equation->terms) add(term.on);
  for (const Pretension& pretension : description.pretension) add(pretension.name);
  for (const Rigid& rigid : description.rigid)
    if (const auto* const shape = std::get_if<SetShape>(&rigid.shape)) add(shape->set);
  return names;
}

/// By node: whether relations of the mesh (knots and ends of shells and beams) or a rigid body of
/// nodes move it together with others; empty: none.
std::vector<bool> joined_nodes(const Description& description, const mesh::Mesh& mesh) {
  std::vector<std::string> bodies;
  for (const Rigid& rigid : description.rigid)
    if (const auto* const shape = std::get_if<SetShape>(&rigid.shape))
      bodies.push_back(shape->set.value);
  if (bodies.empty() && mesh.relations.empty()) return {};
  std::vector<bool> joined = nodes_of(bodies, mesh);
  for (const mesh::Relation& relation : mesh.relations)
    for (const mesh::Relation::Term& term : relation.terms)
      joined[static_cast<std::size_t>(term.node)] = true;
  return joined;
}

/// Of the contacts that name two sets of nodes, of ties, of springs and equations that join nodes.
std::vector<mesh::ContactSides> sides_of_contacts(const Description& description,
                                                  const mesh::Mesh& mesh) {
  std::vector<mesh::ContactSides> out;
  const auto add = [&](const Name& master, const Name& slave) {
    out.push_back({nodes_of({master.value}, mesh), nodes_of({slave.value}, mesh)});
  };
  for (const Contact& contact : description.contact)
    if (!contact.all && contact.master.value != contact.slave.value)
      add(contact.master, contact.slave);
  for (const Tie& tie : description.ties) add(tie.master, tie.slave);
  if (const std::vector<bool> joined = joined_nodes(description, mesh); !joined.empty())
    out.push_back({joined, joined});
  std::vector<std::string> first, others;
  const auto add_terms = [&](const std::vector<EquationTerm>& terms) {
    for (std::size_t k = 0; k < terms.size(); ++k)
      (k == 0 ? first : others).push_back(terms[k].on.value);
  };
  for (const Spring& spring : description.springs) add_terms(spring.terms);
  for (const Equation& equation : description.equations) add_terms(equation.terms);
  if (!others.empty()) out.push_back({nodes_of(first, mesh), nodes_of(others, mesh)});
  for (const Pretension& pretension : description.pretension) {
    mesh::ContactSides& sides = out.emplace_back();
    for (std::vector<bool>& side : sides) side.resize(mesh.nodes.size());
    for (const auto& [behind, front] : cut_of(pretension, mesh).nodes) {
      sides[0][static_cast<std::size_t>(behind)] = true;
      sides[1][static_cast<std::size_t>(front)] = true;
    }
  }
  return out;
}

template <int Dim>
BasicBuilt<Dim> build_in(const Description& description, mesh::Mesh mesh) {
  BasicBuilt<Dim> built;
  built.input_notes = description.notes;
  for (const mesh::Finding& finding :
       mesh::check_mesh(mesh, sides_of_contacts(description, mesh),
                        nodes_of(sets_without_cells(description, mesh), mesh))) {
    if (finding.is_error) throw core::InputError(description.mesh.mark, finding.message);
    built.warnings.push_back(finding.message);
  }
  if (Dim == 2) check_planar(description, mesh);
  built.options = analysis_options(description.solver);
  model::BasicModel<Dim>& m = built.model;
  m.title = description.title;
  m.mesh = std::move(mesh);
  for (const Vec3& node : m.mesh.nodes) m.reference.push_back(node.head<Dim>());
  m.body_of_node.assign(m.reference.size(), -1);
  BuildContext<Dim> context{description, built, {}, {}, {}, {}, {}};
  for (const mesh::Set& set : m.mesh.sets) context.set_names.push_back(set.name);
  for (const mesh::Relation& relation : m.mesh.relations) {
    context.related.resize(m.reference.size() * Dim, false);
    for (const mesh::Relation::Term& term : relation.terms)
      if (term.direction < Dim)
        context.related[static_cast<std::size_t>(Dim * term.node + term.direction)] = true;
  }
  build_sections(context);
  build_initial_state(context);
  build_rigid(context);
  build_axes(context);
  build_masses(context);
  adjust_ties(context);
  build_contact(context);
  build_equations(context);
  build_initial_temperature(context);
  build_node_constraints(context);
  build_springs(context);
  build_body_changes(context);
  build_steps(context);
  build_pair_changes(context);
  check_removed(context);
  build_initial_velocity(context);
  warn_of_rest(context);
  build_history(context);
  check_model(context);
  choose_linear_solver(description.solver.linear, {.memory = core::memory_in_all()}, built);
  return built;
}

/// The error for a model that its builder is not made for.
void require_dimension(const Description& description, int wanted) {
  if (dimension(description) == wanted) return;
  const core::SourceMark mark = description.sections.empty()
                                    ? core::SourceMark{description.file, 0, ""}
                                    : description.sections.front().element.mark;
  throw core::InputError(mark, wanted == 2 ? "this is a model in space; a plane one is needed here"
                                           : "this is a plane model; one in space is needed here");
}

}  // namespace

Built build(const Description& description, mesh::Mesh mesh) {
  require_dimension(description, 2);
  return build_in<2>(description, std::move(mesh));
}

Built3 build3(const Description& description, mesh::Mesh mesh) {
  require_dimension(description, 3);
  return build_in<3>(description, std::move(mesh));
}

AnyBuilt build_any(const Description& description, mesh::Mesh mesh) {
  if (dimension(description) == 3) return build3(description, std::move(mesh));
  return build(description, std::move(mesh));
}

Built build_file(const std::string& path) {
  const Description description = read_model(path);
  return build(description, load_mesh(description));
}

AnyBuilt build_any_file(const std::string& path) {
  const Description description = read_model(path);
  return build_any(description, load_mesh(description));
}

}  // namespace osculate::deck

#include "osculate/deck/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::deck {
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
  return options;
}

/// Words of the model file, in the order of Quantity.
constexpr std::array<std::string_view, 16> quantity_words{
    "ux",      "uy",      "rz",           "rfx",         "rfy",          "rmz",
    "force_x", "force_y", "normal_force", "shear_force", "max_pressure", "max_penetration",
    "stick",   "slip",    "open",         "area"};

std::string_view quantity_name(Quantity q) { return quantity_words[static_cast<std::size_t>(q)]; }

void check_planar(const Description& description, const mesh::Mesh& mesh) {
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(mesh.nodes[n].z()) > 1e-12 * (1 + mesh.nodes[n].norm()))
      throw core::InputError(
          description.mesh.mark,
          fmt::format("node {} has z = {:g}; plane problems need z = 0", n + 1, mesh.nodes[n].z()));
}

}  // namespace

void build_history(BuildContext& c) {
  for (const HistoryRequest& request : c.description.output.history) {
    model::HistoryRequest out;
    out.name = request.column;
    out.quantity = std::string(quantity_name(request.of.value));
    if (request.target == HistoryTarget::contact) {
      out.kind = model::HistoryRequest::Kind::pair;
      for (std::size_t p = 0; p < c.model().pairs.size(); ++p)
        if (c.model().pairs[p].name == request.on.value) out.target = static_cast<Index>(p);
    } else if (request.target == HistoryTarget::rigid) {
      out.kind = model::HistoryRequest::Kind::rigid;
      out.target = c.rigid_index.at(request.on.value);
    } else {
      out.kind = model::HistoryRequest::Kind::nodes;
      out.nodes = c.set(request.on).nodes;
      if (out.nodes.empty())
        throw core::InputError(request.on.mark,
                               fmt::format("set '{}' has no nodes", request.on.value));
    }
    c.built.history.push_back(std::move(out));
  }
}

Built build(const Description& description, mesh::Mesh mesh) {
  Built built;
  for (const mesh::Finding& finding : mesh::check_mesh(mesh)) {
    if (finding.is_error) throw core::InputError(description.mesh.mark, finding.message);
    built.warnings.push_back(finding.message);
  }
  check_planar(description, mesh);
  built.options = analysis_options(description.solver);
  model::Model& m = built.model;
  m.title = description.title;
  m.mesh = std::move(mesh);
  for (const Vec3& node : m.mesh.nodes) m.reference.push_back(node.head<2>());
  m.body_of_node.assign(m.reference.size(), -1);
  BuildContext context{description, built, {}, {}, {}, {}, {}};
  for (const mesh::Set& set : m.mesh.sets) context.set_names.push_back(set.name);
  build_sections(context);
  build_rigid(context);
  build_contact(context);
  build_equations(context);
  build_steps(context);
  build_history(context);
  check_model(context);
  return built;
}

int dimension(const Description& description) {
  for (const Section& section : description.sections)
    if (is_space(section.element.value)) return 3;
  return 2;
}

Built3 build3(const Description& description, mesh::Mesh) {
  throw core::InputError(description.mesh.mark, "models in space are not available yet");
}

AnyBuilt build_any(const Description& description, mesh::Mesh mesh) {
  if (dimension(description) == 3) return build3(description, std::move(mesh));
  return build(description, std::move(mesh));
}

AnyBuilt build_any_file(const std::string& path) {
  const Description description = read_model(path);
  return build_any(description, load_mesh(description));
}

Built build_file(const std::string& path) {
  const Description description = read_model(path);
  return build(description, load_mesh(description));
}

}  // namespace osculate::deck

#include "osculate/api/check_facts.hpp"

#include <fmt/format.h>

#include <optional>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "osculate/core/text.hpp"
#include "osculate/material/law.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/quality.hpp"
#include "osculate/model/body_changes.hpp"
#include "osculate/model/supports.hpp"

namespace osculate::api {
namespace {

std::string line(std::string_view heading, std::string_view name, std::string_view text) {
  return fmt::format("{:<13} {:<16} {}\n", heading, name, text);
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

nlohmann::json numbers(const Vec3& v, int dimension) {
  nlohmann::json out = nlohmann::json::array();
  for (int i = 0; i < dimension; ++i) out.push_back(v[i]);
  return out;
}

// ---- mesh -------------------------------------------------------------------------------------

struct Extent {
  Vec3 low = Vec3::Constant(HUGE_VAL), high = Vec3::Constant(-HUGE_VAL);
  void add(const Vec3& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  [[nodiscard]] std::string text(int dimension) const {
    std::string out;
    for (int i = 0; i < dimension; ++i)
      out += fmt::format("{}{} {:.6g} to {:.6g}", i ? ", " : "", "xyz"[i], low[i], high[i]);
    return out;
  }
};

template <int Dim>
std::string extent_text(const deck::BasicBuilt<Dim>& built, nlohmann::json& json) {
  const mesh::Mesh& mesh = built.model.mesh;
  Extent all;
  for (const Vec3& x : mesh.nodes) all.add(x);
  if (mesh.nodes.empty()) return {};
  json["size"] = {{"low", numbers(all.low, Dim)}, {"high", numbers(all.high, Dim)}};
  return line("Size", "mesh", fmt::format("{}; {} nodes", all.text(Dim), mesh.nodes.size()));
}

/// Where Young's modulus is that of a metal or a hard plastic in Pa and the mesh longer than a
/// bridge in metres, or that of a metal or ceramics in MPa and the mesh too short for millimetres:
/// a question, as either may be meant.
template <int Dim>
std::string units_text(const model::BasicModel<Dim>& m) {
  constexpr double pascal = 1e9, megapascal = 2e4, most_megapascal = 1e6;
  constexpr double metres = 50, millimetres = 0.2;
  Extent all;
  for (const Vec<Dim>& x : m.reference) {
    Vec3 place = Vec3::Zero();
    place.head<Dim>() = x;
    all.add(place);
  }
  double young = 0;
  for (const auto& section : m.sections)
    young = std::max(young, material::unloaded(section.section.law).young);
  const double size = m.reference.empty() ? 0 : (all.high - all.low).maxCoeff();
  if (young >= pascal && size > metres)
    return line("Units", "?",
                fmt::format("E of {:.3g}, if in Pa, goes with m: {:.3g} m long? (mm go with N and "
                            "MPa)",
                            young, size));
  if (young >= megapascal && young <= most_megapascal && size > 0 && size < millimetres)
    return line("Units", "?",
                fmt::format("E of {:.3g}, if in MPa, goes with mm: {:.3g} mm long? (m go with N "
                            "and Pa)",
                            young, size));
  return {};
}

constexpr std::array<const char*, 4> set_kinds{"nodes", "lines", "areas", "volumes"};

/// Sets of one dimension: `left 4, right 4`, in lines that fit a screen. --json has all.
std::string sets_text(const mesh::Mesh& mesh, int dimension, std::size_t most_listed) {
  constexpr std::size_t width = 70;
  std::vector<std::string> rows(1);
  std::size_t count = 0;
  for (const mesh::Set& set : mesh.sets) {
    if (set.dimension != dimension || ++count > most_listed) continue;
    const std::string item =
        fmt::format("{} {}", set.name, dimension == 0 ? set.nodes.size() : set.cells.size());
    if (!rows.back().empty()) rows.back() += ",";
    if (rows.back().size() + item.size() > width) rows.emplace_back();
    if (!rows.back().empty()) rows.back() += " ";
    rows.back() += item;
  }
  if (count == 0) return {};
  if (count > most_listed) rows.back() += fmt::format(", and {} more", count - most_listed);
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += line(i == 0 ? "Sets" : "", i == 0 ? set_kinds[static_cast<std::size_t>(dimension)] : "",
                 rows[i]);
  return text;
}

nlohmann::json sets_json(const mesh::Mesh& mesh) {
  nlohmann::json out = nlohmann::json::array();
  for (const mesh::Set& set : mesh.sets)
    out.push_back({{"name", set.name},
                   {"kind", set_kinds[static_cast<std::size_t>(set.dimension)]},
                   {"cells", set.cells.size()},
                   {"nodes", set.nodes.size()}});
  return out;
}

/// A cell by its place.
std::string place_of(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  return mesh::describe_node(mesh,
                             mesh.blocks[static_cast<std::size_t>(ref.block)].cell(ref.cell)[0]);
}

template <int Dim>
std::string quality_text(const deck::BasicBuilt<Dim>& built, nlohmann::json& json) {
  const model::BasicModel<Dim>& m = built.model;
  std::string text;
  json["quality"] = nlohmann::json::array();
  for (const model::BasicBulkSection<Dim>& section : m.sections) {
    const mesh::Quality q = mesh::quality(m.mesh, section.cells);
    std::string poor = fmt::format("none below {:g}", mesh::poor_shape);
    if (q.poor > 0) poor = fmt::format("{} below {:g}", counted(q.poor, "cell"), mesh::poor_shape);
    text += line("Cell shapes", section.name,
                 fmt::format("worst {:.3g} of 1 at {}, {}; edges of a cell up to 1 : {:.3g}",
                             q.worst_shape, place_of(m.mesh, q.worst), poor, q.largest_ratio));
    json["quality"].push_back({{"section", section.name},
                               {"worst_shape", q.worst_shape},
                               {"worst_at", place_of(m.mesh, q.worst)},
                               {"poor_cells", q.poor},
                               {"largest_edge_ratio", q.largest_ratio}});
  }
  return text;
}

// ---- steps ------------------------------------------------------------------------------------

bool is_axisymmetric(const model::Model& m) {
  return std::any_of(m.sections.begin(), m.sections.end(), [](const auto& section) {
    return section.section.assumption == solid::Assumption::axisymmetric;
  });
}
bool is_axisymmetric(const model::Model3&) { return false; }

/// Round-off of sums is nothing.
double rounded(double value, double scale) { return std::abs(value) < 1e-10 * scale ? 0.0 : value; }

template <int Dim>
std::string resultant_text(const model::BasicModel<Dim>& m, const deck::Resultant& r) {
  const double force = r.force.norm();
  if (is_axisymmetric(m))
    return fmt::format("force along the axis {:.6g}, outwards {:.6g} in all (of the whole ring)",
                       rounded(r.force.y(), force), rounded(r.force.x(), force));
  std::string forces, moments;
  for (int i = 0; i < Dim; ++i)
    forces += fmt::format("{}{:.6g}", i ? ", " : "", rounded(r.force[i], force));
  double reach = 0;
  for (const Vec<Dim>& x : m.reference) reach = std::max(reach, x.norm());
  const double scale = std::max(r.moment.norm(), force * reach);
  for (int i = Dim == 2 ? 2 : 0; i < 3; ++i)
    moments += fmt::format("{}{:.6g}", moments.empty() ? "" : ", ", rounded(r.moment[i], scale));
  return fmt::format("force ({}), moment {} about the origin", forces,
                     Dim == 2 ? moments : "(" + moments + ")");
}

/// `ux = 0, uy = -0.007, times 'wave'`
std::string prescription_text(const deck::Prescription& p) {
  std::string text;
  for (std::size_t i = 0; i < deck::component_count; ++i)
    if (p.values[i])
      text += fmt::format("{}{} = {:g}", text.empty() ? "" : ", ", deck::component_names[i],
                          p.values[i]->value);
  return p.amplitude ? text + fmt::format(", times '{}'", p.amplitude->value) : text;
}

std::string release_text(const deck::Release& r) {
  std::string text;
  for (std::size_t i = 0; i < deck::component_count; ++i)
    if (r.of[i]) text += fmt::format("{}{}", text.empty() ? "" : ", ", deck::component_names[i]);
  return text;
}

/// `1 ux -2 ux of b.right = 0.5`, behind the set of the first term.
std::string equation_text(const deck::Equation& e) {
  std::string text;
  for (const deck::EquationTerm& term : e.terms) {
    const char* const of = deck::component_names[static_cast<std::size_t>(term.of)];
    text += text.empty() ? fmt::format("{:g} {}", term.factor.value, of)
                         : fmt::format(" {:+g} {} of {}", term.factor.value, of, term.on.value);
  }
  return fmt::format("{} = {:g}{}", text, e.value.value, e.for_each_node ? ", of each node" : "");
}

template <int Dim>
std::string on_text(const deck::BasicBuilt<Dim>& built, const std::string& on) {
  for (const model::BasicRigidBody<Dim>& body : built.model.rigid)
    if (body.name == on) return {};
  const mesh::Set* const set = built.model.mesh.find_set(on);
  return set ? " (" + counted(set->nodes.size(), "node") + ")" : std::string{};
}

template <int Dim>
nlohmann::json resultant_json(const deck::Resultant& r) {
  nlohmann::json out = {{"force", numbers(r.force, Dim)}};
  out["moment"] = Dim == 2 ? nlohmann::json(r.moment.z()) : numbers(r.moment, 3);
  return out;
}

}  // namespace

template <int Dim>
std::string mesh_text(const deck::BasicBuilt<Dim>& built, nlohmann::json& json) {
  std::string text = extent_text(built, json) + units_text(built.model);
  for (int dimension = 3; dimension >= 0; --dimension)  // bodies, sides; edges and corners
    text += sets_text(built.model.mesh, dimension, dimension >= Dim - 1 ? 24 : 6);
  json["sets"] = sets_json(built.model.mesh);
  return text + quality_text(built, json);
}

/// Names of contacts, with what they cannot hold.
template <int Dim>
std::vector<std::string> with_friction(const model::BasicModel<Dim>& m,
                                       std::vector<std::string> names) {
  for (std::string& name : names) {
    const auto pair = std::ranges::find(m.pairs, name, &model::BasicContactPair<Dim>::name);
    if (pair != m.pairs.end() && !pair->definition.friction &&
        !pairing::held_from_start(pair->definition))
      name += " (without friction)";
  }
  return names;
}

template <int Dim>
std::string support_text(const deck::BasicBuilt<Dim>& built, nlohmann::json& json) {
  const model::BasicModel<Dim>& m = built.model;
  std::string text;
  std::vector<std::string> last;
  json["supports"] = nlohmann::json::array();
  std::optional<model::BasicModel<Dim>> changing;
  if (!m.body_changes.empty()) changing = m;
  for (std::size_t s = 0; s < m.steps.size(); ++s) {
    if (changing) model::change_bodies(m, s, *changing);
    const std::vector<model::Support> supports =
        model::supports(changing ? *changing : m, m.steps[s]);
    if (last.size() != supports.size()) last.assign(supports.size(), {});
    for (std::size_t b = 0; b < supports.size(); ++b) {
      const model::Support& body = supports[b];
      json["supports"].push_back({{"step", m.steps[s].name},
                                  {"body", body.body},
                                  {"held", body.held},
                                  {"free", body.free},
                                  {"contact", body.contact}});
      std::string what =
          body.held == 0 ? "nothing prescribed"
          : body.rigid   ? fmt::format("{} of {} motions prescribed", body.held, body::motions<Dim>)
                         : counted(body.held, "displacement") + " prescribed";
      if (body.free.empty())
        what += "; no free motion";
      else if (body.all_free && body.free.size() > 1)
        what += "; free to move and turn";
      else
        what += "; free to " + core::join(body.free, " and ");
      if (!body.free.empty() && !body.contact.empty())
        what += ", but for " + core::join(with_friction(m, body.contact), ", ", 5);
      if (what == last[b]) continue;
      text += line(s == 0 ? "Supports" : "  then", body.body,
                   s == 0 ? what : fmt::format("in {}: {}", m.steps[s].name, what));
      last[b] = what;
    }
  }
  return text;
}

template <int Dim>
std::string step_text(const deck::Description& description, const deck::BasicBuilt<Dim>& built,
                      std::size_t step, nlohmann::json& json) {
  const deck::Step& given = description.steps[step];
  std::string text;
  for (const deck::Prescription& p : given.prescribe)
    text += line("  prescribe", p.on.value, prescription_text(p) + on_text(built, p.on.value));
  for (const deck::Release& r : given.release)
    text += line("  release", r.on.value, release_text(r) + on_text(built, r.on.value));
  if (given.frees_all_equations) text += line("  free", "all", "equations");
  for (const deck::Release& r : given.free_equations)
    text += line("  free", r.on.value, "equations of " + release_text(r));
  for (const deck::Equation& e : given.equations)
    text += line("  equation", e.terms.front().on.value, equation_text(e));
  deck::Resultant sum;
  nlohmann::json loads = nlohmann::json::array();
  for (const deck::LoadTotal& load : built.loads[step]) {
    sum.force += load.end.force;
    sum.moment += load.end.moment;
    const std::string amplitude =
        load.amplitude.empty() ? "" : fmt::format(", times '{}'", load.amplitude);
    text += line("  " + load.kind, load.on,
                 fmt::format("{}{}{}: {}", load.kept ? "as before, " : "", load.values, amplitude,
                             resultant_text(built.model, load.whole)));
    loads.push_back(resultant_json<Dim>(load.whole));
    loads.back().update(
        {{"kind", load.kind}, {"on", load.on}, {"amplitude", load.amplitude}, {"kept", load.kept}});
  }
  if (built.loads[step].size() > 1)
    text += line("  all loads", "", "at the end: " + resultant_text(built.model, sum));
  json = {{"name", given.name.value}, {"loads", loads}, {"total", resultant_json<Dim>(sum)}};
  return text;
}

template std::string mesh_text(const deck::Built&, nlohmann::json&);
template std::string mesh_text(const deck::Built3&, nlohmann::json&);
template std::string support_text(const deck::Built&, nlohmann::json&);
template std::string support_text(const deck::Built3&, nlohmann::json&);
template std::string step_text(const deck::Description&, const deck::Built&, std::size_t,
                               nlohmann::json&);
template std::string step_text(const deck::Description&, const deck::Built3&, std::size_t,
                               nlohmann::json&);

}  // namespace osculate::api

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {

const mesh::Set& BuildContext::set(const Name& on) const {
  const mesh::Set* const found = model().mesh.find_set(on.value);
  if (!found) throw unknown_set(on, set_names);
  return *found;
}

bool BuildContext::takes_part(Index node) const {
  const auto n = static_cast<std::size_t>(node);
  return (n < section_of_node.size() && section_of_node[n] >= 0) || model().body_of_node[n] >= 0;
}

core::InputError BuildContext::idle_node(const Name& on, Index node) const {
  return {on.mark, fmt::format("{} of '{}' belongs to no section and to no rigid body",
                               mesh::describe_node(model().mesh, node), on.value)};
}

solid::Section make_solid_section(const Section& s, const Material& material) {
  solid::Section out;
  switch (s.element.value) {
    case SectionElement::plane_strain:
      out.assumption = solid::Assumption::plane_strain;
      break;
    case SectionElement::plane_stress:
      out.assumption = solid::Assumption::plane_stress;
      break;
    case SectionElement::axisymmetric:
      out.assumption = solid::Assumption::axisymmetric;
      break;
    case SectionElement::solid:
    case SectionElement::solid_shell:
      throw core::InputError(s.element.mark, "the model is plane");
  }
  out.kinematics = s.kinematics.value == Kinematics::finite ? solid::Kinematics::finite
                                                            : solid::Kinematics::small;
  switch (s.formulation.value) {
    case Formulation::full:
      out.formulation = solid::Formulation::full;
      break;
    case Formulation::bbar:
      out.formulation = solid::Formulation::bbar;
      break;
    case Formulation::enhanced:
      out.formulation = solid::Formulation::enhanced;
      break;
  }
  out.thickness = s.thickness.value;
  const double young = material.young.value, poisson = material.poisson.value;
  const double density = material.density.value;
  switch (material.law.value) {
    case MaterialLaw::linear_elastic:
      out.law = material::LinearElastic{young, poisson, density};
      break;
    case MaterialLaw::st_venant_kirchhoff:
      out.law = material::StVenantKirchhoff{young, poisson, density};
      break;
    case MaterialLaw::neo_hooke:
      out.law = material::NeoHooke{young, poisson, density};
      break;
  }
  return out;
}

namespace {

geometry::Curve nurbs_curve(const NurbsShape& shape, bool flip) {
  geometry::NurbsCurve curve;
  curve.degree = shape.degree.value;
  curve.knots = shape.knots.value;
  for (const Vec3& c : shape.control.value) {
    curve.control.emplace_back(c.x(), c.y());
    curve.weights.push_back(c.z());
  }
  if (flip) {
    std::reverse(curve.control.begin(), curve.control.end());
    std::reverse(curve.weights.begin(), curve.weights.end());
    const double sum = curve.knots.front() + curve.knots.back();
    std::reverse(curve.knots.begin(), curve.knots.end());
    for (double& knot : curve.knots) knot = sum - knot;
  }
  return curve;
}

solid::Section solid_section(const BuildContext& c, const Section& s) {
  const Material* const material = [&] {
    for (const Material& m : c.description.materials)
      if (m.name.value == s.material.value) return &m;
    throw core::InputError(s.material.mark, fmt::format("unknown material '{}'", s.material.value));
  }();
  return make_solid_section(s, *material);
}

void check_cell(const BuildContext& c, const Section& s, const model::BulkSection& section,
                const mesh::CellRef& ref) {
  const mesh::Block& block = c.model().mesh.blocks[static_cast<std::size_t>(ref.block)];
  const cell::CellInfo& info = cell::info(block.type);
  const std::string_view reason = solid::unsupported(section.section, block.type);
  if (!reason.empty())
    throw core::InputError(s.formulation.mark,
                           fmt::format("set '{}' has {} cells: {}", s.on.value, info.name, reason));
  const double jacobian = model::smallest_jacobian(c.model(), ref);
  if (!(jacobian > 0))
    throw core::InputError(
        s.on.mark,
        fmt::format(
            "{} cell {} of set '{}' has a negative or zero volume (smallest Jacobian {:.3g}); "
            "number its nodes counter-clockwise",
            info.name, ref.cell + 1, s.on.value, jacobian));
  if (section.section.assumption != solid::Assumption::axisymmetric) return;
  for (int k = 0; k < info.nodes; ++k) {
    const Index node = block.cell(ref.cell)[k];
    const Vec3& x = c.model().mesh.nodes[static_cast<std::size_t>(node)];
    if (x.x() < -1e-12 * x.norm())
      throw core::InputError(
          s.element.mark,
          fmt::format("{} of set '{}' has a negative radius; an axisymmetric body needs x >= 0",
                      mesh::describe_node(c.model().mesh, node), s.on.value));
  }
}

void check_mixture(const BuildContext& c, const Section& s, const model::BulkSection& section) {
  for (const model::BulkSection& other : c.model().sections)
    if ((other.section.assumption == solid::Assumption::axisymmetric) !=
        (section.section.assumption == solid::Assumption::axisymmetric))
      throw core::InputError(
          s.element.mark,
          fmt::format("'{}' and '{}': axisymmetric and plane sections exclude each other",
                      other.name, section.name));
}

}  // namespace

void build_sections(BuildContext& c) {
  model::Model& m = c.model();
  c.section_of_node.assign(m.mesh.nodes.size(), -1);
  for (const Section& s : c.description.sections) {
    const mesh::Set& set = c.set(s.on);
    if (set.dimension != 2 || set.cells.empty())
      throw core::InputError(
          s.on.mark,
          fmt::format("set '{}' has no area cells, so it cannot be a section", s.on.value));
    model::BulkSection section;
    section.name = s.on.value;
    section.section = solid_section(c, s);
    section.cells = set.cells;
    check_mixture(c, s, section);
    const auto index = static_cast<Index>(m.sections.size());
    for (const mesh::CellRef& ref : section.cells) {
      const auto [at, fresh] = c.section_of_cell.emplace(std::pair(ref.block, ref.cell), index);
      if (!fresh)
        throw core::InputError(
            s.on.mark,
            fmt::format("cells of set '{}' already belong to the section on '{}'", s.on.value,
                        at->second == index
                            ? section.name
                            : m.sections[static_cast<std::size_t>(at->second)].name));
      check_cell(c, s, section, ref);
      const mesh::Block& block = m.mesh.blocks[static_cast<std::size_t>(ref.block)];
      for (int k = 0; k < cell::info(block.type).nodes; ++k) {
        Index& slot = c.section_of_node[static_cast<std::size_t>(block.cell(ref.cell)[k])];
        if (slot < 0) slot = index;
      }
    }
    m.sections.push_back(std::move(section));
  }
  std::vector<mesh::CellRef> cells;
  for (const auto& entry : c.section_of_cell)
    cells.push_back({entry.first.first, entry.first.second});
  c.edges = mesh::edge_table(m.mesh, cells);
}

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Analytic curve of a rigid body; nothing for meshed sets and polylines.
std::optional<geometry::Curve> analytic_curve(const Rigid& rigid) {
  const double side = rigid.flip ? -1.0 : 1.0;
  if (const auto* s = std::get_if<CircleShape>(&rigid.shape))
    return geometry::Circle{s->center, s->radius.value, s->inside != rigid.flip};
  if (const auto* s = std::get_if<ArcShape>(&rigid.shape))
    return geometry::Arc{s->center, s->radius.value, radians(s->from.value), radians(s->to.value),
                         s->inside != rigid.flip};
  if (const auto* s = std::get_if<HalfPlaneShape>(&rigid.shape))
    return geometry::InfiniteLine{s->point, side * s->normal};
  if (const auto* s = std::get_if<NurbsShape>(&rigid.shape)) return nurbs_curve(*s, rigid.flip);
  return std::nullopt;
}

Vec2 shape_center(const Rigid& rigid, const std::vector<Vec2>& points) {
  if (const auto* s = std::get_if<CircleShape>(&rigid.shape)) return s->center;
  if (const auto* s = std::get_if<ArcShape>(&rigid.shape)) return s->center;
  if (const auto* s = std::get_if<HalfPlaneShape>(&rigid.shape)) return s->point;
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : points) sum += p;
  return points.empty() ? sum : Vec2(sum / static_cast<double>(points.size()));
}

Index add_node(model::Model& m, const Vec2& x, Index body) {
  m.reference.push_back(x);
  m.body_of_node.push_back(body);
  return static_cast<Index>(m.reference.size()) - 1;
}

void add_meshed(BuildContext& c, const Rigid& rigid, const SetShape& shape, Index index,
                model::RigidBody& body) {
  model::Model& m = c.model();
  const mesh::Set& set = c.set(shape.set);
  if (set.nodes.empty())
    throw core::InputError(shape.set.mark, fmt::format("set '{}' has no nodes", shape.set.value));
  for (const Index node : set.nodes) {
    Index& owner = m.body_of_node[static_cast<std::size_t>(node)];
    if (owner >= 0)
      throw core::InputError(
          rigid.name.mark,
          fmt::format("rigid bodies '{}' and '{}' share a node",
                      m.rigid[static_cast<std::size_t>(owner)].name, rigid.name.value));
    owner = index;
    body.nodes.push_back(node);
  }
}

}  // namespace

void build_rigid(BuildContext& c) {
  model::Model& m = c.model();
  for (const Rigid& rigid : c.description.rigid) {
    model::RigidBody body;
    body.name = rigid.name.value;
    const auto index = static_cast<Index>(m.rigid.size());
    if (m.mesh.find_set(body.name))
      throw core::InputError(rigid.name.mark,
                             fmt::format("rigid body '{}' has the name of a set of the "
                                         "mesh; choose another",
                                         body.name));
    if (const auto* s = std::get_if<SetShape>(&rigid.shape)) add_meshed(c, rigid, *s, index, body);
    if (const auto* s = std::get_if<PolylineShape>(&rigid.shape)) {
      body.polyline = s->points.value;
      if (rigid.flip) std::reverse(body.polyline.begin(), body.polyline.end());
      for (const Vec2& p : body.polyline) body.nodes.push_back(add_node(m, p, index));
    }
    body.shape = analytic_curve(rigid);
    if (body.shape) {
      const std::string wrong = geometry::validate(*body.shape);
      if (!wrong.empty()) throw core::InputError(rigid.name.mark, wrong);
      for (const Vec2& tip : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)})
        body.nodes.push_back(add_node(m, tip, index));
    }
    std::vector<Vec2> points;
    for (const Index n : body.nodes) points.push_back(m.reference[static_cast<std::size_t>(n)]);
    body.reference = rigid.reference ? rigid.reference->value : shape_center(rigid, points);
    c.rigid_index.emplace(body.name, index);
    m.rigid.push_back(std::move(body));
  }
}

}  // namespace osculate::deck

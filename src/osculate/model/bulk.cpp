#include "osculate/model/bulk.hpp"

#include <fmt/format.h>

#include "osculate/mesh/check.hpp"
#include "osculate/solid/stress_stiffness.hpp"

namespace osculate::model {
namespace {

template <class Vector>
std::vector<double> to_vector(const Vector& v) {
  return {v.begin(), v.end()};
}

}  // namespace

template <int Dim>
void set_dofs(std::span<const Index> nodes, BasicBulkBlock<Dim>& out) {
  out.dof_count = Dim * static_cast<int>(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int i = 0; i < Dim; ++i)
      out.dofs[Dim * k + static_cast<std::size_t>(i)] = Dim * nodes[k] + i;
}

CellNodes cell_nodes(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  return {block.type,
          {block.cell(ref.cell), static_cast<std::size_t>(cell::info(block.type).nodes)}};
}

template <int Dim>
solid::Coordinates<Dim> reference_of(const BasicModel<Dim>& model, std::span<const Index> nodes) {
  solid::Coordinates<Dim> x(static_cast<Eigen::Index>(nodes.size()), Dim);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    x.row(static_cast<Eigen::Index>(k)) =
        model.reference[static_cast<std::size_t>(nodes[k])].transpose();
  return x;
}

template <int Dim>
solid::Coordinates<Dim> displacement_of(const Eigen::VectorXd& u, std::span<const Index> nodes) {
  solid::Coordinates<Dim> d(static_cast<Eigen::Index>(nodes.size()), Dim);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    d.row(static_cast<Eigen::Index>(k)) = u.segment<Dim>(Dim * nodes[k]).transpose();
  return d;
}

template <int Dim>
CellPlaces<Dim> places_of(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                          std::span<const Index> nodes, const Eigen::VectorXd& u,
                          const material::Memory& memory) {
  CellPlaces<Dim> out{reference_of(model, nodes), displacement_of<Dim>(u, nodes)};
  if (!memory.origin) return out;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::RowMajor>;
  const Eigen::Map<const Rows> origin(memory.origin, out.reference.rows(), Dim);
  out.displacement -= origin;
  if (section.section.kinematics == solid::Kinematics::finite) out.reference += origin;
  return out;
}

namespace {
/// Whether cells of a type have the formulation of their section (docs/decisions/064).
template <int Dim>
bool has_formulation(const BasicBulkSection<Dim>& section, cell::CellType type) {
  if (!solid::unsupported(section.section, type).empty()) return false;
  if (!section.by_default || section.section.formulation != solid::Formulation::bbar) return true;
  return cell::info(type).order == 1 || solid::volume_terms<Dim>(type) > 1;
}
}  // namespace

template <int Dim>
solid::Section<Dim> section_on(const BasicBulkSection<Dim>& section, cell::CellType type) {
  solid::Section<Dim> own = section.section;
  if (!has_formulation(section, type)) own.formulation = {};
  return own;
}

template <int Dim>
void evaluate_cell(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                   const mesh::CellRef& ref, const Eigen::VectorXd& u,
                   const material::Memory& memory, bool with_tangent, BasicBulkBlock<Dim>& out) {
  const CellNodes cell = cell_nodes(model.mesh, ref);
  set_dofs(cell.nodes, out);
  const CellPlaces<Dim> at = places_of(model, section, cell.nodes, u, memory);
  const auto evaluate = [&](const solid::Section<Dim>& own) {
    solid::evaluate(own, cell.type, at.reference, at.displacement, with_tangent, out.result,
                    memory);
  };
  if (has_formulation(section, cell.type))
    evaluate(section.section);  // no copy of the law
  else
    evaluate(section_on(section, cell.type));
  out.ok = out.result.status == solid::Status::ok;
  if (out.ok) return;
  const bool inverted = out.result.status == solid::Status::inverted;
  out.message = fmt::format(
      "{} cell {} of '{}' {}", cell::info(cell.type).name, mesh::cell_number(model.mesh, ref),
      section.name, inverted ? "turned inside out" : "has a strain its material cannot answer");
  if (const std::string why = inverted ? "" : material::complaint(section.section.law);
      !why.empty())
    out.message += ": " + why;
}

template <int Dim>
void stressed_cell(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                   const mesh::CellRef& ref, const Eigen::VectorXd& u,
                   const material::Memory& memory, const Eigen::VectorXd* less,
                   const material::Memory& memory_of_less, BasicBulkBlock<Dim>& out) {
  const CellNodes cell = cell_nodes(model.mesh, ref);
  set_dofs(cell.nodes, out);
  const solid::Section<Dim> own = section_on(section, cell.type);
  const solid::Coordinates<Dim> x = reference_of(model, cell.nodes);
  const auto stress_at = [&](const Eigen::VectorXd& of, const material::Memory& with) {
    return solid::stress_at_points(
        own, cell.type, x, places_of(model, section, cell.nodes, of, with).displacement, with);
  };
  solid::CellStress<Dim> stress = stress_at(u, memory);
  const auto points = static_cast<std::size_t>(stress.count);
  if (less) {
    const solid::CellStress<Dim> before = stress_at(*less, memory_of_less);
    for (std::size_t q = 0; q < points; ++q) stress.point[q].stress -= before.point[q].stress;
  }
  out.ok = false;
  for (std::size_t q = 0; q < points; ++q) out.ok = out.ok || !stress.point[q].stress.isZero(0);
  if (out.ok) out.result.tangent = solid::stress_stiffness(own, cell.type, x, stress);
}

template <int Dim>
void pressure_block(const BasicModel<Dim>& model, const PressureLoad::Facet& facet,
                    const Eigen::VectorXd& u, double pressure, BasicBulkBlock<Dim>& out) {
  set_dofs(std::span<const Index>(facet.nodes), out);
  const solid::Section<Dim>& section =
      model.sections[static_cast<std::size_t>(facet.section)].section;
  const auto side = solid::side_pressure(section, facet.type, reference_of(model, facet.nodes),
                                         displacement_of<Dim>(u, facet.nodes), pressure);
  out.result.force = side.force;
  out.result.tangent = side.tangent;
}

template <int Dim>
void centrifugal_block(const BasicModel<Dim>& model, const CentrifugalLoad& load,
                       const CentrifugalLoad::Cell& cell, const Eigen::VectorXd* u,
                       BasicBulkBlock<Dim>& out) {
  const std::span<const Index> nodes(cell.nodes);
  set_dofs(nodes, out);
  const Mat<3, 3> across = Mat<3, 3>::Identity() - load.axis * load.axis.transpose();
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::Matrix<double, Dim, Eigen::Dynamic, 0, Dim, solid::max_nodes<Dim>> arms(Dim, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Index node = nodes[static_cast<std::size_t>(j)];
    Vec3 arm = -load.point;
    arm.head<Dim>() += model.reference[static_cast<std::size_t>(node)];
    if (u) arm.head<Dim>() += u->template segment<Dim>(Dim * node);
    arms.col(j) = (across * arm).template head<Dim>();
  }
  out.result.force.resize(Dim * n);
  for (Eigen::Index i = 0; i < n; ++i)
    out.result.force.template segment<Dim>(Dim * i) = arms * cell.mass.col(i);
  if (!u) return;
  out.result.tangent.resize(Dim * n, Dim * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      out.result.tangent.template block<Dim, Dim>(Dim * i, Dim * j) =
          cell.mass(i, j) * across.topLeftCorner<Dim, Dim>();
}

template <int Dim>
std::vector<double> cell_weights(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                                 const mesh::CellRef& ref) {
  const CellNodes cell = cell_nodes(model.mesh, ref);
  return to_vector(
      solid::volume_weights(section.section, cell.type, reference_of(model, cell.nodes)));
}

template <int Dim>
std::vector<double> side_weights(const BasicModel<Dim>& model, const solid::Section<Dim>& section,
                                 cell::CellType type, std::span<const Index> nodes) {
  return to_vector(solid::side_weights(section, type, reference_of(model, nodes)));
}

template <int Dim>
double smallest_jacobian(const BasicModel<Dim>& model, const mesh::CellRef& ref) {
  const CellNodes cell = cell_nodes(model.mesh, ref);
  return solid::smallest_jacobian<Dim>(cell.type, reference_of(model, cell.nodes),
                                       mesh::is_collapsed(model.mesh, ref));
}

template <int Dim>
BasicDofSpace<Dim> dof_space(const BasicModel<Dim>& model) {
  std::vector<bool> used(model.reference.size(), false);
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (std::size_t i = 0; i < section.cells.size(); ++i)
      if (!is_removed(section, i))
        for (const Index node : cell_nodes(model.mesh, section.cells[i]).nodes)
          used[static_cast<std::size_t>(node)] = true;
  std::vector<Dof> also_used;
  for (const Spring& spring : model.springs) {
    for (const Index node : spring.ends)
      if (node >= 0) used[static_cast<std::size_t>(node)] = true;
    for (const Equation::Term& term : spring.terms)
      if (term.dof < Dim * static_cast<Dof>(used.size())) also_used.push_back(term.dof);
  }
  for (const PointMass& point : model.masses) used[static_cast<std::size_t>(point.node)] = true;
  std::vector<Index> bodies = model.body_of_node;
  if (bodies.empty()) bodies.assign(model.reference.size(), -1);
  return {static_cast<Index>(model.reference.size()),
          std::move(bodies),
          static_cast<Index>(model.rigid.size()),
          model.equations,
          used,
          also_used};
}

template void set_dofs(std::span<const Index>, BulkBlock&);
template void set_dofs(std::span<const Index>, BulkBlock3&);
template DofSpace dof_space(const Model&);
template DofSpace3 dof_space(const Model3&);
template solid::Coordinates<2> reference_of(const Model&, std::span<const Index>);
template solid::Coordinates<3> reference_of(const Model3&, std::span<const Index>);
template solid::Coordinates<2> displacement_of<2>(const Eigen::VectorXd&, std::span<const Index>);
template solid::Coordinates<3> displacement_of<3>(const Eigen::VectorXd&, std::span<const Index>);
template CellPlaces<2> places_of(const Model&, const BulkSection&, std::span<const Index>,
                                 const Eigen::VectorXd&, const material::Memory&);
template CellPlaces<3> places_of(const Model3&, const BulkSection3&, std::span<const Index>,
                                 const Eigen::VectorXd&, const material::Memory&);
template solid::Section<2> section_on(const BulkSection&, cell::CellType);
template solid::Section<3> section_on(const BulkSection3&, cell::CellType);
template void evaluate_cell(const Model&, const BulkSection&, const mesh::CellRef&,
                            const Eigen::VectorXd&, const material::Memory&, bool, BulkBlock&);
template void evaluate_cell(const Model3&, const BulkSection3&, const mesh::CellRef&,
                            const Eigen::VectorXd&, const material::Memory&, bool, BulkBlock3&);
template void stressed_cell(const Model&, const BulkSection&, const mesh::CellRef&,
                            const Eigen::VectorXd&, const material::Memory&, const Eigen::VectorXd*,
                            const material::Memory&, BulkBlock&);
template void stressed_cell(const Model3&, const BulkSection3&, const mesh::CellRef&,
                            const Eigen::VectorXd&, const material::Memory&, const Eigen::VectorXd*,
                            const material::Memory&, BulkBlock3&);
template void pressure_block(const Model&, const PressureLoad::Facet&, const Eigen::VectorXd&,
                             double, BulkBlock&);
template void pressure_block(const Model3&, const PressureLoad::Facet&, const Eigen::VectorXd&,
                             double, BulkBlock3&);
template void centrifugal_block(const Model&, const CentrifugalLoad&, const CentrifugalLoad::Cell&,
                                const Eigen::VectorXd*, BulkBlock&);
template void centrifugal_block(const Model3&, const CentrifugalLoad&, const CentrifugalLoad::Cell&,
                                const Eigen::VectorXd*, BulkBlock3&);
template std::vector<double> cell_weights(const Model&, const BulkSection&, const mesh::CellRef&);
template std::vector<double> cell_weights(const Model3&, const BulkSection3&, const mesh::CellRef&);
template std::vector<double> side_weights(const Model&, const solid::Section<2>&, cell::CellType,
                                          std::span<const Index>);
template std::vector<double> side_weights(const Model3&, const solid::Section<3>&, cell::CellType,
                                          std::span<const Index>);
template double smallest_jacobian(const Model&, const mesh::CellRef&);
template double smallest_jacobian(const Model3&, const mesh::CellRef&);

}  // namespace osculate::model

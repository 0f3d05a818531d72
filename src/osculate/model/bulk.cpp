#include "osculate/model/bulk.hpp"

#include <fmt/format.h>

namespace osculate::model {
namespace {

void set_dofs(std::span<const Index> nodes, BulkBlock& out) {
  out.dof_count = static_cast<int>(2 * nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    out.dofs[2 * k] = 2 * nodes[k];
    out.dofs[2 * k + 1] = 2 * nodes[k] + 1;
  }
}

std::vector<double> to_vector(const solid::ElementVector& v) { return {v.begin(), v.end()}; }

}  // namespace

CellNodes cell_nodes(const Model& model, const mesh::CellRef& ref) {
  const mesh::Block& block = model.mesh.blocks[static_cast<std::size_t>(ref.block)];
  return {block.type,
          {block.cell(ref.cell), static_cast<std::size_t>(cell::info(block.type).nodes)}};
}

solid::Coordinates reference_of(const Model& model, std::span<const Index> nodes) {
  solid::Coordinates x(static_cast<Eigen::Index>(nodes.size()), 2);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    x.row(static_cast<Eigen::Index>(k)) =
        model.reference[static_cast<std::size_t>(nodes[k])].transpose();
  return x;
}

solid::Coordinates displacement_of(const Eigen::VectorXd& u, std::span<const Index> nodes) {
  solid::Coordinates d(static_cast<Eigen::Index>(nodes.size()), 2);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    d.row(static_cast<Eigen::Index>(k)) = u.segment<2>(2 * nodes[k]).transpose();
  return d;
}

void evaluate_cell(const Model& model, const BulkSection& section, const mesh::CellRef& ref,
                   const Eigen::VectorXd& u, bool with_tangent, BulkBlock& out) {
  const CellNodes cell = cell_nodes(model, ref);
  set_dofs(cell.nodes, out);
  solid::evaluate(section.section, cell.type, reference_of(model, cell.nodes),
                  displacement_of(u, cell.nodes), with_tangent, out.result);
  out.ok = out.result.status == solid::Status::ok;
  if (out.ok) return;
  out.message = fmt::format(
      "{} cell {} of '{}' {}", cell::info(cell.type).name, ref.cell + 1, section.name,
      out.result.status == solid::Status::inverted ? "turned inside out"
                                                   : "has a strain its material cannot answer");
}

void pressure_block(const Model& model, const solid::Section& section, std::span<const Index> nodes,
                    const Eigen::VectorXd& u, double pressure, BulkBlock& out) {
  set_dofs(nodes, out);
  solid::PressureResult result = solid::edge_pressure(section, reference_of(model, nodes),
                                                      displacement_of(u, nodes), pressure);
  out.result.force = result.force;
  out.result.tangent = result.tangent;
}

std::vector<double> cell_weights(const Model& model, const BulkSection& section,
                                 const mesh::CellRef& ref) {
  const CellNodes cell = cell_nodes(model, ref);
  return to_vector(
      solid::volume_weights(section.section, cell.type, reference_of(model, cell.nodes)));
}

std::vector<double> edge_weights(const Model& model, const solid::Section& section,
                                 std::span<const Index> nodes) {
  return to_vector(solid::edge_weights(section, reference_of(model, nodes)));
}

double smallest_jacobian(const Model& model, const mesh::CellRef& ref) {
  const CellNodes cell = cell_nodes(model, ref);
  return solid::smallest_jacobian(cell.type, reference_of(model, cell.nodes));
}

}  // namespace osculate::model

#include "osculate/model/inertia.hpp"

#include <cmath>

#include "osculate/model/material_memory.hpp"
#include "osculate/solid/mass.hpp"

namespace osculate::model {

template <int Dim>
BasicInertia<Dim>::BasicInertia(const BasicModel<Dim>& model, bool lumped)
    : nodes_(static_cast<Index>(model.reference.size())) {
  for (const BasicBulkSection<Dim>& section : model.sections) {
    for (std::size_t i = 0; i < section.cells.size(); ++i) {
      const double density = is_removed(section, i) ? 0 : material::density(section.section.law);
      const CellNodes cell = cell_nodes(model.mesh, section.cells[i]);
      const solid::NodeMass unit =
          solid::consistent_mass(section.section, cell.type, reference_of(model, cell.nodes));
      cells_.push_back({{cell.nodes.begin(), cell.nodes.end()},
                        density * (lumped ? solid::lumped_mass(unit) : unit)});
    }
  }
  for (const PointMass& point : model.masses)
    cells_.push_back({{point.node}, Eigen::MatrixXd::Constant(1, 1, point.mass)});
  for (const BasicRigidBody<Dim>& body : model.rigid) bodies_.push_back({body.mass, body.inertia});
}

template <int Dim>
Mat<body::motions<Dim>, body::motions<Dim>> BasicInertia<Dim>::body_mass(std::size_t body) const {
  Mat<body::motions<Dim>, body::motions<Dim>> m =
      Mat<body::motions<Dim>, body::motions<Dim>>::Zero();
  m.diagonal().template head<Dim>().setConstant(bodies_[body].mass);
  if constexpr (Dim == 2) m(2, 2) = bodies_[body].inertia(0, 0);
  return m;
}

template <int Dim>
Eigen::VectorXd BasicInertia<Dim>::multiply(const Eigen::VectorXd& w) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(w.size());
  for (const CellMass& cell : cells_)
    for (std::size_t i = 0; i < cell.nodes.size(); ++i)
      for (std::size_t j = 0; j < cell.nodes.size(); ++j)
        out.template segment<Dim>(Dim * cell.nodes[i]) +=
            cell.mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
            w.template segment<Dim>(Dim * cell.nodes[j]);
  constexpr int motions = body::motions<Dim>;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Eigen::Index first = Dim * nodes_ + motions * static_cast<Eigen::Index>(b);
    out.template segment<motions>(first) += body_mass(b) * w.template segment<motions>(first);
  }
  return out;
}

template <int Dim>
Eigen::VectorXd BasicInertia<Dim>::times(const Vec<Dim>& acceleration) const {
  constexpr int motions = body::motions<Dim>;
  const auto bodies = static_cast<Eigen::Index>(bodies_.size());
  Eigen::VectorXd w = Eigen::VectorXd::Zero(Dim * nodes_ + motions * bodies);
  for (Eigen::Index n = 0; n < nodes_; ++n) w.template segment<Dim>(Dim * n) = acceleration;
  for (Eigen::Index b = 0; b < bodies; ++b)
    w.template segment<Dim>(Dim * nodes_ + motions * b) = acceleration;
  return multiply(w);
}

template <int Dim>
double BasicInertia<Dim>::size() const {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(nodes_);
  for (const CellMass& cell : cells_)
    for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      diagonal[cell.nodes[i]] += cell.mass(k, k);
    }
  double sum = diagonal.squaredNorm();
  for (const Body& body : bodies_) sum += body.mass * body.mass;
  return std::sqrt(Dim * sum);
}

template <int Dim>
double BasicInertia<Dim>::total() const {
  double sum = 0;
  for (const CellMass& cell : cells_) sum += cell.mass.sum();
  for (const Body& body : bodies_) sum += body.mass;
  return sum;
}

template <int Dim>
void CellInertia<Dim>::add_to(std::size_t cell, Eigen::Ref<Eigen::MatrixXd> tangent) const {
  tangent *= stiffness;
  if (!damped.empty()) tangent += damping * damped[cell];
  const Eigen::MatrixXd& of_cell = inertia.cells()[cell].mass;
  for (Eigen::Index i = 0; i < of_cell.rows(); ++i)
    for (Eigen::Index j = 0; j < of_cell.cols(); ++j)
      for (int d = 0; d < Dim; ++d) tangent(Dim * i + d, Dim * j + d) += mass * of_cell(i, j);
}

template <int Dim>
solid::CellEnergy energy_of_cell(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                                 const mesh::CellRef& ref, const CellMemory& where,
                                 const Eigen::VectorXd& u, std::span<const double> memory) {
  if (where.removed) return {};
  const CellNodes cell = cell_nodes(model.mesh, ref);
  const material::Memory of = where.of(memory);
  const CellPlaces<Dim> at = places_of(model, section, cell.nodes, u, of);
  return solid::cell_energy(section_on(section, cell.type), cell.type, at.reference,
                            at.displacement, of);
}

template <int Dim>
solid::CellEnergy bulk_energy(const BasicModel<Dim>& model, const Eigen::VectorXd& u,
                              std::span<const double> memory) {
  solid::CellEnergy sum;
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
    const solid::CellEnergy of_cell = energy_of_cell(model, section, ref, m, u, memory);
    sum.stored += of_cell.stored;
    sum.dissipated += of_cell.dissipated;
  });
  return sum;
}

template solid::CellEnergy energy_of_cell(const Model&, const BulkSection&, const mesh::CellRef&,
                                          const CellMemory&, const Eigen::VectorXd&,
                                          std::span<const double>);
template solid::CellEnergy energy_of_cell(const Model3&, const BulkSection3&, const mesh::CellRef&,
                                          const CellMemory&, const Eigen::VectorXd&,
                                          std::span<const double>);
template struct CellInertia<2>;
template struct CellInertia<3>;
template class BasicInertia<2>;
template class BasicInertia<3>;
template solid::CellEnergy bulk_energy(const Model&, const Eigen::VectorXd&,
                                       std::span<const double>);
template solid::CellEnergy bulk_energy(const Model3&, const Eigen::VectorXd&,
                                       std::span<const double>);

}  // namespace osculate::model

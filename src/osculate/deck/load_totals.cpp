#include "osculate/deck/load_totals.hpp"

#include <Eigen/Geometry>

#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

template <int Dim>
Vec3 in_space(const Vec<Dim>& v) {
  Vec3 out = Vec3::Zero();
  out.template head<Dim>() = v;
  return out;
}

void add(Resultant& sum, const Vec3& force, const Vec3& at) {
  sum.force += force;
  sum.moment += at.cross(force);
}

template <int Dim>
void add_dof(const model::BasicModel<Dim>& m, model::Dof dof, double value, Resultant& sum) {
  constexpr int motions = body::motions<Dim>;
  const auto node_dofs = Dim * static_cast<model::Dof>(m.reference.size());
  Vec3 part = Vec3::Zero();
  if (dof < node_dofs) {
    part[dof % Dim] = value;
    add(sum, part, in_space<Dim>(m.reference[static_cast<std::size_t>(dof / Dim)]));
    return;
  }
  const auto body = static_cast<std::size_t>((dof - node_dofs) / motions);
  const int motion = (dof - node_dofs) % motions;
  if (motion < Dim) {
    part[motion] = value;
    add(sum, part, in_space<Dim>(m.rigid[body].reference));
  } else {
    sum.moment[Dim == 2 ? 2 : motion - Dim] += value;
  }
}

}  // namespace

template <int Dim>
Resultant resultant(const model::BasicModel<Dim>& m,
                    const std::vector<std::pair<model::Dof, double>>& unit) {
  Resultant sum;
  for (const auto& [dof, value] : unit) add_dof(m, dof, value, sum);
  return sum;
}

template <int Dim>
Resultant resultant(const model::BasicModel<Dim>& m,
                    const std::vector<model::PressureLoad::Facet>& facets) {
  Resultant sum;
  const Eigen::VectorXd u =
      Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(m.reference.size()));
  for (const model::PressureLoad::Facet& facet : facets) {
    model::BasicBulkBlock<Dim> block;
    model::pressure_block(m, facet, u, 1.0, block);
    for (int i = 0; i < block.dof_count; ++i)
      add_dof(m, block.dofs[static_cast<std::size_t>(i)], block.result.force[i], sum);
  }
  return sum;
}

template <int Dim>
Masses masses(const model::BasicModel<Dim>& m) {
  Masses sum;
  const auto add_mass = [&sum](double mass, const Vec<Dim>& at) {
    sum.mass += mass;
    sum.moment += mass * in_space<Dim>(at);
  };
  for (const model::BasicBulkSection<Dim>& section : m.sections) {
    const double density = material::density(section.section.law);
    if (density == 0) continue;
    for (const mesh::CellRef& ref : section.cells) {
      const std::vector<double> shares = model::cell_weights(m, section, ref);
      const std::span<const Index> nodes = model::cell_nodes(m.mesh, ref).nodes;
      for (std::size_t k = 0; k < shares.size(); ++k)
        add_mass(density * shares[k], m.reference[static_cast<std::size_t>(nodes[k])]);
    }
  }
  for (const model::PointMass& point : m.masses)
    add_mass(point.mass, m.reference[static_cast<std::size_t>(point.node)]);
  for (const model::BasicRigidBody<Dim>& body : m.rigid) add_mass(body.mass, body.reference);
  return sum;
}

Resultant weight(const Masses& masses, const Vec3& acceleration) {
  return {masses.mass * acceleration, masses.moment.cross(acceleration)};
}

template Resultant resultant(const model::Model&,
                             const std::vector<std::pair<model::Dof, double>>&);
template Resultant resultant(const model::Model3&,
                             const std::vector<std::pair<model::Dof, double>>&);
template Resultant resultant(const model::Model&, const std::vector<model::PressureLoad::Facet>&);
template Resultant resultant(const model::Model3&, const std::vector<model::PressureLoad::Facet>&);
template Masses masses(const model::Model&);
template Masses masses(const model::Model3&);

}  // namespace osculate::deck

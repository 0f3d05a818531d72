#include "osculate/result/answer_sums.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "osculate/model/bulk.hpp"

namespace osculate::result {
namespace {

template <int Dim>
Vec3 with_z(const Vec<Dim>& v) {
  Vec3 out = Vec3::Zero();
  out.head<Dim>() = v;
  return out;
}

std::array<double, 3> numbers(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// Place, normal and area of facets, weighted by the area.
struct Geometry {
  Vec3 place = Vec3::Zero(), normal = Vec3::Zero();
  double area = 0;
};

template <int Dim>
void add_facet(const model::BasicModel<Dim>& m, const model::PressureLoad::Facet& facet,
               const Eigen::VectorXd& u, Geometry& sum) {
  const solid::Section<Dim>& section = m.sections[static_cast<std::size_t>(facet.section)].section;
  const solid::Coordinates<Dim> x =
      model::reference_of(m, std::span<const Index>(facet.nodes)) +
      model::displacement_of<Dim>(u, std::span<const Index>(facet.nodes));
  const auto weights = solid::side_weights(section, facet.type, x);
  const solid::Coordinates<Dim> still = solid::Coordinates<Dim>::Zero(x.rows(), Dim);
  const auto pressed = solid::side_pressure(section, facet.type, x, still, 1.0);
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    sum.place += weights[k] * with_z<Dim>(x.row(k).transpose());
    sum.area += weights[k];
    sum.normal -= with_z<Dim>(pressed.force.template segment<Dim>(Dim * k));
  }
}

}  // namespace

template <int Dim>
io::DatResultant resultant_through(const AnswerModel<Dim>& answers,
                                   const model::BasicModel<Dim>& running,
                                   const model::BasicState<Dim>& state,
                                   const std::vector<deck::CutFacet>& facets) {
  const model::BasicModel<Dim>& m = answers.model;
  const bool moves = std::ranges::any_of(m.sections, [](const auto& section) {
    return section.section.kinematics == solid::Kinematics::finite;
  });
  const Eigen::VectorXd u = moves ? state.u : Eigen::VectorXd::Zero(state.u.size());
  Geometry geometry;
  std::map<std::size_t, std::vector<Index>> nodes_of_place;
  for (const deck::CutFacet& facet : facets) {
    add_facet(m, facet.side, u, geometry);
    auto& nodes = nodes_of_place[answers.place_of.at({facet.cell.block, facet.cell.cell})];
    nodes.insert(nodes.end(), facet.side.nodes.begin(), facet.side.nodes.end());
  }
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  model::BasicBulkBlock<Dim> block;
  for (const auto& [at, nodes] : nodes_of_place) {
    const auto [section, memory] = answers.place_in(running, at);
    if (memory.removed) continue;
    const mesh::CellRef& cell = answers.mesh.cells[at].ref;
    model::evaluate_cell(m, *section, cell, state.u, memory.of(state.memory), false, block);
    if (!block.ok) continue;
    const std::span<const Index> own = model::cell_nodes(m.mesh, cell).nodes;
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (std::ranges::find(nodes, own[k]) == nodes.end()) continue;
      const Vec3 f =
          with_z<Dim>(block.result.force.template segment<Dim>(Dim * static_cast<Eigen::Index>(k)));
      const Vec<Dim> x =
          m.reference[static_cast<std::size_t>(own[k])] + u.template segment<Dim>(Dim * own[k]);
      force += answers.sector * f;
      moment += answers.sector * with_z<Dim>(x).cross(f);
    }
  }
  io::DatResultant out;
  const Vec3 centre = geometry.place / geometry.area, normal = geometry.normal.normalized();
  const Vec3 about_centre = moment - centre.cross(force);
  out.force = numbers(force);
  out.moment = numbers(moment);
  out.centre = numbers(centre);
  out.normal = numbers(normal);
  out.moment_about_centre = numbers(about_centre);
  out.area = answers.sector * geometry.area;
  out.normal_force = force.dot(normal);
  out.shear_force = (force - out.normal_force * normal).norm();
  out.torque = about_centre.dot(normal);
  out.bending_moment = (about_centre - out.torque * normal).norm();
  return out;
}

template <int Dim>
ContactEnergies contact_energies(const model::BasicSystem<Dim>& system,
                                 const model::BasicModel<Dim>& model) {
  ContactEnergies sum;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const auto& slave = model.pairs[p].definition.slave;
    const auto& points = system.contact()[p].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double energy = points[i].weight * points[i].stored;
      sum.total += energy;
      if (i >= slave.points.size() || points[i].status == contact::Status::open) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(slave.points[i].count); ++k)
        sum.of_nodes[slave.points[i].nodes[k]] += slave.points[i].shape[k] * energy;
    }
  }
  return sum;
}

template io::DatResultant resultant_through(const AnswerModel<2>&, const model::Model&,
                                            const model::State&,
                                            const std::vector<deck::CutFacet>&);
template io::DatResultant resultant_through(const AnswerModel<3>&, const model::Model3&,
                                            const model::State3&,
                                            const std::vector<deck::CutFacet>&);
template ContactEnergies contact_energies(const model::System&, const model::Model&);
template ContactEnergies contact_energies(const model::System3&, const model::Model3&);

}  // namespace osculate::result

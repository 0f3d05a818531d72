#include "beam.hpp"

#include <cmath>

namespace osculate::verification {
namespace {

/// Returns the bottom faces, seen from below.
std::vector<pairing::SurfaceFacet> add_beam(Builder3& b, bool quadratic, int elements) {
  const double step = beam_length / elements;
  std::vector<pairing::SurfaceFacet> bottom;
  for (int e = 0; e < elements; ++e) {
    const auto at = [&](const Vec2& xi, double z) {
      return b.node({(e + 0.5 + 0.5 * xi.x()) * step, 0.5 * beam_width * (1 + xi.y()), z});
    };
    const cell::CellType face = quadratic ? cell::CellType::quad9 : cell::CellType::quad4;
    std::vector<Index> nodes;
    for (const double z : {0.0, beam_height})
      for (int k = 0; k < cell::info(face).nodes; ++k)
        nodes.push_back(at(cell::area_node(face, k), z));
    b.cell(quadratic ? cell::CellType::shell18 : cell::CellType::hex8, nodes, 0);
    // the bottom face seen from below: corners 0 3 2 1, so edges 3 2 1 0
    constexpr std::array<std::size_t, 9> below{0, 3, 2, 1, 7, 6, 5, 4, 8};
    std::vector<Index> turned;
    for (std::size_t k = 0; k < static_cast<std::size_t>(cell::info(face).nodes); ++k)
      turned.push_back(nodes[below[k]]);
    bottom.push_back(pairing::surface_facet(face, turned));
  }
  return bottom;
}

/// Rigid body 0.
pairing::FacetSurface add_cylinder(Builder3& b, const BeamModel& o) {
  pairing::FacetSurface ring;
  const auto at = [&](int k, double y) {
    const double angle = o.from + (o.to - o.from) * k / o.chords;
    return b.node({0.5 * beam_length + cylinder_radius * std::sin(angle), y,
                   -cylinder_radius + cylinder_radius * std::cos(angle)},
                  0);
  };
  for (int k = 0; k < o.chords; ++k)
    ring.facets.push_back(pairing::surface_facet(
        cell::CellType::quad4,
        std::array<Index, 4>{at(k, 0), at(k + 1, 0), at(k + 1, beam_width), at(k, beam_width)}));
  model::RigidBody3 body;
  body.name = "cylinder";
  body.reference = {0.5 * beam_length, 0.5 * beam_width, -cylinder_radius};
  for (std::size_t n = 0; n < b.model.reference.size(); ++n)
    if (b.model.body_of_node[n] == 0) body.nodes.push_back(static_cast<Index>(n));
  b.model.rigid.push_back(std::move(body));
  return ring;
}

model::Step bend(const Builder3& b, int increments) {
  model::Step step;
  step.name = "bend";
  step.increments = increments;
  for (std::size_t n = 0; n < b.model.reference.size(); ++n) {
    if (b.model.body_of_node[n] >= 0) continue;
    const Vec3& x = b.model.reference[n];
    const auto node = static_cast<Index>(n);
    if (x.x() == 0) Builder3::fix(step, node);
    if (std::abs(x.x() - beam_length) < 1e-9 && x.z() == 0)
      step.prescribed.push_back({3 * node + 2, {0, -tip_pull, {}}, false});
  }
  b.hold(step, 0);
  return step;
}

}  // namespace

model::Model3 beam_model(const BeamModel& o) {
  Builder3 b;
  b.model.title = "Beam bent over a rigid cylinder";
  model::BulkSection3 section;
  section.name = "beam";
  section.section = {solid::Kinematics::finite, solid::Formulation::solid_shell,
                     material::StVenantKirchhoff{beam_modulus, o.poisson, 0}};
  b.model.sections.push_back(section);
  model::ContactPair3 pair;
  pair.name = "contact";
  pairing::FacetSurface beam;
  beam.facets = add_beam(b, o.quadratic, o.elements);
  pairing::FacetSurface cylinder = add_cylinder(b, o);
  if (o.cylinder_master) std::swap(beam, cylinder);
  pairing::connect(beam);
  pairing::connect(cylinder);
  pair.definition.master = std::move(beam);
  pair.definition.slave = pairing::make_slave_side(std::move(cylinder));
  pair.definition.normal = contact::penalty(o.penalty);
  pair.definition.tangent = o.tangent;
  pairing::prepare(pair.definition, b.model.reference);
  b.model.pairs.push_back(std::move(pair));
  b.model.steps.push_back(bend(b, o.increments));
  return std::move(b.model);
}

}  // namespace osculate::verification

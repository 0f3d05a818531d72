#pragma once
// One contact constraint, whatever it was sampled by; for sources of this layer (pair.hpp is the
// entry).
//
//   sampler -> ContactSample -> respond -> report, block
//
// Slave nodes and quadrature points (point_sample), edge-edge contacts (pair_edge_contacts), mortar
// nodes (mortar_node), re-entrant vertices (reentrant_vertex) and ties (tie) are samplers: each
// says where its sample is and how its gap and slip depend on the nodes. Law, enforcement and
// active set (response.hpp), history and report (report.hpp), forces and tangent (point_block.hpp)
// are the same for all.
#include "osculate/contact/point_terms.hpp"
#include "osculate/pairing/elastic_predictor.hpp"

namespace osculate::pairing {

/// One place where contact is tested, in the configuration of an evaluation.
///
/// Sign       gap < 0 is penetration, the normal points out of the master
template <int Dim>
struct ContactSample {
  // The key of its history: where on the master it is.
  Index facet = -1;
  projection::Feature feature = projection::Feature::none;
  Vec<Dim - 1> xi = Vec<Dim - 1>::Zero();
  double gap = 0;  ///< between the surfaces, before offset
  Vec<Dim> foot = Vec<Dim>::Zero(), normal = Vec<Dim>::UnitY();
  Mat<Dim, Dim - 1> frame = Mat<Dim, Dim - 1>::Zero();  ///< perpendicular to the normal
};

/// What law, enforcement and active set answer at a sample.
template <int Dim>
struct Response {
  contact::Traction<Dim> traction;           ///< of the branch that is linearised
  contact::TangentialResponse<Dim> law{};    ///< what the law says
  Vec<Dim - 1> slip = Vec<Dim - 1>::Zero();  ///< of the increment, times the contact time fraction
  double slid = 0;                           ///< distance, in the increment
  contact::LawMemory memory{};               ///< of the friction law, for the next increment
  double dissipated = 0;                     ///< per area (or per node) in the increment
  double stored = 0;                         ///< by the spring of the shear, per area (or node)
  bool has_shear = false;                    ///< else it slides without friction
  [[nodiscard]] bool branched() const {
    return has_shear && law.traction != traction.tangential.traction;
  }
};

}  // namespace osculate::pairing

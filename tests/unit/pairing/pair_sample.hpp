#pragma once
// Small contact pairs with every branch within reach, in the plane and in space, for derivative and
// identity tests.
#include <Eigen/Core>

#include "osculate/cell/shape.hpp"
#include "osculate/contact/law/law.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::testing {

/// A pair and a configuration; `x` holds all node positions.
template <int Dim>
struct ContactSample {
  pairing::PairDefinition<Dim> pair;
  std::vector<Vec<Dim>> x;
  pairing::PairState<Dim> committed;
};
using PairSample = ContactSample<2>;
using PairSample3 = ContactSample<3>;

Eigen::VectorXd flatten(const std::vector<Vec2>& x);
Eigen::VectorXd flatten(const std::vector<Vec3>& x);
template <int Dim>
std::vector<Vec<Dim>> unflatten(const Eigen::VectorXd& v);

/// Sum of the forces of all blocks over the nodes, of the first `size` unknowns.
template <int Dim>
Eigen::VectorXd assembled_force(const pairing::PairEvaluation<Dim>& e, Eigen::Index size);

/// Assembled dense tangent, rank-one terms included.
template <int Dim>
Eigen::MatrixXd assembled_tangent(const pairing::PairEvaluation<Dim>& e, Eigen::Index size);

template <int Dim>
pairing::PairEvaluation<Dim> pair_evaluation(const ContactSample<Dim>& s, const Eigen::VectorXd& v,
                                             bool tangent = false);
template <int Dim>
Eigen::VectorXd pair_residual(const ContactSample<Dim>& s, const Eigen::VectorXd& v);
template <int Dim>
Eigen::MatrixXd pair_tangent(const ContactSample<Dim>& s, const Eigen::VectorXd& v);

/// Of every point.
template <int Dim>
std::vector<contact::Status> pair_status(const ContactSample<Dim>& s, const Eigen::VectorXd& v);

struct PointFacts {
  contact::Status status;
  projection::Feature feature;
  Index facet;
  bool operator==(const PointFacts&) const = default;
};
/// Of every point; open points have no feature.
template <int Dim>
std::vector<PointFacts> pair_facts(const ContactSample<Dim>& s, const Eigen::VectorXd& v);

/// A history by its scalars.
contact::PointHistory<2> remembered(bool active, Index facet, projection::Feature feature,
                                    double xi, double gap, double traction, bool slipping = false);
contact::PointHistory<3> remembered(Index facet, const Vec2& xi, double gap, const Vec2& traction,
                                    bool active = true);

/// Adds the places as nodes of a slave of one facet (line2 or quad4), with the normal penalty 1000.
template <int Dim>
void add_sample_slave(ContactSample<Dim>& s, const std::vector<Vec<Dim>>& places);

/// Makes the last node the slave: one point of weight 1 with the normal penalty 1000.
template <int Dim>
void make_last_node_slave(ContactSample<Dim>& s);

/// Joined line2 facets through nodes 0, 1, ... of that number.
pairing::Chain line_through(std::size_t nodes);

/// A chain of `facets` Lagrange facets with `nodes_per_facet` nodes from (0, 0) along +x, facet
/// lengths alternating 1 : 3, bent by `bend` and turned by `angle`; the slave is a short line2
/// facet whose first node lies `depth` (positive = penetration) under the facet `at`, xi = `xi`.
struct SampleOptions {
  int nodes_per_facet = 2;
  int facets = 3;
  double bend = 0.0;
  double angle = 0.3;
  int at = 1;
  double xi = 0.2;
  double depth = 0.05;
};
PairSample make_sample(const SampleOptions& o);

/// A strip of facets from x = 0 along +x, lengths 1 : 3 : 1 (two triangles each for triangles),
/// width 2, pushed out of the plane by `height`. Slave: one quad4 facet whose first node lies
/// `depth` under the place `at`, `xi`.
struct SampleOptions3 {
  cell::CellType type = cell::CellType::quad4;
  double bend = 0.0;  ///< curvature and warp of the surface
  Index at = 1;
  Vec2 xi{0.2, -0.3};
  double depth = 0.05;
  double kink = 0.0;  ///< slope that starts at x = 4
};
PairSample3 make_sample3(const SampleOptions3& o);

double sample_height(const SampleOptions3& o, double x, double y);

/// Adds a facet over the parallelogram (or triangle) origin + xi edge_1 + eta edge_2.
void add_sample_facet(PairSample3& s, const SampleOptions3& o, const Vec2& origin,
                      const Vec2& first, const Vec2& second);

}  // namespace osculate::testing

#pragma once
// The traction of a slave point in a concave edge of the master, with its derivatives; for sources
// of this layer.
#include "osculate/pairing/reentrant_edge_place.hpp"
#include "osculate/pairing/response.hpp"

namespace osculate::pairing {

/// What the friction of both facets answers along an edge, and its derivatives by the elastic
/// predictor and by the normal tractions.
struct EdgeFriction {
  bool slides = false;
  double value = 0, d_predictor = 1;
  std::array<double, 2> d_normal{};
};

/// The law of both facets: they slide by the same way, so that each is given what the other leaves
/// of the elastic predictor.
///
/// Formula    t = t_1 + t_2 ,  t_i = law(t_tr - t_j, N_i) ; Coulomb: |t| <= mu (|N_1| + |N_2|)
/// Tested by  tests/unit/pairing/test_reentrant_edge.cpp
[[nodiscard]] EdgeFriction friction_of_both(const contact::FrictionLaw& law, double predictor,
                                            const std::array<double, 2>& normal,
                                            const contact::Sliding& sliding);

/// The way along the edge since the last converged state.
///
/// Formula    (t + t_o) . (e(s) - r_o) / (1 + t . t_o): the length of the way also over the
///            end of a straight edge to the next one; r_o on a facet: t_o = t
struct EdgeWay {
  bool known = false;
  std::optional<EdgeLocation> from;  ///< the point was in an edge there
  Vec3 chord = Vec3::Zero();         ///< e(s) - r_o
  Vec3 last = Vec3::Zero();          ///< derivative of the last edge there, run as the present one
  bool turned = false;               ///< that edge is run the other way round
  double along = 0, across = 0;
};
[[nodiscard]] EdgeWay way_along(const PairDefinition<3>& pair, const EdgePlace& place,
                                const contact::PointHistory<3>& history, Points<3> x);

/// N_1, N_2 of the part of a traction across the edge, N_1 n_1 + N_2 n_2.
[[nodiscard]] std::array<double, 2> normal_parts(const EdgePlace& place, const Vec3& traction);

/// What of a multiplier has a meaning without friction: it is indifferent along the edge, and has
/// no component along the axis in space that is nearest to the edge.
[[nodiscard]] Vec3 edge_axis(const EdgePlace& place);

/// Traction at a place of an edge. Forces are sum_a w^(a) f[a], the constraint is `constraint`
/// times the area. Variables are v_b = sum_k w^(b)_k du_k, the slots
///   0: x - e, 1: e', and with friction 2, 3 and 4, 5: r_1, r_2 of both facets, without: 2: e''
/// at fixed coordinates, then the multiplier.
struct EdgeTraction {
  contact::Status status = contact::Status::stick;    ///< of the law
  bool slides = false;                                ///< the branch that is linearised
  Vec3 lawful = Vec3::Zero();                         ///< T of the law
  std::array<Vec3, 2> f{Vec3::Zero(), Vec3::Zero()};  ///< f[0] = T of the branch
  Vec3 constraint = Vec3::Zero(), branch_constraint = Vec3::Zero();
  EdgeWay way{};
  double slid = 0, dissipated = 0;
  // Derivatives.
  std::array<std::array<Mat<3, 3>, 6>, 2> of_slot{};  ///< of f
  std::array<Mat<3, 3>, 6> constraint_of_slot{};
  std::array<Mat<3, 3>, 2> of_multiplier{};  ///< of f
  Mat<3, 3> constraint_of_multiplier = Mat<3, 3>::Zero();
  std::array<Vec3, 6> d_place{};  ///< ds
  // Of what lies behind the point: dT = of_way d(along), by e - r_o and by the last edge.
  Vec3 of_way = Vec3::Zero(), way_of_chord = Vec3::Zero(), way_of_last = Vec3::Zero();
};

/// Formula    with friction T = (I - t t^T) Y + t_law t , Y = Lambda + eps_T (x - e),
///            t_tr = Lambda . t + eps_T way ; constraint T - Lambda.
///            Without: T = Y - e' (e' . Lambda) / g , f_1 = -(e' . Lambda) (x - e) / g,
///            g = e'^2 - e'' . (x - e), constraint eps_T (x - e) - a (a . Lambda): the derivatives
///            of Lambda . (x - e) + eps_T (x - e)^2 / 2 - (a . Lambda)^2 / (2 eps_T), a = edge_axis
/// Source     docs/decisions/029-valleys.md
/// Tested by  tests/unit/pairing/test_reentrant_edge.cpp (order 2 in every branch)
[[nodiscard]] EdgeTraction edge_traction(const PairDefinition<3>& pair, const EdgePlace& place,
                                         const Vec3& point, const Vec3& multiplier, double spring,
                                         const contact::PointHistory<3>& history,
                                         const PointContext<3>& context, Points<3> x);

}  // namespace osculate::pairing

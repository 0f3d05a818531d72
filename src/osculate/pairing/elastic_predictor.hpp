#pragma once
#include <span>
#include <vector>

#include "osculate/contact/history.hpp"
#include "osculate/pairing/projected_point.hpp"

namespace osculate::pairing {

/// Part of the increment that a point which was open at its start has spent in contact, assuming
/// a constant approach velocity, and its derivative with respect to the gap.
struct ContactTimeFraction {
  double value = 1, d_gap = 0;
};

/// How the traction of the last increment comes to the present place.
///   continuous  along the way over all borders, its length kept
///   chord       by the straight line between the places, projected on the present tangent: short
///               by the cosine of the angle over a kink; in the plane the covariant component of
///               the traction is kept over borders, wrong by the ratio of the facets' lengths
///   per_facet   by the difference of the convective coordinates, as if there was one facet only:
///               a jump at every border
/// The last two are what is printed, and are there to be compared with.
enum class HistoryRule : std::uint8_t { continuous, chord, per_facet };

/// Elastic predictor of the friction law, t_tr = (t of the last increment, carried to the present
/// place) + eps_T (slip of the increment), and its derivative as a vector in space.
template <int Dim>
struct ElasticPredictor {
  bool known = false;                         ///< the way from the last place is known
  Vec<Dim - 1> value = Vec<Dim - 1>::Zero();  ///< in `Kinematics::frame`
  Vec<Dim - 1> slip = Vec<Dim - 1>::Zero();   ///< of the increment, there
  contact::VectorForm<Dim> variation;         ///< by the motion of the point on the master
};

/// Derivatives of a trial by nodes behind the point; `scratch` is working space.
template <int Dim>
struct PathBuffers {
  std::vector<NodeMatrix<Dim>> path;
  std::vector<NodeGradient<Dim>> scratch;
};

/// In the plane the slip is the arc length over all borders and t keeps its size (minimal
/// rotation).
///
/// Formula    t_tr = t + eps_T share s ,  d(t_tr tau) = eps_T (share ds + s d(share)) tau + t_tr
///            d(tau) ;
///            chord: t_tr = T / sqrt(a11) + eps_T share (rho - rho_o) . tau, T stored as it was ;
///            per_facet, on another facet: s = sqrt(a11) (xi - xi_o)
/// Source     KS2D:89 with the length of T kept across borders (docs/errata.md); within one facet
///            of constant metric KS2D:74 and, after KS2D:81, the moved centre of KS2D:82; as
///            printed: KS2D:88, 89 (chord) and KS2D:84, 85 (per_facet)
/// Returns    `path->path` (if given) is extended by d(t_tr) of nodes behind the point
/// Tested by  tests/unit/pairing/test_pair_tangent.cpp, test_pair_history.cpp,
///            test_history_rules.cpp
[[nodiscard]] ElasticPredictor<2> elastic_predictor(
    const Chain& master, const contact::PointHistory<2>& history,
    const ProjectedPoint<2>& projected, double stiffness, const ContactTimeFraction& time_fraction,
    std::span<const Vec2> x, PathBuffers<2>* path, HistoryRule rule = HistoryRule::continuous);

/// In space the slip is the chord between the last place (on the present nodes) and the present
/// one, and t the frame components of the last increment on the present nodes; both are carried by
/// the minimal rotation of the normals.
///
/// Formula    t_tr = G q ,  q = E_o t + eps_T share (rho - rho_o) ,
///            G = I - (n_o + n) n^T / (1 + n_o . n)
///            which is the minimal rotation n_o -> n for vectors perpendicular to n_o, and for a
///            chord over the edge between two flat facets the length of the way over it, exactly;
///            on curved facets the error is of second order in the angle between the normals ;
///            chord: the same q projected, G = I - n n^T ;
///            per_facet, on another facet: q = E t + eps_T share rho_,j (xi^j - xi_o^j)
/// Source     docs/errata.md (3D transport; KS2D:89 in space)
/// Returns    as above; no trial when the places are on different pieces of the master, or the
///            normals are opposite
/// Tested by  tests/unit/pairing/test_pair3_tangent.cpp, test_pair3_identities.cpp,
///            test_history_rules.cpp
[[nodiscard]] ElasticPredictor<3> elastic_predictor(
    const FacetSurface& master, const contact::PointHistory<3>& history,
    const ProjectedPoint<3>& projected, double stiffness, const ContactTimeFraction& time_fraction,
    std::span<const Vec3> x, PathBuffers<3>* path, HistoryRule rule = HistoryRule::continuous);

/// Components of the shear `t` (in `Kinematics::frame`) in the frame of the facet that the history
/// is kept in: the same on faces; from edges and vertices by the minimal rotation to the facet. By
/// the chord in the plane it is the covariant component sqrt(a11) t.
[[nodiscard]] Vec<1> stored_components(const Chain& master, const ProjectedPoint<2>& projected,
                                       const Vec<1>& t, std::span<const Vec2> x,
                                       HistoryRule rule = HistoryRule::continuous);
[[nodiscard]] Vec2 stored_components(const FacetSurface& master, const ProjectedPoint<3>& projected,
                                     const Vec2& t, std::span<const Vec3> x,
                                     HistoryRule rule = HistoryRule::continuous);

/// That frame: columns are unit vectors in space.
[[nodiscard]] Mat<2, 1> stored_frame(const Chain& master, Index facet, const Vec<1>& xi,
                                     std::span<const Vec2> x);
[[nodiscard]] Mat<3, 2> stored_frame(const FacetSurface& master, Index facet, const Vec2& xi,
                                     std::span<const Vec3> x);

}  // namespace osculate::pairing

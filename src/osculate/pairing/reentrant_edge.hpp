#pragma once
// A slave point with unknown tractions in a concave edge of a meshed master in space; for sources
// of this layer. What is the same in the plane is said in reentrant_vertex.hpp.
#include "osculate/pairing/point_context.hpp"
#include "osculate/pairing/reentrant_edge_place.hpp"

namespace osculate::pairing {

/// Whether a point in contact was held in a re-entrant edge at the end of the last increment.
[[nodiscard]] bool rests_in_reentrant_edge(const PairDefinition<3>& pair,
                                           const contact::PointHistory<3>& history);

/// What becomes of a point near a re-entrant edge. In it the multiplier is the whole traction as in
/// a re-entrant vertex, and the point is tied to the closest place of the edge; along the edge it
/// slides as both facets' friction lets it (`edge_traction`). It comes from a facet, from outside
/// and leaves as in the plane; beyond the end of the edge, where no other one goes on within 60
/// degrees, it is where it is projected.
///
/// Formula    held while for both facets not: T leads away from the edge into facet i, and its law
///            lets it slide, given N_i = T . n_i and the shear T - N_i n_i. In the increment in
///            which the point has slid to the edge along facet i, held only while that facet does
///            not hold it before
/// Source     docs/decisions/029-valleys.md
/// Returns    the place in the edge that holds the point; `context.multiplier` becomes `taken`: the
///            same traction as the state that is found takes it, and `projected` its place
/// Tested by  tests/unit/pairing/test_reentrant_edge.cpp
[[nodiscard]] std::optional<EdgePlace> find_reentrant_edge(
    const PairDefinition<3>& pair, Points<3> x, const contact::PointHistory<3>& history,
    std::size_t i, const PairEvaluation<3>& work, contact::Multiplier<3>& taken,
    PointContext<3>& context, ProjectedPoint<3>& projected);

/// Fills `out.points[i]` and `out.blocks[i]` of a point that is held in a re-entrant edge.
///
/// Sign       T is the traction on the residual (as N n + t), the force on the point is -T
/// Returns    N and t are reported along the bisector of the normals, and along and across the
/// edge;
///            the gap is the lesser one of both facets
/// Tested by  tests/unit/pairing/test_reentrant_edge.cpp
void evaluate_reentrant_edge(const PairDefinition<3>& pair, Points<3> x,
                             const contact::PointHistory<3>& history, const EdgePlace& place,
                             const PointContext<3>& context, bool with_tangent, std::size_t i,
                             PairEvaluation<3>& out);

/// The branch in which a point is predicted that was held in a re-entrant edge.
[[nodiscard]] ActiveBranch<3> predicted_in_edge(const PairDefinition<3>& pair,
                                                const contact::PointHistory<3>& history,
                                                Points<3> x, Prediction friction);

}  // namespace osculate::pairing

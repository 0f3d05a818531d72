#pragma once
#include <optional>
#include <string>

#include "osculate/contact/history.hpp"
#include "osculate/contact/point_terms.hpp"
#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// What the traction law's result is multiplied by.
enum class Weight : std::uint8_t { node, reference_area, current_area };

/// One contact pair: one entry per axis (sampling: the slave's nodes; target: the master chain;
/// law; enforcement: penalty), plus the forms of residual and tangent.
struct PairDefinition {
  Chain master;
  SlaveSide slave;
  contact::NormalPenalty normal;
  std::optional<contact::Coulomb> friction;
  Weight weight = Weight::reference_area;
  contact::ResidualForm residual = contact::ResidualForm::surface;
  contact::TangentForm tangent;
  AreaRule area;
  double depth = std::numeric_limits<double>::infinity();  ///< deeper points are not in contact
  std::vector<double> reference_areas;                     ///< filled by `prepare`
};

/// Committed history of a pair, one entry per slave node.
struct PairState {
  std::vector<contact::PointHistory> points;
};

/// Result of one contact point, for output and for the next history.
struct PointResult {
  contact::Status status = contact::Status::open;
  contact::PointHistory history;  ///< trial
  double gap = 0;                 ///< zeta; +inf when no place of the master was found
  double normal_traction = 0;     ///< N <= 0
  double shear_traction = 0;      ///< t
  contact::Branch branch = contact::Branch::none;  ///< the tangent belongs to
  double weight = 1;                               ///< 1 or the area the traction acts on
  double slip_increment = 0;                       ///< along the master
  Vec2 foot{0, 0}, normal{0, 1}, unit_tangent{1, 0};
};

inline constexpr int max_block_nodes = 1 + cell::max_line_nodes;
using BlockVector = Vec<2 * max_block_nodes>;
using BlockMatrix = Mat<2 * max_block_nodes, 2 * max_block_nodes>;

/// Forces and tangent of one contact point. Row 2k + i belongs to node k, direction i; only the
/// first 2 * count rows and columns are used. The forces are ADDED to the internal forces.
/// `path` and `area` are rank-one terms: dR = path_rows * sum path . dx + area_rows * sum area .
/// dx.
struct ContactBlock {
  int count = 0;
  std::array<Index, max_block_nodes> nodes{};
  BlockVector force;
  BlockVector branch_force;  ///< force of the linearised branch; equals `force` unless `branched`
  bool branched = false;
  BlockMatrix tangent;
  BlockVector path_rows, area_rows;
  std::vector<NodeGradient> path, area;
  [[nodiscard]] bool active() const { return count > 0; }
};

/// Buffers of one evaluation; reused, so that the point loop allocates nothing after the first
/// call.
struct PairEvaluation {
  std::vector<PointResult> points;
  std::vector<ContactBlock> blocks;  ///< one per point, `count == 0` where open
  std::vector<double> areas;
  std::vector<std::vector<NodeGradient>> area_gradients;
  std::vector<Vec2> normals;
  std::vector<search::Box<2>> boxes;
  Tree tree;
};

/// Fills the reference areas from the reference coordinates. Throws core::GeometryError when area
/// weights are asked for and a slave node has no facet or a non-positive area.
void prepare(PairDefinition& pair, std::span<const Vec2> reference);

/// Projection of all points in configuration `x`: the state before the first increment
/// (KS2D Table 1, step 1: the convective coordinate of points in contact from the start).
[[nodiscard]] PairState initial_state(const PairDefinition& pair, std::span<const Vec2> x);

/// Branches of the friction law in the last iteration, one per point. A point that has slipped one
/// way and now would slip the other way has jumped over its narrow sticking range: it is linearised
/// in the stick branch (without limit), from where it finds its side (primal-dual active set).
/// Plain return mapping jumps back and forth there for ever.
struct Assumed {
  std::vector<contact::Branch> branch;
  bool predict = false;  ///< first iteration: points that slipped go on slipping
};

/// Branches at the end of the last increment.
[[nodiscard]] Assumed committed_branches(const PairState& committed);
/// Branches of an evaluation, for the next iteration.
[[nodiscard]] Assumed evaluated_branches(const PairEvaluation& evaluation);

/// One evaluation of all points of the pair: search, projection, kinematics, tractions from the
/// committed history, residual and (if asked) tangent.
///
/// Source     KS2D Tables 1 and 2 with docs/errata.md
/// Tested by  tests/unit/pairing/test_pair_tangent.cpp, test_pair_history.cpp
void evaluate(const PairDefinition& pair, std::span<const Vec2> x, const PairState& committed,
              bool with_tangent, PairEvaluation& out, const Assumed& assumed = {});

/// The trial history of an accepted evaluation. A point that opens forgets.
[[nodiscard]] PairState commit(const PairEvaluation& evaluation);

}  // namespace osculate::pairing

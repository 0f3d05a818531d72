#pragma once
#include <functional>
#include <optional>
#include <string>
#include <type_traits>

#include "osculate/contact/history.hpp"
#include "osculate/contact/law/law.hpp"
#include "osculate/contact/multiplier.hpp"
#include "osculate/contact/point_terms.hpp"
#include "osculate/core/crew.hpp"
#include "osculate/core/prediction.hpp"
#include "osculate/core/ranks.hpp"
#include "osculate/pairing/axes.hpp"
#include "osculate/pairing/candidate_filter.hpp"
#include "osculate/pairing/constraint.hpp"
#include "osculate/pairing/elastic_predictor.hpp"
#include "osculate/pairing/mortar_buffers.hpp"
#include "osculate/pairing/projected_point.hpp"
#include "osculate/pairing/relative_stiffness.hpp"
#include "osculate/pairing/same_way.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// Positions of all nodes. (No template argument is deduced from it: any range of points will do.)
template <int Dim>
using Points = std::type_identity_t<std::span<const Vec<Dim>>>;

/// What the traction law's result is multiplied by.
enum class Weight : std::uint8_t { node, reference_area, current_area };

/// Initial penetrations: they act from the beginning, they are let in over the first step, or they
/// never count: the gap is measured from them. `given`: every gap begins with the same clearance,
/// whatever it is in the mesh.
enum class InitialOverlap : std::uint8_t { acts, ramped, kept, given };

/// One contact pair: a choice on each of the four axes, the forms of residual and tangent, and what
/// the two sides of it are. Everything here is the same in the plane and in space.
template <int Dim>
struct PairDefinition {
  // Sampling: the slave with its points, and how they are used.
  SlaveSide<Dim> slave;
  Sampler<Dim> sampler{};
  Weight weight = Weight::reference_area;
  AreaRule area;
  std::vector<double> reference_areas;  ///< of the slave's points; filled by `prepare`

  // Target: what each facet of the master is, and which of them a point may touch. With
  // `candidate filter.own` both sides of a contact are slaves, and each carries half of the
  // traction.
  Boundary<Dim> master;
  CandidateFilter<Dim> filter;
  double pass_factor = 1;  ///< of the traction that this pass carries (two passes: 1/2 each)
  double depth = std::numeric_limits<double>::infinity();  ///< deeper points are not in contact

  // Law.
  contact::NormalLaw normal;
  std::optional<contact::FrictionLaw> friction;
  std::optional<contact::DampingLaw> damping;  ///< by penalty, where points may part
  Separation<Dim> separation{};
  /// Factors of the penalties of both laws, one per slave point; empty: all 1. Only a NormalPenalty
  /// has one in the normal direction. Read by point_penalty.hpp.
  std::vector<RelativeStiffness> relative_stiffness{};
  double offset = 0;  ///< half thicknesses of master and slave: the laws see the gap less this
  InitialOverlap overlap = InitialOverlap::acts;
  double clearance = 0;  ///< of InitialOverlap::given; negative: an overlap

  // Enforcement.
  Enforcement enforcement{};

  // Forms of the papers.
  contact::ResidualForm residual = contact::ResidualForm::surface;
  contact::TangentForm tangent;
  HistoryRule history = HistoryRule::continuous;
};

/// Edges of a pair that is sampled where they cross, too; otherwise null.
template <int Dim>
[[nodiscard]] const EdgeContact* edges_of(const PairDefinition<Dim>& pair) {
  return std::get_if<AtEdgesToo>(&pair.sampler);
}
template <int Dim>
[[nodiscard]] bool by_mortar(const PairDefinition<Dim>& pair) {
  return is<ByMortar<Dim>>(pair.sampler);
}
/// Points are tied, and do not slide.
template <int Dim>
[[nodiscard]] bool is_tied(const PairDefinition<Dim>& pair) {
  return is<Tied<Dim>>(pair.separation);
}
/// Points are held that were near the master at the start; no others come into contact.
template <int Dim>
[[nodiscard]] bool held_from_start(const PairDefinition<Dim>& pair) {
  return is_tied(pair) || is<TiedNormal>(pair.separation);
}
template <int Dim>
[[nodiscard]] bool by_multipliers(const PairDefinition<Dim>& pair) {
  return is<ByMultipliers>(pair.enforcement);
}
/// Tractions by multipliers, and points that corners of the master hold by them.
template <int Dim>
[[nodiscard]] bool has_reentrant_vertices(const PairDefinition<Dim>& pair) {
  const auto* const unknown = std::get_if<ByMultipliers>(&pair.enforcement);
  return unknown && unknown->reentrant_vertices;
}

/// Committed history of a pair: one entry per slave point, then one per edge-edge contact.
template <int Dim>
struct PairState {
  std::vector<contact::PointHistory<Dim>> points;
  std::vector<MortarPlace> places;  ///< mortar: one per slave node; empty at first
  /// Gaps of the slave's points at the beginning which do not count: overlaps, or what is more than
  /// the clearance; empty where they act from then on.
  std::vector<double> overlap;
};

/// Multipliers of a pair in an iteration: one per slave point; none where penalties are enough.
template <int Dim>
struct PairMultipliers {
  std::vector<contact::Multiplier<Dim>> points;
  /// Factor of the pair's penalties (augmented Lagrangian), or of a normal penalty that the program
  /// has chosen and found too soft.
  double stiffening = 1;
  /// Largest gap or elastic slip of the last correction of the multipliers; how fast it falls tells
  /// whether the penalties are stiff enough.
  double violation = std::numeric_limits<double>::infinity();
};

/// The branch of the friction law a point is linearised in; of a slipping point also where to.
template <int Dim>
struct ActiveBranch {
  contact::Branch branch = contact::Branch::none;
  Vec<Dim> direction = Vec<Dim>::Zero();  ///< unit vector of the shear traction while slipping
  std::array<Index, 2> edges{-1, -1};     ///< of an edge-edge contact: the slave's and the master's
  /// A point that has gone back and forth over the border of a facet keeps that facet until the
  /// increment is done: between two facets at an angle the force jumps, and iterations that follow
  /// it find no end.
  Index facet = -1;  ///< in this iteration
  int changes = 0;   ///< of the facet, in this increment
  /// In contact on a face when it was linearised, and where on `facet` (see keeps_contact).
  bool closed = false;
  Vec<Dim - 1> xi = Vec<Dim - 1>::Zero();
  int kept_on = 0;  ///< iterations in a row that it was kept in contact though it was open
  [[nodiscard]] Index kept() const {
    constexpr int enough = 6;
    return changes >= enough ? facet : -1;
  }
};

/// Result of one contact point, for output and for the next history.
template <int Dim>
struct PointResult {
  contact::Status status = contact::Status::open;
  contact::PointHistory<Dim> history;  ///< trial
  double gap = 0;                      ///< less the offset; +inf: no place of the master found
  /// Deep enough for contact, but at or beyond the centre of curvature of the master under it
  /// (contact::inside_domain): there is no normal to push along, so the point gives no force.
  bool outside_domain = false;
  double normal_traction = 0;                          ///< N <= 0
  Vec<Dim - 1> shear_traction = Vec<Dim - 1>::Zero();  ///< t in `frame`
  ActiveBranch<Dim> branch;                            ///< the tangent belongs to
  double weight = 1;                                   ///< 1 or the area the traction acts on
  double stored = 0;  ///< energy of the springs of the penalties, per weight
  Vec<Dim - 1> slip_increment = Vec<Dim - 1>::Zero();  ///< along the master, in `frame`
  Vec<Dim> foot = Vec<Dim>::Zero(), normal = Vec<Dim>::UnitY();
  Mat<Dim, Dim - 1> frame = Mat<Dim, Dim - 1>::Zero();  ///< 2D: unit tangent

  /// The shear traction as a vector in space (the force on the slave is its negative).
  [[nodiscard]] Vec<Dim> shear() const { return frame * shear_traction; }
};

/// Forces and tangent of one contact point. Row Dim * k + i belongs to node k, direction i; the
/// slave's nodes come first. Only the first Dim * count rows and columns are used: the buffers grow
/// once, to the largest block of the pair. The forces are ADDED to the internal forces. `path` and
/// `area` are terms of other nodes: dR = path_rows * sum path . dx + area_rows * sum area . dx.
template <int Dim>
struct ContactBlock {
  int count = 0;
  int slave_count = 0;
  std::vector<Index> nodes;
  Eigen::VectorXd force;
  Eigen::VectorXd branch_force;  ///< of the linearised branch; equals `force` unless `branched`
  bool branched = false;
  Eigen::MatrixXd tangent;  ///< empty: nothing but `path`
  /// The tangent is in that of a former block with the same nodes, or another process has it.
  bool elsewhere = false;
  /// Its rows and columns of the master's nodes are zero: what belongs there is in the block of the
  /// master's facet.
  bool without_master = false;
  Eigen::Matrix<double, Eigen::Dynamic, Dim> path_rows;
  Eigen::VectorXd area_rows;
  PathBuffers<Dim> behind;
  std::vector<NodeGradient<Dim>> area;
  ConstraintBlock<Dim> constraint;  ///< of a point whose multipliers are unknowns, open or not
  [[nodiscard]] bool active() const { return count > 0; }
  [[nodiscard]] bool has_tangent() const { return tangent.size() > 0 && !elsewhere; }
  [[nodiscard]] const std::vector<NodeMatrix<Dim>>& path() const { return behind.path; }
  /// Room for blocks of so many nodes.
  void reserve(int most) {
    if (static_cast<int>(nodes.size()) >= most) return;
    const Eigen::Index size = Dim * most;
    nodes.resize(static_cast<std::size_t>(most));
    force.resize(size);
    branch_force.resize(size);
  }
  /// Likewise, of a block that has a tangent.
  void reserve_tangent(int most) {
    if (tangent.rows() >= Dim * most) return;
    tangent.resize(Dim * most, Dim * most);
    without_master = false;
  }
  /// Likewise, of one with terms of other nodes.
  void reserve_path() {
    if (path_rows.rows() < force.size()) path_rows.resize(force.size(), Dim);
  }
  void reserve_area() {
    if (area_rows.size() < force.size()) area_rows.resize(force.size());
  }
};

/// Takes blocks, some of which may be of no use, in the order of their points.
template <int Dim>
using BlockTaker = std::function<void(std::span<const ContactBlock<Dim>>)>;

/// Where the time of evaluations went [s], summed up over all calls with the same buffers.
struct PairSeconds {
  double search = 0;      ///< normals and areas of the slave, boxes and tree of the master
  double projection = 0;  ///< candidates out of the tree, closest points, kinematics
  double evaluation = 0;  ///< tractions, forces and tangents
};

/// Buffers of one evaluation; reused, so that the point loop allocates nothing after the first
/// call.
template <int Dim>
struct PairEvaluation {
  std::vector<PointResult<Dim>> points;  ///< one per slave point, then one per edge-edge contact
  /// One per point, `count == 0` where open; mortar: then those of the facets, without forces (and
  /// unused ones with `count == 0`). Likewise those of a smooth master's facets in space.
  std::vector<ContactBlock<Dim>> blocks;
  std::size_t master_blocks = 0;  ///< the first one of the master's facets; 0: there are none
  /// Tangents of blocks that have been taken, for the next ones.
  struct SpareTangent {
    Eigen::MatrixXd tangent;
    bool without_master = false;
    int slave_count = 0;  ///< where `without_master`, that of the block
  };
  std::vector<SpareTangent> spare;
  EdgeBuffers edges;
  int block_nodes = 0;        ///< of the largest block there can be
  std::vector<double> areas;  ///< of the slave's points, if they change
  std::vector<std::vector<NodeGradient<Dim>>> area_gradients;
  std::vector<Vec<Dim>> normals;    ///< of the slave at its points
  std::vector<Vec<Dim>> master_at;  ///< nodes of the master's facets where boxes and patches are of
  bool planted = false;             ///< tree and outlines are of there, too
  std::vector<search::Box<Dim>> boxes;
  std::vector<GregoryPoints> patches;  ///< of the master's facets; empty where none is smooth
  Tree<Dim> tree;
  FilterBuffers<Dim> filter;
  SameWay<Dim> same_way;  ///< without a candidate filter, where points had no place before
  MortarBuffers<Dim> mortar;
  /// With re-entrant vertices: the multipliers as the states that were found take them, one per
  /// slave point.
  std::vector<contact::Multiplier<Dim>> taken_multipliers;
  double stiffening = 1;  ///< that was used (PairMultipliers)
  bool apart =
      false;  ///< master and slave are farther from each other than the candidate filter reaches
  bool near = false;  ///< places far in front of their points were left out (ActiveSet::near)
  PairSeconds seconds;
};

/// Fills the reference areas from the reference coordinates, and prepares the candidate filter.
/// Throws core::GeometryError for choices that do not go together (combinations.hpp), and when area
/// weights are asked for and a slave point has no facet or a non-positive area.
template <int Dim>
void prepare(PairDefinition<Dim>& pair, Points<Dim> reference);

/// Projection of all points in configuration `x`: the state before the first increment
/// (KS2D Table 1, step 1: the convective coordinate of points in contact from the start).
template <int Dim>
[[nodiscard]] PairState<Dim> initial_state(const PairDefinition<Dim>& pair, Points<Dim> x);

/// Branches of the friction law in the last iteration, one per point. A point that has slipped one
/// way and now would slip the other way has jumped over its narrow sticking range: it is linearised
/// in the stick branch (without limit), from where it finds its side (primal-dual active set).
/// Plain return mapping jumps back and forth there for ever.
template <int Dim>
struct ActiveSet {
  std::vector<ActiveBranch<Dim>> branch;
  bool predict = false;  ///< first iteration: points that slipped go on slipping
  double duration = 0;   ///< of the increment, for laws that depend on speed; 0: not known
  double relief = 0;     ///< share of the initial overlaps that does not count yet
  /// Where contact begins or ends within the increment, its traction is the mean over the way the
  /// gap has gone in it: explicit time steps neither make nor lose energy there.
  bool mean_onset = false;
  /// Points that are far from the master need no place yet: half the reach is searched round them
  /// (all of it, if they may have come through the master). `look_far` finds what is left out.
  bool near = false;
};

/// Branches at the end of the last increment; `x` is the configuration then.
template <int Dim>
[[nodiscard]] ActiveSet<Dim> committed_active_set(const PairDefinition<Dim>& pair,
                                                  const PairState<Dim>& committed, Points<Dim> x,
                                                  Prediction friction = Prediction::as_before);
/// Branches of an evaluation, for the next iteration; `before` are those it was made with.
template <int Dim>
[[nodiscard]] ActiveSet<Dim> evaluated_active_set(const PairEvaluation<Dim>& evaluation,
                                                  const ActiveSet<Dim>& before = {});

/// Who evaluates a pair: threads, and several processes that have the same state. A process looks
/// for the places of its part of the points, and has the tangents of those that it sees; all else,
/// with the same bits, all of them have.
struct Workers {
  core::Crew* crew = nullptr;          ///< null: one thread
  const core::Ranks* ranks = nullptr;  ///< null: this process is alone
  std::span<const char> seen{};  ///< by node: tangents of its blocks are wanted; empty: all of them
};

/// One evaluation of all points of the pair: search, projection, kinematics, tractions from the
/// committed history, residual and (if asked) tangent. `multipliers` are needed where the pair's
/// enforcement is not by penalty alone. `take` gets all blocks, those of some facets of the slave
/// as soon as they are complete: their tangents are gone afterwards. Results have the same bits by
/// any number of threads and processes.
///
/// Source     KS2D Tables 1 and 2 with docs/errata.md; KSVD section 3
/// Tested by  tests/unit/pairing/test_pair_tangent.cpp, test_pair_history.cpp, and their 3D like
template <int Dim>
void evaluate(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              bool with_tangent, PairEvaluation<Dim>& out, const ActiveSet<Dim>& active_set = {},
              const PairMultipliers<Dim>* multipliers = nullptr, const BlockTaker<Dim>& take = {},
              const Workers& workers = {});

/// The places that a `near` evaluation at `x` has left out: what points without a place remember
/// and report, before `commit`.
template <int Dim>
void look_far(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              PairEvaluation<Dim>& out, const Workers& workers = {});

/// True if any point is in contact.
template <int Dim>
[[nodiscard]] bool touches(const PairEvaluation<Dim>& evaluation) {
  for (const PointResult<Dim>& point : evaluation.points)
    if (point.status != contact::Status::open) return true;
  return false;
}

/// Whether the unknown tractions of a pair's points have a shear.
template <int Dim>
[[nodiscard]] bool has_shear(const PairDefinition<Dim>& pair) {
  return pair.friction.has_value() || has_reentrant_vertices(pair);
}

/// The multipliers of an iteration as the states that its evaluation found take them: a point that
/// came into a re-entrant vertex or left one has the same traction, but other multipliers.
template <int Dim>
[[nodiscard]] PairMultipliers<Dim> taken_over(const PairEvaluation<Dim>& evaluation,
                                              PairMultipliers<Dim> used);

/// Multipliers to start from: none in contact.
template <int Dim>
[[nodiscard]] PairMultipliers<Dim> initial_multipliers(const PairDefinition<Dim>& pair,
                                                       const PairState<Dim>& state);
/// The multipliers that an evaluation around `used` asks for: the tractions of its points. The
/// penalties are multiplied by 10 where the violation fell by less than a factor of 4.
///
/// Formula    lambda <- N , t <- t ; violation = max |N - lambda| / eps_N, |t - t_old| / eps_T
/// Source     SL92 (Uzawa's iteration with friction)
/// Tested by  tests/unit/pairing/test_multipliers.cpp
template <int Dim>
[[nodiscard]] PairMultipliers<Dim> augmented(const PairDefinition<Dim>& pair,
                                             const PairEvaluation<Dim>& evaluation,
                                             const PairMultipliers<Dim>& used);
/// Multipliers at the start of the next increment: those of open points vanish, the shear has taken
/// up the slip of the increment.
template <int Dim>
[[nodiscard]] PairMultipliers<Dim> commit(const PairEvaluation<Dim>& evaluation,
                                          PairMultipliers<Dim> used);

/// The trial history of an accepted evaluation. A point that opens forgets.
template <int Dim>
[[nodiscard]] PairState<Dim> commit(const PairEvaluation<Dim>& evaluation);

}  // namespace osculate::pairing

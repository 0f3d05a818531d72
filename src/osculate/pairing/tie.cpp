#include "osculate/pairing/tie.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "osculate/cell/shape.hpp"
#include "osculate/pairing/mortar.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_sample.hpp"
#include "osculate/pairing/point_weight.hpp"
#include "osculate/pairing/report.hpp"

namespace osculate::pairing {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// ---- the plane and space ------------------------------------------------------------------------

cell::LineShape shape_at(const Facet& facet, const Vec<1>& xi) { return facet_shape(facet, xi[0]); }
cell::FacetShape shape_at(const SurfaceFacet& facet, const Vec2& xi) {
  return facet_shape(facet, xi);
}

Vec<1> own_place(const Facet& facet, int local) {
  if (local < 2) return Vec<1>(local == 0 ? -1.0 : 1.0);
  return Vec<1>(-1 + 2.0 * (local - 1) / (facet.count - 1));
}
Vec2 own_place(const SurfaceFacet& facet, int local) { return cell::area_node(facet.type, local); }

template <int Dim>
using Bases = std::array<Vec<Dim>, Dim - 1>;

Vec2 normal_of(const Bases<2>& r) { return turn(r[0]); }
Vec3 normal_of(const Bases<3>& r) { return r[0].cross(r[1]); }

Mat<3, 3> cross_matrix(const Vec3& v) {
  Mat<3, 3> m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// d(m) / d(r_,i)
std::array<Mat<2, 2>, 1> normal_rates(const Bases<2>&) {
  Mat<2, 2> turned;
  turned << 0, -1, 1, 0;
  return {turned};
}
std::array<Mat<3, 3>, 2> normal_rates(const Bases<3>& r) {
  return {Mat<3, 3>(-cross_matrix(r[1])), cross_matrix(r[0])};
}

/// The part of the tangent by the second derivative of m, times c^n q.
void add_second_rate(const Vec2&, contact::PointTerms<2>&) {}
void add_second_rate(const Vec3& q, contact::PointTerms<3>& terms) {
  terms.m[1][2] += cross_matrix(q);
  terms.m[2][1] -= cross_matrix(q);
}

// ---- places -------------------------------------------------------------------------------------

template <int Dim>
std::size_t slot(TiedPoint<Dim>& tie, Index node) {
  for (std::size_t k = 0; k < tie.nodes.size(); ++k)
    if (tie.nodes[k] == node) return k;
  tie.nodes.push_back(node);
  tie.weights.push_back(0);
  for (std::vector<double>& b : tie.carrier) b.push_back(0);
  return tie.nodes.size() - 1;
}

template <int Dim, class AnyFacet>
void add_carrier(const AnyFacet& facet, const Vec<Dim - 1>& xi, TiedPoint<Dim>& tie) {
  const auto shape = shape_at(facet, xi);
  for (std::size_t l = 0; l < at(facet.count); ++l) {
    const std::size_t k = slot(tie, facet.nodes[l]);
    for (std::size_t i = 0; i < tie.carrier.size(); ++i) tie.carrier[i][k] += shape.n[1 + i][l];
  }
}

template <int Dim>
Vec<Dim> distance_of(const TiedPoint<Dim>& tie, Points<Dim> x) {
  Vec<Dim> apart = Vec<Dim>::Zero();
  for (std::size_t k = 0; k < tie.nodes.size(); ++k) apart += tie.weights[k] * x[at(tie.nodes[k])];
  return apart;
}

template <int Dim>
Bases<Dim> bases_of(const TiedPoint<Dim>& tie, Points<Dim> x) {
  Bases<Dim> r;
  for (std::size_t i = 0; i < r.size(); ++i) {
    r[i].setZero();
    for (std::size_t k = 0; k < tie.nodes.size(); ++k)
      r[i] += tie.carrier[i][k] * x[at(tie.nodes[k])];
  }
  return r;
}

/// Sets what is kept; false where the point is too far away, or has no facet to be carried by.
template <int Dim>
bool keep(const PairDefinition<Dim>& pair, const Tied<Dim>& tied, Points<Dim> x,
          TiedPoint<Dim>& tie) {
  const Vec<Dim> apart = distance_of<Dim>(tie, x);
  if (!(std::abs(apart.norm() - pair.offset) <= tied.tolerance)) return false;
  const Bases<Dim> r = bases_of<Dim>(tie, x);
  const Vec<Dim> m = normal_of(r);
  if (!(m.norm() > 0)) return false;
  if (tied.keep_gap) {
    Mat<Dim, Dim> base;
    for (int i = 0; i < Dim - 1; ++i) base.col(i) = r[static_cast<std::size_t>(i)];
    base.col(Dim - 1) = m;
    tie.kept = base.partialPivLu().solve(apart);
  } else {
    tie.kept[Dim - 1] = tie.side * pair.offset / m.norm();
  }
  return true;
}

template <int Dim>
void tie_points(const PairDefinition<Dim>& pair, Points<Dim> x, Tied<Dim>& tied) {
  PairDefinition<Dim> open = pair;  // the same, to search in
  open.separation = MayPart{};
  PairEvaluation<Dim> work;
  PairState<Dim> none;
  none.points.resize(pair.slave.points.size());
  evaluate<Dim>(open, x, none, false, work);
  // what moves as one may look whichever way
  work.normals.assign(pair.slave.points.size(), Vec<Dim>::Zero());
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    const ProjectedPoint<Dim> projected = project_point<Dim>(open, work, x, i, {});
    if (projected.projection.feature == projection::Feature::none) continue;
    const SlavePoint<Dim>& point = pair.slave.points[i];
    const auto& facet = pair.master.facets[at(projected.projection.facet)];
    TiedPoint<Dim> tie;
    tie.point = static_cast<Index>(i);
    for (std::size_t k = 0; k < at(point.count); ++k)
      tie.weights[slot(tie, point.nodes[k])] += point.shape[k];
    tie.slave_count = static_cast<int>(tie.nodes.size());
    const auto shape = shape_at(facet, projected.projection.xi);
    for (std::size_t l = 0; l < at(facet.count); ++l)
      tie.weights[slot(tie, facet.nodes[l])] -= shape.n[0][l];
    add_carrier<Dim>(facet, projected.projection.xi, tie);
    tie.facet = projected.projection.facet;
    tie.feature = projected.projection.feature;
    tie.xi = projected.projection.xi;
    if (keep(pair, tied, x, tie)) tied.ties.push_back(std::move(tie));
  }
}

template <int Dim>
void tie_by_mortar(PairDefinition<Dim>& pair, Points<Dim> x, Tied<Dim>& tied) {
  constexpr double nothing = 1e-8;  // parts of a node's area smaller than this are nothing
  PairEvaluation<Dim> work;
  PairState<Dim> none;
  none.points.resize(pair.slave.nodes.size());
  evaluate_mortar<Dim>(pair, x, none, false, work);
  for (std::size_t j = 0; j < pair.slave.nodes.size(); ++j) {
    const MortarNode<Dim>& node = work.mortar.nodes[j];
    const double full = pair.reference_areas[j];
    pair.reference_areas[j] = node.area;
    if (node.facet < 0 || !(node.area > nothing * full)) continue;
    TiedPoint<Dim> tie;
    tie.point = static_cast<Index>(j);
    tie.side = -1;
    tie.facet = node.facet;
    for (std::size_t k = 0; k < node.slaves.nodes.size(); ++k)
      tie.weights[slot(tie, node.slaves.nodes[k])] += node.slaves.weights[k] / node.area;
    const auto& facet = pair.slave.boundary.facets[at(pair.slave.facets_of[j].front())];
    int local = 0;
    while (facet.nodes[at(local)] != pair.slave.nodes[j]) ++local;
    add_carrier<Dim>(facet, own_place(facet, local), tie);
    tie.slave_count = static_cast<int>(tie.nodes.size());
    for (std::size_t l = 0; l < node.masters.nodes.size(); ++l)
      tie.weights[slot(tie, node.masters.nodes[l])] -= node.masters.weights[l] / node.area;
    if (keep(pair, tied, x, tie)) tied.ties.push_back(std::move(tie));
  }
}

// ---- evaluation ---------------------------------------------------------------------------------

/// What a tied point says at a configuration: the sample, and q in its direction and across it.
template <int Dim>
struct TieState {
  Bases<Dim> r;
  ContactSample<Dim> sample;
  Vec<Dim> q;
};

template <int Dim>
TieState<Dim> state_of(const PairDefinition<Dim>& pair, const TiedPoint<Dim>& tie, Points<Dim> x) {
  TieState<Dim> s;
  s.r = bases_of<Dim>(tie, x);
  const Vec<Dim> m = normal_of(s.r), apart = distance_of<Dim>(tie, x);
  s.q = apart - tie.kept[Dim - 1] * m;
  for (std::size_t i = 0; i < s.r.size(); ++i)
    s.q -= tie.kept[static_cast<Eigen::Index>(i)] * s.r[i];
  ContactSample<Dim>& at = s.sample;
  at.facet = tie.facet;
  at.feature = tie.feature;
  at.xi = tie.xi;
  at.foot = position<Dim>(pair.slave.points[static_cast<std::size_t>(tie.point)], x) - apart;
  at.normal = tie.side * m / m.norm();
  at.frame = contact::tangent_frame<Dim>(at.normal, s.r[0]);
  at.gap = at.normal.dot(apart);
  return s;
}

/// A law without limit surface: it sticks, pressed and pulled.
template <int Dim>
Response<Dim> response_of(const TieState<Dim>& s, double stiffness) {
  Response<Dim> r;
  r.has_shear = true;
  r.traction.normal = {true, stiffness * s.sample.normal.dot(s.q), stiffness,
                       0.5 * stiffness * s.q.squaredNorm()};
  r.law.traction = r.traction.tangential.traction = stiffness * (s.sample.frame.transpose() * s.q);
  return r;
}

/// R_k and K_kl of a tied point by slots: w_k, then b_ik.
template <int Dim>
contact::PointTerms<Dim> terms_of(const TiedPoint<Dim>& tie, const TieState<Dim>& s,
                                  double stiffness) {
  const double along = tie.kept[Dim - 1];
  std::array<Mat<Dim, Dim>, Dim> rate;  // of q by the sums of each slot
  rate[0].setIdentity();
  const std::array<Mat<Dim, Dim>, Dim - 1> turning = normal_rates(s.r);
  for (std::size_t i = 0; i + 1 < Dim; ++i)
    rate[i + 1] =
        -tie.kept[static_cast<Eigen::Index>(i)] * Mat<Dim, Dim>::Identity() - along * turning[i];
  contact::PointTerms<Dim> terms;
  terms.used = Dim;
  for (std::size_t a = 0; a < Dim; ++a) {
    terms.f[a] = stiffness * (rate[a].transpose() * s.q);
    for (std::size_t b = 0; b < Dim; ++b)
      terms.m[a][b] = stiffness * (rate[a].transpose() * rate[b]);
  }
  add_second_rate(Vec<Dim>(stiffness * along * s.q), terms);
  return terms;
}

template <int Dim>
void set_block(const TiedPoint<Dim>& tie, const Response<Dim>& r,
               const contact::PointTerms<Dim>& terms, double area, bool with_tangent,
               ContactBlock<Dim>& block) {
  const auto size = Dim * static_cast<Eigen::Index>(tie.nodes.size());
  const auto own = static_cast<std::size_t>(tie.slave_count);
  block.nodes.resize(tie.nodes.size());
  block.force.resize(size);
  block.branch_force.resize(size);
  if (with_tangent) block.tangent.resize(size, size);
  set_nodes<Dim>(std::span(tie.nodes).first(own), std::span(tie.nodes).subspan(own), block);
  const auto w = [&](std::size_t slot, int k) {
    const auto n = static_cast<std::size_t>(k);
    return slot == 0 ? tie.weights[n] : tie.carrier[slot - 1][n];
  };
  set_forces<Dim>(
      r, {}, terms.f, [&](const auto&) { return terms.f; }, w, area, block);
  if (with_tangent) scatter_tangent<Dim>(terms, block.count, w, area, block.tangent);
}

}  // namespace

template <int Dim>
void prepare_ties(PairDefinition<Dim>& pair, Points<Dim> reference) {
  auto* const tied = std::get_if<Tied<Dim>>(&pair.separation);
  if (!tied) return;
  tied->ties.clear();
  if (by_mortar(pair))
    tie_by_mortar<Dim>(pair, reference, *tied);
  else
    tie_points<Dim>(pair, reference, *tied);
}

template <int Dim>
void evaluate_ties(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>&,
                   bool with_tangent, PairEvaluation<Dim>& out) {
  const std::size_t n = pair.slave.points.size();
  out.points.assign(n, {});
  out.blocks.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    out.points[i].gap = std::numeric_limits<double>::infinity();
    clear_block(out.blocks[i]);
    out.blocks[i].nodes.clear();
  }
  for (const TiedPoint<Dim>& tie : std::get<Tied<Dim>>(pair.separation).ties) {
    const std::size_t i = at(tie.point);
    const double stiffness = point_penalty(pair, i).normal;
    const TieState<Dim> s = state_of<Dim>(pair, tie, x);
    const Response<Dim> r = response_of(s, stiffness);
    PointResult<Dim>& result = out.points[i];
    const bool by_node = pair.weight == Weight::node;
    result = open_result<Dim>(
        {}, by_mortar(pair) ? pair.reference_areas[i]
                            : pair.pass_factor * (by_node ? 1.0 : pair.reference_areas[i]));
    report_sample(s.sample, pair.offset, result);
    report_normal(r.traction.normal, 0, result);
    report_contact<Dim>(r, r.law.traction, {}, result);
    result.history.held = true;
    set_block(tie, r, terms_of(tie, s, stiffness), result.weight, with_tangent, out.blocks[i]);
  }
}

template void prepare_ties<2>(PairDefinition<2>&, Points<2>);
template void prepare_ties<3>(PairDefinition<3>&, Points<3>);
template void evaluate_ties<2>(const PairDefinition<2>&, Points<2>, const PairState<2>&, bool,
                               PairEvaluation<2>&);
template void evaluate_ties<3>(const PairDefinition<3>&, Points<3>, const PairState<3>&, bool,
                               PairEvaluation<3>&);

}  // namespace osculate::pairing

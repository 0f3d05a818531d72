#include "osculate/pairing/tie.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "osculate/cell/shape.hpp"
#include "osculate/pairing/mortar.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_penalty.hpp"
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

/// The part of the tangent by the second derivative of m: v . d2m.
void add_second_rate(const Vec2&, contact::PointTerms<2>&) {}
void add_second_rate(const Vec3& v, contact::PointTerms<3>& terms) {
  terms.m[1][2] -= cross_matrix(v);
  terms.m[2][1] += cross_matrix(v);
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

/// The part of the gap at the start that may not count (InitialOverlap).
template <int Dim>
double relieved_gap(const PairDefinition<Dim>& pair, double gap) {
  if (pair.overlap == InitialOverlap::acts) return 0;
  return pair.overlap == InitialOverlap::given ? gap - pair.clearance : std::min(0.0, gap);
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
    base.col(Dim - 1) = m.normalized();
    tie.kept = base.partialPivLu().solve(apart);
  } else {
    const double gap = tie.side * m.dot(apart) / m.norm();
    tie.kept[Dim - 1] = tie.side * pair.offset;
    tie.relieved = tie.side * relieved_gap(pair, gap - pair.offset);
  }
  return true;
}

template <int Dim>
void tie_points(const PairDefinition<Dim>& pair, Points<Dim> x, Tied<Dim>& tied) {
  PairDefinition<Dim> open = pair;  // the same, to search in
  open.separation = MayPart{};
  for (SlavePoint<Dim>& point : open.slave.points) point.inside = false;  // what is tied stays so
  PairEvaluation<Dim> work;
  PairState<Dim> none;
  none.points.resize(pair.slave.points.size());
  evaluate<Dim>(open, x, none, false, work);
  const bool over = tied.tolerance == any_gap;
  const std::vector<Vec<Dim>> normals = work.normals;
  // what moves as one may look whichever way, but for what is far apart
  if (!over) work.normals.assign(pair.slave.points.size(), Vec<Dim>::Zero());
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    const ProjectedPoint<Dim> projected = project_point<Dim>(open, work, x, i, {});
    if (projected.projection.feature == projection::Feature::none) continue;
    if (over && (projected.projection.beyond_end ||
                 projected.kinematics.normal.dot(normals[i]) > facing_cosine))
      continue;
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
  Vec<Dim> normal;   ///< n = m / |m|
  double size = 0;   ///< |m|
  double along = 0;  ///< c^n
};

template <int Dim>
TieState<Dim> state_of(const PairDefinition<Dim>& pair, const TiedPoint<Dim>& tie, Points<Dim> x,
                       double relief) {
  TieState<Dim> s;
  s.r = bases_of<Dim>(tie, x);
  s.along = tie.kept[Dim - 1] + relief * tie.relieved;
  const Vec<Dim> m = normal_of(s.r), apart = distance_of<Dim>(tie, x);
  s.size = m.norm();
  s.normal = m / s.size;
  s.q = apart - s.along * s.normal;
  for (std::size_t i = 0; i < s.r.size(); ++i)
    s.q -= tie.kept[static_cast<Eigen::Index>(i)] * s.r[i];
  ContactSample<Dim>& at = s.sample;
  at.facet = tie.facet;
  at.feature = tie.feature;
  at.xi = tie.xi;
  at.foot = position<Dim>(pair.slave.points[static_cast<std::size_t>(tie.point)], x) - apart;
  at.normal = tie.side * s.normal;
  at.frame = contact::tangent_frame<Dim>(at.normal, s.r[0]);
  at.gap = at.normal.dot(apart);
  return s;
}

/// A law without limit surface: it sticks, pressed and pulled.
template <int Dim>
Response<Dim> response_of(const TieState<Dim>& s, const PointPenalty& eps) {
  const double across = s.sample.normal.dot(s.q);
  const Vec<Dim - 1> shear = s.sample.frame.transpose() * s.q;
  Response<Dim> r;
  r.has_shear = true;
  r.traction.normal = {true, eps.normal * across, eps.normal,
                       0.5 * (eps.normal * across * across + eps.shear * shear.squaredNorm())};
  r.law.traction = r.traction.tangential.traction = eps.shear * shear;
  return r;
}

/// Derivatives by the sums of each slot.
template <int Dim>
struct TieRates {
  std::array<Mat<Dim, Dim>, Dim> n, q;
};

template <int Dim>
TieRates<Dim> rates_of(const TiedPoint<Dim>& tie, const TieState<Dim>& s) {
  const std::array<Mat<Dim, Dim>, Dim - 1> turning = normal_rates(s.r);
  const Mat<Dim, Dim> across = Mat<Dim, Dim>::Identity() - s.normal * s.normal.transpose();
  TieRates<Dim> d;
  d.n[0].setZero();
  d.q[0].setIdentity();
  for (std::size_t i = 0; i + 1 < Dim; ++i) {
    d.n[i + 1] = across * turning[i] / s.size;
    d.q[i + 1] =
        -tie.kept[static_cast<Eigen::Index>(i)] * Mat<Dim, Dim>::Identity() - s.along * d.n[i + 1];
  }
  return d;
}

/// The second derivative of the normal, times q and a factor:
///   q . d2n = u . d2m / |m| - [(n . dm_a) (u . dm_b) + (n . dm_b) (u . dm_a)] / |m|^2 -
///             (n . q) dn_a . dn_b ,  u = q - (n . q) n
template <int Dim>
void add_turning_rate(const TieState<Dim>& s, const TieRates<Dim>& d, double factor,
                      contact::PointTerms<Dim>& terms) {
  const double h = s.normal.dot(s.q);
  const Vec<Dim> u = s.q - h * s.normal;
  const std::array<Mat<Dim, Dim>, Dim - 1> turning = normal_rates(s.r);
  std::array<Vec<Dim>, Dim - 1> along, across;
  for (std::size_t i = 0; i + 1 < Dim; ++i) {
    along[i] = turning[i].transpose() * s.normal / s.size;
    across[i] = turning[i].transpose() * u / s.size;
  }
  for (std::size_t i = 0; i + 1 < Dim; ++i)
    for (std::size_t j = 0; j + 1 < Dim; ++j)
      terms.m[i + 1][j + 1] -=
          factor * (along[i] * across[j].transpose() + across[i] * along[j].transpose() +
                    h * (d.n[i + 1].transpose() * d.n[j + 1]));
  add_second_rate(Vec<Dim>(factor * u / s.size), terms);
}

/// R_k and K_kl of a tied point by slots, w_k, then b_ik: derivatives of the energy
/// eps_T q . q / 2 + (eps_N - eps_T) h^2 / 2, h = n . q, for which n . d2q = c^n dn_a . dn_b.
template <int Dim>
contact::PointTerms<Dim> terms_of(const TiedPoint<Dim>& tie, const TieState<Dim>& s,
                                  const PointPenalty& eps) {
  const TieRates<Dim> d = rates_of(tie, s);
  const double more = eps.normal - eps.shear, h = s.normal.dot(s.q);
  std::array<Vec<Dim>, Dim> of_h;
  contact::PointTerms<Dim> terms;
  terms.used = Dim;
  for (std::size_t a = 0; a < Dim; ++a) {
    of_h[a] = d.q[a].transpose() * s.normal + d.n[a].transpose() * s.q;
    terms.f[a] = eps.shear * (d.q[a].transpose() * s.q) + more * h * of_h[a];
  }
  for (std::size_t a = 0; a < Dim; ++a)
    for (std::size_t b = 0; b < Dim; ++b)
      terms.m[a][b] = eps.shear * (d.q[a].transpose() * d.q[b]) +
                      more * (of_h[a] * of_h[b].transpose() +
                              h * (d.n[a].transpose() * d.q[b] + d.q[a].transpose() * d.n[b] +
                                   s.along * d.n[a].transpose() * d.n[b]));
  add_turning_rate<Dim>(s, d, more * h - eps.shear * s.along, terms);
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
void evaluate_ties(const PairDefinition<Dim>& pair, Points<Dim> x, double relief, bool with_tangent,
                   PairEvaluation<Dim>& out) {
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
    PointPenalty eps = point_penalty(pair, i);
    if (!pair.friction) eps.shear = eps.normal;
    const TieState<Dim> s = state_of<Dim>(pair, tie, x, relief);
    const Response<Dim> r = response_of(s, eps);
    PointResult<Dim>& result = out.points[i];
    const bool by_node = pair.weight == Weight::node;
    result = open_result<Dim>(
        {}, by_mortar(pair) ? pair.reference_areas[i]
                            : pair.pass_factor * (by_node ? 1.0 : pair.reference_areas[i]));
    report_sample(s.sample, pair.offset, result);
    report_normal(r.traction.normal, 0, result);
    report_contact<Dim>(r, r.law.traction, {}, result);
    result.history.held = true;
    set_block(tie, r, terms_of(tie, s, eps), result.weight, with_tangent, out.blocks[i]);
  }
}

template void prepare_ties<2>(PairDefinition<2>&, Points<2>);
template void prepare_ties<3>(PairDefinition<3>&, Points<3>);
template void evaluate_ties<2>(const PairDefinition<2>&, Points<2>, double, bool,
                               PairEvaluation<2>&);
template void evaluate_ties<3>(const PairDefinition<3>&, Points<3>, double, bool,
                               PairEvaluation<3>&);

}  // namespace osculate::pairing

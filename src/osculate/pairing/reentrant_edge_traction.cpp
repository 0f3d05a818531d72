#include "osculate/pairing/reentrant_edge_traction.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "osculate/core/dual.hpp"
#include "osculate/pairing/point_sample.hpp"

namespace osculate::pairing {

using contact::Branch;
using contact::PointHistory;
using contact::Status;

namespace {

/// Slots, then e - r_o, the last edge's derivative, and the multiplier.
constexpr int chord_at = 18, last_at = 21, multiplier_at = 24, variables = 27;
using Number = core::Dual<variables>;

/// A vector in space with its derivatives.
struct Vector {
  std::array<Number, 3> c;

  Vector() = default;
  /// The variable that begins at column `first`.
  Vector(const Vec3& value, int first) {
    for (int i = 0; i < 3; ++i)
      c[static_cast<std::size_t>(i)] = Number::variable(value[i], first + i);
  }
  [[nodiscard]] Vec3 value() const { return {c[0].v, c[1].v, c[2].v}; }
  [[nodiscard]] Mat<3, 3> by(int first) const {
    Mat<3, 3> m;
    for (int i = 0; i < 3; ++i)
      m.row(i) = c[static_cast<std::size_t>(i)].d.segment<3>(first).transpose();
    return m;
  }
  /// Moves by `rate` with the place.
  Vector& move(const Vec3& rate, const Vec<variables>& d_place) {
    for (int i = 0; i < 3; ++i) c[static_cast<std::size_t>(i)].d += rate[i] * d_place;
    return *this;
  }
  friend Vector operator+(const Vector& a, const Vector& b) {
    return made([&](std::size_t i) { return a.c[i] + b.c[i]; });
  }
  friend Vector operator-(const Vector& a, const Vector& b) {
    return made([&](std::size_t i) { return a.c[i] - b.c[i]; });
  }
  friend Vector operator*(const Number& f, const Vector& a) {
    return made([&](std::size_t i) { return f * a.c[i]; });
  }
  template <class Component>
  static Vector made(const Component& component) {
    Vector v;
    for (std::size_t i = 0; i < 3; ++i) v.c[i] = component(i);
    return v;
  }
};

Number dot(const Vector& a, const Vector& b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return Vector::made([&](std::size_t i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    return a.c[j] * b.c[k] - a.c[k] * b.c[j];
  });
}
Vector unit(const Vector& a) { return (Number(1) / sqrt(dot(a, a))) * a; }

/// ds = (e' . v_0 + (x - e) . v_1) / g
Vec<variables> place_rate(const EdgePlace& place, const Vec3& offset) {
  const double g = place.first.squaredNorm() - place.second.dot(offset);
  Vec<variables> rate = Vec<variables>::Zero();
  rate.segment<3>(0) = place.first / g;
  rate.segment<3>(3) = offset / g;
  return rate;
}

/// Unit normal of one of the facets at the edge.
Vector normal_at(const FacetSurface& master, const SharpEdge& edge, std::size_t side, double s,
                 const Vec<variables>& d_place, Points<3> x) {
  const SurfaceFacet& facet = master.facets[static_cast<std::size_t>(edge.facets[side])];
  const geometry::SurfaceJet jet = facet_jet(facet, edge_xi(edge, side, s), x);
  const Vec2 rate = edge_xi_rate(edge, side);
  const int first = 6 + 6 * static_cast<int>(side);
  const Vector
      r1 = Vector(jet.r1[0], first).move(rate[0] * jet.r2[0] + rate[1] * jet.r2[1], d_place),
      r2 = Vector(jet.r1[1], first + 3).move(rate[0] * jet.r2[1] + rate[1] * jet.r2[2], d_place);
  return unit(cross(r1, r2));
}

/// N_i of a traction across the edge where they press; a facet that would pull has none.
std::array<Number, 2> pressing(const Vector& traction, const std::array<Vector, 2>& n) {
  const Number c = dot(n[0], n[1]), b0 = dot(traction, n[0]), b1 = dot(traction, n[1]),
               det = Number(1) - c * c;
  std::array<Number, 2> parts{(b0 - c * b1) / det, (b1 - c * b0) / det};
  for (Number& part : parts)
    if (part.v > 0) part = Number(0);
  return parts;
}

/// Whether a facet takes part in the friction along the edge: it is pressed, or neither is.
bool bears(const std::array<double, 2>& normal, std::size_t k) {
  return normal[k] < 0 || !(normal[1 - k] < 0);
}

/// The limit at which a point that slid is expected to go on, towards `way`.
EdgeFriction predicted_friction(const contact::FrictionLaw& law, double predictor,
                                const std::array<double, 2>& normal,
                                const contact::Sliding& sliding, double way) {
  EdgeFriction out;
  out.slides = true;
  out.d_predictor = 0;
  double limit = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!bears(normal, k)) continue;
    const contact::SlipLimit of =
        contact::predicted_limit(law, std::abs(predictor), normal[k], sliding);
    limit += of.value;
    out.d_predictor += of.d_predictor;
    out.d_normal[k] = -of.d_pressure * way;
  }
  out.value = way * std::max(limit, std::abs(predictor));
  return out;
}

/// The law's answer, or the branch that the context keeps it in (as `linearised_branch`).
EdgeFriction linearised(const contact::FrictionLaw& law, const EdgeFriction& lawful,
                        double predictor, const std::array<double, 2>& normal, const Vec3& tangent,
                        const contact::Sliding& sliding, const PointContext<3>& context) {
  if (context.active.branch != Branch::reentrant) return lawful;
  const double before = tangent.dot(context.active.direction);
  const EdgeFriction stick{false, predictor};
  if (context.predict)
    return before == 0 ? stick
                       : predicted_friction(law, predictor, normal, sliding, before > 0 ? 1 : -1);
  return lawful.slides && before * predictor < 0 ? stick : lawful;
}

/// The way as a number with its derivatives.
Number number_of(const EdgeWay& way, const EdgePlace& place, const Vector& tangent,
                 const Vec<variables>& d_place) {
  if (!way.known) return {};
  const Vector chord = Vector(way.chord, chord_at).move(place.first, d_place);
  if (!way.from) return dot(tangent, chord);
  const Vector last = unit(Vector(way.last, last_at));
  return dot(tangent + last, chord) / (Number(1) + dot(tangent, last));
}

template <std::size_t Slots>
void set_derivatives(const Vector& f, std::array<Mat<3, 3>, Slots>& of_slot,
                     Mat<3, 3>& of_multiplier) {
  for (std::size_t b = 0; b < Slots; ++b) of_slot[b] = f.by(3 * static_cast<int>(b));
  of_multiplier = f.by(multiplier_at);
}

void set_frictionless(const EdgePlace& place, const Vec3& point, const Vec3& multiplier,
                      double spring, const Vec<variables>& d_place, EdgeTraction& out) {
  const Vector offset = Vector(point - place.point, 0).move(-place.first, d_place),
               first = Vector(place.first, 3).move(place.second, d_place),
               second = Vector(place.second, 6), lambda = Vector(multiplier, multiplier_at);
  const Number along = dot(first, lambda) / (dot(first, first) - dot(second, offset));
  const Vector pull = Number(spring) * offset;
  const std::array<Vector, 2> f{lambda + pull - along * first, Number(-1) * (along * offset)};
  const Vec3 axis = edge_axis(place);
  for (std::size_t a = 0; a < 2; ++a) {
    out.f[a] = f[a].value();
    set_derivatives(f[a], out.of_slot[a], out.of_multiplier[a]);
  }
  out.lawful = out.f[0];
  out.constraint = out.branch_constraint = pull.value() - axis * axis.dot(multiplier);
  set_derivatives(pull, out.constraint_of_slot, out.constraint_of_multiplier);
  out.constraint_of_multiplier = -axis * axis.transpose();
}

void set_with_friction(const PairDefinition<3>& pair, const EdgePlace& place, const Vec3& point,
                       const Vec3& multiplier, double spring, const PointHistory<3>& history,
                       const PointContext<3>& context, const Vec<variables>& d_place, Points<3> x,
                       EdgeTraction& out) {
  const ReentrantEdges& edges = std::get<ByMultipliers>(pair.enforcement).reentrant_edges;
  const SharpEdge& edge = edges.list[static_cast<std::size_t>(place.edge)];
  const Vector offset = Vector(point - place.point, 0).move(-place.first, d_place),
               tangent = unit(Vector(place.first, 3).move(place.second, d_place)),
               lambda = Vector(multiplier, multiplier_at),
               carried = lambda + Number(spring) * offset;
  const std::array<Vector, 2> n{normal_at(pair.master, edge, 0, place.s, d_place, x),
                                normal_at(pair.master, edge, 1, place.s, d_place, x)};
  const std::array<Number, 2> parts = pressing(carried, n);
  const std::array<double, 2> normal{parts[0].v, parts[1].v};
  const contact::FrictionLaw law = friction_law(pair, normal[0] + normal[1], context);
  const double stiffness = contact::stiffness(law);
  const contact::Sliding sliding = sliding_of(history, context);
  const Number way = number_of(out.way, place, tangent, d_place);
  const Number predictor = dot(lambda, tangent) + stiffness * way;
  const EdgeFriction lawful = friction_of_both(law, predictor.v, normal, sliding);
  const EdgeFriction branch =
      linearised(law, lawful, predictor.v, normal, tangent.value(), sliding, context);
  const Number along{branch.value, Vec<variables>(branch.d_predictor * predictor.d +
                                                  branch.d_normal[0] * parts[0].d +
                                                  branch.d_normal[1] * parts[1].d)};
  const Vector traction = carried + (along - dot(carried, tangent)) * tangent;
  out.f[0] = traction.value();
  out.lawful = out.f[0] + (lawful.value - branch.value) * tangent.value();
  out.status = lawful.slides ? Status::slip : Status::stick;
  out.slides = branch.slides;
  out.constraint = out.lawful - multiplier;
  out.branch_constraint = out.f[0] - multiplier;
  if (lawful.slides) {
    out.slid = std::abs(predictor.v - lawful.value) / stiffness;
    out.dissipated = lawful.value * (predictor.v - lawful.value) / stiffness;
  }
  set_derivatives(traction, out.of_slot[0], out.of_multiplier[0]);
  out.constraint_of_slot = out.of_slot[0];
  out.constraint_of_multiplier = out.of_multiplier[0] - Mat<3, 3>::Identity();
  out.of_way = branch.d_predictor * stiffness * tangent.value();
  out.way_of_chord = way.d.segment<3>(chord_at);
  out.way_of_last = way.d.segment<3>(last_at);
}

}  // namespace

EdgeFriction friction_of_both(const contact::FrictionLaw& law, double predictor,
                              const std::array<double, 2>& normal,
                              const contact::Sliding& sliding) {
  constexpr int most = 100;
  constexpr double rounding = 1e-15;
  std::array<contact::TangentialResponse<2>, 2> r;
  std::array<double, 2> t{0, 0};
  for (int i = 0; i < most; ++i) {
    double change = 0;
    for (const std::size_t k : {0u, 1u}) {
      if (!bears(normal, k)) continue;
      r[k] = contact::response<2>(law, Vec<1>(predictor - t[1 - k]), normal[k], sliding);
      if (r[k].status == Status::stick) return {false, predictor};
      change = std::max(change, std::abs(r[k].traction[0] - t[k]));
      t[k] = r[k].traction[0];
    }
    if (change <= rounding * std::abs(predictor)) break;
  }
  const double a = r[0].d_predictor(0, 0), b = r[1].d_predictor(0, 0), det = 1 - a * b;
  return {true,
          t[0] + t[1],
          (a + b - 2 * a * b) / det,
          {r[0].d_normal[0] * (1 - b) / det, r[1].d_normal[0] * (1 - a) / det}};
}

EdgeWay way_along(const PairDefinition<3>& pair, const EdgePlace& place,
                  const PointHistory<3>& history, Points<3> x) {
  EdgeWay way;
  const ReentrantEdges& edges = std::get<ByMultipliers>(pair.enforcement).reentrant_edges;
  const SharpEdge& edge = edges.list[static_cast<std::size_t>(place.edge)];
  if (history.facet < 0) return way;
  const auto piece = [&](Index f) { return pair.master.facets[static_cast<std::size_t>(f)].piece; };
  if (piece(history.facet) != piece(edge.facets[0])) return way;
  way.known = true;
  way.chord = place.point - place_in_space(pair.master, history, x);
  Vec3 along = place.tangent;
  if (history.feature != projection::Feature::face)
    way.from = location_on_edge(edges, pair.master, history.facet, history.xi);
  if (way.from) {
    const SharpEdge& last = edges.list[static_cast<std::size_t>(way.from->edge)];
    way.last = edge_derivative(last, 1, way.from->s, x);
    way.turned = way.last.dot(place.tangent) < 0;
    if (way.turned) way.last = -way.last;
    along = way.last.normalized();
  }
  way.along = (place.tangent + along).dot(way.chord) / (1 + place.tangent.dot(along));
  if (!way.from) way.across = (way.chord - way.along * place.tangent).norm();
  return way;
}

std::array<double, 2> normal_parts(const EdgePlace& place, const Vec3& traction) {
  const double c = place.normal[0].dot(place.normal[1]), a = traction.dot(place.normal[0]),
               b = traction.dot(place.normal[1]), det = 1 - c * c;
  return {(a - c * b) / det, (b - c * a) / det};
}

Vec3 edge_axis(const EdgePlace& place) {
  Eigen::Index axis = 0;
  place.tangent.cwiseAbs().maxCoeff(&axis);
  return Vec3::Unit(axis);
}

EdgeTraction edge_traction(const PairDefinition<3>& pair, const EdgePlace& place, const Vec3& point,
                           const Vec3& multiplier, double spring, const PointHistory<3>& history,
                           const PointContext<3>& context, Points<3> x) {
  EdgeTraction out;
  for (auto& row : out.of_slot) row.fill(Mat<3, 3>::Zero());
  out.of_multiplier.fill(Mat<3, 3>::Zero());
  out.way = way_along(pair, place, history, x);
  const Vec<variables> d_place = place_rate(place, point - place.point);
  for (std::size_t b = 0; b < 6; ++b) out.d_place[b] = d_place.segment<3>(3 * static_cast<int>(b));
  if (pair.friction)
    set_with_friction(pair, place, point, multiplier, spring, history, context, d_place, x, out);
  else
    set_frictionless(place, point, multiplier, spring, d_place, out);
  return out;
}

}  // namespace osculate::pairing

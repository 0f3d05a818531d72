// Overlap of a slave facet with a master facet in space.
#include <Eigen/Geometry>
#include <cmath>

#include "osculate/cell/linear_facet.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/pairing/mortar_cell.hpp"
#include "osculate/pairing/mortar_clip.hpp"
#include "osculate/pairing/mortar_pieces.hpp"
#include "osculate/pairing/mortar_rule.hpp"

namespace osculate::pairing {
namespace {

using namespace mortar_pieces;
using I = Eigen::Index;

/// Variables of a polygon: plane coordinates of up to four nodes of the slave, then of the master.
constexpr int corner_variables = 16;
using Variables = core::Dual<corner_variables>;

constexpr int most_columns = 4 * cell::max_facet_nodes;
/// Derivatives by the plane coordinates of all nodes, the slave's first.
using Rows = Eigen::Matrix<double, 5, Eigen::Dynamic, Eigen::ColMajor, 5, most_columns>;

// ---- the plane ----------------------------------------------------------------------------------

using Points3 = FacetPoints;
using Points2 = std::array<Vec2, cell::max_facet_nodes>;

/// Plane through a linear piece of the slave, across its normal in the middle.
struct Plane {
  Vec3 origin, normal;
  Mat<3, 2> frame;
  std::array<Mat<3, 3>, 4> d_normal;  ///< by the piece's corners
};

Mat<3, 3> cross_matrix(const Vec3& v) {
  Mat<3, 3> m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// n along (x_1 - x_0) x (x_2 - x_0), or along the product of the diagonals.
bool plane_of(const Piece& piece, const Points3& x, Plane& out) {
  const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(piece[k])]; };
  const bool triangle = piece[3] < 0;
  const Vec3 a = triangle ? at(1) - at(0) : at(2) - at(0);
  const Vec3 b = triangle ? at(2) - at(0) : at(3) - at(1);
  const Vec3 across = a.cross(b);
  const double size = across.norm();
  if (!(size > 0)) return false;
  out.origin = at(0);
  out.normal = across / size;
  out.frame.col(0) = a.normalized();
  out.frame.col(1) = out.normal.cross(out.frame.col(0));
  const Mat<3, 3> unit = (Mat<3, 3>::Identity() - out.normal * out.normal.transpose()) / size;
  const Mat<3, 3> by_a = -unit * cross_matrix(b), by_b = unit * cross_matrix(a);
  if (triangle)
    out.d_normal = {-by_a - by_b, by_a, by_b, Mat<3, 3>::Zero()};
  else
    out.d_normal = {-by_a, -by_b, by_a, by_b};
  return true;
}

Points2 flat(const Plane& plane, const Points3& x, int count) {
  Points2 u;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    u[k] = plane.frame.transpose() * (x[k] - plane.origin);
  return u;
}

// ---- places on the facets -----------------------------------------------------------------------

/// A facet in the plane; of a first-order one also u = c_0 + c_1 xi + c_2 eta + c_3 xi eta.
struct Flat {
  cell::CellType type = cell::CellType::quad4;
  int count = 0;
  Points2 u;
  std::array<Vec2, 4> c;

  void set(const Points2& points) {
    u = points;
    if (type == cell::CellType::tri3)
      c = {u[0], u[1] - u[0], u[2] - u[0], Vec2::Zero()};
    else
      c = {0.25 * (u[0] + u[1] + u[2] + u[3]), 0.25 * (u[1] + u[2] - u[0] - u[3]),
           0.25 * (u[2] + u[3] - u[0] - u[1]), 0.25 * (u[0] + u[2] - u[1] - u[3])};
  }
};

/// A place on a facet with the first derivatives of its plane coordinates.
struct Place {
  cell::FacetShape shape;
  Mat<2, 2> jacobian, inverse;
};

void set_place(const Flat& facet, const Vec2& xi, int order, Place& out) {
  if (facet.type == cell::CellType::quad4)
    cell::set_bilinear(xi, out.shape);
  else
    out.shape = cell::facet_shape(facet.type, xi, order);
  out.jacobian.setZero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    for (std::size_t i = 0; i < 2; ++i)
      out.jacobian.col(static_cast<I>(i)) += out.shape.n[1 + i][k] * facet.u[k];
}

/// What is missing from the place at xi to point `p`, and the derivatives of the place.
Vec2 miss_at(const Flat& facet, const Vec2& p, const Vec2& xi, Place& work, Mat<2, 2>& jacobian) {
  if (cell::is_linear_facet(facet.type)) {
    const std::array<Vec2, 4>& c = facet.c;
    jacobian << c[1] + xi.y() * c[3], c[2] + xi.x() * c[3];
    return p - c[0] - xi.x() * c[1] - xi.y() * (c[2] + xi.x() * c[3]);
  }
  set_place(facet, xi, 1, work);
  jacobian = work.jacobian;
  Vec2 miss = p;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    miss -= work.shape.n[0][k] * facet.u[k];
  return miss;
}

/// The place over point `p` of the plane: Newton's method from `start`.
bool find_place(const Flat& facet, const Vec2& p, const Vec2& start, Place& out) {
  Vec2 xi = start;
  for (int i = 0; i < 30; ++i) {
    Mat<2, 2> jacobian;
    const Vec2 miss = miss_at(facet, p, xi, out, jacobian);
    const double det = jacobian.determinant();
    if (!(std::abs(det) > 0)) return false;
    const Vec2 step = jacobian.inverse() * miss;
    xi += step;
    if (!xi.allFinite() || xi.cwiseAbs().maxCoeff() > 10) return false;
    if (step.cwiseAbs().maxCoeff() > 1e-13) continue;
    set_place(facet, xi, 2, out);
    out.inverse = out.jacobian.inverse();
    return out.inverse.allFinite();
  }
  return false;
}

// ---- integration --------------------------------------------------------------------------------

constexpr int most_rows = cell::max_facet_nodes * cell::max_facet_nodes;
/// Derivatives of the integrals by the plane's coordinates.
using FlatRates = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_rows, most_columns>;

/// One overlap: both facets in the plane of a linear piece of the slave.
struct Work {
  Flat slave, master;
  Points3 slave_x, master_x,
      measured;  ///< `measured`: positions of the area that is integrated over
  bool current = false, derivatives = false;
  Plane plane;
  Vec2 slave_start, master_start;
  const cell::Quadrature2D* rule = nullptr;
  MortarCell<3>* cell = nullptr;
  Place on_slave, on_master;  ///< of the point
  FlatRates de, df;
  double way = 0, area = 0, flat_area = 0;
  [[nodiscard]] I columns() const { return 2 * (slave.count + master.count); }
};

/// Where the pieces' corners are among all columns.
struct Corners {
  std::array<I, 8> column{};
  void scatter(const Vec<corner_variables>& d, double factor, Rows& rows, I row) const {
    for (std::size_t k = 0; k < column.size(); ++k)
      if (column[k] >= 0)
        rows.template block<1, 2>(row, column[k]) +=
            factor * d.segment<2>(2 * static_cast<I>(k)).transpose();
  }
};

PlanePoint<double> corner(const Vec2& p, int, double) { return {p.x(), p.y()}; }
PlanePoint<Variables> corner(const Vec2& p, int first, const Variables&) {
  return {Variables::variable(p.x(), first), Variables::variable(p.y(), first + 1)};
}

/// A piece in the plane; the master's, seen from its other side, is run through backwards.
template <class T>
Polygon<T> polygon(const Flat& facet, const Piece& piece, bool master) {
  Polygon<T> out;
  const std::size_t n = corners_of(piece);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t c = master ? n - 1 - k : k;
    out.add(corner(facet.u[static_cast<std::size_t>(piece[c])],
                   2 * static_cast<int>(c) + (master ? 8 : 0), T{}));
  }
  return out;
}

/// Area of the slave per area of the plane, and its logarithm's derivatives by xi.
struct Stretch {
  double value;
  Vec2 d_xi = Vec2::Zero();
  Vec3 first, second;  ///< d(area per xi) / d(r_,1) and d(r_,2), over that area
};

Stretch stretch_of(const Work& w, const Place& place) {
  std::array<Vec3, 5> r;
  r.fill(Vec3::Zero());
  Vec2 second[3] = {Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  for (std::size_t k = 0; k < static_cast<std::size_t>(w.slave.count); ++k) {
    for (std::size_t d = 0; d < 5; ++d) r[d] += place.shape.n[1 + d][k] * w.measured[k];
    for (std::size_t d = 0; d < 3; ++d) second[d] += place.shape.n[3 + d][k] * w.slave.u[k];
  }
  const Vec3 across = r[0].cross(r[1]);
  const double area = across.norm();
  Stretch s;
  s.value = area / place.jacobian.determinant();
  s.first = r[1].cross(across) / (area * area);
  s.second = across.cross(r[0]) / (area * area);
  for (std::size_t i = 0; i < 2; ++i) {
    Mat<2, 2> d_jacobian;
    d_jacobian << second[i], second[i + 1];
    s.d_xi[static_cast<I>(i)] =
        s.first.dot(r[2 + i]) + s.second.dot(r[3 + i]) - (place.inverse * d_jacobian).trace();
  }
  return s;
}

/// to += of * rates: with the sizes of two quad4, which are those of most facets, known.
template <int Terms>
void add_terms(const Eigen::Matrix<double, Eigen::Dynamic, Terms, 0, most_rows, Terms>& of,
               const Rows& rates, FlatRates& to) {
  if (of.rows() == 16 && rates.cols() == 16)
    Eigen::Map<Mat<16, 16>>(to.data()) += Eigen::Map<const Mat<16, Terms>>(of.data()).lazyProduct(
        Eigen::Map<const Mat<5, 16>>(rates.data()).template topRows<Terms>());
  else
    to += of.lazyProduct(rates.template topRows<Terms>());
}

/// Adds to the derivatives: coefficient matrices of (weight, xi, eta) times their rows.
void add_rates(Work& w, const Place& s, const Place& m, double weight, const Rows& rates) {
  const I n = w.slave.count, l = w.master.count;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 81, 3> of_e(n * n, 3);
  Eigen::Matrix<double, Eigen::Dynamic, 5, 0, 81, 5> of_f(n * l, 5);
  const auto at = [](I i) { return static_cast<std::size_t>(i); };
  for (I j = 0; j < n; ++j) {
    const double nj = s.shape.n[0][at(j)];
    const double n1 = weight * s.shape.n[1][at(j)], n2 = weight * s.shape.n[2][at(j)];
    for (I k = 0; k < n; ++k) {
      const auto& t = s.shape.n;
      of_e.row(j + n * k) << nj * t[0][at(k)], n1 * t[0][at(k)] + weight * nj * t[1][at(k)],
          n2 * t[0][at(k)] + weight * nj * t[2][at(k)];
    }
    for (I k = 0; k < l; ++k) {
      const auto& t = m.shape.n;
      of_f.row(j + n * k) << nj * t[0][at(k)], n1 * t[0][at(k)], n2 * t[0][at(k)],
          weight * nj * t[1][at(k)], weight * nj * t[2][at(k)];
    }
  }
  add_terms<3>(of_e, rates, w.de);
  add_terms<5>(of_f, rates, w.df);
}

/// Of the current area also by the positions in space.
void add_area_rates(Work& w, const Place& s, const Place& m, double weight,
                    const Stretch& stretch) {
  const I n = w.slave.count, l = w.master.count;
  const auto at = [](I i) { return static_cast<std::size_t>(i); };
  Sheet::View de = w.cell->de.view(), df = w.cell->df.view();
  for (I c = 0; c < n; ++c) {
    const Eigen::RowVector3d rate =
        weight * (s.shape.n[1][at(c)] * stretch.first + s.shape.n[2][at(c)] * stretch.second);
    for (I j = 0; j < n; ++j) {
      for (I k = 0; k < n; ++k)
        de.block<1, 3>(j + n * k, 3 * c) += s.shape.n[0][at(j)] * s.shape.n[0][at(k)] * rate;
      for (I k = 0; k < l; ++k)
        df.block<1, 3>(j + n * k, 3 * c) += s.shape.n[0][at(j)] * m.shape.n[0][at(k)] * rate;
    }
  }
}

/// Rows of the place's coordinates: J^-1 (dp - sum N_k du_k).
void set_place_rows(const Flat& facet, const Place& place, I first, Rows& rows, I row,
                    const Rows& of_point) {
  rows.middleRows<2>(row) = place.inverse * of_point.topRows<2>();
  for (I k = 0; k < facet.count; ++k)
    rows.block<2, 2>(row, first + 2 * k) -=
        place.shape.n[0][static_cast<std::size_t>(k)] * place.inverse;
}

struct TriangleRates {
  Rows point[3];  ///< of the corners, first two rows
  Rows area;      ///< first row: of log(area)
};

/// Rows of (weight, xi, eta) at one Gauss point.
Rows point_rates(const Work& w, const TriangleRates& t, const Vec3& corner_weights, const Place& s,
                 const Place& m, double weight, const Stretch& stretch) {
  Rows of_point = corner_weights[0] * t.point[0] + corner_weights[1] * t.point[1] +
                  corner_weights[2] * t.point[2];
  Rows rates = Rows::Zero(5, w.columns());
  set_place_rows(w.slave, s, 0, rates, 1, of_point);
  set_place_rows(w.master, m, 2 * w.slave.count, rates, 3, of_point);
  rates.row(0) = t.area.row(0) + stretch.d_xi.transpose() * rates.middleRows<2>(1);
  for (I k = 0; k < w.slave.count; ++k) {  // -d(log det J) at fixed xi
    const auto i = static_cast<std::size_t>(k);
    rates.block<1, 2>(0, 2 * k) -=
        (s.shape.n[1][i] * s.inverse.row(0) + s.shape.n[2][i] * s.inverse.row(1));
  }
  rates.row(0) *= weight;
  return rates;
}

bool add_point(Work& w, const Vec2& p, double weight, const Vec3& corner_weights,
               const TriangleRates* rates) {
  Place &s = w.on_slave, &m = w.on_master;
  if (!find_place(w.slave, p, w.slave_start, s) || !find_place(w.master, p, w.master_start, m))
    return false;
  const Stretch stretch = stretch_of(w, s);
  const double area = weight * stretch.value;
  if (!std::isfinite(area)) return false;
  const I n = w.slave.count, l = w.master.count;
  const auto at = [](I i) { return static_cast<std::size_t>(i); };
  Vec3 way = Vec3::Zero();
  for (I j = 0; j < n; ++j) {
    const double part = area * s.shape.n[0][at(j)];
    for (I k = 0; k < n; ++k) w.cell->e(j, k) += part * s.shape.n[0][at(k)];
    for (I k = 0; k < l; ++k) w.cell->f(j, k) += part * m.shape.n[0][at(k)];
    way -= s.shape.n[0][at(j)] * w.slave_x[at(j)];
  }
  for (I k = 0; k < l; ++k) way += m.shape.n[0][at(k)] * w.master_x[at(k)];
  w.way += area * w.plane.normal.dot(way);
  w.area += area;
  if (!rates) return true;
  add_rates(w, s, m, area, point_rates(w, *rates, corner_weights, s, m, area, stretch));
  if (w.current) add_area_rates(w, s, m, area, stretch);
  return true;
}

void set_rates(const PlanePoint<double>&, const Corners&, Rows&) {}
void set_rates(const PlanePoint<Variables>& p, const Corners& corners, Rows& rows) {
  corners.scatter(p.x.d, 1, rows, 0);
  corners.scatter(p.y.d, 1, rows, 1);
}
void set_log_rate(double, const Corners&, Rows&) {}
void set_log_rate(const Variables& area, const Corners& corners, Rows& rows) {
  corners.scatter(area.d, 1 / area.v, rows, 0);
}

template <class T>
bool add_polygon(Work& w, const Polygon<T>& polygon, const Corners& corners) {
  TriangleRates rates;
  for (std::size_t k = 1; k + 1 < polygon.count; ++k) {
    const std::array<PlanePoint<T>, 3> c{polygon.corners[0], polygon.corners[k],
                                         polygon.corners[k + 1]};
    const T twice = cross(c[1] - c[0], c[2] - c[0]);
    const double area = core::value(twice);
    if (!(area > 0)) continue;
    if (w.derivatives) {
      for (std::size_t i = 0; i < 3; ++i) {
        rates.point[i].setZero(5, w.columns());
        set_rates(c[i], corners, rates.point[i]);
      }
      rates.area.setZero(5, w.columns());
      set_log_rate(twice, corners, rates.area);
    }
    for (std::size_t q = 0; q < w.rule->points.size(); ++q) {
      const Vec2& at = w.rule->points[q];
      const Vec3 weights(1 - at.x() - at.y(), at.x(), at.y());
      Vec2 p = Vec2::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        p += weights[static_cast<I>(i)] * Vec2(core::value(c[i].x), core::value(c[i].y));
      if (!add_point(w, p, w.rule->weights[q] * area, weights, w.derivatives ? &rates : nullptr))
        return false;
    }
  }
  return true;
}

/// Common part of a piece of the slave and one of the master; empty where they do not face each
/// other.
template <class T>
Polygon<T> overlap_of(const Work& w, const Piece& slave, const Piece& master) {
  const Polygon<T> own = polygon<T>(w.slave, slave, false),
                   other = polygon<T>(w.master, master, true);
  if (!(area_of(other) > 0)) return {};
  constexpr double rounding = 1e-10;
  return common_part(other, own, rounding * std::sqrt(area_of(own)));
}

template <class T>
bool add_pieces(Work& w, const Piece& slave, const Piece& master) {
  // Most facets that are near do not overlap, and derivatives cost many times the numbers.
  if (w.derivatives && overlap_of<double>(w, slave, master).count < 3) return true;
  const Polygon<T> common = overlap_of<T>(w, slave, master);
  if (common.count < 3) return true;
  Corners corners;
  corners.column.fill(-1);
  for (std::size_t k = 0; k < corners_of(slave); ++k) corners.column[k] = 2 * slave[k];
  for (std::size_t k = 0; k < corners_of(master); ++k)
    corners.column[4 + k] = 2 * (w.slave.count + master[k]);
  w.slave_start = middle_of(w.slave.type, slave);
  w.master_start = middle_of(w.master.type, master);
  w.flat_area += area_of(common);
  return add_polygon(w, common, corners);
}

/// From the plane's coordinates u_k = E^T (x_k - x_0) to positions in space:
/// du_k = E^T dx_k - h_k E^T dn, h_k = n . (x_k - x_0).
void to_space(const Work& w, const Piece& piece, const FlatRates& flat_rates, Sheet::View out) {
  const Mat<2, 3> across = w.plane.frame.transpose();
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 81, 3> turning(flat_rates.rows(), 3);
  turning.setZero();
  for (I k = 0; k < w.slave.count + w.master.count; ++k) {
    const bool own = k < w.slave.count;
    const auto i = static_cast<std::size_t>(own ? k : k - w.slave.count);
    const Vec3& x = own ? w.slave_x[i] : w.master_x[i];
    const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 81, 3> part =
        flat_rates.middleCols<2>(2 * k) * across;
    out.middleCols<3>(3 * k) += part;
    turning -= w.plane.normal.dot(x - w.plane.origin) * part;
  }
  for (std::size_t c = 0; c < corners_of(piece); ++c)
    out.middleCols<3>(3 * piece[c]) += turning * w.plane.d_normal[c];
}

bool add_slave_piece(Work& w, const Piece& piece, std::span<const Piece> master, double& whole) {
  if (!plane_of(piece, w.slave_x, w.plane)) return true;
  w.slave.set(flat(w.plane, w.slave_x, w.slave.count));
  w.master.set(flat(w.plane, w.master_x, w.master.count));
  whole += area_of(polygon<double>(w.slave, piece, false));
  if (w.derivatives) {
    w.de.setZero(w.slave.count * w.slave.count, w.columns());
    w.df.setZero(w.slave.count * w.master.count, w.columns());
  }
  const double before = w.flat_area;
  for (const Piece& other : master)
    if (!(w.derivatives ? add_pieces<Variables>(w, piece, other)
                        : add_pieces<double>(w, piece, other)))
      return false;
  if (!w.derivatives || w.flat_area == before) return true;
  to_space(w, piece, w.de, w.cell->de.view());
  to_space(w, piece, w.df, w.cell->df.view());
  return true;
}

Points3 positions(const SurfaceFacet& facet, std::span<const Vec3> x) {
  Points3 out;
  out.fill(Vec3::Zero());
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    out[k] = x[static_cast<std::size_t>(facet.nodes[k])];
  return out;
}

void set_nodes(const SurfaceFacet& slave, const SurfaceFacet& master, MortarCell<3>& cell) {
  cell.nodes.assign(slave.nodes.begin(), slave.nodes.begin() + slave.count);
  cell.nodes.insert(cell.nodes.end(), master.nodes.begin(), master.nodes.begin() + master.count);
  const I columns = 3 * (slave.count + master.count);
  cell.de.set_zero(slave.count * slave.count, columns);
  cell.df.set_zero(slave.count * master.count, columns);
}

}  // namespace

bool mortar_cell(const MortarSides<3>& sides, Index s, std::span<const std::size_t>, Index m,
                 std::span<const Vec3> x, bool derivatives, MortarCell<3>& cell) {
  const SurfaceFacet& slave = sides.slave->facets[static_cast<std::size_t>(s)];
  const SurfaceFacet& master = sides.master->facets[static_cast<std::size_t>(m)];
  Work w;
  w.slave.type = slave.type;
  w.slave.count = slave.count;
  w.master.type = master.type;
  w.master.count = master.count;
  w.slave_x = positions(slave, x);
  w.master_x = positions(master, x);
  w.current = sides.measure.current;
  w.derivatives = derivatives;
  const Points3 reference = positions(slave, sides.measure.reference);
  w.measured = w.current ? w.slave_x : reference;
  w.rule =
      &mortar_rule(slave.type, reference, master.type, positions(master, sides.measure.reference));
  w.cell = &cell;
  cell.master = m;
  cell.e.setZero(slave.count, slave.count);
  cell.f.setZero(slave.count, master.count);
  if (derivatives) set_nodes(slave, master, cell);
  double whole = 0;
  for (const Piece& piece : pieces_of(slave.type))
    if (!add_slave_piece(w, piece, pieces_of(master.type), whole)) return false;
  if (!(w.area > 0)) return false;
  cell.distance = w.way / w.area;
  cell.cover = w.flat_area / whole;
  return true;
}

}  // namespace osculate::pairing

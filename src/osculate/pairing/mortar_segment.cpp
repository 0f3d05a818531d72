// Overlap of a slave line with a master line in the plane.
#include <algorithm>
#include <cmath>

#include "osculate/cell/quadrature.hpp"
#include "osculate/core/dual.hpp"
#include "osculate/pairing/mortar_cell.hpp"

namespace osculate::pairing {
namespace {

using core::chain;
using core::value;

constexpr std::size_t most = max_mortar_line;
/// Variables: positions of the slave's nodes, their normals, positions of the master's nodes.
using Variables = core::Dual<6 * max_mortar_line>;

template <class T>
struct Point {
  T x{}, y{};
  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(const T& s, const Point& a) { return {s * a.x, s * a.y}; }
};
template <class T>
T dot(const Point<T>& a, const Point<T>& b) {
  return a.x * b.x + a.y * b.y;
}
/// A quarter turn clockwise: a normal becomes the direction of travel.
template <class T>
Point<T> back(const Point<T>& n) {
  return {n.y, -n.x};
}

template <class T>
using Values = std::array<T, most>;
template <class T>
using Line = std::array<Point<T>, most>;

/// Shape functions (`order` 0) or their derivatives at xi.
template <class T>
Values<T> shape_at(int count, const T& xi, std::size_t order) {
  const cell::LineShape s = cell::lagrange_line(count, value(xi));
  Values<T> n{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    n[k] = chain(xi, s.n[order][k], s.n[order + 1][k]);
  return n;
}
template <class T>
Point<T> sum(int count, const Values<T>& n, const Line<T>& at) {
  Point<T> r{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) r = r + n[k] * at[k];
  return r;
}
template <class T>
Point<T> point_at(int count, const Line<T>& at, const T& xi, std::size_t order = 0) {
  return sum(count, shape_at(count, xi, order), at);
}

template <class T>
struct Both {
  int slave_count = 0, master_count = 0;
  Line<T> slave, normal, master, reference;
};

template <class T>
Line<double> values(const Line<T>& line) {
  Line<double> out;
  for (std::size_t k = 0; k < most; ++k) out[k] = {value(line[k].x), value(line[k].y)};
  return out;
}
template <class T>
Both<double> values(const Both<T>& b) {
  return {b.slave_count,    b.master_count,   values(b.slave),
          values(b.normal), values(b.master), values(b.reference)};
}

/// The value of a function at a place and its derivative there.
struct Sample {
  double value, slope;
};

/// Root of a function with opposite signs at both ends: Newton, kept inside by bisection.
template <class F>
double root(const F& f, double a, double b) {
  const bool rising = f(a).value < 0;
  double at = 0.5 * (a + b);
  for (int i = 0; i < 100; ++i) {
    const Sample s = f(at);
    if (s.value == 0) return at;
    ((s.value < 0) == rising ? a : b) = at;
    double next = at - s.value / s.slope;
    if (!(next > std::min(a, b) && next < std::max(a, b))) next = 0.5 * (a + b);
    if (std::abs(next - at) <= 4e-16) return next;
    at = next;
  }
  return at;
}

/// How far master point `p` lies ahead of the slave's point at xi along the slave, seen along the
/// field of normals there.
Sample ahead(const Both<double>& b, const Point<double>& p, double xi) {
  const Point<double> n = point_at(b.slave_count, b.normal, xi),
                      n1 = point_at(b.slave_count, b.normal, xi, 1),
                      r1 = point_at(b.slave_count, b.slave, xi, 1),
                      way = p - point_at(b.slave_count, b.slave, xi);
  return {dot(back(n), way), dot(back(n1), way) - dot(back(n), r1)};
}

/// Place on the slave from which master node `l` is seen along the field of normals; the slave's
/// end where it lies beyond it.
template <class T>
T end_on_slave(const Both<T>& b, const Both<double>& v, std::size_t l) {
  const auto f = [&](double xi) { return ahead(v, v.master[l], xi); };
  if (f(-1).value <= 0) return T(-1);
  if (f(1).value >= 0) return T(1);
  const double xi = root(f, -1, 1);
  const T fixed(xi);
  const Point<T> n = point_at(b.slave_count, b.normal, fixed);
  const T residual = dot(back(n), b.master[l] - point_at(b.slave_count, b.slave, fixed));
  return core::implicit_root(xi, residual, f(xi).slope);
}

/// Place on the master that is seen from the slave's place xi along the field of normals.
template <class T>
T place_on_master(const Both<T>& b, const Both<double>& v, const T& xi) {
  const double at = value(xi);
  const Point<double> along = back(point_at(v.slave_count, v.normal, at)),
                      from = point_at(v.slave_count, v.slave, at);
  const auto f = [&](double eta) {
    return Sample{dot(along, point_at(v.master_count, v.master, eta) - from),
                  dot(along, point_at(v.master_count, v.master, eta, 1))};
  };
  const double first = f(-1).value, last = f(1).value;
  // Beyond an end by rounding, or over a strongly curved facet: the nearer end.
  if ((first > 0) == (last > 0)) return T(std::abs(first) < std::abs(last) ? -1 : 1);
  const double eta = root(f, -1, 1);
  const T residual =
      dot(back(point_at(b.slave_count, b.normal, xi)),
          point_at(b.master_count, b.master, T(eta)) - point_at(b.slave_count, b.slave, xi));
  return core::implicit_root(eta, residual, f(eta).slope);
}

template <class T>
struct Integrals {
  std::array<T, most * most> e{}, f{};
  double way = 0, area = 0, cover = 0;
};

/// Length of slave per xi, times thickness or circumference.
template <class T>
T speed(const Both<T>& b, const MortarMeasure<2>& measure, const T& xi) {
  const Line<T>& line = measure.current ? b.slave : b.reference;
  const Point<T> r1 = point_at(b.slave_count, line, xi, 1);
  const T length = sqrt(dot(r1, r1));
  if (!measure.area.axisymmetric) return measure.area.thickness * length;
  return (2 * std::numbers::pi) * (point_at(b.slave_count, line, xi).x * length);
}

template <class T>
void add_point(const Both<T>& b, const Both<double>& v, const MortarMeasure<2>& measure,
               const T& xi, const T& weight, Integrals<T>& sum) {
  const T eta = place_on_master(b, v, xi);
  const Values<T> s = shape_at(b.slave_count, xi, 0), m = shape_at(b.master_count, eta, 0);
  const T w = weight * speed(b, measure, xi);
  for (std::size_t j = 0; j < static_cast<std::size_t>(b.slave_count); ++j) {
    const T part = w * s[j];
    for (std::size_t k = 0; k < static_cast<std::size_t>(b.slave_count); ++k)
      sum.e[j + most * k] += part * s[k];
    for (std::size_t l = 0; l < static_cast<std::size_t>(b.master_count); ++l)
      sum.f[j + most * l] += part * m[l];
  }
  const double at = value(xi), area = value(w);
  const Point<double> n = point_at(v.slave_count, v.normal, at);
  const Point<double> way =
      point_at(v.master_count, v.master, value(eta)) - point_at(v.slave_count, v.slave, at);
  sum.way += area * dot(n, way);
  sum.area += area;
}

/// Points for two straight lines in parallel, where the integrands are polynomials of degree 2, and
/// for all others.
const cell::Quadrature1D& rule_of(int slave, int master) {
  static const cell::Quadrature1D straight = cell::gauss_legendre(3),
                                  curved = cell::gauss_legendre(8);
  return slave == 2 && master == 2 ? straight : curved;
}

template <class T>
bool integrate(const Both<T>& b, const MortarMeasure<2>& measure, Integrals<T>& out) {
  const Both<double> v = values(b);
  const T first = end_on_slave(b, v, 1), last = end_on_slave(b, v, 0);  // they face each other
  constexpr double nothing = 1e-9;
  if (!(value(last) - value(first) > nothing)) return false;
  const T half = 0.5 * (last - first), middle = 0.5 * (first + last);
  const cell::Quadrature1D& rule = rule_of(b.slave_count, b.master_count);
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    add_point(b, v, measure, T(middle + rule.points[q] * half), T(rule.weights[q] * half), out);
  out.cover = value(half);
  return out.area > 0;
}

template <class T>
Point<T> constant(const Vec2& p) {
  return {T(p.x()), T(p.y())};
}
/// The two variables from number `first` on; for numbers just their values.
Point<double> variable(const Vec2& p, std::size_t, double) { return {p.x(), p.y()}; }
Point<Variables> variable(const Vec2& p, std::size_t first, const Variables&) {
  const auto i = static_cast<int>(first);
  return {Variables::variable(p.x(), i), Variables::variable(p.y(), i + 1)};
}

template <class T>
Both<T> lines(const MortarSides<2>& sides, const Facet& slave, std::span<const std::size_t> local,
              const Facet& master, std::span<const Vec2> x) {
  Both<T> b;
  b.slave_count = slave.count;
  b.master_count = master.count;
  const auto at = [](Index n) { return static_cast<std::size_t>(n); };
  for (std::size_t k = 0; k < at(slave.count); ++k) {
    b.slave[k] = variable(x[at(slave.nodes[k])], 2 * k, T{});
    b.normal[k] = variable(sides.normals[local[k]].value, 2 * (most + k), T{});
    b.reference[k] = constant<T>(sides.measure.reference[at(slave.nodes[k])]);
  }
  for (std::size_t l = 0; l < at(master.count); ++l)
    b.master[l] = variable(x[at(master.nodes[l])], 2 * (2 * most + l), T{});
  return b;
}

/// One link from the position of a node to the variables.
struct Link {
  Eigen::Index column, variable;  ///< first of two each
  Mat<2, 2> value;                ///< d(variable)/d(position)
};

/// Calls `use` with every link; `nodes` is extended by what is new.
template <class Use>
void for_each_link(const MortarSides<2>& sides, const Facet& slave,
                   std::span<const std::size_t> local, const Facet& master,
                   std::vector<Index>& nodes, const Use& use) {
  const auto offer = [&](Index node, std::size_t variable, const Mat<2, 2>& value) {
    use(Link{static_cast<Eigen::Index>(2 * slot_of(nodes, node)),
             static_cast<Eigen::Index>(2 * variable), value});
  };
  const Mat<2, 2> unit = Mat<2, 2>::Identity();
  for (std::size_t k = 0; k < static_cast<std::size_t>(slave.count); ++k)
    offer(slave.nodes[k], k, unit);
  for (std::size_t l = 0; l < static_cast<std::size_t>(master.count); ++l)
    offer(master.nodes[l], 2 * most + l, unit);
  for (std::size_t k = 0; k < static_cast<std::size_t>(slave.count); ++k)
    for (const NodeMatrix<2>& g : sides.normals[local[k]].gradient)
      offer(g.node, most + k, g.value);
}

void set_values(const Both<double>& b, const Integrals<double>& sum, MortarCell<2>& cell) {
  const auto n = static_cast<std::size_t>(b.slave_count),
             m = static_cast<std::size_t>(b.master_count);
  cell.e.resize(b.slave_count, b.slave_count);
  cell.f.resize(b.slave_count, b.master_count);
  for (std::size_t j = 0; j < n; ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    for (std::size_t k = 0; k < n; ++k)
      cell.e(row, static_cast<Eigen::Index>(k)) = sum.e[j + most * k];
    for (std::size_t l = 0; l < m; ++l)
      cell.f(row, static_cast<Eigen::Index>(l)) = sum.f[j + most * l];
  }
  cell.distance = sum.way / sum.area;
  cell.cover = sum.cover;
}

void add_derivatives(const std::array<Variables, most * most>& from, std::size_t rows,
                     std::size_t columns, const Link& by, Sheet::View to) {
  for (std::size_t k = 0; k < columns; ++k)
    for (std::size_t j = 0; j < rows; ++j)
      to.block<1, 2>(static_cast<Eigen::Index>(j + rows * k), by.column) +=
          from[j + most * k].d.segment<2>(by.variable).transpose() * by.value;
}

}  // namespace

std::size_t slot_of(std::vector<Index>& nodes, Index node) {
  const auto found = std::find(nodes.begin(), nodes.end(), node);
  const auto slot = static_cast<std::size_t>(found - nodes.begin());
  if (found == nodes.end()) nodes.push_back(node);
  return slot;
}

bool mortar_cell(const MortarSides<2>& sides, Index s, std::span<const std::size_t> local, Index m,
                 std::span<const Vec2> x, bool derivatives, MortarCell<2>& cell) {
  const Facet& slave = sides.slave->facets[static_cast<std::size_t>(s)];
  const Facet& master = sides.master->facets[static_cast<std::size_t>(m)];
  cell.master = m;
  const Both<double> numbers = lines<double>(sides, slave, local, master, x);
  Integrals<double> sum;
  if (!integrate(numbers, sides.measure, sum)) return false;
  set_values(numbers, sum, cell);
  if (!derivatives) return true;
  Integrals<Variables> rates;
  if (!integrate(lines<Variables>(sides, slave, local, master, x), sides.measure, rates))
    return false;
  cell.nodes.clear();
  for_each_link(sides, slave, local, master, cell.nodes, [](const Link&) {});
  const auto n = static_cast<std::size_t>(slave.count), l = static_cast<std::size_t>(master.count);
  const auto columns = static_cast<Eigen::Index>(2 * cell.nodes.size());
  cell.de.set_zero(static_cast<Eigen::Index>(n * n), columns);
  cell.df.set_zero(static_cast<Eigen::Index>(n * l), columns);
  for_each_link(sides, slave, local, master, cell.nodes, [&](const Link& by) {
    add_derivatives(rates.e, n, n, by, cell.de.view());
    add_derivatives(rates.f, n, l, by, cell.df.view());
  });
  return true;
}

}  // namespace osculate::pairing

#include "osculate/projection/piece.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/projection/bernstein.hpp"

namespace osculate::projection {
namespace {

using Row = std::array<double, max_piece_degree + 1>;

/// Bernstein polynomials of a degree and their first two derivatives.
struct Basis {
  std::array<Row, 3> b{};
};

void raise(int degree, double x, Row& row) {  // degree - 1 -> degree
  row[static_cast<std::size_t>(degree)] = 0;
  for (int i = degree; i > 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    row[k] = (1 - x) * row[k] + x * row[k - 1];
  }
  row[0] *= 1 - x;
}

/// d/dx of degree `degree` from the values of degree - 1.
void differentiate(int degree, const Row& lower, Row& out) {
  for (int i = 0; i <= degree; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out[k] = degree * ((i > 0 ? lower[k - 1] : 0.0) - (i < degree ? lower[k] : 0.0));
  }
}

Basis basis(int degree, double x) {
  Basis out;
  Row row{};
  row[0] = 1;
  Row one_less{}, two_less{};
  for (int d = 1; d <= degree; ++d) {
    two_less = one_less;
    one_less = row;
    raise(d, x, row);
  }
  out.b[0] = row;
  if (degree > 0) differentiate(degree, one_less, out.b[1]);
  if (degree > 1) {
    Row first{};
    differentiate(degree - 1, two_less, first);
    differentiate(degree, first, out.b[2]);
  }
  return out;
}

template <int Dim>
Vec<Dim> euclidean(const ControlPoint<Dim>& c) {
  return c.template head<Dim>() / c[Dim];
}

/// A direction for every Bernstein coefficient of dr/ds times a positive function (s direction).
/// For weights: X_s w - X w_s, of degree 2 p - 1 in s and 2 q in t.
template <int Dim>
void tangent_directions(Control<Dim> control, const std::array<int, 2>& degree, int direction,
                        bool rational, std::vector<Vec<Dim>>& out) {
  const int p = degree[0], q = degree[1];
  const auto at = [&](int i, int j) -> const ControlPoint<Dim>& {
    return control[static_cast<std::size_t>(i * (q + 1) + j)];
  };
  const std::array<int, 2> less{direction == 0 ? p - 1 : p, direction == 0 ? q : q - 1};
  const auto step = [&](int i, int j) -> ControlPoint<Dim> {
    return (direction == 0 ? at(i + 1, j) : at(i, j + 1)) - at(i, j);
  };
  out.clear();
  if (!rational) {
    for (int i = 0; i <= less[0]; ++i)
      for (int j = 0; j <= less[1]; ++j) out.push_back(step(i, j).template head<Dim>());
    return;
  }
  const std::array<int, 2> sum{less[0] + p, less[1] + q};
  out.assign(static_cast<std::size_t>((sum[0] + 1) * (sum[1] + 1)), Vec<Dim>::Zero());
  for (int i = 0; i <= less[0]; ++i)
    for (int j = 0; j <= less[1]; ++j) {
      const ControlPoint<Dim> d = step(i, j);
      const double left = binomial(less[0], i) * binomial(less[1], j);
      for (int k = 0; k <= p; ++k)
        for (int l = 0; l <= q; ++l) {
          const ControlPoint<Dim>& c = at(k, l);
          const Vec<Dim> term = d.template head<Dim>() * c[Dim] - c.template head<Dim>() * d[Dim];
          out[static_cast<std::size_t>((i + k) * (sum[1] + 1) + j + l)] +=
              left * binomial(p, k) * binomial(q, l) * term;
        }
    }
}

template <int Dim>
double angle_between(const Vec<Dim>& a, const Vec<Dim>& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

template <int Dim>
Cone<Dim> cone_of(const std::vector<Vec<Dim>>& directions) {
  double largest = 0;
  for (const Vec<Dim>& d : directions) largest = std::max(largest, d.norm());
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  const double least = 1e-14 * largest;  // shorter ones are rounding errors of zero
  Cone<Dim> cone;
  cone.axis.setZero();
  for (const Vec<Dim>& d : directions)
    if (d.norm() > least) cone.axis += d.normalized();
  if (!(cone.axis.norm() > 1e-6)) return {};
  cone.axis.normalize();
  cone.angle = 1e-12;
  for (const Vec<Dim>& d : directions)
    if (d.norm() > least)
      cone.angle = std::max(cone.angle, angle_between<Dim>(d.normalized(), cone.axis) + 1e-12);
  return cone;
}

Cone<3> triangle_cone(Control<3> control) {
  const Vec3 a = control[0].head<3>(), b = control[1].head<3>(), c = control[2].head<3>();
  const Vec3 n = (b - a).cross(c - a);
  Cone<3> cone;
  if (!(n.norm() > 1e-12 * (b - a).norm() * (c - a).norm()) || !std::isfinite(n.norm()))
    return cone;
  cone.axis = n.normalized();
  cone.angle = 1e-10;
  return cone;
}

}  // namespace

template <int Dim>
PieceJet<Dim> jet(const Piece<Dim>& piece, Control<Dim> control, const Vec2& st) {
  const int p = piece.degree[0], q = piece.degree[1];
  const Basis bs = basis(p, st[0]), bt = basis(q, st[1]);
  std::array<ControlPoint<Dim>, 6> sum;  // value; s, t; ss, st, tt
  for (ControlPoint<Dim>& one : sum) one.setZero();
  const ControlPoint<Dim>* c = control.data();
  for (std::size_t i = 0; i <= static_cast<std::size_t>(p); ++i) {
    ControlPoint<Dim> row = ControlPoint<Dim>::Zero(), row_t = row, row_tt = row;
    for (std::size_t j = 0; j <= static_cast<std::size_t>(q); ++j, ++c) {
      row += bt.b[0][j] * *c;
      row_t += bt.b[1][j] * *c;
      row_tt += bt.b[2][j] * *c;
    }
    sum[0] += bs.b[0][i] * row;
    sum[1] += bs.b[1][i] * row;
    sum[2] += bs.b[0][i] * row_t;
    sum[3] += bs.b[2][i] * row;
    sum[4] += bs.b[1][i] * row_t;
    sum[5] += bs.b[0][i] * row_tt;
  }
  PieceJet<Dim> out;
  const auto part = [&](std::size_t k) { return sum[k].template head<Dim>(); };
  const double w = sum[0][Dim];
  out.r = part(0) / w;
  if (!piece.rational) {
    out.r1 = {part(1), part(2)};
    out.r2 = {part(3), part(4), part(5)};
    return out;
  }
  const double ws = sum[1][Dim], wt = sum[2][Dim];
  out.r1[0] = (part(1) - ws * out.r) / w;
  out.r1[1] = (part(2) - wt * out.r) / w;
  out.r2[0] = (part(3) - 2 * ws * out.r1[0] - sum[3][Dim] * out.r) / w;
  out.r2[1] = (part(4) - ws * out.r1[1] - wt * out.r1[0] - sum[4][Dim] * out.r) / w;
  out.r2[2] = (part(5) - 2 * wt * out.r1[1] - sum[5][Dim] * out.r) / w;
  return out;
}

template <int Dim>
search::Box<Dim> box_of(const Piece<Dim>& piece, Control<Dim> control) {
  search::Box<Dim> box;
  for (const ControlPoint<Dim>& c : control)
    box.extend(piece.rational ? euclidean<Dim>(c) : Vec<Dim>(c.template head<Dim>()));
  return box;
}

template <int Dim>
Cone<Dim> join(const Cone<Dim>& a, const Cone<Dim>& b) {
  if (!a.narrow() || !b.narrow()) return {};
  const double between = angle_between<Dim>(a.axis, b.axis);
  if (between + b.angle <= a.angle) return a;
  if (between + a.angle <= b.angle) return b;
  const double angle = 0.5 * (a.angle + b.angle + between);
  if (!(angle < 1.5)) return {};
  const double share = (angle - a.angle) / between;  // of the way from a to b
  const double s = std::sin(between);
  Cone<Dim> out;
  out.axis =
      s > 1e-8
          ? Vec<Dim>(
                (std::sin((1 - share) * between) * a.axis + std::sin(share * between) * b.axis) / s)
          : a.axis;
  out.axis.normalize();
  out.angle = angle + 1e-12 + (s > 1e-8 ? 0 : between);
  return out;
}

template <int Dim>
Cone<Dim> normal_cone(const Piece<Dim>& piece, Control<Dim> control) {
  if constexpr (Dim == 3)
    if (piece.triangle) return triangle_cone(control);
  Cone<Dim> out;
  const std::array<int, 2> degree{piece.degree[0], piece.degree[1]};
  std::vector<Vec<Dim>> directions;
  tangent_directions<Dim>(control, degree, 0, piece.rational, directions);
  const Cone<Dim> s = cone_of<Dim>(directions);
  if constexpr (Dim == 2) {
    out = s;
    out.axis = turn(s.axis);
    return out;
  } else {
    tangent_directions<Dim>(control, degree, 1, piece.rational, directions);
    const Cone<Dim> t = cone_of<Dim>(directions);
    if (!s.narrow() || !t.narrow()) return {};
    const Vec3 cross = s.axis.cross(t.axis);
    const double across = cross.norm(), along = std::abs(s.axis.dot(t.axis));
    const double sa = std::sin(s.angle), sb = std::sin(t.angle);
    const double sine = std::sqrt(sa * sa + 2 * sa * sb * along + sb * sb);
    if (!(sine < 0.99 * across)) return {};
    out.axis = cross / across;
    out.angle = std::asin(sine / across) + 1e-10;
    return out;
  }
}

template <int Dim>
Cone<Dim> inward_cone(const Piece<Dim>& piece, Control<Dim> control, std::size_t side) {
  std::vector<Vec<Dim>> directions;
  if (piece.triangle) {
    const auto at = [&](std::size_t k) -> Vec<Dim> { return control[k % 3].template head<Dim>(); };
    return cone_of<Dim>({at(side + 2) - at(side), at(side + 2) - at(side + 1)});
  }
  tangent_directions<Dim>(control, {piece.degree[0], piece.degree[1]}, static_cast<int>(side / 2),
                          piece.rational, directions);
  Cone<Dim> cone = cone_of<Dim>(directions);
  if (side % 2 == 1) cone.axis = -cone.axis;
  return cone;
}

template <int Dim>
std::vector<ControlPoint<Dim>> side_control(const Piece<Dim>& piece, Control<Dim> control,
                                            std::size_t side) {
  const int p = piece.degree[0], q = piece.degree[1];
  const bool along_s = side >= 2 || q == 0;
  const int degree = along_s ? p : q, last = along_s ? q : p;
  const int other = side % 2 == 1 ? last : 0;
  std::vector<ControlPoint<Dim>> line;
  for (int k = 0; k <= degree; ++k)
    line.push_back(
        control[static_cast<std::size_t>(along_s ? k * (q + 1) + other : other * (q + 1) + k)]);
  return line;
}

template <int Dim>
Cone<Dim> along_cone(const Piece<Dim>& piece, Control<Dim> control, std::size_t side) {
  if (piece.triangle)
    return cone_of<Dim>({(control[(side + 1) % 3] - control[side]).template head<Dim>().eval()});
  const std::vector<ControlPoint<Dim>> line = side_control<Dim>(piece, control, side);
  std::vector<Vec<Dim>> directions;
  tangent_directions<Dim>(line, {static_cast<int>(line.size()) - 1, 0}, 0, piece.rational,
                          directions);
  return cone_of<Dim>(directions);
}

namespace {
template <int Dim>
using Points = std::vector<ControlPoint<Dim>>;
}  // namespace

template <int Dim>
void cut(const Piece<Dim>& piece, const Points<Dim>& control, int direction,
         std::array<Piece<Dim>, 2>& halves, std::array<Points<Dim>, 2>& points) {
  const int p = piece.degree[0], q = piece.degree[1];
  const int degree = direction == 0 ? p : q, lines = direction == 0 ? q : p;
  points[0] = points[1] = control;
  const auto at = [&](int k, int line) {
    return static_cast<std::size_t>(direction == 0 ? k * (q + 1) + line : line * (q + 1) + k);
  };
  for (int l = 0; l <= lines; ++l) {
    std::array<ControlPoint<Dim>, max_piece_degree + 1> row;
    for (int k = 0; k <= degree; ++k) row[static_cast<std::size_t>(k)] = control[at(k, l)];
    for (int k = 0; k <= degree; ++k) {
      const auto last = static_cast<std::size_t>(degree - k);
      points[0][at(k, l)] = row[0];
      points[1][at(degree - k, l)] = row[last];
      for (std::size_t i = 0; i < last; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
    }
  }
  halves[0] = halves[1] = piece;
  const std::size_t low = direction == 0 ? 0 : 2, high = low + 1;
  halves[0].side[high] = halves[1].side[low] = -1;
  const auto middle = [&](std::size_t a, std::size_t b) -> Vec2 {
    return 0.5 * (piece.xi[a] + piece.xi[b]);
  };
  const std::size_t other = direction == 0 ? 1 : 2, far = 3 - other;  // ends of the first side
  halves[0].xi[other] = halves[1].xi[0] = middle(0, other);
  halves[0].xi[3] = halves[1].xi[far] = middle(far, 3);
}

template <int Dim>
int longer_direction(const Piece<Dim>& piece, Control<Dim> control) {
  if (piece.degree[1] == 0) return 0;
  const auto q = static_cast<std::size_t>(piece.degree[1]);
  const auto corner = [&](std::size_t k) { return euclidean<Dim>(control[k]); };
  const std::size_t last = control.size() - 1;
  const double s = (corner(last - q) - corner(0)).norm() + (corner(last) - corner(q)).norm();
  const double t = (corner(q) - corner(0)).norm() + (corner(last) - corner(last - q)).norm();
  return t > s ? 1 : 0;
}

namespace {

template <int Dim>
void add_cut(const Piece<Dim>& piece, Points<Dim> control, std::array<int, 2> cuts,
             PieceSet<Dim>& set) {
  constexpr int max_cuts = 3;
  constexpr double narrow = 0.3;
  const Cone<Dim> cone = normal_cone<Dim>(piece, control);
  const bool may_cut = cuts[0] < max_cuts || (piece.degree[1] > 0 && cuts[1] < max_cuts);
  if (piece.triangle || cone.angle <= narrow || !may_cut) {
    Piece<Dim> one = piece;
    one.first = static_cast<Index>(set.control.size());
    one.bent = cone.angle > narrow;
    set.control.insert(set.control.end(), control.begin(), control.end());
    set.pieces.push_back(one);
    return;
  }
  // Along the longer side, so that halves do not get thin.
  int direction = longer_direction<Dim>(piece, control);
  if (piece.degree[1] > 0 && cuts[static_cast<std::size_t>(direction)] >= max_cuts)
    direction = 1 - direction;
  std::array<Piece<Dim>, 2> halves;
  std::array<Points<Dim>, 2> points;
  cut(piece, control, direction, halves, points);
  ++cuts[static_cast<std::size_t>(direction)];
  for (std::size_t k = 0; k < 2; ++k) add_cut(halves[k], std::move(points[k]), cuts, set);
}

}  // namespace

template <int Dim>
void add_pieces(const Piece<Dim>& piece, std::vector<ControlPoint<Dim>> control,
                PieceSet<Dim>& set) {
  add_cut(piece, std::move(control), {0, 0}, set);
}

template PieceJet<2> jet(const Piece<2>&, Control<2>, const Vec2&);
template PieceJet<3> jet(const Piece<3>&, Control<3>, const Vec2&);
template search::Box<2> box_of(const Piece<2>&, Control<2>);
template search::Box<3> box_of(const Piece<3>&, Control<3>);
template Cone<2> normal_cone(const Piece<2>&, Control<2>);
template Cone<3> normal_cone(const Piece<3>&, Control<3>);
template Cone<2> inward_cone(const Piece<2>&, Control<2>, std::size_t);
template Cone<3> inward_cone(const Piece<3>&, Control<3>, std::size_t);
template std::vector<ControlPoint<2>> side_control(const Piece<2>&, Control<2>, std::size_t);
template std::vector<ControlPoint<3>> side_control(const Piece<3>&, Control<3>, std::size_t);
template Cone<2> along_cone(const Piece<2>&, Control<2>, std::size_t);
template Cone<3> along_cone(const Piece<3>&, Control<3>, std::size_t);
template void cut(const Piece<2>&, const Points<2>&, int, std::array<Piece<2>, 2>&,
                  std::array<Points<2>, 2>&);
template void cut(const Piece<3>&, const Points<3>&, int, std::array<Piece<3>, 2>&,
                  std::array<Points<3>, 2>&);
template int longer_direction(const Piece<2>&, Control<2>);
template int longer_direction(const Piece<3>&, Control<3>);
template Cone<2> join(const Cone<2>&, const Cone<2>&);
template Cone<3> join(const Cone<3>&, const Cone<3>&);
template void add_pieces(const Piece<2>&, std::vector<ControlPoint<2>>, PieceSet<2>&);
template void add_pieces(const Piece<3>&, std::vector<ControlPoint<3>>, PieceSet<3>&);

}  // namespace osculate::projection

#include "brute.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <type_traits>

namespace osculate::verification {
namespace {

constexpr int second_parameter(int dim) { return dim - 2; }  // 0 in the plane, 1 in space

std::vector<double> break_points(const std::vector<double>& knots, double lo, double hi) {
  std::vector<double> u;
  for (const double k : knots)
    if (k >= lo && k <= hi && (u.empty() || k > u.back())) u.push_back(k);
  return u;
}

}  // namespace

template <int Dim>
void BruteForce<Dim>::add_facets(const projection::FacetMesh<Dim>& mesh) {
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const projection::MeshFacet& facet = mesh.facets[f];
    std::vector<Vec<Dim>> nodes;
    for (int k = 0; k < cell::info(facet.type).nodes; ++k)
      nodes.push_back(
          mesh.nodes[static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(k)])]);
    Chart chart;
    chart.facet = static_cast<int>(f);
    if constexpr (Dim == 2) {
      chart.shape = geometry::lagrange_curve(nodes);
      chart.corner = {Vec2(-1, 0), Vec2(1, 0), Vec2(-1, 0), Vec2(1, 0)};
      chart.border = {true, true, false, false};
      add(chart);
    } else {
      chart.shape = geometry::lagrange_surface(facet.type, nodes);
      chart.corner = {Vec2(-1, -1), Vec2(1, -1), Vec2(-1, 1), Vec2(1, 1)};
      chart.border = {true, true, true, true};
      if (!cell::is_triangle(facet.type)) {
        add(chart);
        continue;
      }
      const std::array<Vec2, 3> c{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
      for (std::size_t k = 0; k < 3; ++k) {
        chart.corner = {c[k], 0.5 * (c[k] + c[(k + 1) % 3]), 0.5 * (c[k] + c[(k + 2) % 3]),
                        Vec2(1.0 / 3, 1.0 / 3)};
        chart.border = {true, false, true, false};
        add(chart);
      }
    }
  }
}

template <int Dim>
BruteForce<Dim>::BruteForce(const projection::Target<Dim>& target, int grid) : grid_(grid) {
  if (const auto* mesh = std::get_if<projection::FacetMesh<Dim>>(&target)) {
    add_facets(*mesh);
    return;
  }
  const auto& shape = std::get<projection::Shape<Dim>>(target);
  Chart chart;
  chart.shape = shape;
  if constexpr (Dim == 2) {
    const auto& curve = std::get<geometry::NurbsCurve>(shape);
    const std::vector<double> u = break_points(curve.knots, curve.lo(), curve.hi());
    for (std::size_t i = 0; i + 1 < u.size(); ++i) {
      chart.corner = {Vec2(u[i], 0), Vec2(u[i + 1], 0), Vec2(u[i], 0), Vec2(u[i + 1], 0)};
      chart.border = {i == 0, i + 2 == u.size(), false, false};
      add(chart);
    }
  } else {
    const auto& patch = std::get<geometry::NurbsPatch>(shape);
    const std::vector<double> u = break_points(patch.knots[0], patch.lo()[0], patch.hi()[0]);
    const std::vector<double> v = break_points(patch.knots[1], patch.lo()[1], patch.hi()[1]);
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
      for (std::size_t j = 0; j + 1 < v.size(); ++j) {
        chart.corner = {Vec2(u[i], v[j]), Vec2(u[i + 1], v[j]), Vec2(u[i], v[j + 1]),
                        Vec2(u[i + 1], v[j + 1])};
        chart.border = {i == 0, i + 2 == u.size(), j == 0, j + 2 == v.size()};
        add(chart);
      }
  }
}

template <int Dim>
typename BruteForce<Dim>::Jet BruteForce<Dim>::jet(const Chart& c, const Vec2& st) const {
  const double s = st[0], t = st[1];
  const Vec2 xi = (1 - t) * ((1 - s) * c.corner[0] + s * c.corner[1]) +
                  t * ((1 - s) * c.corner[2] + s * c.corner[3]);
  const Vec2 a = (1 - t) * (c.corner[1] - c.corner[0]) + t * (c.corner[3] - c.corner[2]);
  const Vec2 b = (1 - s) * (c.corner[2] - c.corner[0]) + s * (c.corner[3] - c.corner[1]);
  const Vec2 ab = c.corner[3] - c.corner[2] - c.corner[1] + c.corner[0];
  Jet out;
  if constexpr (Dim == 2) {
    // A place at the end of a span belongs to that span: look a little inside for derivatives.
    const geometry::CurveJet<2> j = geometry::jet(c.shape, xi[0]);
    out.r = j.r;
    out.r1 = a[0] * j.r1;
    out.r11 = a[0] * a[0] * j.r2;
    out.r2 = out.r12 = out.r22 = Vec2::Zero();
  } else {
    const geometry::SurfaceJet j = geometry::jet(c.shape, xi);
    const auto second = [&](const Vec2& p, const Vec2& q) -> Vec3 {
      return p[0] * q[0] * j.r2[0] + (p[0] * q[1] + p[1] * q[0]) * j.r2[1] + p[1] * q[1] * j.r2[2];
    };
    out.r = j.r;
    out.r1 = a[0] * j.r1[0] + a[1] * j.r1[1];
    out.r2 = b[0] * j.r1[0] + b[1] * j.r1[1];
    out.r11 = second(a, a);
    out.r12 = second(a, b) + ab[0] * j.r1[0] + ab[1] * j.r1[1];
    out.r22 = second(b, b);
  }
  return out;
}

template <int Dim>
void BruteForce<Dim>::add(Chart chart) {
  const int last_t = grid_ * second_parameter(Dim);
  for (int i = 0; i <= grid_; ++i)
    for (int j = 0; j <= last_t; ++j)
      chart.samples.push_back(
          jet(chart, Vec2(static_cast<double>(i) / grid_, static_cast<double>(j) / grid_)).r);
  const auto at = [&](int i, int j) {
    return chart.samples[static_cast<std::size_t>(i * (last_t + 1) + j)];
  };
  for (int i = 0; i <= grid_; ++i)
    for (int j = 0; j <= last_t; ++j) {
      lo_ = lo_.cwiseMin(at(i, j));
      hi_ = hi_.cwiseMax(at(i, j));
      if (i > 0) chart.spacing = std::max(chart.spacing, (at(i, j) - at(i - 1, j)).norm());
      if (j > 0) chart.spacing = std::max(chart.spacing, (at(i, j) - at(i, j - 1)).norm());
    }
  charts_.push_back(std::move(chart));
}

/// A place on a chart on its way down.
template <int Dim>
struct BruteForce<Dim>::Descent {
  const BruteForce& brute;
  const Chart& chart;
  const Vec<Dim>& point;
  Vec2 st;
  double f = squared(st);
  Vec2 slope = Vec2::Zero();
  Mat<2, 2> bend = Mat<2, 2>::Identity();

  static constexpr int count = 1 + second_parameter(Dim);

  [[nodiscard]] double squared(const Vec2& x) const {
    return (point - brute.jet(chart, x).r).squaredNorm();
  }
  void look() {
    const Jet j = brute.jet(chart, st);
    const Vec<Dim> g = point - j.r;
    slope = {-g.dot(j.r1), -g.dot(j.r2)};
    bend << j.r1.squaredNorm() - g.dot(j.r11), j.r1.dot(j.r2) - g.dot(j.r12),
        j.r1.dot(j.r2) - g.dot(j.r12), j.r2.squaredNorm() - g.dot(j.r22);
  }
  /// Newton's steps while they lead down.
  void newton() {
    for (int it = 0; it < 20; ++it) {
      look();
      Vec2 step(0, 0);
      std::array<bool, 2> free{};
      for (int i = 0; i < count; ++i)
        free[static_cast<std::size_t>(i)] =
            !(st[i] <= 0 && slope[i] > 0) && !(st[i] >= 1 && slope[i] < 0);
      if (free[0] && free[1]) {
        if (!(bend(0, 0) > 0 && bend.determinant() > 0)) return;
        step = -bend.inverse() * slope;
      } else {
        for (int i = 0; i < count; ++i)
          if (free[static_cast<std::size_t>(i)]) {
            if (!(bend(i, i) > 0)) return;
            step[i] = -slope[i] / bend(i, i);
          }
      }
      const Vec2 next = (st + step).cwiseMax(0.0).cwiseMin(1.0);
      const double value = squared(next);
      if (!(value < f)) return;
      const double moved = (next - st).norm();
      st = next;
      f = value;
      if (moved < 1e-15) return;
    }
  }
  /// What Newton's method left, down to steps that no longer count.
  void search(double h) {
    const double dirs[8][2] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                               {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    while (h > 1e-8) {
      bool moved = false;
      for (int d = 0; d < (count == 1 ? 2 : 8) && !moved; ++d) {
        const Vec2 next = (st + h * Vec2(dirs[d][0], dirs[d][1])).cwiseMax(0.0).cwiseMin(1.0);
        const double value = squared(next);
        if (!(value < f * (1 - 1e-15))) continue;
        st = next;
        f = value;
        moved = true;
      }
      if (moved)
        newton();
      else
        h *= 0.05;
    }
  }
  /// On which sides it lies, and whether it is pulled beyond them.
  void name_sides(Minimum& m) const {
    m.from_border = 1;
    m.pulled = true;
    for (int side = 0; side < 2 * count; ++side) {
      const int i = side / 2;
      const double away = side % 2 == 0 ? st[i] : 1 - st[i];
      const double outward = side % 2 == 0 ? slope[i] : -slope[i];
      if (!chart.border[static_cast<std::size_t>(side)]) {
        m.inner = m.inner || (away <= 0 && outward > 1e-9 * std::abs(bend(i, i)));
        continue;
      }
      m.from_border = std::min(m.from_border, away);
      // Steps end at 1e-8 of a chart: this close to a corner an edge and the corner look alike.
      if (away > 0) {
        m.pulled = m.pulled && away > 1e-7;
        continue;
      }
      ++m.on_sides;
      m.pulled = m.pulled && outward > 1e-6 * std::abs(bend(i, i));
    }
  }
};

template <int Dim>
typename BruteForce<Dim>::Minimum BruteForce<Dim>::refine(std::size_t number, const Vec2& st,
                                                          const Vec<Dim>& point) const {
  const Chart& chart = charts_[number];
  Descent way{*this, chart, point, st};
  way.newton();
  way.search(0.3 / grid_);
  way.look();
  Minimum m;
  m.distance = std::sqrt(way.f);
  m.point = jet(chart, way.st).r;
  m.facet = chart.facet;
  m.chart = number;
  m.st = way.st;
  way.name_sides(m);
  return m;
}

template <int Dim>
std::vector<typename BruteForce<Dim>::Minimum> BruteForce<Dim>::minima(const Vec<Dim>& point,
                                                                       double beyond) const {
  const int last_t = grid_ * second_parameter(Dim);
  double nearest = 1e300;
  for (const Chart& chart : charts_)
    for (const Vec<Dim>& r : chart.samples) nearest = std::min(nearest, (point - r).squaredNorm());
  nearest = std::sqrt(nearest);
  std::vector<Minimum> out;
  std::vector<double> d;
  for (std::size_t c = 0; c < charts_.size(); ++c) {
    const Chart& chart = charts_[c];
    d.clear();
    double least = 1e300;
    for (const Vec<Dim>& r : chart.samples) {
      d.push_back((point - r).norm());
      least = std::min(least, d.back());
    }
    if (least - chart.spacing > nearest + beyond) continue;
    const auto at = [&](int i, int j) { return d[static_cast<std::size_t>(i * (last_t + 1) + j)]; };
    for (int i = 0; i <= grid_; ++i)
      for (int j = 0; j <= last_t; ++j) {
        if (at(i, j) - chart.spacing > nearest + beyond) continue;
        // Lowest round about, or along a side: minima pressed against one are often narrow.
        const bool on_side = i == 0 || i == grid_ || (last_t > 0 && (j == 0 || j == last_t));
        bool lowest = true;
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, grid_) && lowest; ++a)
          for (int b = std::max(j - 1, 0); b <= std::min(j + 1, last_t); ++b)
            if (!on_side ||
                ((a == i && (i == 0 || i == grid_)) || (b == j && (j == 0 || j == last_t))))
              lowest = lowest && at(a, b) >= at(i, j);
        if (!lowest) continue;
        out.push_back(
            refine(c, Vec2(static_cast<double>(i) / grid_, static_cast<double>(j) / grid_), point));
      }
  }
  std::sort(out.begin(), out.end(),
            [](const Minimum& a, const Minimum& b) { return a.distance < b.distance; });
  return out;
}

template <int Dim>
bool BruteForce<Dim>::holds(const Vec<Dim>& point, const Vec<Dim>& place) const {
  const std::vector<Minimum> at = minima(place, 0);
  const Chart& chart = charts_[at.front().chart];
  const Vec2 st = at.front().st;
  const double here = (point - jet(chart, st).r).squaredNorm();
  for (const double h : {1e-6, 1e-5})
    for (int k = 0; k < 64; ++k) {
      const double angle = 0.1 * k;
      const Vec2 step = h * Vec2(std::cos(angle), second_parameter(Dim) * std::sin(angle));
      const Vec2 next = (st + step).cwiseMax(0.0).cwiseMin(1.0);
      if ((point - jet(chart, next).r).squaredNorm() < here * (1 - 1e-13)) return false;
    }
  return true;
}

template class BruteForce<2>;
template class BruteForce<3>;

}  // namespace osculate::verification

#include "osculate/io/inp/hollow_section.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "osculate/cell/quadrature.hpp"

namespace osculate::io::inp {
namespace {

class SectionMesh {
 public:
  /// A cell between four places, with straight or given middles.
  void add(const std::array<Vec2, 8>& places) {
    std::array<std::size_t, 8> cell{};
    for (std::size_t k = 0; k < 8; ++k) cell[k] = point(places[k], k < 4);
    out_.cells.push_back(cell);
  }

  HollowSection finish() {
    out_.share.assign(out_.points.size(), 0);
    out_.corner_share.assign(out_.points.size(), 0);
    double area = 0;
    const cell::Quadrature2D rule = cell::gauss_quad(4);
    for (const auto& cell : out_.cells)
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const std::array<double, 8> all = shares_around(rule.points[q]);
        const std::array<double, 4> corners = shares_of_corners(rule.points[q]);
        const double part = rule.weights[q] * jacobian(cell, rule.points[q]);
        area += part;
        for (std::size_t k = 0; k < 8; ++k) out_.share[cell[k]] += part * all[k];
        for (std::size_t k = 0; k < 4; ++k) out_.corner_share[cell[k]] += part * corners[k];
      }
    for (double& share : out_.share) share /= area;
    for (double& share : out_.corner_share) share /= area;
    out_.axis_share = about_axis(out_.share);
    out_.axis_corner_share = about_axis(out_.corner_share);
    return std::move(out_);
  }

 private:
  std::size_t point(const Vec2& place, bool corner) {
    constexpr double same = 1e-12;
    for (std::size_t k = 0; k < out_.points.size(); ++k)
      if ((out_.points[k] - place).norm() < same) return k;
    out_.points.push_back(place);
    out_.is_corner.push_back(corner);
    return out_.points.size() - 1;
  }

  /// Of the way from the cell's own places `around` to those of the section; quadratic, so that
  /// central differences have no error but that of rounding.
  [[nodiscard]] double jacobian(const std::array<std::size_t, 8>& cell, const Vec2& at) const {
    constexpr double step = 1e-3;
    Mat<2, 2> d = Mat<2, 2>::Zero();
    for (Eigen::Index j = 0; j < 2; ++j) {
      const Vec2 way = step * Vec2::Unit(j);
      const auto ahead = shares_around(at + way), behind = shares_around(at - way);
      for (std::size_t k = 0; k < 8; ++k)
        d.col(j) += (ahead[k] - behind[k]) / (2 * step) * out_.points[cell[k]];
    }
    return d.determinant();
  }

  /// Formula    s (1 - c . I^-1 (x - c)) , c = sum s x , I = sum s (x - c) (x - c)^T
  [[nodiscard]] std::vector<double> about_axis(std::vector<double> share) const {
    Vec2 middle = Vec2::Zero();
    for (std::size_t p = 0; p < share.size(); ++p) middle += share[p] * out_.points[p];
    Mat<2, 2> inertia = Mat<2, 2>::Zero();
    for (std::size_t p = 0; p < share.size(); ++p) {
      const Vec2 arm = out_.points[p] - middle;
      inertia += share[p] * arm * arm.transpose();
    }
    const Vec2 slope = inertia.inverse() * middle;
    for (std::size_t p = 0; p < share.size(); ++p)
      share[p] *= 1 - slope.dot(out_.points[p] - middle);
    return share;
  }

  HollowSection out_;
};

/// Four corners and the middles between them.
std::array<Vec2, 8> straight(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return {a, b, c, d, (a + b) / 2, (b + c) / 2, (c + d) / 2, (d + a) / 2};
}

}  // namespace

std::array<double, 4> shares_of_corners(const Vec2& place) {
  std::array<double, 4> n{};
  for (std::size_t k = 0; k < 4; ++k)
    n[k] = 0.25 * (1 + around[k][0] * place.x()) * (1 + around[k][1] * place.y());
  return n;
}

std::array<double, 8> shares_around(const Vec2& place) {
  const double x = place.x(), y = place.y();
  const std::array<double, 4> corners = shares_of_corners(place);
  std::array<double, 8> n{};
  for (std::size_t k = 0; k < 4; ++k) n[k] = corners[k] * (around[k][0] * x + around[k][1] * y - 1);
  for (std::size_t k = 4; k < 8; ++k)
    n[k] = around[k][0] == 0 ? 0.5 * (1 - x * x) * (1 + around[k][1] * y)
                             : 0.5 * (1 - y * y) * (1 + around[k][0] * x);
  return n;
}

HollowSection hollow_section(const ThinSection& section) {
  SectionMesh mesh;
  const std::array<double, 4>& wall = section.wall;
  const double a = section.thickness[0], b = section.thickness[1];
  if (section.shape == ThinSection::Shape::pipe) {
    constexpr int count = 16;
    const double inner = 1 - 2 * wall[0] / a;
    const auto at = [](double radius, double turn) -> Vec2 {
      const double angle = 2 * std::numbers::pi * turn / count;
      return radius * Vec2(std::cos(angle), std::sin(angle));
    };
    for (int k = 0; k < count; ++k) {
      const double next = k + 1 == count ? 0 : k + 1;
      mesh.add({at(inner, k), at(1, k), at(1, next), at(inner, next), at((1 + inner) / 2, k),
                at(1, k + 0.5), at((1 + inner) / 2, next), at(inner, k + 0.5)});
    }
    return mesh.finish();
  }
  const std::array<double, 4> x{-1, -1 + 2 * wall[2] / a, 1 - 2 * wall[0] / a, 1};
  const std::array<double, 4> y{-1, -1 + 2 * wall[3] / b, 1 - 2 * wall[1] / b, 1};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (i != 1 || j != 1)
        mesh.add(straight({x[i], y[j]}, {x[i + 1], y[j]}, {x[i + 1], y[j + 1]}, {x[i], y[j + 1]}));
  return mesh.finish();
}

}  // namespace osculate::io::inp

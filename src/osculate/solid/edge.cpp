#include <numbers>

#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/quadrature.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {
namespace {

/// Visits the Gauss points of an edge: shape values, slopes, weight.
template <class Visit>
void over_edge(Eigen::Index nodes, const Visit& visit) {
  static const cell::Quadrature1D rule = cell::gauss_legendre(4);
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    visit(cell::lagrange_line(static_cast<int>(nodes), rule.points[q]), rule.weights[q]);
}

double depth_at(const Section& section, double radius) {
  return section.assumption == Assumption::axisymmetric ? 2 * std::numbers::pi * radius
                                                        : section.thickness;
}

}  // namespace

ElementVector edge_weights(const Section& section, const Coordinates& reference) {
  const Eigen::Index n = reference.rows();
  ElementVector weights = ElementVector::Zero(n);
  over_edge(n, [&](const cell::LineShape& s, double weight) {
    Vec2 x = Vec2::Zero(), t = Vec2::Zero();
    for (Eigen::Index k = 0; k < n; ++k) {
      x += s.n[0][static_cast<std::size_t>(k)] * reference.row(k).transpose();
      t += s.n[1][static_cast<std::size_t>(k)] * reference.row(k).transpose();
    }
    for (Eigen::Index k = 0; k < n; ++k)
      weights[k] +=
          weight * s.n[0][static_cast<std::size_t>(k)] * t.norm() * depth_at(section, x.x());
  });
  return weights;
}

PressureResult edge_pressure(const Section& section, const Coordinates& reference,
                             const Coordinates& displacement, double pressure) {
  const Eigen::Index n = reference.rows();
  const bool follows = section.kinematics == Kinematics::finite;
  const bool axisymmetric = section.assumption == Assumption::axisymmetric;
  PressureResult out;
  out.force.setZero(2 * n);
  out.tangent.setZero(2 * n, 2 * n);
  Coordinates now = reference;
  if (follows) now += displacement;
  over_edge(n, [&](const cell::LineShape& s, double weight) {
    Vec2 x = Vec2::Zero(), t = Vec2::Zero();
    for (Eigen::Index k = 0; k < n; ++k) {
      x += s.n[0][static_cast<std::size_t>(k)] * now.row(k).transpose();
      t += s.n[1][static_cast<std::size_t>(k)] * now.row(k).transpose();
    }
    const double depth = depth_at(section, x.x());
    for (Eigen::Index k = 0; k < n; ++k) {
      const double factor = -pressure * weight * s.n[0][static_cast<std::size_t>(k)];
      out.force.segment<2>(2 * k) += factor * depth * turn(t);
      if (!follows) continue;
      for (Eigen::Index l = 0; l < n; ++l) {
        const double slope = s.n[1][static_cast<std::size_t>(l)];
        out.tangent(2 * k, 2 * l + 1) -= factor * depth * slope;
        out.tangent(2 * k + 1, 2 * l) += factor * depth * slope;
        if (axisymmetric)
          out.tangent.block<2, 1>(2 * k, 2 * l) +=
              factor * 2 * std::numbers::pi * s.n[0][static_cast<std::size_t>(l)] * turn(t);
      }
    }
  });
  return out;
}

}  // namespace osculate::solid

#include <Eigen/Geometry>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/solid/volume.hpp"

namespace osculate::solid {
namespace {

/// Exact for the pressure on the face as it is.
cell::Quadrature2D quadrature_of(cell::CellType face) {
  switch (face) {
    case cell::CellType::tri3:
      return cell::gauss_triangle(2);
    case cell::CellType::tri6:
      return cell::gauss_triangle(4);
    case cell::CellType::quad4:
      return cell::gauss_quad(2);
    default:
      return cell::gauss_quad(3);
  }
}

struct FaceRule {
  cell::Quadrature2D rule;
  std::vector<cell::AreaShape> shape;
};

FaceRule make_rule(cell::CellType face) {
  FaceRule r{quadrature_of(face), {}};
  for (const Vec2& xi : r.rule.points) r.shape.push_back(cell::area_shape(face, xi));
  return r;
}

/// Visits the Gauss points of a face: shape functions, the tangents x_1, x_2, and weight.
template <class Visit>
void over_face(cell::CellType face, const Coordinates3& x, const Visit& visit) {
  using enum cell::CellType;
  static const std::array<FaceRule, 5> rules{make_rule(tri3), make_rule(tri6), make_rule(quad4),
                                             make_rule(quad8), make_rule(quad9)};
  const FaceRule& r = rules[static_cast<std::size_t>(face) - static_cast<std::size_t>(tri3)];
  for (std::size_t q = 0; q < r.shape.size(); ++q) {
    const Mat<3, 2> t = x.transpose() * r.shape[q].d.topRows(x.rows());
    visit(r.shape[q], t, r.rule.weights[q]);
  }
}

/// a x as a matrix.
Mat<3, 3> cross_matrix(const Vec3& a) {
  Mat<3, 3> m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace

FaceVector face_weights(cell::CellType face, const Coordinates3& reference) {
  const Eigen::Index n = reference.rows();
  FaceVector weights = FaceVector::Zero(n);
  over_face(face, reference, [&](const cell::AreaShape& s, const Mat<3, 2>& t, double weight) {
    weights += weight * t.col(0).cross(t.col(1)).norm() * s.n.head(n);
  });
  return weights;
}

FacePressure face_pressure(const VolumeSection& section, cell::CellType face,
                           const Coordinates3& reference, const Coordinates3& displacement,
                           double pressure) {
  const Eigen::Index n = reference.rows();
  const bool follows = section.kinematics == Kinematics::finite;
  FacePressure out;
  out.force.setZero(3 * n);
  out.tangent.setZero(3 * n, 3 * n);
  Coordinates3 now = reference;
  if (follows) now += displacement;
  over_face(face, now, [&](const cell::AreaShape& s, const Mat<3, 2>& t, double weight) {
    const Vec3 x1 = t.col(0), x2 = t.col(1), normal = x1.cross(x2);
    const Mat<3, 3> cross1 = cross_matrix(x1), cross2 = cross_matrix(x2);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double factor = -pressure * weight * s.n[k];
      out.force.segment<3>(3 * k) += factor * normal;
      if (!follows) continue;
      for (Eigen::Index l = 0; l < n; ++l)
        out.tangent.block<3, 3>(3 * k, 3 * l) += factor * (s.d(l, 1) * cross1 - s.d(l, 0) * cross2);
    }
  });
  return out;
}

}  // namespace osculate::solid

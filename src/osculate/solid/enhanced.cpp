#include "osculate/solid/enhanced.hpp"

#include <Eigen/LU>

#include "osculate/solid/local_modes.hpp"

namespace osculate::solid {
namespace {

constexpr std::array<std::array<int, 2>, 6> axes{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// Strains of unit natural strains (11, 22, 33, 12, 23, 13, columns) at the centre of the cell; in
/// the plane those across it are zero.
template <int C>
struct Centre {
  Mat<C, C> strain = Mat<C, C>::Zero();
  double determinant;
};

template <int Dim, int C = components<Dim>>
Centre<C> centre_of(const Coordinates<Dim>& reference) {
  const Shape<Dim> shape = shape_at<Dim>(corner_cell<Dim>, Vec<Dim>::Zero());
  const Mat<Dim, Dim> j =
      reference.transpose() * shape.d.template topRows<corners<Dim>>();  // dX_i/dxi_j
  const Mat<Dim, Dim> i = j.inverse();                                   // dxi_i/dX_j
  Centre<C> c;
  c.determinant = j.determinant();
  for (Eigen::Index n = 0; n < C; ++n) {
    const auto [first, second] = axes[static_cast<std::size_t>(n)];
    if (first >= Dim) continue;
    const Vec<Dim> a = i.row(first), b = i.row(second);
    const Mat<Dim, Dim> e = 0.5 * (a * b.transpose() + b * a.transpose());
    for (Eigen::Index m = 0; m < C; ++m) {
      const auto [row, column] = axes[static_cast<std::size_t>(m)];
      if (row < Dim) c.strain(m, n) = (m < 3 ? 1 : 2) * e(row, column);
    }
  }
  return c;
}

/// Strain and axis of the modes that are linear along the axes.
constexpr std::array<std::array<Eigen::Index, 2>, 4> plane_linear{{{0, 0}, {1, 1}, {3, 0}, {3, 1}}};
constexpr std::array<std::array<Eigen::Index, 2>, 9> space_linear{
    {{0, 0}, {1, 1}, {2, 2}, {3, 0}, {3, 1}, {4, 1}, {4, 2}, {5, 0}, {5, 2}}};

/// The modes, brought from the centre of the cell to a point with the determinants' `ratio`; their
/// mean is zero, so that the patch test holds (Simo & Rifai 1990). In a ring `mean` is that of xi,
/// eta and xi eta over the circumference.
template <int Count>
Mat<4, Count> mode_matrix(const Centre<4>& centre, const Vec2& xi, double ratio, const Vec3& mean) {
  Mat<4, Count> m = Mat<4, Count>::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [strain, axis] = plane_linear[k];
    m.col(static_cast<Eigen::Index>(k)) = (xi[axis] - mean[axis]) * centre.strain.col(strain);
  }
  if constexpr (Count == ring_modes) m(2, 4) = xi.x() * xi.y() - mean[2];
  return ratio * m;
}
template <int Count>
Mat<6, Count> mode_matrix(const Centre<6>& centre, const Vec3& xi, double ratio, const Vec3&) {
  Mat<6, Count> m = Mat<6, Count>::Zero();
  for (std::size_t k = 0; k < 9; ++k) {
    const auto [strain, axis] = space_linear[k];
    m.col(static_cast<Eigen::Index>(k)) = xi[axis] * centre.strain.col(strain);
  }
  for (Eigen::Index k = 0; k < 3; ++k)
    m.col(9 + k).template head<3>().setConstant(xi[k] * xi[(k + 1) % 3]);
  return ratio * m;
}

/// The mean of xi, eta and xi eta over the circumference; zero but in a ring.
template <int Count, int Dim>
Vec3 mean_place(const Rule<Dim>& rule, const CornerPoints<Dim>& points) {
  Vec3 mean = Vec3::Zero();
  if constexpr (Count == ring_modes) {
    double circumference = 0;
    for (std::size_t q = 0; q < points.size(); ++q) {
      const Vec2& xi = rule.points[q];
      mean += points[q].radius * Vec3(xi.x(), xi.y(), xi.x() * xi.y());
      circumference += points[q].radius;
    }
    mean /= circumference;
  }
  return mean;
}

/// Responses, equations int M^T S dV = 0 and their derivative at the modes of `e`. `scale` is the
/// size that rounding errors of the equations are relative to. False where the law fails.
template <int Count, int Dim>
bool sample(const Section<Dim>& section, const CornerPoints<Dim>& points,
            const material::Memory& memory, EnhancedModes<Count>& e, Vec<Count>& rest,
            double& scale) {
  constexpr int C = components<Dim>;
  rest.setZero();
  scale = 0;
  e.stiffness.setZero();
  for (std::size_t q = 0; q < e.matrix.size(); ++q) {
    const Vec<C>& given = points[q].strain;
    const Vec<C> total = given + e.matrix[q] * e.alpha;
    e.response[q] = point_response(section, total, memory.at(q));
    const material::ResponseOf<C>& r = e.response[q];
    if (!r.ok) return false;
    const Mat<C, Count> weighted = points[q].volume * e.matrix[q];
    const Mat<C, Count> stress = r.tangent * e.matrix[q];
    rest.noalias() += weighted.transpose() * r.stress;
    e.stiffness.noalias() += weighted.transpose() * stress;
    // before they cancel: modes of a long cell take nearly all of its strain away
    const Vec<C> parts = given.cwiseAbs() + e.matrix[q].cwiseAbs() * e.alpha.cwiseAbs();
    const Vec<C> size = r.tangent.cwiseAbs() * parts + r.stress.cwiseAbs();
    scale += (weighted.cwiseAbs().transpose() * size).maxCoeff();
  }
  return true;
}

}  // namespace

template <int Count, int Dim>
EnhancedModes<Count> enhanced_modes(const Section<Dim>& section, const Coordinates<Dim>& reference,
                                    const CornerPoints<Dim>& points,
                                    const material::Memory& memory) {
  EnhancedModes<Count> e;
  const Rule<Dim>& rule = rule_of(section, corner_cell<Dim>);
  const auto centre = centre_of<Dim>(reference);
  const Vec3 mean = mean_place<Count, Dim>(rule, points);
  for (std::size_t q = 0; q < points.size(); ++q)
    e.matrix[q] = mode_matrix<Count>(centre, rule.points[q],
                                     centre.determinant / points[q].determinant, mean);
  solve_modes<Vec<Count>>(e, memory.size > 0,
                          [&](EnhancedModes<Count>& m, Vec<Count>& rest, double& scale) {
                            return sample<Count, Dim>(section, points, memory, m, rest, scale);
                          });
  return e;
}

template EnhancedModes<plane_modes> enhanced_modes(const Section<2>&, const Coordinates<2>&,
                                                   const CornerPoints<2>&, const material::Memory&);
template EnhancedModes<ring_modes> enhanced_modes(const Section<2>&, const Coordinates<2>&,
                                                  const CornerPoints<2>&, const material::Memory&);
template EnhancedModes<space_modes> enhanced_modes(const Section<3>&, const Coordinates<3>&,
                                                   const CornerPoints<3>&, const material::Memory&);

}  // namespace osculate::solid

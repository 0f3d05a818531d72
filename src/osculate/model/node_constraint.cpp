#include "osculate/model/node_constraint.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace osculate::model {
namespace {

using Kind = NodeConstraint::Kind;

/// A function of places relative to the first node's.
template <int Dim>
struct Relative {
  std::vector<Vec<Dim>> gradient;                 ///< by place
  std::vector<std::vector<Mat<Dim, Dim>>> mixed;  ///< second derivatives, by pairs of places
  explicit Relative(std::size_t places)
      : gradient(places, Vec<Dim>::Zero()),
        mixed(places, std::vector<Mat<Dim, Dim>>(places, Mat<Dim, Dim>::Zero())) {}
};

/// By the places themselves: the first node moves all of them.
template <int Dim>
void put(const Relative<Dim>& f, Eigen::Index row, double lambda, NodeConstraintValue<Dim>& out) {
  for (std::size_t a = 0; a < f.gradient.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(Dim * (a + 1));
    out.gradient.template block<1, Dim>(row, i) += f.gradient[a].transpose();
    out.gradient.template block<1, Dim>(row, 0) -= f.gradient[a].transpose();
    for (std::size_t b = 0; b < f.gradient.size(); ++b) {
      const auto j = static_cast<Eigen::Index>(Dim * (b + 1));
      const Mat<Dim, Dim> h = lambda * f.mixed[a][b];
      out.curvature.template block<Dim, Dim>(i, j) += h;
      out.curvature.template block<Dim, Dim>(0, j) -= h;
      out.curvature.template block<Dim, Dim>(i, 0) -= h;
      out.curvature.template block<Dim, Dim>(0, 0) += h;
    }
  }
}

template <int Dim>
NodeConstraintValue<Dim> empty(const NodeConstraint& c) {
  const auto columns = static_cast<Eigen::Index>(Dim * c.nodes.size());
  NodeConstraintValue<Dim> out;
  out.value.setZero(rows<Dim>(c));
  out.gradient.setZero(rows<Dim>(c), columns);
  if (c.kind != Kind::mean_motion) out.curvature.setZero(columns, columns);
  return out;
}

template <int Dim>
void distance(const NodeConstraint& c, std::span<const Vec<Dim>> reference,
              std::span<const Vec<Dim>> x, const Eigen::VectorXd& lambda,
              NodeConstraintValue<Dim>& out) {
  const double length = (reference[1] - reference[0]).norm();
  const Vec<Dim> d = x[1] - x[0];
  const double s = c.stiffness / length;
  out.value[0] = s * (d.squaredNorm() - length * length) / 2;
  Relative<Dim> f(1);
  f.gradient[0] = s * d;
  f.mixed[0][0] = s * Mat<Dim, Dim>::Identity();
  put(f, 0, lambda[0], out);
}

void line(const NodeConstraint& c, std::span<const Vec2> reference, std::span<const Vec2> x,
          const Eigen::VectorXd& lambda, NodeConstraintValue<2>& out) {
  const Vec2 a = x[1] - x[0], b = x[2] - x[0];
  const double s = c.stiffness / (reference[1] - reference[0]).norm();
  out.value[0] = s * (b.x() * a.y() - b.y() * a.x());
  Relative<2> f(2);
  f.gradient = {s * Vec2(-b.y(), b.x()), s * Vec2(a.y(), -a.x())};
  f.mixed[0][1] << 0, -s, s, 0;
  f.mixed[1][0] = f.mixed[0][1].transpose();
  put(f, 0, lambda[0], out);
}

void line(const NodeConstraint& c, std::span<const Vec3> reference, std::span<const Vec3> x,
          const Eigen::VectorXd& lambda, NodeConstraintValue<3>& out) {
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], along = reference[1] - reference[0];
  Eigen::Index least = 0;
  along.cwiseAbs().minCoeff(&least);
  const Vec3 first = along.cross(Vec3::Unit(least)).normalized();
  const std::array<Vec3, 2> across{first, along.cross(first).normalized()};
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Vec3 e = c.stiffness / along.norm() * across[static_cast<std::size_t>(k)];
    out.value[k] = e.dot(b.cross(a));
    Relative<3> f(2);
    f.gradient = {e.cross(b), a.cross(e)};
    f.mixed[0][1] = body::cross_matrix(e);
    f.mixed[1][0] = -body::cross_matrix(e);
    put(f, k, lambda[k], out);
  }
}

void plane(const NodeConstraint& c, std::span<const Vec3> reference, std::span<const Vec3> x,
           const Eigen::VectorXd& lambda, NodeConstraintValue<3>& out) {
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], d = x[3] - x[0];
  const double area = (reference[1] - reference[0]).cross(reference[2] - reference[0]).norm();
  const double s = c.stiffness / area;
  out.value[0] = s * d.dot(a.cross(b));
  Relative<3> f(3);
  f.gradient = {s * b.cross(d), s * d.cross(a), s * a.cross(b)};
  f.mixed[0][1] = -s * body::cross_matrix(d);
  f.mixed[0][2] = s * body::cross_matrix(b);
  f.mixed[1][2] = -s * body::cross_matrix(a);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < i; ++j) f.mixed[i][j] = f.mixed[j][i].transpose();
  put(f, 0, lambda[0], out);
}

/// Rotation of an arm and its derivatives, in the plane and in space alike. `turned`: the arm as it
/// is now, of small rotations as it was.
Mat<2, 1> turning(const body::RigidMotion&, const Vec2& turned) { return Mat<2, 1>(turn(turned)); }
Mat<3, 3> turning(const body::RigidMotion3& motion, const Vec3& turned) {
  return -body::cross_matrix(turned) * body::spin_tangent(motion);
}
void add_bending(const body::RigidMotion&, const Vec2& turned, const Vec2&, const Vec2& f,
                 Eigen::MatrixXd& to) {
  to(0, 0) -= f.dot(turned);
}
void add_bending(const body::RigidMotion3& motion, const Vec3&, const Vec3& arm, const Vec3& f,
                 Eigen::MatrixXd& to) {
  to += body::rotation_hessian(motion.rotation, f, motion.base * arm);
}
/// The rows v -> a x v.
Mat<1, 2> moment_of(const Vec2& arm) { return {-arm.y(), arm.x()}; }
Mat<3, 3> moment_of(const Vec3& arm) { return body::cross_matrix(arm); }

/// Weighted centres of the nodes at first and now, and the mean square of the arms at first.
template <int Dim>
struct Centres {
  Vec<Dim> centre = Vec<Dim>::Zero(), now = Vec<Dim>::Zero();
  double square = 0;
};
template <int Dim>
Centres<Dim> centres(const NodeConstraint& c, std::span<const Vec<Dim>> reference,
                     std::span<const Vec<Dim>> x) {
  Centres<Dim> out;
  for (std::size_t i = 0; i < x.size(); ++i) {
    out.centre += c.weights[i] * reference[i];
    out.now += c.weights[i] * x[i];
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    out.square += c.weights[i] * (reference[i] - out.centre).squaredNorm();
  return out;
}

/// With the small rotation of the body: linear.
template <int Dim>
void small_mean_motion(const NodeConstraint& c, std::span<const Vec<Dim>> reference,
                       std::span<const Vec<Dim>> x, const body::BasicRigidMotion<Dim>& motion,
                       NodeConstraintValue<Dim>& out) {
  constexpr int turns = body::rotations<Dim>;
  const auto& [centre, now, square] = centres<Dim>(c, reference, x);
  const double s = c.stiffness, per_arm = s / std::sqrt(square);
  const auto turned = [&](const Vec<Dim>& arm) {
    return Vec<Dim>(motion.position(motion.reference + arm) - motion.center());
  };
  const Vec<Dim> lever = motion.reference - centre;
  out.value.template head<Dim>() = s * (motion.center() - now - turned(lever));
  out.of_body.setZero(Dim + turns, Dim + turns);
  out.of_body.template topLeftCorner<Dim, Dim>() = s * Mat<Dim, Dim>::Identity();
  out.of_body.template block<Dim, turns>(0, Dim) = -s * turning(motion, lever);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(Dim * i);
    const Vec<Dim> arm = reference[i] - centre;
    const Mat<turns, Dim> across = per_arm * c.weights[i] * moment_of(arm);
    out.value.template tail<turns>() += across * (x[i] - now - turned(arm));
    out.gradient.template block<Dim, Dim>(0, at) = -s * c.weights[i] * Mat<Dim, Dim>::Identity();
    out.gradient.template block<turns, Dim>(Dim, at) = across;
    out.of_body.template block<turns, turns>(Dim, Dim) -= across * turning(motion, arm);
  }
}

template <int Dim>
void mean_motion(const NodeConstraint& c, std::span<const Vec<Dim>> reference,
                 std::span<const Vec<Dim>> x, const body::BasicRigidMotion<Dim>& motion,
                 const Eigen::VectorXd& lambda, NodeConstraintValue<Dim>& out) {
  constexpr int turns = body::rotations<Dim>;
  const auto& [centre, now, square] = centres<Dim>(c, reference, x);
  const double s = c.stiffness, per_arm = s / std::sqrt(square);
  const auto turned = [&](const Vec<Dim>& arm) {
    return Vec<Dim>(motion.position(motion.reference + arm) - motion.center());
  };
  const Vec<Dim> lever = motion.reference - centre, turned_lever = turned(lever);
  out.value.template head<Dim>() = s * (motion.center() - now - turned_lever);
  out.of_body.setZero(Dim + turns, Dim + turns);
  out.of_body.template topLeftCorner<Dim, Dim>() = s * Mat<Dim, Dim>::Identity();
  out.of_body.template block<Dim, turns>(0, Dim) = -s * turning(motion, turned_lever);
  out.mixed.setZero(out.gradient.cols(), turns);
  const Vec<Dim> force = lambda.head<Dim>();
  const Vec<turns> moment = lambda.tail<turns>();
  out.body_curvature.setZero(turns, turns);
  add_bending(motion, turned_lever, lever, Vec<Dim>(-s * force), out.body_curvature);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(Dim * i);
    const Vec<Dim> arm = reference[i] - centre, turned_arm = turned(arm);
    const double w = per_arm * c.weights[i];
    // R A x (x - c) = - (x - c) x R A ; the sum of w A vanishes, and c with it
    out.value.template tail<turns>() += w * moment_of(turned_arm) * (x[i] - now);
    out.gradient.template block<Dim, Dim>(0, at) = -s * c.weights[i] * Mat<Dim, Dim>::Identity();
    out.gradient.template block<turns, Dim>(Dim, at) = w * moment_of(turned_arm);
    const Mat<turns, Dim> by_arm = -w * moment_of(Vec<Dim>(x[i] - now));
    const Mat<Dim, turns> turning_arm = turning(motion, turned_arm);
    out.of_body.template block<turns, turns>(Dim, Dim) += by_arm * turning_arm;
    add_bending(motion, turned_arm, arm, Vec<Dim>(by_arm.transpose() * moment), out.body_curvature);
    // d/dtheta of w moment_of(R A)^T m
    Mat<Dim, Dim> cross;
    for (int k = 0; k < Dim; ++k)
      cross.col(k) = w * moment_of(Vec<Dim>(Vec<Dim>::Unit(k))).transpose() * moment;
    out.mixed.template block<Dim, turns>(at, 0) = cross * turning_arm;
  }
}

}  // namespace

template <int Dim>
int rows(const NodeConstraint& constraint) {
  if (constraint.kind == Kind::mean_motion) return body::motions<Dim>;
  return constraint.kind == Kind::line ? Dim - 1 : 1;
}

template <int Dim>
NodeConstraintValue<Dim> evaluate(const NodeConstraint& c, std::span<const Vec<Dim>> reference,
                                  std::span<const Vec<Dim>> x,
                                  const body::BasicRigidMotion<Dim>* motion,
                                  const Eigen::VectorXd& lambda) {
  NodeConstraintValue<Dim> out = empty<Dim>(c);
  if (c.kind == Kind::distance) distance<Dim>(c, reference, x, lambda, out);
  if (c.kind == Kind::line) line(c, reference, x, lambda, out);
  if (c.kind == Kind::mean_motion && motion->small)
    small_mean_motion<Dim>(c, reference, x, *motion, out);
  else if (c.kind == Kind::mean_motion)
    mean_motion<Dim>(c, reference, x, *motion, lambda, out);
  if constexpr (Dim == 3)
    if (c.kind == Kind::plane) plane(c, reference, x, lambda, out);
  return out;
}

template int rows<2>(const NodeConstraint&);
template int rows<3>(const NodeConstraint&);
template NodeConstraintValue<2> evaluate(const NodeConstraint&, std::span<const Vec2>,
                                         std::span<const Vec2>, const body::RigidMotion*,
                                         const Eigen::VectorXd&);
template NodeConstraintValue<3> evaluate(const NodeConstraint&, std::span<const Vec3>,
                                         std::span<const Vec3>, const body::RigidMotion3*,
                                         const Eigen::VectorXd&);

}  // namespace osculate::model

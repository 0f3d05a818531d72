#include "pair_checks.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "expect_derivative.hpp"

namespace osculate::testing {
namespace {

Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0}; }
Vec3 in_space(const Vec3& v) { return v; }

}  // namespace

template <int Dim>
void expect_pair_tangent(const ContactSample<Dim>& s, contact::Status status,
                         projection::Feature feature, double h) {
  const Eigen::VectorXd v = flatten(s.x);
  const PointFacts first = pair_facts(s, v).front();
  ASSERT_EQ(first.status, status);
  ASSERT_EQ(first.feature, feature);
  expect_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                    pair_tangent(s, v), [&](const Eigen::VectorXd& y) { return pair_facts(s, y); },
                    v, h);
}

template <int Dim>
void expect_symmetric_tangent(const ContactSample<Dim>& s) {
  const Eigen::MatrixXd k = pair_tangent(s, flatten(s.x));
  EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
}

template <int Dim>
Vec<Dim> net_force(const Eigen::VectorXd& r) {
  return r.reshaped(Dim, r.size() / Dim).rowwise().sum();
}

template <int Dim>
Vec3 net_moment(const ContactSample<Dim>& s, const Eigen::VectorXd& r) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < s.x.size(); ++n) {
    const Vec<Dim> f = r.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
    sum += in_space(s.x[n]).cross(in_space(f));
  }
  return sum;
}

template void expect_pair_tangent(const ContactSample<2>&, contact::Status, projection::Feature,
                                  double);
template void expect_pair_tangent(const ContactSample<3>&, contact::Status, projection::Feature,
                                  double);
template void expect_symmetric_tangent(const ContactSample<2>&);
template void expect_symmetric_tangent(const ContactSample<3>&);
template Vec2 net_force<2>(const Eigen::VectorXd&);
template Vec3 net_force<3>(const Eigen::VectorXd&);
template Vec3 net_moment(const ContactSample<2>&, const Eigen::VectorXd&);
template Vec3 net_moment(const ContactSample<3>&, const Eigen::VectorXd&);

}  // namespace osculate::testing

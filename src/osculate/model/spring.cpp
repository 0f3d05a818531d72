#include "osculate/model/spring.hpp"

#include <cmath>
#include <limits>

#include "osculate/contact/law/normal_tensile.hpp"

namespace osculate::model {
namespace {

/// At a corner of the curve its slope behind it.
SpringResponse by_table(const core::Table& table, double elongation) {
  SpringResponse r;
  if (elongation < table.front()[0]) {
    r.force = table.front()[1];
    return r;
  }
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto &a = table[i - 1], &b = table[i];
    if (elongation >= b[0]) continue;
    r.slope = (b[1] - a[1]) / (b[0] - a[0]);
    // From the end with the smaller force: that of a stiff stop is nothing but rounding elsewhere.
    const auto& from = std::abs(a[1]) < std::abs(b[1]) ? a : b;
    r.force = from[1] + r.slope * (elongation - from[0]);
    return r;
  }
  r.force = table.back()[1];
  return r;
}

/// Area below the curve between two elongations, the first one smaller.
double area_between(const core::Table& table, double low, double high) {
  double area = 0, at = low, force = by_table(table, low).force;
  const auto go_to = [&](double elongation, double next) {
    area += 0.5 * (elongation - at) * (force + next);
    at = elongation;
    force = next;
  };
  for (const auto& point : table)
    if (point[0] > low && point[0] < high) go_to(point[0], point[1]);
  go_to(high, by_table(table, high).force);
  return area;
}

SpringResponse by_gap(const SpringGap& gap, double elongation) {
  const contact::NormalTensile law{gap.stiffness, gap.tension,
                                   std::numeric_limits<double>::infinity()};
  const contact::NormalResponse r = law.response(gap.clearance + elongation);
  return {r.traction, r.d_traction,
          law.work(-gap.clearance - elongation) - law.work(-gap.clearance)};
}

}  // namespace

SpringResponse response(const Spring& spring, double elongation) {
  if (spring.gap) return by_gap(*spring.gap, elongation);
  if (spring.table.empty()) {
    const double k = spring.stiffness;
    return {k * elongation, k, 0.5 * k * elongation * elongation};
  }
  SpringResponse r = by_table(spring.table, elongation);
  r.stored = elongation < 0 ? -area_between(spring.table, elongation, 0)
                            : area_between(spring.table, 0, elongation);
  return r;
}

template <int Dim>
SpringMotion motion_of(const Spring& spring, std::span<const Vec<Dim>> reference,
                       std::span<const Vec<Dim>> x, const std::function<double(Dof)>& value) {
  SpringMotion m;
  if (!spring.joins()) {
    m.gradient.resize(static_cast<Eigen::Index>(spring.terms.size()));
    for (std::size_t i = 0; i < spring.terms.size(); ++i) {
      m.dofs.push_back(spring.terms[i].dof);
      m.gradient[static_cast<Eigen::Index>(i)] = spring.terms[i].factor;
      m.elongation += spring.terms[i].factor * value(spring.terms[i].dof);
    }
    return m;
  }
  for (const Index node : spring.ends)
    for (int i = 0; i < Dim; ++i) m.dofs.push_back(Dim * node + i);
  const auto between = [&](std::span<const Vec<Dim>> at) {
    return Vec<Dim>(at[static_cast<std::size_t>(spring.ends[1])] -
                    at[static_cast<std::size_t>(spring.ends[0])]);
  };
  const Vec<Dim> before = between(reference), now = between(x);
  const double length = now.norm();
  const bool turns = spring.turns && length > 0;
  const Vec<Dim> n = turns ? Vec<Dim>(now / length) : Vec<Dim>(before.normalized());
  m.elongation = turns ? length - before.norm() : n.dot(now - before);
  m.gradient.resize(2 * Dim);
  m.gradient << -n, n;
  if (!turns) return m;
  const Mat<Dim, Dim> across = (Mat<Dim, Dim>::Identity() - n * n.transpose()) / length;
  m.curvature.resize(2 * Dim, 2 * Dim);
  m.curvature << across, -across, -across, across;
  return m;
}

template SpringMotion motion_of(const Spring&, std::span<const Vec<2>>, std::span<const Vec<2>>,
                                const std::function<double(Dof)>&);
template SpringMotion motion_of(const Spring&, std::span<const Vec<3>>, std::span<const Vec<3>>,
                                const std::function<double(Dof)>&);

}  // namespace osculate::model

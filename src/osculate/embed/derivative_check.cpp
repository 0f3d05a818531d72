#include "osculate/derivative_check.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/errors.hpp"

namespace osculate {
namespace {

/// All that an evaluation is a function of: coordinates, then unknown tractions.
struct Place {
  std::vector<double> x, unknowns;
  [[nodiscard]] Place moved(const std::vector<double>& way, double step) const {
    Place to = *this;
    for (std::size_t i = 0; i < x.size(); ++i) to.x[i] += step * way[i];
    for (std::size_t i = 0; i < unknowns.size(); ++i) to.unknowns[i] += step * way[x.size() + i];
    return to;
  }
};

template <int Dim>
struct Probe {
  const Evaluator<Dim>& evaluator;
  const History<Dim>& committed;
  const ActiveSet<Dim>& active_set;
  const Multipliers<Dim>& multipliers;
  Increment increment;
  bool unknown;

  void at(const Place& place, bool tangent, Result<Dim>& out) const {
    Increment now = increment;
    now.tangent = tangent;
    Multipliers<Dim> m = multipliers;
    if (unknown) m.points = evaluator.multipliers_of(place.unknowns).points;
    evaluator.evaluate(place.x, committed, active_set, m, out, now);
  }
};

/// Forces, then constraints.
template <int Dim>
std::vector<double> values_of(const Result<Dim>& r) {
  std::vector<double> out(r.branch_force().begin(), r.branch_force().end());
  const std::vector<double>& c = r.constraints().branch_value;
  out.insert(out.end(), c.begin(), c.end());
  return out;
}

template <int Dim>
std::vector<double> tangent_times(const Result<Dim>& r, const std::vector<double>& way) {
  const std::size_t n = r.force().size();
  std::vector<double> out(way.size(), 0.0);
  const auto add = [&](std::span<const Entry> entries, std::size_t row, std::size_t column) {
    for (const Entry& e : entries)
      out[row + static_cast<std::size_t>(e.row)] +=
          e.value * way[column + static_cast<std::size_t>(e.column)];
  };
  add(r.tangent(), 0, 0);
  add(r.constraints().rows, n, 0);
  add(r.constraints().columns, 0, n);
  add(r.constraints().own, n, n);
  return out;
}

template <int Dim>
bool same_states(const Result<Dim>& a, const Result<Dim>& b) {
  const auto same = [](const ContactPoint<Dim>& p, const ContactPoint<Dim>& q) {
    return p.status == q.status &&
           (p.status == Status::open || (p.feature == q.feature && p.facet == q.facet));
  };
  return std::ranges::equal(a.points(), b.points(), same);
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double value : v) sum += value * value;
  return std::sqrt(sum);
}

}  // namespace

template <int Dim>
DerivativeCheck check_derivative(const Evaluator<Dim>& evaluator,
                                 std::span<const double> coordinates, const History<Dim>& committed,
                                 const ActiveSet<Dim>& active_set,
                                 const Multipliers<Dim>& multipliers, double step,
                                 const Increment& increment) {
  if (!(step > 0) || !std::isfinite(step)) throw Refused("the step of a derivative must be > 0");
  constexpr double rounding = 1e-11;
  Result<Dim> here, there;
  Probe<Dim> probe{evaluator, committed, active_set, multipliers, increment, false};
  Place base{{coordinates.begin(), coordinates.end()}, {}};
  probe.at(base, true, here);
  if (!here.constraints().value.empty()) {
    probe.unknown = true;
    base.unknowns = evaluator.unknowns_of(multipliers);
  }
  std::vector<double> way(base.x.size() + base.unknowns.size());
  for (std::size_t i = 0; i < way.size(); ++i) way[i] = std::sin(3.0 * static_cast<double>(i) + 1);
  const std::vector<double> tangent = tangent_times(here, way);
  DerivativeCheck out;
  const auto error = [&](double h) {
    std::vector<double> wrong = tangent;
    for (const double side : {1.0, -1.0}) {
      probe.at(base.moved(way, side * h), false, there);
      out.same_states = out.same_states && same_states(here, there);
      const std::vector<double> values = values_of(there);
      for (std::size_t i = 0; i < wrong.size(); ++i) wrong[i] -= side * values[i] / (2 * h);
    }
    return norm(wrong) / std::max(norm(tangent), 1e-300);
  };
  const double whole = error(step), half = error(step / 2);
  out.error = half;
  out.order = std::log2(whole / half);
  out.exact = whole < rounding && half < rounding;
  return out;
}

template DerivativeCheck check_derivative(const Evaluator<2>&, std::span<const double>,
                                          const History<2>&, const ActiveSet<2>&,
                                          const Multipliers<2>&, double, const Increment&);
template DerivativeCheck check_derivative(const Evaluator<3>&, std::span<const double>,
                                          const History<3>&, const ActiveSet<3>&,
                                          const Multipliers<3>&, double, const Increment&);

}  // namespace osculate

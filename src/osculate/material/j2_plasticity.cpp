#include "osculate/material/j2_plasticity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/material/radial_return.hpp"

namespace osculate::material {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

bool yields(const J2Plasticity& law) { return law.yield > 0 || !law.hardening.empty(); }
double initial_yield(const J2Plasticity& law) {
  return law.hardening.empty() ? law.yield : law.hardening.front()[0];
}

/// The piece of the table that begins at the last point not beyond a plastic strain.
struct Piece {
  double start, end, value, slope;  ///< value at the start
};
Piece piece_at(const J2Plasticity& law, double plastic) {
  const auto& table = law.hardening;
  if (table.empty()) return {0, infinite, law.yield, law.isotropic};
  const auto above = std::upper_bound(
      table.begin(), table.end(), plastic,
      [](double value, const std::array<double, 2>& point) { return value < point[1]; });
  const std::size_t next =
      std::max<std::size_t>(1, static_cast<std::size_t>(above - table.begin()));
  const std::array<double, 2>& a = table[next - 1];
  const double value = a[0] + law.isotropic * a[1];
  if (next >= table.size()) return {a[1], infinite, value, law.isotropic};
  const std::array<double, 2>& b = table[next];
  return {a[1], b[1], value, (b[0] - a[0]) / (b[1] - a[1]) + law.isotropic};
}

/// Increment d of the equivalent plastic strain with  q - stiffness d = Y(alpha + d) , piece by
/// piece, and the slope of Y there.
struct Flow {
  double increment, slope;
};
Flow flow(const J2Plasticity& law, double alpha, double q, double stiffness) {
  for (double from = alpha;;) {
    const Piece p = piece_at(law, from);
    const double increment = (q - p.value - p.slope * (alpha - p.start)) / (stiffness + p.slope);
    if (!(alpha + increment >= p.end)) return {increment, p.slope};
    from = p.end;
  }
}

/// int (Y - Y_0) d(alpha) from 0.
double hardening_energy(const J2Plasticity& law, double plastic) {
  const double first = initial_yield(law);
  double sum = 0;
  for (double from = 0; from < plastic;) {
    const Piece p = piece_at(law, from);
    const double to = std::min(plastic, p.end), width = to - p.start;
    sum += width * (p.value - first + 0.5 * p.slope * width);
    from = to;
  }
  return sum;
}

}  // namespace

YieldStress yield_stress(const J2Plasticity& law, double plastic) {
  if (!yields(law)) return {infinite, 0};
  const Piece p = piece_at(law, plastic);
  return {p.value + p.slope * (plastic - p.start), p.slope};
}

Response3 respond(const J2Plasticity& law, const Strain3& strain, Memory memory) {
  const Lame c = lame(law.young, law.poisson);
  Inelastic now = inelastic_of(memory.committed);
  Response3 r = elastic_predictor(c, elastic_strain(strain, now.strain));
  // The stress of a committed state is on the yield surface but for rounding: it is an elastic one.
  constexpr double rounding = 1e-12;
  const Vec<6> relative = deviator(r.stress) - 2.0 / 3 * law.kinematic * now.strain;
  const double size = tensor_norm(relative), q = std::sqrt(1.5) * size;
  const double limit = yield_stress(law, now.equivalent).value;
  r.ok = std::isfinite(q);
  if (!(q > (1 + rounding) * limit)) {
    remember(now, memory);
    return r;
  }
  const auto [increment, slope] = flow(law, now.equivalent, q, 3 * c.mu + law.kinematic);
  const Vec<6> direction = relative / size;
  const Vec<6> step = std::sqrt(1.5) * increment * direction;
  now.equivalent += increment;
  now.strain += step;
  remember(now, memory);
  const double lost = 3 * c.mu * increment / q;
  return_radially(c.mu, step, direction, lost, 3 * c.mu / (3 * c.mu + law.kinematic + slope) - lost,
                  r);
  return r;
}

Response respond(const J2Plasticity& law, const Strain& strain, Memory memory) {
  return in_plane(respond(law, in_space(strain), memory));
}

Response respond_plane_stress(const J2Plasticity& law, const Strain& strain, double& strain_33,
                              Memory memory) {
  return return_in_plane_stress(law, strain, strain_33, memory);
}

double energy_of(const J2Plasticity& law, const Strain3& strain, const double* state) {
  const Lame c = lame(law.young, law.poisson);
  const Inelastic p = inelastic_of(state);
  const Vec<6> elastic = elastic_strain(strain, p.strain);
  const double trace = elastic.head<3>().sum(), size = tensor_norm(elastic),
               plastic = tensor_norm(p.strain);
  const double stored =
      0.5 * c.lambda * trace * trace + c.mu * size * size + law.kinematic / 3 * plastic * plastic;
  return yields(law) ? stored + hardening_energy(law, p.equivalent) : stored;
}

double dissipated_by(const J2Plasticity& law, const double* state) {
  return state ? initial_yield(law) * state[0] : 0;
}

std::optional<core::Fault> J2Plasticity::fault() const {
  if ((yield > 0) == !hardening.empty())
    return core::Fault{"give `yield` or `hardening`, one of both"};
  const double elastic = 3 * lame(young, poisson).mu + kinematic + isotropic;
  constexpr const char* const steep =
      "the yield stress falls more steeply than the elastic stress can follow";
  if (!(elastic > 0)) return core::Fault{steep};
  const auto wrong = [](const char* why, std::size_t i) {
    return core::Fault{why, "hardening", i};
  };
  for (std::size_t i = 0; i < hardening.size(); ++i) {
    const auto [stress, plastic] = hardening[i];
    if (!(stress > 0)) return wrong("a yield stress is greater than 0", i);
    if (i == 0 && plastic != 0) return wrong("the first plastic strain is 0", i);
    if (i == 0) continue;
    const double way = plastic - hardening[i - 1][1], rise = stress - hardening[i - 1][0];
    if (!(way > 0)) return wrong("plastic strains rise from point to point", i);
    if (!(elastic * way + rise > 0)) return wrong(steep, i);
  }
  return std::nullopt;
}

}  // namespace osculate::material

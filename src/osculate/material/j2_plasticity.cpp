#include "osculate/material/j2_plasticity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/material/curves.hpp"
#include "osculate/material/over_temperature.hpp"
#include "osculate/material/radial_return.hpp"

namespace osculate::material {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Among what is remembered; the first two where there are curves.
constexpr std::size_t back_stress = 7, plastic_work = 13, without_curves = 7;

bool has_curves(const J2Plasticity& law) {
  return !law.hardening_over.empty() || !law.kinematic_over.empty();
}
bool yields(const J2Plasticity& law) {
  return law.yield > 0 || !law.hardening.empty() || !law.hardening_over.empty();
}
double initial_yield(const J2Plasticity& law) {
  return law.hardening.empty() ? law.yield : law.hardening.front()[0];
}

/// Of the yield stress.
CurvePiece yield_piece(const J2Plasticity& law, const double* temperature, double plastic) {
  CurvePiece p{0, infinite, law.yield, 0};
  if (!law.hardening_over.empty())
    p = piece_at(law.hardening_over, temperature, plastic);
  else if (!law.hardening.empty())
    p = piece_at(law.hardening, plastic);
  p.value += law.isotropic * p.start;
  p.slope += law.isotropic;
  return p;
}
/// Of what the middle of the yield surface moves by.
CurvePiece kinematic_piece(const J2Plasticity& law, const double* temperature, double plastic) {
  if (law.kinematic_over.empty()) return {0, infinite, 0, law.kinematic};
  return piece_at(law.kinematic_over, temperature, plastic);
}

/// Increment d of the equivalent plastic strain with  q - 3 G d - (X(alpha + d) - X(alpha)) =
/// Y(alpha + d) , piece by piece, what X rises by, and the slope of both together there.
struct Flow {
  double increment, moved, slope;
};
Flow flow(const J2Plasticity& law, const double* temperature, double alpha, double q,
          double stiffness) {
  const double middle = kinematic_piece(law, temperature, alpha).at(alpha);
  for (double from = alpha;;) {
    const CurvePiece y = yield_piece(law, temperature, from),
                     x = kinematic_piece(law, temperature, from);
    const double slope = y.slope + x.slope;
    const double increment = (q - (y.at(alpha) + x.at(alpha) - middle)) / (stiffness + slope);
    const double end = std::min(y.end, x.end);
    if (!(alpha + increment >= end)) return {increment, x.at(alpha + increment) - middle, slope};
    from = end;
  }
}

/// int (Y - Y_0) d(alpha) from 0.
double hardening_energy(const J2Plasticity& law, double plastic) {
  const double first = initial_yield(law);
  double sum = 0;
  for (double from = 0; from < plastic;) {
    const CurvePiece p = yield_piece(law, nullptr, from);
    const double to = std::min(plastic, p.end), width = to - p.start;
    sum += width * (p.value - first + 0.5 * p.slope * width);
    from = to;
  }
  return sum;
}

Lame lame_at(const J2Plasticity& law, const Memory& memory) {
  return lame(value_at(law.young_over, law.young, memory),
              value_at(law.poisson_over, law.poisson, memory));
}

/// The back stress and the plastic work of a law with curves.
struct Moved {
  Vec<6> back = Vec<6>::Zero();
  double work = 0;
};
Moved moved_of(const double* state) {
  if (!state) return {};
  return {Eigen::Map<const Vec<6>>(state + back_stress), state[plastic_work]};
}
void remember(const Moved& m, const Memory& memory) {
  if (!memory.next) return;
  Eigen::Map<Vec<6>>(memory.next + back_stress) = m.back;
  memory.next[plastic_work] = m.work;
}

/// Product of two symmetric tensors.
double tensor_product(const Vec<6>& a, const Vec<6>& b) {
  return a.head<3>().dot(b.head<3>()) + 2 * a.tail<3>().dot(b.tail<3>());
}

}  // namespace

YieldStress yield_stress(const J2Plasticity& law, double plastic, const double* temperature) {
  if (!yields(law)) return {infinite, 0};
  const CurvePiece p = yield_piece(law, temperature, plastic);
  return {p.at(plastic), p.slope};
}

std::span<const Remembered> remembered_by(const J2Plasticity& law) {
  const std::span<const Remembered> all(J2Plasticity::memory);
  return has_curves(law) ? all : all.first(without_curves);
}

Response3 respond(const J2Plasticity& law, const Strain3& strain, Memory memory) {
  const Lame c = lame_at(law, memory);
  const bool curves = has_curves(law);
  Inelastic now = inelastic_of(memory.committed);
  Moved moved = curves ? moved_of(memory.committed) : Moved{2.0 / 3 * law.kinematic * now.strain};
  const auto keep = [&] {
    remember(now, memory);
    if (curves) remember(moved, memory);
  };
  Response3 r = elastic_predictor(c, elastic_strain(strain, now.strain));
  // The stress of a committed state is on the yield surface but for rounding: it is an elastic one.
  constexpr double rounding = 1e-12;
  const Vec<6> relative = deviator(r.stress) - moved.back;
  const double size = tensor_norm(relative), q = std::sqrt(1.5) * size;
  const double limit = yield_stress(law, now.equivalent, memory.temperature).value;
  r.ok = std::isfinite(q);
  if (!(q > (1 + rounding) * limit)) {
    keep();
    return r;
  }
  const Flow f = flow(law, memory.temperature, now.equivalent, q, 3 * c.mu);
  const Vec<6> direction = relative / size;
  const Vec<6> step = std::sqrt(1.5) * f.increment * direction;
  now.equivalent += f.increment;
  now.strain += step;
  const double lost = 3 * c.mu * f.increment / q;
  return_radially(c.mu, step, direction, lost, 3 * c.mu / (3 * c.mu + f.slope) - lost, r);
  moved.back += std::sqrt(2.0 / 3) * f.moved * direction;
  moved.work += tensor_product(r.stress, step);
  keep();
  return r;
}

Response respond(const J2Plasticity& law, const Strain& strain, Memory memory) {
  return in_plane(respond(law, in_space(strain), memory));
}

Response respond_plane_stress(const J2Plasticity& law, const Strain& strain, double& strain_33,
                              Memory memory) {
  return return_in_plane_stress(law, strain, strain_33, memory);
}

double energy_of(const J2Plasticity& law, const Strain3& strain, const Memory& memory) {
  const Lame c = lame_at(law, memory);
  const Inelastic p = inelastic_of(memory.committed);
  const Vec<6> elastic = elastic_strain(strain, p.strain);
  const double trace = elastic.head<3>().sum(), size = tensor_norm(elastic);
  const double stored = 0.5 * c.lambda * trace * trace + c.mu * size * size;
  if (has_curves(law) || !yields(law)) return stored;
  const double plastic = tensor_norm(p.strain);
  return stored + law.kinematic / 3 * plastic * plastic + hardening_energy(law, p.equivalent);
}

double dissipated_by(const J2Plasticity& law, const double* state) {
  if (!state) return 0;
  return has_curves(law) ? state[plastic_work] : initial_yield(law) * state[0];
}

namespace {

constexpr const char* too_steep =
    "the yield stress falls more steeply than the elastic stress can follow";

/// Of the shear modulus, over the temperature.
double least_shear(const J2Plasticity& law) {
  double young = law.young, poisson = law.poisson;
  for (const auto& row : law.young_over) young = std::min(young, row[1]);
  for (const auto& row : law.poisson_over) poisson = std::max(poisson, row[1]);
  return lame(young, poisson).mu;
}

/// `first`: of the curve, among the points of all curves; `elastic`: what a fall has to stay below.
std::optional<core::Fault> hardening_fault(const core::Table& curve, std::size_t first,
                                           double elastic) {
  const auto wrong = [&](const char* why, std::size_t i) {
    return core::Fault{why, "hardening", first + i};
  };
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const auto [stress, plastic] = curve[i];
    if (!(stress > 0)) return wrong("a yield stress is greater than 0", i);
    if (i == 0 && plastic != 0) return wrong("the first plastic strain is 0", i);
    if (i == 0) continue;
    const double way = plastic - curve[i - 1][1], rise = stress - curve[i - 1][0];
    if (!(way > 0)) return wrong("plastic strains rise from point to point", i);
    if (!(elastic * way + rise > 0)) return wrong(too_steep, i);
  }
  return std::nullopt;
}

std::optional<core::Fault> kinematic_fault(const core::Curves& curves) {
  std::size_t item = 0;
  for (const core::Curve& curve : curves)
    for (std::size_t i = 0; i < curve.points.size(); ++i, ++item) {
      const auto [stress, plastic] = curve.points[i];
      if (i == 0 && (stress != 0 || plastic != 0))
        return core::Fault{"a curve of kinematic hardening begins with [0, 0]", "kinematic", item};
      if (i > 0 && !(plastic > curve.points[i - 1][1]))
        return core::Fault{"plastic strains rise from point to point", "kinematic", item};
    }
  return std::nullopt;
}

}  // namespace

std::optional<core::Fault> J2Plasticity::fault() const {
  const bool tables = !hardening.empty() || !hardening_over.empty();
  if ((yield > 0) == tables) return core::Fault{"give `yield` or `hardening`, one of both"};
  if (auto fault = kinematic_fault(kinematic_over)) return fault;
  const double moves = kinematic_over.empty() ? kinematic : -steepest_fall(kinematic_over);
  const double elastic = 3 * least_shear(*this) + moves + isotropic;
  if (!(elastic > 0)) return core::Fault{too_steep};
  if (auto fault = hardening_fault(hardening, 0, elastic)) return fault;
  std::size_t first = 0;
  for (const core::Curve& curve : hardening_over) {
    if (auto fault = hardening_fault(curve.points, first, elastic)) return fault;
    first += curve.points.size();
  }
  return std::nullopt;
}

}  // namespace osculate::material

#include "osculate/material/viscoelastic.hpp"

#include <array>
#include <cmath>

#include "osculate/material/radial_return.hpp"

namespace osculate::material {
namespace {

/// Products of a branch at the beginning of an increment and of the change of the strain.
struct Squares {
  double begin, both, change;  ///< h : h , h : de , de : de
};
/// x int h : h ds over an increment, s from 0 to 1, h(s) = exp(-x s) h + s left(x s) de.
///
/// Formula    x (left(2x) h:h + 2 (left(x) - left(2x)) / x h:de + (1 - 2 left(x) + left(2x)) / x^2
///            de:de) , by Gauss' rule where that would lose digits
double relaxed_square(double x, const Squares& of) {
  constexpr double loses_digits = 0.25;
  if (x > loses_digits) {
    const double once = left_in_the_mean(x), twice = left_in_the_mean(2 * x);
    return x * twice * of.begin + 2 * (once - twice) * of.both +
           (1 - 2 * once + twice) / x * of.change;
  }
  constexpr std::array<std::array<double, 2>, 5> rule{{{-0.9061798459386640, 0.2369268850561891},
                                                       {-0.5384693101056831, 0.4786286704993665},
                                                       {0, 0.5688888888888889},
                                                       {0.5384693101056831, 0.4786286704993665},
                                                       {0.9061798459386640, 0.2369268850561891}}};
  double sum = 0;
  for (const auto& [at, weight] : rule) {
    const double s = 0.5 * (1 + at), left = std::exp(-x * s), comes = s * left_in_the_mean(x * s);
    sum += 0.5 * weight *
           (left * left * of.begin + 2 * left * comes * of.both + comes * comes * of.change);
  }
  return x * sum;
}

/// Strain, less what has relaxed, of all branches of one modulus, weighted by their shares.
template <int N>
struct Relaxed {
  Vec<N> strain;      ///< what the modulus at once multiplies
  double slope;       ///< of it by the strain now
  double dissipated;  ///< x int h : h ds , by the shares
  double stored;      ///< h : h , by the shares
};
/// `norm`: h : h of the components. Branches are read from `before` and written to `next`.
template <int N, class Product>
Relaxed<N> relaxed(const core::Table& series, double duration, const Vec<N>& now,
                   const Vec<N>& change, const double* before, double* next,
                   const Product& product) {
  const double rest = remaining(series);
  Relaxed<N> out{rest * now, rest, 0, rest * product(now, now)};
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto [share, time] = series[i];
    const double x = duration / time, left = std::exp(-x), mean = left_in_the_mean(x);
    Vec<N> h = Vec<N>::Zero();
    if (before) h = Eigen::Map<const Vec<N>>(before + i * Viscoelastic::each);
    out.dissipated +=
        share * relaxed_square(x, {product(h, h), product(h, change), product(change, change)});
    h = left * h + mean * change;
    if (next) Eigen::Map<Vec<N>>(next + i * Viscoelastic::each) = h;
    out.strain += share * h;
    out.slope += share * mean;
    out.stored += share * product(h, h);
  }
  return out;
}

double product_of_tensors(const Vec<6>& a, const Vec<6>& b) {
  return a.head<3>().dot(b.head<3>()) + 2 * a.tail<3>().dot(b.tail<3>());
}

/// What both moduli make of a strain after an increment.
struct Both {
  Relaxed<6> shear;
  Relaxed<1> bulk;
  Vec<6> strain;  ///< tensor components
};
Both both_of(const Viscoelastic& law, const Strain3& strain, const Memory& memory) {
  const auto part = [](auto* from, std::size_t offset) { return from ? from + offset : nullptr; };
  constexpr std::size_t strains = 1;
  constexpr std::size_t volumes = Viscoelastic::own + 6;
  const Vec<6> now = elastic_strain(strain, Vec<6>::Zero());
  Vec<6> before = Vec<6>::Zero();
  if (memory.committed) before = Eigen::Map<const Vec<6>>(memory.committed + strains);
  const Vec<6> change = now - before;
  const Vec<1> volume(now.head<3>().sum()), of_volume(change.head<3>().sum());
  return {relaxed<6>(law.shear, memory.duration, deviator(now), deviator(change),
                     part(memory.committed, Viscoelastic::own),
                     part(memory.next, Viscoelastic::own), product_of_tensors),
          relaxed<1>(law.bulk, memory.duration, volume, of_volume, part(memory.committed, volumes),
                     part(memory.next, volumes),
                     [](const Vec<1>& a, const Vec<1>& b) { return a[0] * b[0]; }),
          now};
}

}  // namespace

Response3 respond(const Viscoelastic& law, const Strain3& strain, Memory memory) {
  const Lame c = lame(law.young, law.poisson);
  const double bulk = c.lambda + 2 * c.mu / 3;
  const Both now = both_of(law, strain, memory);
  const double shear_slope = c.mu * now.shear.slope, bulk_slope = bulk * now.bulk.slope;
  Response3 r = elastic_predictor({bulk_slope - 2 * shear_slope / 3, shear_slope}, Vec<6>::Zero());
  r.stress = 2 * c.mu * now.shear.strain;
  r.stress.head<3>().array() += bulk * now.bulk.strain[0];
  r.ok = r.stress.allFinite();
  if (!memory.next) return r;
  memory.next[0] = (memory.committed ? memory.committed[0] : 0) + 2 * c.mu * now.shear.dissipated +
                   bulk * now.bulk.dissipated;
  Eigen::Map<Vec<6>>(memory.next + 1) = now.strain;
  return r;
}

Response respond(const Viscoelastic& law, const Strain& strain, Memory memory) {
  return in_plane(respond(law, in_space(strain), memory));
}

Response respond_plane_stress(const Viscoelastic& law, const Strain& strain, double& strain_33,
                              Memory memory) {
  Strain e = strain;
  e[2] = memory.committed ? memory.committed[3] : 0;
  return without_stress_across(law, e, strain_33, memory);
}

/// At once, from the state that is remembered.
double energy_of(const Viscoelastic& law, const Strain3& strain, const Memory& memory) {
  const Lame c = lame(law.young, law.poisson);
  const Both now = both_of(law, strain, {memory.committed, nullptr, memory.size});
  return c.mu * now.shear.stored + 0.5 * (c.lambda + 2 * c.mu / 3) * now.bulk.stored;
}

double dissipated_by(const Viscoelastic&, const double* state) { return state ? state[0] : 0; }

std::span<const Remembered> remembered_by(const Viscoelastic& law) {
  return std::span(Viscoelastic::memory)
      .first(Viscoelastic::own + Viscoelastic::each * terms_of(law.shear, law.bulk));
}

std::optional<core::Fault> Viscoelastic::fault() const { return fault_of_series(shear, bulk); }

}  // namespace osculate::material

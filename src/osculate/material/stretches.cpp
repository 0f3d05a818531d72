#include "osculate/material/stretches.hpp"

#include <array>

#include "osculate/material/hyperfoam.hpp"
#include "osculate/material/ogden.hpp"
#include "osculate/material/orientation.hpp"

namespace osculate::material {
namespace {

struct OgdenTerm {
  double mu, alpha;
};
std::array<OgdenTerm, 3> terms_of(const Ogden& c) {
  return {{{c.mu1, c.alpha1}, {c.mu2, c.alpha2}, {c.mu3, c.alpha3}}};
}
struct FoamTerm {
  double mu, alpha, nu;
  [[nodiscard]] double beta() const { return nu / (1 - 2 * nu); }
};
std::array<FoamTerm, 3> terms_of(const Hyperfoam& c) {
  return {{{c.mu1, c.alpha1, c.nu1}, {c.mu2, c.alpha2, c.nu2}, {c.mu3, c.alpha3, c.nu3}}};
}

Isotropic from_moduli(double mu, double bulk) {
  return {9 * bulk * mu / (3 * bulk + mu), (3 * bulk - 2 * mu) / (2 * (3 * bulk + mu))};
}

/// sum (J - 1)^(2 k) / d_k.
OfVolume volume_of(const Ogden& law, double log_j) {
  OfVolume out;
  const double j = std::exp(log_j), change = std::expm1(log_j);
  double power = 1, first = 0, second = 0;  // (J - 1)^(2 k - 2), dU/dJ, d2U/dJ2
  int n = 2;
  for (const double d : {law.d1, law.d2, law.d3}) {
    if (d > 0) {
      out.energy += power * change * change / d;
      first += n * power * change / d;
      second += n * (n - 1) * power / d;
    }
    power *= change * change;
    n += 2;
  }
  out.pull = j * first;
  out.slope = j * first + j * j * second;
  return out;
}

/// Every term with a factor has a power; together they resist shear.
template <class Terms>
std::optional<core::Fault> fault_of(const Terms& terms) {
  constexpr std::array<std::string_view, 3> powers{"alpha1", "alpha2", "alpha3"};
  double shear = 0;
  for (std::size_t p = 0; p < terms.size(); ++p) {
    shear += terms[p].mu;
    if (terms[p].mu != 0 && terms[p].alpha == 0)
      return core::Fault{"a term with mu has a power that is not 0", powers[p], {}};
  }
  if (!(shear > 0))
    return core::Fault{"mu1 + mu2 + mu3 > 0 is needed: the shear modulus", "mu1", {}};
  return std::nullopt;
}

}  // namespace

Response3 response_of_axes(const LogarithmicStrain& strain, const AlongAxes& law) {
  const PrincipalStrain e = strain.principal();
  const Vec3 c = (2 * e.value).array().exp();
  const Vec3 s = (law.stress.array() + law.volume.pull).matrix().cwiseQuotient(c);
  Tangent3 d = Tangent3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      d(i, j) = ((law.slope(i, j) + law.volume.slope) / c[j] - (i == j ? 2 * s[i] : 0)) / c[i];
  constexpr std::array<std::array<Eigen::Index, 2>, 3> shears{{{0, 1}, {1, 2}, {0, 2}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [i, j] = shears[k];
    const auto row = static_cast<Eigen::Index>(3 + k);
    d(row, row) = 0.5 * (law.secant(i, j) * e.mean_slope(i, j) - 2 * s[j]) / c[i];
  }
  Response3 r;
  r.stress = into_axes(strain.axes()).transpose() * Vec<6>(s[0], s[1], s[2], 0, 0, 0);
  r.tangent = turned(d, strain.axes());
  r.ok = r.stress.allFinite() && r.tangent.allFinite();
  return r;
}

AlongAxes along_axes(const Ogden& law, const PrincipalStrain& e) {
  AlongAxes out;
  const double log_j = e.value.sum();
  for (const auto& [mu, alpha] : terms_of(law)) {
    if (mu == 0) continue;
    const double factor = 2 * mu / alpha;
    const Vec3 less_one =
        (alpha * (e.value.array() - log_j / 3)).unaryExpr([](double x) { return std::expm1(x); });
    const double mean = less_one.mean();
    out.energy += factor / alpha * 3 * mean;
    out.stress.array() += factor * (less_one.array() - mean);
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j)
        out.slope(i, j) +=
            factor * alpha *
            ((i == j ? 1 + less_one[i] : 0) - (1 + less_one[i] + less_one[j] - mean) / 3);
    add_secants({factor, alpha, log_j / 3}, e, out);
  }
  out.volume = volume_of(law, log_j);
  return out;
}

AlongAxes along_axes(const Hyperfoam& law, const PrincipalStrain& e) {
  AlongAxes out;
  const double log_j = e.value.sum();
  for (const FoamTerm& term : terms_of(law)) {
    const auto [mu, alpha, nu] = term;
    if (mu == 0) continue;
    const double factor = 2 * mu / alpha, beta = term.beta();
    const Vec3 less_one = (alpha * e.value).unaryExpr([](double x) { return std::expm1(x); });
    const double volume = std::expm1(-alpha * beta * log_j);
    out.energy += factor / alpha * (less_one.sum() + (beta == 0 ? -alpha * log_j : volume / beta));
    out.stress.array() += factor * (less_one.array() - volume);
    out.slope.array() += factor * alpha * beta * (1 + volume);
    out.slope.diagonal().array() += factor * alpha * (1 + less_one.array());
    add_secants({factor, alpha, 0}, e, out);
  }
  return out;
}

Isotropic unloaded(const Ogden& law) {
  return from_moduli(law.mu1 + law.mu2 + law.mu3, 2 / law.d1);
}
Isotropic unloaded(const Hyperfoam& law) {
  double mu = 0, bulk = 0;
  for (const FoamTerm& term : terms_of(law)) {
    mu += term.mu;
    bulk += 2 * term.mu * (1.0 / 3 + term.beta());
  }
  return from_moduli(mu, bulk);
}

std::optional<core::Fault> Ogden::fault() const { return fault_of(terms_of(*this)); }
std::optional<core::Fault> Hyperfoam::fault() const {
  if (auto wrong = fault_of(terms_of(*this))) return wrong;
  const Isotropic is = unloaded(*this);
  if (is.young > 0 && is.poisson > -1 && is.poisson < 0.5) return std::nullopt;
  return core::Fault{"the terms together do not resist changes of volume", "nu1", {}};
}

}  // namespace osculate::material

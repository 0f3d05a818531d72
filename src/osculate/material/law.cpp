#include "osculate/material/law.hpp"

#include <algorithm>

namespace osculate::material {
namespace {

Response hooke(double young, double poisson, const Strain& e) {
  const Lame c = lame(young, poisson);
  Response r;
  r.tangent.topLeftCorner<3, 3>().setConstant(c.lambda);
  r.tangent.diagonal() += Vec<4>(2 * c.mu, 2 * c.mu, 2 * c.mu, c.mu);
  r.stress = r.tangent * e;
  return r;
}

Response respond(const LinearElastic& m, const Strain& e) { return hooke(m.young, m.poisson, e); }
Response respond(const StVenantKirchhoff& m, const Strain& e) {
  return hooke(m.young, m.poisson, e);
}

Response respond(const NeoHooke& m, const Strain& e) {
  const Lame c = lame(m.young, m.poisson);
  const double c11 = 1 + 2 * e[0], c22 = 1 + 2 * e[1], c33 = 1 + 2 * e[2], c12 = e[3];
  const double plane = c11 * c22 - c12 * c12;
  Response r;
  r.ok = plane > 0 && c33 > 0 && c11 > 0;
  if (!r.ok) return r;
  const double log_j = 0.5 * std::log(plane * c33);
  const Vec<4> inv(c22 / plane, c11 / plane, 1 / c33, -c12 / plane);  // C^-1
  const double p = c.lambda * log_j - c.mu;
  r.stress = Vec<4>(c.mu, c.mu, c.mu, 0) + p * inv;
  // dS/dE = lambda C^-1 x C^-1 - 2 p (symmetrised C^-1 . C^-1)
  r.tangent = c.lambda * inv * inv.transpose();
  Tangent square;
  square << inv[0] * inv[0], inv[3] * inv[3], 0, inv[0] * inv[3],  //
      inv[3] * inv[3], inv[1] * inv[1], 0, inv[1] * inv[3],        //
      0, 0, inv[2] * inv[2], 0,                                    //
      inv[0] * inv[3], inv[1] * inv[3], 0, 0.5 * (inv[0] * inv[1] + inv[3] * inv[3]);
  r.tangent -= 2 * p * square;
  return r;
}

/// Static condensation of the 33 component at S33 = 0.
Response condense(Response r) {
  const Vec<4> column = r.tangent.col(2);
  const double stiff = r.tangent(2, 2);
  r.tangent -= column * column.transpose() / stiff;
  r.tangent.row(2).setZero();
  r.tangent.col(2).setZero();
  r.stress[2] = 0;
  return r;
}

}  // namespace

bool finite_strain(const Law& law) {
  return std::visit([](const auto& m) { return m.finite_strain; }, law);
}

Response response(const Law& law, const Strain& strain) {
  return std::visit([&](const auto& m) { return respond(m, strain); }, law);
}

Response plane_stress_response(const Law& law, Strain strain, double* strain_33) {
  const double nu = std::visit([](const auto& m) { return m.poisson; }, law);
  strain[2] = std::max(-nu / (1 - nu) * (strain[0] + strain[1]), -0.45);
  Response r;
  for (int i = 0; i < 60; ++i) {
    r = response(law, strain);
    if (!r.ok || !(r.tangent(2, 2) > 0)) {
      r.ok = false;
      return r;
    }
    const double scale = r.tangent(2, 2);
    const double step = -r.stress[2] / scale;
    if (std::abs(step) <= 1e-15 * std::max(1.0, strain.norm())) break;
    strain[2] = std::max(strain[2] + step, 0.5 * (strain[2] - 0.5));  // stay above -1/2
  }
  if (strain_33) *strain_33 = strain[2];
  return condense(r);
}

}  // namespace osculate::material

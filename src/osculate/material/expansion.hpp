#pragma once
#include "osculate/material/memory.hpp"
#include "osculate/material/response.hpp"

namespace osculate::material {

/// How a material expands with its temperature: pairs of a temperature and the mean coefficient
/// from `reference` to it, linear between them and constant beyond. Empty: it does not.
struct Expansion {
  core::Table table;
  double reference = 0;
};

/// Strain of a body that is free to expand from the temperature `before`, at which it is free of
/// strain, to `temperature`.
///
/// Formula    alpha(T) (T - T_ref) - alpha(T_0) (T_0 - T_ref)
/// Source     Abaqus' and CalculiX' *EXPANSION, ZERO=T_ref
/// Units      1
/// Tested by  tests/unit/material/test_expansion.cpp
[[nodiscard]] double expansion(const Expansion& law, double temperature, double before);

/// What the expansion e of a point makes of the response of its law.
///
/// Formula    small strain: S(E - e I). Finite: F = F_e theta with theta = 1 + e, so that
///            E_e = (E - (theta^2 - 1)/2 I) / theta^2 , W = theta^3 W_e(E_e) (the law's energy is
///            one of the volume that is free of stress now), S = theta S_e , dS/dE = dS_e/dE_e /
///            theta : the Cauchy stress is that of the law at F_e
/// Source     Stojanovic, Djuric & Vujosevic 1964; Lu & Pister 1975
/// Tested by  tests/unit/material/test_expansion.cpp
///
/// An initial strain (Memory::initial) is added to the strain before.
///
/// Formula    S(E + E_0) , E_0 = D^-1 S_0 of an initial stress
class Expanded {
 public:
  Expanded(bool finite, const Memory& memory)
      : any_(memory.expansion),
        finite_(finite),
        strain_(any_ ? *memory.expansion : 0),
        initial_(memory.initial) {}

  [[nodiscard]] double stretch() const { return finite_ ? 1 + strain_ : 1; }
  [[nodiscard]] double volume() const { return stretch() * stretch() * stretch(); }
  template <int N>
  [[nodiscard]] Vec<N> elastic(Vec<N> strain) const {
    if (initial_) strain += Eigen::Map<const Vec<6>>(initial_).template head<N>();
    if (!any_) return strain;
    strain.template head<3>().array() -= of_axes();
    return strain / (stretch() * stretch());
  }
  /// The strain along an axis, from the elastic one.
  [[nodiscard]] double total(double elastic) const {
    const double here = any_ ? stretch() * stretch() * elastic + of_axes() : elastic;
    return initial_ ? here - initial_[2] : here;
  }
  template <int N>
  [[nodiscard]] ResponseOf<N> response(ResponseOf<N> elastic) const {
    if (any_) {
      elastic.stress *= stretch();
      elastic.tangent /= stretch();
    }
    return elastic;
  }

 private:
  [[nodiscard]] double of_axes() const {
    return finite_ ? strain_ + 0.5 * strain_ * strain_ : strain_;
  }
  bool any_, finite_;
  double strain_;
  const double* initial_;
};

}  // namespace osculate::material

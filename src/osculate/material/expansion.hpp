#pragma once
#include <optional>
#include <vector>

#include "osculate/material/memory.hpp"
#include "osculate/material/response.hpp"

namespace osculate::material {

/// How a material expands with its temperature: pairs of a temperature and the mean coefficient
/// from `reference` to it, linear between them and constant beyond. Empty: it does not.
struct Expansion {
  core::Table table{};
  double reference = 0;
  /// In place of the table, of a material that expands by directions: the coefficients are those of
  /// a strain in its axes.
  struct Directions {
    double temperature = 0;
    Strain3 coefficients = Strain3::Zero();  ///< shear components twice those of the tensor
  };
  std::vector<Directions> directions{};
};

/// Numbers of its strain a point (Memory::strains): 0, 1, or 6 where it differs with the direction.
[[nodiscard]] inline std::size_t strains_of(const Expansion& law) {
  if (!law.directions.empty()) return 6;
  return law.table.empty() ? 0 : 1;
}

/// Strain of a body that is free to expand from the temperature `before`, at which it is free of
/// strain, to `temperature`.
///
/// Formula    alpha(T) (T - T_ref) - alpha(T_0) (T_0 - T_ref)
/// Source     Abaqus' and CalculiX' *EXPANSION, ZERO=T_ref
/// Units      1
/// Tested by  tests/unit/material/test_expansion.cpp
[[nodiscard]] double expansion(const Expansion& law, double temperature, double before);
/// The same of one that differs with the direction, in its axes.
[[nodiscard]] Strain3 expansion_by_directions(const Expansion& law, double temperature,
                                              double before);

/// What a strain of six components by the temperature makes of others.
struct FreeExpansion {
  Strain3 strain = Strain3::Zero();        ///< of the body that is free to expand
  Mat<6, 6> into = Mat<6, 6>::Identity();  ///< strains, less that one, into elastic ones
  Mat<6, 6> back = Mat<6, 6>::Identity();  ///< and back
  double volume = 1;
};
[[nodiscard]] FreeExpansion free_expansion(bool finite, const Strain3& strain);

/// What the expansion e of a point makes of the response of its law.
///
/// Formula    small strain: S(E - e). Finite: F = F_e U with U = I + e, so that
///            E_e = U^-1 (E - (U^2 - I)/2) U^-1 , W = det(U) W_e(E_e) (the law's energy is one of
///            the volume that is free of stress now), S = det(U) U^-1 S_e U^-1 : the Cauchy stress
///            is that of the law at F_e. Of one number e, U = theta I: S = theta S_e , dS/dE =
///            dS_e/dE_e / theta
/// Source     Stojanovic, Djuric & Vujosevic 1964; Lu & Pister 1975
/// Tested by  tests/unit/material/test_expansion.cpp
///
/// An initial strain (Memory::initial) is added to the strain before.
///
/// Formula    S(E + E_0) , E_0 = D^-1 S_0 of an initial stress
class Expanded {
 public:
  Expanded(bool finite, const Memory& memory)
      : any_(memory.expansion && memory.strains == 1),
        finite_(finite),
        strain_(any_ ? *memory.expansion : 0),
        initial_(memory.initial) {
    if (memory.expansion && memory.strains == 6)
      by_directions_ = free_expansion(finite, Eigen::Map<const Strain3>(memory.expansion));
  }

  [[nodiscard]] double volume() const {
    return by_directions_ ? by_directions_->volume : stretch() * stretch() * stretch();
  }
  template <int N>
  [[nodiscard]] Vec<N> elastic(Vec<N> strain) const {
    if (initial_) strain += Eigen::Map<const Vec<6>>(initial_).template head<N>();
    if (by_directions_) {
      const Vec<N> rest = strain - by_directions_->strain.template head<N>();
      return by_directions_->into.template topLeftCorner<N, N>() * rest;
    }
    if (!any_) return strain;
    strain.template head<3>().array() -= of_axes();
    return strain / (stretch() * stretch());
  }
  /// The strain along an axis, from the elastic one; that axis is one of the expansion's.
  [[nodiscard]] double total(double elastic) const {
    double here = any_ ? stretch() * stretch() * elastic + of_axes() : elastic;
    if (by_directions_) here = by_directions_->back(2, 2) * elastic + by_directions_->strain[2];
    return initial_ ? here - initial_[2] : here;
  }
  template <int N>
  [[nodiscard]] Vec<N> stress(const Vec<N>& elastic) const {
    if (!by_directions_) return stretch() * elastic;
    const Mat<N, N> into = by_directions_->into.template topLeftCorner<N, N>();
    return by_directions_->volume * (into.transpose() * elastic);
  }
  template <int N>
  [[nodiscard]] ResponseOf<N> response(ResponseOf<N> elastic) const {
    if (by_directions_) {
      const Mat<N, N> into = by_directions_->into.template topLeftCorner<N, N>();
      elastic.stress = stress<N>(elastic.stress);
      elastic.tangent = by_directions_->volume * (into.transpose() * elastic.tangent * into).eval();
    } else if (any_) {
      elastic.stress *= stretch();
      elastic.tangent /= stretch();
    }
    return elastic;
  }

 private:
  [[nodiscard]] double stretch() const { return finite_ ? 1 + strain_ : 1; }
  [[nodiscard]] double of_axes() const {
    return finite_ ? strain_ + 0.5 * strain_ * strain_ : strain_;
  }
  bool any_, finite_;
  double strain_;
  const double* initial_;
  std::optional<FreeExpansion> by_directions_{};
};

}  // namespace osculate::material

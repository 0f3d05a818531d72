#pragma once
#include <array>
#include <optional>
#include <span>

#include "osculate/material/linear_elastic.hpp"
#include "osculate/material/memory.hpp"

namespace osculate::material {

/// Plasticity of metals: von Mises' yield condition with the associated flow rule, isotropic
/// hardening by a table and kinematic hardening, linear (Prager) or by a table.
///
/// Formula    sigma = K tr(eps) I + 2 G dev(eps - eps_p),  beta = 2/3 H_k eps_p,
///            f = sqrt(3/2) |dev sigma - beta| - Y(alpha) <= 0,
///            d(eps_p) = sqrt(3/2) n d(alpha),  n along dev sigma - beta,
///            Y(alpha) = table(alpha) + H alpha, linear between the points of the table and
///            constant beyond the last one. With a table X(alpha) of kinematic hardening
///            d(beta) = sqrt(2/3) n X'(alpha) d(alpha): what has moved stays when the temperature
///            changes
/// Source     radial return and its consistent tangent: Simo & Taylor 1985, Simo & Hughes 1998,
///            box 3.1 and 3.2, with alpha by the slope of the table; tables of kinematic hardening
///            and all of them over the temperature: *PLASTIC of CalculiX
/// Units      young, isotropic, kinematic: force/length^2; yield: force/length^2 and 1
/// Requires   E > 0, -1 < nu < 0.5; the plastic strains of the tables begin at 0 and rise, the
///            stresses of `hardening` are positive, those of `kinematic` begin at 0, and
///            H + H_k + 3 G is more than what a falling table loses
/// Returns    stored energy: elastic, 1/2 beta . eps_p, and int (Y - Y_0) d(alpha); the rest of the
///            plastic work, Y_0 alpha, is dissipated. With a table of kinematic hardening or curves
///            over the temperature all of the plastic work counts as dissipated
/// Tested by  tests/unit/material/test_j2_plasticity.cpp, test_j2_curves.cpp
struct J2Plasticity {
  static constexpr std::string_view key = "elastoplastic";
  static constexpr std::string_view doc =
      "Plasticity of metals: von Mises' yield condition, isotropic and kinematic hardening by a "
      "table, also over the temperature, or a modulus. With kinematics: finite the strain is the "
      "logarithmic one.";
  static constexpr bool finite_strain = false, large_strain = false, logarithmic = true,
                        hooke_at_first = true;
  /// The back stress and the plastic work stand behind the strains where there are curves.
  static constexpr std::array<Remembered, 14> memory{
      {{"PEEQ", "equivalent plastic strain", false},
       {"PE11", "plastic strain, tensor component"},
       {"PE22", "plastic strain, tensor component"},
       {"PE33", "plastic strain, tensor component"},
       {"PE12", "plastic strain, tensor component"},
       {"PE23", "plastic strain, tensor component"},
       {"PE13", "plastic strain, tensor component"}}};
  double young = 0, poisson = 0, density = 0;
  double yield = 0;  ///< initial yield stress, if there is no table; 0 without one: elastic
  double isotropic = 0, kinematic = 0;  ///< H, H_k
  core::Table hardening = {};           ///< yield stress, equivalent plastic strain
  core::Curves hardening_over = {};     ///< in place of it: over the temperature
  core::Curves kinematic_over = {};     ///< back stress of a bar, in place of the modulus
  core::Table young_over = {}, poisson_over = {};  ///< over the temperature, in place of them
  static constexpr core::PointWords points{
      "One point: the yield stress, the equivalent plastic strain at which it is reached, and "
      "perhaps the temperature of its curve.",
      "A number.", "[250, 0]"};
  static constexpr core::PointWords kinematic_points{
      "One point: what the middle has moved by, the equivalent plastic strain at which it has, and "
      "perhaps the temperature of its curve.",
      "A number.", "[0, 0]"};
  static constexpr std::array<core::Param<J2Plasticity>, 7> params();
  /// What is wrong with the hardening.
  [[nodiscard]] std::optional<core::Fault> fault() const;
};

constexpr std::array<core::Param<J2Plasticity>, 7> J2Plasticity::params() {
  const auto [young, poisson, density] = isotropic_params<J2Plasticity>();
  return {
      young,
      poisson,
      density,
      {.key = "yield",
       .unit = "force/length^2",
       .doc = "Yield stress of a bar that has not flown yet; or give `hardening`.",
       .slot = &J2Plasticity::yield,
       .range = {.lower = 0},
       .required = false,
       .example = "250",
       .otherwise = "that of the first point of hardening"},
      {.key = "hardening",
       .unit = "force/length^2",
       .doc = "Yield stress over the equivalent plastic strain, from 0 on: straight between the "
              "points, constant beyond the last one (as *PLASTIC of Abaqus and CalculiX). With a "
              "third number these are curves over the temperature, one after the other.",
       .slot = &J2Plasticity::hardening,
       .required = false,
       .example = "[[250, 0], [300, 0.02], [350, 0.1]]",
       .otherwise = "the yield stress does not change",
       .points = &J2Plasticity::points,
       .curves = &J2Plasticity::hardening_over},
      {.key = "isotropic",
       .unit = "force/length^2",
       .doc = "What the yield stress rises by, per equivalent plastic strain, beside the table.",
       .slot = &J2Plasticity::isotropic,
       .required = false,
       .example = "2000"},
      {.key = "kinematic",
       .unit = "force/length^2",
       .doc = "Kinematic hardening, what the middle of the yield surface moves by along a bar: a "
              "modulus (Prager), or a curve over the equivalent plastic strain from [0, 0] on, "
              "straight between its points and constant beyond the last one, perhaps over the "
              "temperature.",
       .slot = &J2Plasticity::kinematic,
       .required = false,
       .example = "2000",
       .points = &J2Plasticity::kinematic_points,
       .curves = &J2Plasticity::kinematic_over}};
}

[[nodiscard]] Response3 respond(const J2Plasticity& law, const Strain3& strain, Memory memory);
[[nodiscard]] Response respond(const J2Plasticity& law, const Strain& strain, Memory memory);
[[nodiscard]] Response respond_plane_stress(const J2Plasticity& law, const Strain& strain,
                                            double& strain_33, Memory memory);

/// Yield stress and its slope at an equivalent plastic strain; at a point of the table the slope of
/// the piece behind it. Over the temperature: at that one, null: the first one.
struct YieldStress {
  double value, slope;
};
[[nodiscard]] YieldStress yield_stress(const J2Plasticity& law, double plastic,
                                       const double* temperature = nullptr);

[[nodiscard]] inline Isotropic unloaded(const J2Plasticity& law) {
  return {law.young, law.poisson};
}
/// Stored at a strain by a point that remembers something (null: nothing).
[[nodiscard]] double energy_of(const J2Plasticity& law, const Strain3& strain,
                               const Memory& memory);
/// Dissipated so far by a point that remembers `state`.
[[nodiscard]] double dissipated_by(const J2Plasticity& law, const double* state);
/// What is remembered: more where the hardening is given by curves.
[[nodiscard]] std::span<const Remembered> remembered_by(const J2Plasticity& law);

}  // namespace osculate::material

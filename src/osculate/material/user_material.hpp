#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/material/memory.hpp"
#include "osculate/material/user_routine.hpp"

namespace osculate::material {

/// A material whose formulas are a routine of a shared library, with the arguments of UMAT
/// (include/osculate/user_material.h).
///
/// Formula    sigma, d(sigma)/d(eps) = routine(sigma_n, state_n, eps_n, eps - eps_n, ...); in
/// finite
///            strain eps = ln U, the routine sees U as the deformation gradient and returns R^T
///            sigma R, of which J times as much works on eps: T = J sigma, dT/d(eps) = J DDSDDE
/// Source     UMAT as documented by Abaqus; the frame that turns with the body: Miehe, Apel &
///            Lambrecht 2002
/// Units      those of the model
/// Requires   a routine: open() has been called. Without one there is no answer
/// Returns    stored energy: SSE of the routine; of one that leaves SSE, SPD and SCD at 0 the work
///            of the stresses by the trapezoidal rule. Dissipated: SPD + SCD
/// Tested by  tests/unit/material/test_user_material.cpp, verification/user_material
struct UserMaterial {
  static constexpr std::string_view key = "user";
  static constexpr std::string_view doc =
      "A material of one's own: a routine of a shared library with the arguments of UMAT "
      "(user_material.h, docs/user_material.md). With kinematics: finite the strain is the "
      "logarithmic one. Every step needs a duration.";
  static constexpr bool finite_strain = false, large_strain = false, logarithmic = true,
                        takes_temperature = true;
  /// Behind these, which are no results, stand the state variables (remembered_by).
  static constexpr std::array<Remembered, 18> memory{};
  std::string library, function = "umat_", name = "user";
  std::vector<double> constants = {};
  double state = 0, density = 0;  ///< how many state variables
  bool finite = false;            ///< the strain is the logarithmic one
  std::shared_ptr<const UserRoutine> routine = {};
  Isotropic at_rest{1, 0};  ///< what the unloaded material is like in the mean of all directions

  static constexpr std::array<core::Param<UserMaterial>, 6> params();
  [[nodiscard]] std::optional<core::Fault> fault() const;
  /// Finds the routine in the library, whose name is relative to the folder, and asks it for the
  /// stiffness of the unloaded material. Returns what is wrong.
  [[nodiscard]] std::optional<core::Fault> open(const std::string& folder);
  /// The same for a routine that has been found.
  [[nodiscard]] std::optional<core::Fault> use(osculate_user_material* found,
                                               std::shared_ptr<void> kept = {});
};

constexpr std::array<core::Param<UserMaterial>, 6> UserMaterial::params() {
  using P = core::Param<UserMaterial>;
  return {P{.key = "library",
            .unit = "1",
            .doc = "The shared library, relative to the folder of the model file.",
            .slot = &UserMaterial::library,
            .required = false,
            .example = "umat.so",
            .otherwise = "none: the function is an address",
            .timed = true},
          P{.key = "function",
            .unit = "1",
            .doc = "The routine: gfortran's name of UMAT, unless another one is given.",
            .slot = &UserMaterial::function,
            .required = false,
            .example = "umat_",
            .otherwise = "umat_"},
          P{.key = "name",
            .unit = "1",
            .doc = "What the routine gets as CMNAME, in capitals.",
            .slot = &UserMaterial::name,
            .required = false,
            .example = "steel",
            .otherwise = "USER"},
          P{.key = "constants",
            .unit = "1",
            .doc = "The constants that it gets as PROPS, in its own units.",
            .slot = &UserMaterial::constants,
            .required = false,
            .example = "[2.1e5, 0.3]",
            .otherwise = "none"},
          P{.key = "state",
            .unit = "1",
            .doc = "How many state variables it has; they are the fields SDV1, SDV2, ...",
            .slot = &UserMaterial::state,
            .range = {.lower = 0, .upper = 999, .with_lower = true, .with_upper = true},
            .required = false,
            .example = "7"},
          P{.key = "density",
            .unit = "mass/length^3",
            .doc = "Mass per reference volume.",
            .slot = &UserMaterial::density,
            .range = {.lower = 0, .with_lower = true},
            .required = false,
            .example = "7.85e-9"}};
}

[[nodiscard]] Response3 respond(const UserMaterial& law, const Strain3& strain, Memory memory);
[[nodiscard]] Response respond(const UserMaterial& law, const Strain& strain, Memory memory);
[[nodiscard]] Response respond_plane_stress(const UserMaterial& law, const Strain& strain,
                                            double& strain_33, Memory memory);

/// What a point remembers: 18 numbers without a name, then the state variables.
[[nodiscard]] std::span<const Remembered> remembered_by(const UserMaterial& law);
/// Why the routine had no answer the last time it had none.
[[nodiscard]] std::string complaint_of(const UserMaterial& law);

[[nodiscard]] inline Isotropic unloaded(const UserMaterial& law) { return law.at_rest; }
/// Stored by a point that remembers `state` (null: nothing).
[[nodiscard]] double energy_of(const UserMaterial& law, const Strain3& strain,
                               const Memory& memory);
/// Dissipated so far by a point that remembers `state`.
[[nodiscard]] double dissipated_by(const UserMaterial& law, const double* state);

}  // namespace osculate::material

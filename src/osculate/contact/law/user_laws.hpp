#pragma once
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/contact/law/penalty_param.hpp"
#include "osculate/contact/law/tangential.hpp"
#include "osculate/core/param.hpp"
#include "osculate/user_law.h"

namespace osculate::contact {

/// A function of one's own with its constants. Laws share it: they are copied at contact points.
template <class Function>
struct UserFunction {
  Function* function = nullptr;
  std::shared_ptr<void> library{};  ///< that it is of; null: of this process
  std::vector<double> constants{};
};

/// Parameters that say which function; `open` takes them into `routine`.
template <class Function>
struct UserLaw {
  std::string library{}, function{};
  std::vector<double> constants{};
  std::shared_ptr<const UserFunction<Function>> routine{};

  /// Finds the function in the library, whose name is relative to the folder; without a library
  /// the function is an address. Returns what is wrong.
  [[nodiscard]] std::optional<core::Fault> open(const std::string& folder);

 protected:
  template <class T>
  [[nodiscard]] static constexpr std::array<core::Param<T>, 3> function_params(
      std::string_view example) {
    return {{{.key = "library",
              .unit = "1",
              .doc = "The shared library, relative to the folder of the model file.",
              .slot = static_cast<std::string T::*>(&T::library),
              .required = false,
              .example = "laws.so",
              .otherwise = "none: the function is an address"},
             {.key = "function",
              .unit = "1",
              .doc = "The function of the library.",
              .slot = static_cast<std::string T::*>(&T::function),
              .example = example},
             {.key = "constants",
              .unit = "1",
              .doc = "Numbers that the function is given.",
              .slot = static_cast<std::vector<double> T::*>(&T::constants),
              .required = false,
              .example = "[1, 2]",
              .otherwise = "none"}}};
  }
};

/// Pressure over the gap by a function of one's own (user_law.h).
///
/// Formula    N = -p(zeta) for zeta <= onset, otherwise 0
/// Units      those of the model; per area (forces with weight node)
/// Requires   open() has found the function
/// Tested by  tests/unit/contact/test_user_laws.cpp, tests/python/test_user_laws.py
struct UserNormal : UserLaw<osculate_user_normal> {
  static constexpr std::string_view key = "user", words = "a function of one's own",
                                    doc =
                                        "Pressure over the gap by a function of a shared library "
                                        "(user_law.h, docs/user_law.md).";
  double onset = 0;

  static constexpr std::array<core::Param<UserNormal>, 4> params() {
    const auto own = function_params<UserNormal>("my_pressure");
    return {own[0], own[1], own[2],
            core::Param<UserNormal>{.key = "onset",
                                    .unit = "length",
                                    .doc = "Gap at which contact begins.",
                                    .slot = &UserNormal::onset,
                                    .required = false,
                                    .example = "0.01"}};
  }

  [[nodiscard]] double onset_gap() const { return onset; }
  [[nodiscard]] NormalResponse response(double gap, bool = false) const {
    if (gap > onset) return {};
    const osculate_normal_point at = asked(gap);
    return {true, -at.pressure, -at.d_pressure};
  }
  /// Work that the traction has taken up, per weight.
  [[nodiscard]] double energy(double gap, bool = false) const {
    return gap > onset ? 0.0 : asked(gap).energy;
  }

 private:
  [[nodiscard]] osculate_normal_point asked(double gap) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    osculate_normal_point at{
        gap, routine->constants.data(), static_cast<int>(routine->constants.size()), none, none,
        none};
    routine->function(&at);
    if (at.energy != at.energy) at.pressure = none;  // no answer
    return at;
  }
};

/// Friction, alike in all directions, whose limit is a function of one's own (user_law.h).
///
/// Formula    t = t_tr if |t_tr| <= L , t = L t_tr / |t_tr| otherwise, L(p, |t_tr|, ...)
/// Units      those of the model; per area (forces with weight node)
/// Requires   open() has found the function
/// Tested by  tests/unit/contact/test_user_laws.cpp, tests/python/test_user_laws.py
struct UserFriction : UserLaw<osculate_user_friction> {
  static constexpr std::string_view key = "user", words = "a function of one's own",
                                    doc =
                                        "The largest shear traction by a function of a shared "
                                        "library (user_law.h, docs/user_law.md).";
  std::optional<double> timed{};
  double stiffness = 0;  ///< eps_T

  static constexpr std::array<core::Param<UserFriction>, 5> params() {
    const auto own = function_params<UserFriction>("my_friction");
    return {own[0], own[1], own[2],
            core::Param<UserFriction>{
                .key = "timed",
                .unit = "1",
                .doc = "With 1 it asks how long an increment lasts; every step "
                       "needs a duration.",
                .slot = &UserFriction::timed,
                .range = {.lower = 1, .upper = 1, .with_lower = true, .with_upper = true},
                .required = false,
                .example = "1",
                .timed = true},
            shear_penalty_param<UserFriction>()};
  }

  [[nodiscard]] SlipLimit predicted_limit(double trial, double pressure,
                                          const Sliding& sliding) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (timed && !(sliding.duration > 0)) return {trial, 1, 0};  // nothing has slid yet
    const osculate_friction_point at = asked(pressure, trial, none, sliding);
    return {at.limit, at.d_trial, at.d_pressure};
  }
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double normal_traction,
                                                 const Sliding& sliding = {}) const {
    const double size = length_of<Dim>(trial);
    SlipLimit limit = predicted_limit(size, pressure_of(normal_traction), sliding);
    if (size <= limit.value) return stick_response<Dim>(trial);
    if (normal_traction > 0) limit.d_pressure = 0;
    if (!(size > 0)) return slip_response<Dim>(trial, 0, limit);
    return slip_response<Dim>(trial / size, size, limit);
  }
  /// What it keeps at a point that has slid so far.
  [[nodiscard]] LawMemory remembered(double slid, const Sliding& sliding) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const osculate_friction_point at = asked(none, none, slid, sliding);
    return {at.next[0], at.next[1]};
  }

 private:
  [[nodiscard]] osculate_friction_point asked(double pressure, double trial, double slid,
                                              const Sliding& sliding) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    osculate_friction_point at{pressure,
                               trial,
                               stiffness,
                               sliding.distance,
                               sliding.duration,
                               slid,
                               {sliding.memory[0], sliding.memory[1]},
                               routine->constants.data(),
                               static_cast<int>(routine->constants.size()),
                               none,
                               none,
                               none,
                               {0, 0}};
    routine->function(&at);
    return at;
  }
};

}  // namespace osculate::contact

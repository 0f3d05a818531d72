#pragma once
#include <memory>
#include <string>
#include <vector>

#include "osculate/material/response.hpp"
#include "osculate/user_material.h"

namespace osculate::material {

/// One material point that a routine is asked about: what it was, what has changed, and its answer.
/// Components as everywhere in this layer.
struct UserPoint {
  Vec<6> strain, change;  ///< at the beginning of the increment, and during it
  Mat<3, 3> stretch_before = Mat<3, 3>::Identity(), stretch = Mat<3, 3>::Identity();
  double time = 0, duration = 0, temperature = 0, warming = 0;
  int increment = 1;
  const double* state = nullptr;  ///< null: all 0
  double* next_state = nullptr;   ///< null: not asked for
  // before the increment, and answered
  Vec<6> stress = Vec<6>::Zero();
  double stored = 0, plastic = 0, creep = 0;  ///< SSE, SPD, SCD
  Mat<6, 6> tangent = Mat<6, 6>::Zero();      ///< answered alone
};

/// A routine with the constants of a material. All routines together are asked about one point at a
/// time, by whatever thread: many keep numbers of their own between their statements, and one
/// routine may serve several materials.
///
/// Tested by  tests/unit/material/test_user_material.cpp
class UserRoutine {
 public:
  /// `library` is kept as long as the routine; `name` is CMNAME.
  UserRoutine(osculate_user_material* function, std::shared_ptr<void> library,
              std::string_view name, const std::vector<double>& constants, std::size_t state);
  /// False: there is no answer, and `complaint` says why.
  [[nodiscard]] bool ask(UserPoint& point) const;
  /// Of the last question that had no answer.
  [[nodiscard]] std::string complaint() const;
  [[nodiscard]] std::size_t state_count() const { return count_; }

 private:
  /// What is wrong with an answer; empty: nothing.
  [[nodiscard]] std::string problem_of(const UserPoint& point, double shorter) const;

  osculate_user_material* function_;
  std::shared_ptr<void> library_;
  std::string name_;
  std::size_t constants_, count_;
  mutable std::vector<double> props_, state_;  ///< with marked numbers behind
  mutable std::string complaint_;
};

}  // namespace osculate::material

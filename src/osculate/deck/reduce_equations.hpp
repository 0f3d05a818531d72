#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/model/dof_space.hpp"

namespace osculate::deck {

/// What the steps prescribe for a dof: value at the end of each step and the name of its amplitude.
struct PrescribedCourse {
  struct OfStep {
    double value = 0;
    std::string amplitude;
    bool operator==(const OfStep&) const = default;
  };
  std::vector<OfStep> steps;  ///< empty: released somewhere, or not from the first step on
};
using PrescribedCourses = std::map<model::Dof, PrescribedCourse>;

struct MarkedEquation {
  model::Equation equation;
  core::SourceMark mark;
  bool first_leads = false;  ///< its first displacement is meant to follow from the others
};

/// Equations as the solver wants them: each gives one displacement by others that no equation
/// gives, none of those is prescribed, and what only repeats others is gone.
///
/// Formula    Gauss-Jordan elimination. Preferred as the eliminated displacement is the first one
///            where it leads, then that no other equation names
/// Input      first_fixed: dofs from there on are those of rigid bodies, which stay
/// Errors     core::InputError for equations that contradict each other or what is prescribed
/// Tested by  tests/unit/deck/test_reduce_equations.cpp
[[nodiscard]] std::vector<model::Equation> reduced_equations(
    const std::vector<MarkedEquation>& equations, const PrescribedCourses& prescribed,
    model::Dof first_fixed);

}  // namespace osculate::deck

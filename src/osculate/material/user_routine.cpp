#include "osculate/material/user_routine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace osculate::material {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// Numbers behind the constants and the state variables, in which a routine that expects more of
/// them shows.
constexpr std::size_t behind = 64;
constexpr double untouched = -6.02214076e-123;

std::mutex& one_at_a_time() {
  static std::mutex lock;
  return lock;
}

/// UMAT's order of components, which swaps the last two.
Vec<6> swapped(Vec<6> v) {
  std::swap(v[4], v[5]);
  return v;
}

}  // namespace

UserRoutine::UserRoutine(osculate_user_material* function, std::shared_ptr<void> library,
                         std::string_view name, const std::vector<double>& constants,
                         std::size_t state)
    : function_(function),
      library_(std::move(library)),
      name_(name),
      constants_(constants.size()),
      count_(state),
      props_(constants),
      state_(state + behind) {
  constexpr std::size_t length = 80;
  for (char& c : name_) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  name_.resize(length, ' ');
  props_.resize(constants.size() + behind);
}

std::string UserRoutine::complaint() const {
  const std::scoped_lock lock(one_at_a_time());
  return complaint_;
}

std::string UserRoutine::problem_of(const UserPoint& p, double shorter) const {
  if (std::any_of(state_.begin() + static_cast<std::ptrdiff_t>(count_), state_.end(),
                  [](double value) { return value != untouched; }))
    return fmt::format("it wrote behind its {} state variables", count_);
  const auto finite = [](double value) { return std::isfinite(value); };
  const bool all = p.stress.allFinite() && p.tangent.allFinite() && finite(p.stored) &&
                   finite(p.plastic) && finite(p.creep) &&
                   std::all_of(state_.begin(), state_.end(), finite);
  if (!all)
    return fmt::format("it returned NaN or infinity (it has {} constants and {} state variables)",
                       constants_, count_);
  if (!(shorter >= 1))
    return fmt::format("it asked for a shorter increment, PNEWDT = {:g}", shorter);
  return {};
}

bool UserRoutine::ask(UserPoint& p) const {  // long: the arguments of UMAT
  const std::scoped_lock lock(one_at_a_time());
  std::fill(props_.begin() + static_cast<std::ptrdiff_t>(constants_), props_.end(), unknown);
  std::fill(state_.begin(), state_.begin() + static_cast<std::ptrdiff_t>(count_), 0.0);
  if (p.state) std::copy_n(p.state, count_, state_.begin());
  std::fill(state_.begin() + static_cast<std::ptrdiff_t>(count_), state_.end(), untouched);
  Vec<6> stress = swapped(p.stress), strain = swapped(p.strain), change = swapped(p.change);
  Mat<6, 6> tangent = Mat<6, 6>::Zero();
  Vec<6> by_temperature = Vec<6>::Zero(), heat = Vec<6>::Zero();
  Mat<3, 3> turn = Mat<3, 3>::Identity(), before = p.stretch_before, now = p.stretch;
  Vec3 place = Vec3::Constant(unknown);
  std::array<double, 2> time{p.time, p.time};
  std::array<int, 4> step{1, 1, 0, 0};
  double power = 0, power_by_temperature = 0, duration = p.duration, temperature = p.temperature,
         warming = p.warming, field = unknown, field_change = unknown, shorter = 1, size = unknown;
  int direct = 3, shear = 3, components = 6, count = static_cast<int>(count_),
      constants = static_cast<int>(constants_), cell = 0, point = 0, layer = 1, section_point = 1,
      increment = p.increment;
  std::string name = name_;
  try {
    function_(stress.data(), state_.data(), tangent.data(), &p.stored, &p.plastic, &p.creep, &power,
              by_temperature.data(), heat.data(), &power_by_temperature, strain.data(),
              change.data(), time.data(), &duration, &temperature, &warming, &field, &field_change,
              name.data(), &direct, &shear, &components, &count, props_.data(), &constants,
              place.data(), turn.data(), &shorter, &size, before.data(), now.data(), &cell, &point,
              &layer, &section_point, step.data(), &increment, name.size());
  } catch (...) {
    complaint_ = "it threw an exception";
    return false;
  }
  p.stress = swapped(stress);
  tangent.row(4).swap(tangent.row(5));
  tangent.col(4).swap(tangent.col(5));
  p.tangent = tangent;
  if (std::string problem = problem_of(p, shorter); !problem.empty()) {
    complaint_ = std::move(problem);
    return false;
  }
  if (p.next_state) std::copy_n(state_.begin(), count_, p.next_state);
  return true;
}

}  // namespace osculate::material

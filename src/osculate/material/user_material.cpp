#include "osculate/material/user_material.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "osculate/core/shared_library.hpp"
#include "osculate/material/radial_return.hpp"
#include "osculate/material/stiffness.hpp"

namespace osculate::material {
namespace {

constexpr std::size_t own = UserMaterial::memory.size(), most_state = 999;

/// SDV1 to SDV999 behind what has no name.
struct UserNames {
  std::array<std::array<char, 6>, most_state> text{};
  std::array<Remembered, own + most_state> of{};
};
constexpr UserNames name_all() {
  UserNames names;
  for (std::size_t i = 0; i < most_state; ++i) {
    std::array<char, 6>& text = names.text[i];
    const std::size_t number = i + 1, digits = number < 10 ? 1 : number < 100 ? 2 : 3;
    text[0] = 'S', text[1] = 'D', text[2] = 'V';
    std::size_t rest = number;
    for (std::size_t d = digits; d > 0; --d, rest /= 10)
      text[2 + d] = static_cast<char>('0' + rest % 10);
  }
  return names;
}
constexpr UserNames with_views(const UserNames& made, const UserNames& texts) {
  UserNames names = made;
  for (std::size_t i = 0; i < most_state; ++i) {
    const std::size_t digits = i + 1 < 10 ? 1 : i + 1 < 100 ? 2 : 3;
    names.of[own + i] = {std::string_view(texts.text[i].data(), 3 + digits),
                         "state variable of the user's routine"};
  }
  return names;
}
constexpr UserNames user_texts = name_all();
constexpr UserNames user_names = with_views(user_texts, user_texts);

/// What a point remembers of its increments, beside the state variables.
struct Past {
  Vec<6> strain = Vec<6>::Zero(), stress = Vec<6>::Zero();
  double stored = 0, plastic = 0, creep = 0, work = 0, time = 0, increments = 0;
};
Past past_of(const double* state) {
  if (!state) return {};
  const Eigen::Map<const Vec<6>> strain(state), stress(state + 6);
  return {strain, stress, state[12], state[13], state[14], state[15], state[16], state[17]};
}
void remember_user(const Past& p, double* next) {
  Eigen::Map<Vec<6>>{next} = p.strain;
  Eigen::Map<Vec<6>>{next + 6} = p.stress;
  const std::array<double, 6> rest{p.stored, p.plastic, p.creep, p.work, p.time, p.increments};
  std::copy(rest.begin(), rest.end(), next + 12);
}

double volume_of(const UserMaterial& law, const Vec<6>& strain) {
  return law.finite ? std::exp(strain.head<3>().sum()) : 1;
}
/// exp of a logarithmic strain.
Mat<3, 3> stretch_of(const Vec<6>& e) {
  Mat<3, 3> log;
  log << e[0], e[3] / 2, e[5] / 2,  //
      e[3] / 2, e[1], e[4] / 2,     //
      e[5] / 2, e[4] / 2, e[2];
  const Eigen::SelfAdjointEigenSolver<Mat<3, 3>> axes(log);
  const Vec3 stretch = axes.eigenvalues().array().exp();
  return axes.eigenvectors() * stretch.asDiagonal() * axes.eigenvectors().transpose();
}

/// The point at the beginning of the increment.
UserPoint point_at(const UserMaterial& law, const Past& before, const Strain3& strain,
                   const Memory& memory) {
  /// Where a state is asked about itself no time passes; rates have to be some.
  constexpr double moment = 1e-12;
  UserPoint p{before.strain, strain - before.strain};
  if (law.finite) {
    p.stretch_before = stretch_of(before.strain);
    p.stretch = stretch_of(strain);
  }
  p.time = before.time;
  p.duration = memory.duration > 0 ? memory.duration : moment;
  p.increment = static_cast<int>(before.increments) + 1;
  if (memory.temperature) {
    p.temperature = *(memory.temperature_before ? memory.temperature_before : memory.temperature);
    p.warming = *memory.temperature - p.temperature;
  }
  if (memory.committed) p.state = memory.committed + own;
  if (memory.next) p.next_state = memory.next + own;
  p.stress = before.stress;
  p.stored = before.stored;
  p.plastic = before.plastic;
  p.creep = before.creep;
  return p;
}

/// Whether nothing has happened since, but rounding.
bool is_itself(const UserPoint& p, const Past& before, const Strain3& strain) {
  constexpr double rounding = 1e-12;
  return before.increments > 0 && p.change.norm() <= rounding * strain.norm();
}
/// Of the stresses during the increment, by the trapezoidal rule.
double work_of(const UserMaterial& law, const Past& before, const UserPoint& p,
               const Strain3& strain) {
  return 0.5 * (volume_of(law, before.strain) * before.stress + volume_of(law, strain) * p.stress)
                   .dot(p.change);
}

}  // namespace

Response3 respond(const UserMaterial& law, const Strain3& strain, Memory memory) {
  Response3 r;
  r.ok = law.routine && strain.allFinite();
  if (!r.ok) return r;
  const Past before = past_of(memory.committed);
  UserPoint p = point_at(law, before, strain, memory);
  r.ok = law.routine->ask(p);
  if (!r.ok) return r;
  const double volume = volume_of(law, strain);
  // A state against itself has the stress that it has.
  const bool itself = memory.duration == 0 && is_itself(p, before, strain);
  if (itself) {
    p.stress = before.stress;
    p.stored = before.stored;
    p.plastic = before.plastic;
    p.creep = before.creep;
  }
  r.stress = volume * p.stress;
  r.tangent = 0.5 * volume * (p.tangent + p.tangent.transpose());
  if (!memory.next) return r;
  const double work = work_of(law, before, p, strain);
  remember_user({strain, p.stress, p.stored, p.plastic, p.creep, before.work + work,
                 before.time + memory.duration, before.increments + (itself ? 0 : 1)},
                memory.next);
  if (itself) std::copy_n(memory.committed + own, law.routine->state_count(), memory.next + own);
  return r;
}

Response respond(const UserMaterial& law, const Strain& strain, Memory memory) {
  return in_plane(respond(law, in_space(strain), memory));
}

Response respond_plane_stress(const UserMaterial& law, const Strain& strain, double& strain_33,
                              Memory memory) {
  Strain e = strain;
  e[2] = past_of(memory.committed).strain[2];
  return without_stress_across(law, e, strain_33, memory);
}

double energy_of(const UserMaterial& law, const Strain3& strain, const Memory& memory) {
  const Past before = past_of(memory.committed);
  UserPoint p = point_at(law, before, strain, {memory.committed});
  if (!is_itself(p, before, strain) && !(law.routine && law.routine->ask(p)))
    return std::numeric_limits<double>::infinity();
  const bool silent = p.stored == 0 && p.plastic == 0 && p.creep == 0;
  return silent ? before.work + work_of(law, before, p, strain) : p.stored;
}
double dissipated_by(const UserMaterial&, const double* state) {
  const Past p = past_of(state);
  return p.plastic + p.creep;
}

std::span<const Remembered> remembered_by(const UserMaterial& law) {
  return std::span(user_names.of).first(own + static_cast<std::size_t>(law.state));
}
std::string complaint_of(const UserMaterial& law) {
  return law.routine ? law.routine->complaint() : std::string();
}

std::optional<core::Fault> UserMaterial::fault() const {
  if (state != std::floor(state)) return core::Fault{"must be a whole number", "state", {}};
  return std::nullopt;
}

std::optional<core::Fault> UserMaterial::open(const std::string& folder) {
  core::FoundFunction found = core::find_function(folder, library, function);
  if (!found.function) return core::Fault{found.problem, found.opened ? "function" : "library", {}};
  return use(reinterpret_cast<osculate_user_material*>(found.function), std::move(found.library));
}

std::optional<core::Fault> UserMaterial::use(osculate_user_material* found,
                                             std::shared_ptr<void> kept) {
  routine = std::make_shared<const UserRoutine>(found, std::move(kept), name, constants,
                                                static_cast<std::size_t>(state));
  const auto answers = [&](std::string what) {
    return core::Fault{fmt::format("{} has no answer for the unloaded material: {}; it was given "
                                   "{} constants and {:g} state variables",
                                   function, what, constants.size(), state),
                       {},
                       {}};
  };
  const Response3 r = respond(*this, Strain3(Strain3::Zero()), Memory{});
  if (!r.ok) return answers(complaint_of(*this));
  at_rest = mean_of_directions(r.tangent);
  if (!(at_rest.young > 0) || !(at_rest.poisson > -1) || !(at_rest.poisson < 0.5))
    return answers("DDSDDE is not the stiffness of a solid");
  return std::nullopt;
}

}  // namespace osculate::material

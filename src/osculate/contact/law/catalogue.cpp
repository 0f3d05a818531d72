#include "osculate/contact/law/catalogue.hpp"

#include <fmt/format.h>

#include <tuple>

namespace osculate::contact {
namespace {

bool positive(double value) { return value > 0 && std::isfinite(value); }
bool not_negative(double value) { return value >= 0 && std::isfinite(value); }

std::string fault_of(const NormalPenalty& law) {
  if (positive(law.stiffness)) return {};
  return fmt::format("normal_penalty must be > 0, got {:g}", law.stiffness);
}

std::string fault_of(const NormalExponential& law) {
  if (positive(law.pressure) && positive(law.clearance)) return {};
  return fmt::format(
      "an exponential law needs a pressure > 0 and a clearance > 0, got {:g} and {:g}",
      law.pressure, law.clearance);
}

std::string fault_of(const NormalTable& law) {
  if (law.points.size() < 2) return "a table of pressures needs at least two points";
  if (law.points.front()[1] != 0) return "the first pressure of a table must be 0";
  if (!std::isfinite(law.points.front()[0]))
    return "a table of pressures has a value that is not finite";
  for (std::size_t i = 1; i < law.points.size(); ++i) {
    const std::array<double, 2>&a = law.points[i - 1], &b = law.points[i];
    if (!std::isfinite(b[0]) || !std::isfinite(b[1]))
      return "a table of pressures has a value that is not finite";
    if (!(b[0] > a[0])) return fmt::format("overclosures must grow: {:g} follows {:g}", b[0], a[0]);
    if (!(b[1] >= a[1]))
      return fmt::format("pressures must not fall: {:g} follows {:g}", b[1], a[1]);
  }
  if (!(law.points.back()[1] > 0)) return "a table needs a pressure > 0";
  return {};
}

std::string fault_of(const Coulomb& law) {
  if (!not_negative(law.mu) || !positive(law.stiffness))
    return fmt::format("friction needs mu >= 0 and a stiffness > 0, got {:g} and {:g}", law.mu,
                       law.stiffness);
  if (!(law.cap > 0)) return fmt::format("the cap of friction must be > 0, got {:g}", law.cap);
  if (law.change && (!not_negative(law.change->kinetic) || !positive(law.change->scale)))
    return fmt::format(
        "a change of friction needs a coefficient >= 0 and a scale > 0, got {:g} and "
        "{:g}",
        law.change->kinetic, law.change->scale);
  return {};
}

std::string fault_of(const Tresca& law) {
  if (not_negative(law.limit_traction) && positive(law.stiffness)) return {};
  return fmt::format("friction needs a shear traction >= 0 and a stiffness > 0, got {:g} and {:g}",
                     law.limit_traction, law.stiffness);
}

std::string fault_of(const Rough& law) {
  if (!positive(law.stiffness))
    return fmt::format("friction needs a stiffness > 0, got {:g}", law.stiffness);
  if (law.coefficient > 0) return {};
  return fmt::format("rough points need a coefficient > 0, got {:g}", law.coefficient);
}

std::string fault_of(const Viscous& law) {
  if (not_negative(law.coefficient)) return {};
  return fmt::format("viscous damping needs a coefficient >= 0, got {:g}", law.coefficient);
}

std::string fault_of(const Restitution& law) {
  if (law.value >= 0 && law.value <= 1) return {};
  return fmt::format("a restitution lies between 0 and 1, got {:g}", law.value);
}

std::string text_of(const NormalPenalty& law) { return fmt::format("penalty {:g}", law.stiffness); }
std::string text_of(const NormalExponential& law) {
  return fmt::format("exponential {:g} within {:g}", law.pressure, law.clearance);
}
std::string text_of(const NormalTable& law) {
  return fmt::format("table of {} points", law.points.size());
}
std::string text_of(const Coulomb& law) {
  std::string text = fmt::format("Coulomb {:g}", law.mu);
  if (law.change) text += fmt::format(" to {:g}", law.change->kinetic);
  if (std::isfinite(law.cap)) text += fmt::format(" up to {:g}", law.cap);
  return text;
}
std::string text_of(const Tresca& law) { return fmt::format("Tresca {:g}", law.limit_traction); }
std::string text_of(const Rough&) { return "rough"; }

/// Calls `f` with the law that it is, with its factor in it.
template <class F>
auto visit(const F& f, const NormalLaw& law) {
  const auto* const penalty = std::get_if<NormalPenalty>(&law.all());
  if (penalty) return f(NormalPenalty{law.factor() * penalty->stiffness});
  return std::visit([&](const auto& l) { return f(l); }, law.all());
}
template <class F>
auto visit(const F& f, const FrictionLaw& law) {
  return std::visit(
      [&](auto l) {
        l.stiffness *= law.factor();
        return f(l);
      },
      law.all());
}
template <class F>
auto visit(const F& f, const DampingLaw& law) {
  return std::visit([&](const auto& l) { return f(l); }, law.all());
}

}  // namespace

NormalLaw penalty(double stiffness) { return NormalPenalty{stiffness}; }
FrictionLaw coulomb(double mu, double stiffness) { return Coulomb{mu, stiffness}; }

template <class Laws>
Law<Laws>::Law() : law_(std::make_shared<const Laws>()) {}
template <class Laws>
template <class Value>
std::shared_ptr<const Laws> Law<Laws>::made(const Value& law) {
  return std::make_shared<const Laws>(law);
}
template <class Laws>
template <class Value>
const Value* Law<Laws>::found(const Laws& law) {
  return std::get_if<Value>(&law);
}

NormalResponse response(const NormalLaw& law, double gap, bool held) {
  return visit([&](const auto& l) { return l.response(gap, held); }, law);
}
NormalResponse mean_response(const NormalLaw& law, double gap, double way) {
  return visit(
      [&](const auto& l) {
        const double from = gap + 0.5 * way, to = gap - 0.5 * way;
        NormalResponse r;
        r.active = !(to > l.reach());
        r.traction = (l.energy(from) - l.energy(to)) / way;
        r.d_traction = (l.response(from).traction - l.response(to).traction) / way;
        return r;
      },
      law);
}
double stored_energy(const NormalLaw& law, double gap, bool held) {
  return visit([&](const auto& l) { return l.energy(gap, held); }, law);
}
NormalResponse damped(const DampingLaw& damping, const NormalLaw& law, double gap,
                      const Closing& closing) {
  return visit(
      [&](const auto& d) {
        return visit([&](const auto& l) { return d.response(l, gap, closing); }, law);
      },
      damping);
}
double reach(const NormalLaw& law) {
  return visit([](const auto& l) { return l.reach(); }, law);
}
bool augmentable(const NormalLaw& law) {
  return visit([](const auto& l) { return l.augmentable; }, law);
}
bool holds(const NormalLaw& law) { return law.as<NormalPenalty>(); }
double penalty_of(const NormalLaw& law) {
  const auto* const penalty = law.as<NormalPenalty>();
  return penalty ? law.factor() * penalty->stiffness : 0.0;
}
std::string fault(const NormalLaw& law) {
  return visit([](const auto& l) { return fault_of(l); }, law);
}
std::string fault(const FrictionLaw& law) {
  return visit([](const auto& l) { return fault_of(l); }, law);
}
std::string fault(const DampingLaw& law) {
  return visit([](const auto& l) { return fault_of(l); }, law);
}
std::string text(const NormalLaw& law) {
  return visit([](const auto& l) { return text_of(l); }, law);
}
std::string text(const FrictionLaw& law) {
  return visit(
      [](const auto& l) { return fmt::format("{} (penalty {:g})", text_of(l), l.stiffness); }, law);
}
double stiffest(const DampingLaw& law, double penalty, double duration) {
  return visit([&](const auto& l) { return l.stiffest(penalty, duration); }, law);
}
double stiffness(const FrictionLaw& law) {
  return visit([](const auto& l) { return l.stiffness; }, law);
}
FrictionLaw with_stiffness(const FrictionLaw& law, double stiffness) {
  return std::visit(
      [&](auto l) {
        l.stiffness = stiffness;
        return FrictionLaw(l);
      },
      law.all());
}
template <int Dim>
TangentialResponse<Dim> response(const FrictionLaw& law, const Vec<Dim - 1>& trial,
                                 double normal_traction, const Sliding& sliding) {
  return visit(
      [&](const auto& l) { return l.template response<Dim>(trial, normal_traction, sliding); },
      law);
}
SlipLimit predicted_limit(const FrictionLaw& law, double trial, double normal_traction,
                          const Sliding& sliding) {
  SlipLimit limit = visit(
      [&](const auto& l) {
        return l.predicted_limit(trial, pressure_of(normal_traction), sliding);
      },
      law);
  if (normal_traction > 0) limit.d_pressure = 0;
  return limit;
}
double steadying(const FrictionLaw& law, double normal_traction, double duration) {
  constexpr double margin = 2, most = 1e12;
  const auto* const coulomb = law.as<Coulomb>();
  if (!coulomb || !coulomb->change) return 1;
  const FrictionChange& change = *coulomb->change;
  const bool by_speed = change.by == FrictionChange::By::speed;
  if (by_speed && !(duration > 0)) return 1;
  const double fall = (coulomb->mu - change.kinetic) * pressure_of(normal_traction) /
                      (by_speed ? change.scale * duration : change.scale);
  const double stiffness = law.factor() * coulomb->stiffness;
  double factor = 1;
  while (factor * stiffness < margin * fall && factor < most) factor *= 10;
  return factor;
}
bool needs_duration(const FrictionLaw& law) {
  const auto* const coulomb = law.as<Coulomb>();
  return coulomb && coulomb->change && coulomb->change->by == FrictionChange::By::speed;
}
bool needs_duration(const DampingLaw& law) { return law.as<Viscous>(); }

template class Law<NormalLaws>;
template class Law<FrictionLaws>;
template class Law<DampingLaws>;
template TangentialResponse<2> response<2>(const FrictionLaw&, const Vec<1>&, double,
                                           const Sliding&);
template TangentialResponse<3> response<3>(const FrictionLaw&, const Vec<2>&, double,
                                           const Sliding&);

namespace {

/// What each law of a catalogue is made and found by: whoever names a law calls these two.
template <class Laws, class... Value>
constexpr auto access(const std::variant<Value...>*) {
  return std::tuple{&Law<Laws>::template made<Value>..., &Law<Laws>::template found<Value>...};
}
[[gnu::used]] const auto normal_access =
    access<NormalLaws>(static_cast<const NormalLaws*>(nullptr));
[[gnu::used]] const auto friction_access =
    access<FrictionLaws>(static_cast<const FrictionLaws*>(nullptr));
[[gnu::used]] const auto damping_access =
    access<DampingLaws>(static_cast<const DampingLaws*>(nullptr));

}  // namespace
}  // namespace osculate::contact

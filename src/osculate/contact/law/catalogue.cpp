#include "osculate/contact/law/catalogue.hpp"

#include <fmt/format.h>

#include <tuple>

#include "osculate/contact/law/every_law.hpp"

namespace osculate::contact {
namespace {

template <class... Value>
constexpr bool all_normal(const std::variant<Value...>*) {
  return (IsNormalLaw<Value> && ...);
}
template <class... Value>
constexpr bool all_friction(const std::variant<Value...>*) {
  return (IsFrictionLaw<Value> && ...);
}
template <class... Value>
constexpr bool all_damping(const std::variant<Value...>*) {
  return (IsDampingLaw<Value, NormalPenalty> && ...);
}
static_assert(all_normal(static_cast<const NormalLaws*>(nullptr)));
static_assert(all_friction(static_cast<const FrictionLaws*>(nullptr)));
static_assert(all_damping(static_cast<const DampingLaws*>(nullptr)));

/// What a fault calls a parameter: `normal_penalty`, `friction_coulomb: mu`.
template <class T>
std::string fault_of(const T& law, std::string_view axis) {
  if (const auto wrong = core::first_out_of_range(law))
    return fmt::format("{}_{}{}{} must be {}, got {:g}", axis, T::key,
                       wrong->key.empty() ? "" : ": ", wrong->key, core::bounds(wrong->range),
                       wrong->value);
  const auto fault = core::own_fault(law);
  return fault ? fault->why : std::string{};
}

/// The value of a parameter in words; empty: that of a new law.
template <class T>
std::string value_text(const T& law, std::string_view key) {
  for (const core::Param<T>& p : T::params()) {
    if (p.key != key) continue;
    if (const core::Table* const table = core::table_in(law, p.slot))
      return fmt::format("{}", table->size());
    const std::optional<double> value = core::number_in(law, p.slot);
    const bool usual = !p.required && value == core::number_in(T{}, p.slot);
    return value && !usual ? fmt::format("{:g}", *value) : std::string{};
  }
  return {};
}

/// The words of a law with its values in them.
template <class T>
std::string text_of(const T& law) {
  std::string text;
  std::size_t part = std::string::npos;  // where what stands in [] begins
  bool left_out = false;
  for (std::string_view rest = T::words; !rest.empty();) {
    const char c = rest.front();
    const std::size_t end = c == '{' ? rest.find('}') : 0;
    if (c == '{') {
      const std::string value = value_text(law, rest.substr(1, end - 1));
      left_out = left_out || value.empty();
      text += value;
    } else if (c == '[') {
      part = text.size();
      left_out = false;
    } else if (c == ']') {
      if (left_out) text.resize(part);
    } else {
      text += c;
    }
    rest.remove_prefix(end + 1);
  }
  return text;
}

/// Calls `f` with the law that it is, with its factor in it.
template <class F, class Laws>
auto visit(const F& f, const Law<Laws>& law) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.stiffness; }) {
          auto stiffened = l;
          stiffened.stiffness *= law.factor();
          return f(stiffened);
        } else {
          return f(l);
        }
      },
      law.all());
}

template <class Laws>
Law<Laws> stiffness_set(const Law<Laws>& law, double stiffness) {
  return std::visit(
      [&](auto l) {
        if constexpr (requires { l.stiffness; }) l.stiffness = stiffness;
        return Law<Laws>(l);
      },
      law.all());
}

template <class Laws>
bool needs_duration_of(const Law<Laws>& law) {
  return std::visit(
      []<class T>(const T& l) {
        bool timed = false;
        for (const core::Param<T>& p : T::params())
          timed = timed || (p.timed && core::number_in(l, p.slot));
        return timed;
      },
      law.all());
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
        r.active = !(to > l.onset_gap());
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
double onset_gap(const NormalLaw& law) {
  return visit([](const auto& l) { return l.onset_gap(); }, law);
}
bool augmentable(const NormalLaw& law) {
  return visit(
      [](const auto& l) {
        if constexpr (requires { l.augmentable; }) return l.augmentable;
        return false;
      },
      law);
}
bool holds(const NormalLaw& law) {
  return visit(
      [](const auto& l) {
        if constexpr (requires { l.holds; }) return l.holds;
        return false;
      },
      law);
}
double penalty_of(const NormalLaw& law) {
  return visit(
      [](const auto& l) {
        if constexpr (requires { l.stiffness; }) return l.stiffness;
        return 0.0;
      },
      law);
}
NormalLaw with_stiffness(const NormalLaw& law, double stiffness) {
  return stiffness_set(law, stiffness);
}
std::string fault(const NormalLaw& law) {
  return visit([](const auto& l) { return fault_of(l, "normal"); }, law);
}
std::string fault(const FrictionLaw& law) {
  return visit([](const auto& l) { return fault_of(l, "friction"); }, law);
}
std::string fault(const DampingLaw& law) {
  return visit([](const auto& l) { return fault_of(l, "damping"); }, law);
}
std::string text(const NormalLaw& law) {
  return visit([](const auto& l) { return text_of(l); }, law);
}
std::string text(const FrictionLaw& law) {
  return visit(
      [](const auto& l) { return fmt::format("{} (penalty {:g})", text_of(l), l.stiffness); }, law);
}
double damper(const DampingLaw& law) {
  return visit(
      [](const auto& l) {
        if constexpr (requires { l.damper(); }) return l.damper();
        return 0.0;
      },
      law);
}
double stiffest(const DampingLaw& law, double penalty, double duration) {
  return visit([&](const auto& l) { return l.stiffest(penalty, duration); }, law);
}
double stiffness(const FrictionLaw& law) {
  return visit([](const auto& l) { return l.stiffness; }, law);
}
FrictionLaw with_stiffness(const FrictionLaw& law, double stiffness) {
  return stiffness_set(law, stiffness);
}
FrictionLaw parting(const FrictionLaw& law) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.parting(); }) return FrictionLaw(l.parting());
        return law;
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
  return visit(
      [&](const auto& l) {
        double factor = 1;
        if constexpr (requires { l.fall(1.0, 1.0); }) {
          const double fall = l.fall(pressure_of(normal_traction), duration);
          while (factor * l.stiffness < margin * fall && factor < most) factor *= 10;
        }
        return factor;
      },
      law);
}
LawMemory remembered(const FrictionLaw& law, double slid, const Sliding& sliding) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.remembered(slid, sliding); }) return l.remembered(slid, sliding);
        return LawMemory{};
      },
      law.all());
}
bool needs_duration(const FrictionLaw& law) { return needs_duration_of(law); }
bool needs_duration(const DampingLaw& law) { return needs_duration_of(law); }

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

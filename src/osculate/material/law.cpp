#include "osculate/material/law.hpp"

#include "osculate/material/expansion.hpp"
#include "osculate/material/over_temperature.hpp"

namespace osculate::material {
namespace {

template <class T, int N>
ResponseOf<N> answer(const T& law, const Vec<N>& strain, [[maybe_unused]] const Memory& memory) {
  if constexpr (Directional<T>)
    return proportional<N>(stiffness_at(law, memory), strain);
  else if constexpr (Remembers<T>)
    return respond(law, strain, memory);
  else if constexpr (OverTemperature<T>)
    return respond(at_point(law, memory), strain);
  else
    return respond(law, strain);
}

/// Of laws that do not say their stress without its derivative.
template <class T, int N>
StressOf<N> stress_of(const T& law, const Vec<N>& strain) {
  const ResponseOf<N> r = respond(law, strain);
  return {r.ok, r.stress};
}
template <class T, int N>
StressOf<N> stress_of(const T& law, const Vec<N>& strain, const Memory& memory) {
  const ResponseOf<N> r = respond(law, strain, memory);
  return {r.ok, r.stress};
}
template <class T, int N>
StressOf<N> stress_alone(const T& law, const Vec<N>& strain,
                         [[maybe_unused]] const Memory& memory) {
  if constexpr (Directional<T>)
    return {true, stiffness_at(law, memory).template topLeftCorner<N, N>() * strain};
  else if constexpr (Remembers<T>)
    return stress_of(law, strain, memory);
  else if constexpr (OverTemperature<T>)
    return stress_of(at_point(law, memory), strain);
  else
    return stress_of(law, strain);
}

template <int N>
ResponseOf<N> expanded_answer(const Law& law, const Vec<N>& strain, const Memory& memory) {
  const auto at = [&](const Vec<N>& elastic) {
    return std::visit([&](const auto& m) { return answer(m, elastic, memory); }, law);
  };
  if (!memory.expansion && !memory.initial) return at(strain);
  const Expanded by(finite_strain(law), memory);
  return by.response(at(by.elastic(strain)));
}
template <int N>
StressOf<N> expanded_stress(const Law& law, const Vec<N>& strain, const Memory& memory) {
  const auto at = [&](const Vec<N>& elastic) {
    return std::visit([&](const auto& m) { return stress_alone(m, elastic, memory); }, law);
  };
  if (!memory.expansion && !memory.initial) return at(strain);
  const Expanded by(finite_strain(law), memory);
  StressOf<N> s = at(by.elastic(strain));
  s.stress = by.stress(s.stress);
  return s;
}

/// The law with the constants.
template <class T>
const T& named(const T& law) {
  return law;
}
template <class T>
const T& named(const Logarithmic<T>& form) {
  return form.law;
}
template <class T>
const T& named(const GreenLagrange<T>& form) {
  return form.law;
}

template <class T>
const T& named(const Relaxing<T>& form) {
  return form.law;
}

template <class T>
bool depends_on_temperature([[maybe_unused]] const T& law) {
  if constexpr (OverTemperature<T>) return has_tables(law);
  return false;
}

}  // namespace

Law::Law() = default;
Law::Law(const Law&) = default;
Law::Law(Law&&) noexcept = default;
Law& Law::operator=(const Law&) = default;
Law& Law::operator=(Law&&) noexcept = default;
Law::~Law() = default;

bool finite_strain(const Law& law) {
  return std::visit([](const auto& m) { return m.finite_strain; }, law);
}

bool large_strain(const Law& law) {
  return std::visit([](const auto& m) { return m.large_strain; }, law);
}

bool linear(const Law& law) {
  const auto of = []<class T>(const T&) {
    return requires { requires T::linear; };
  };
  return !over_temperature(law) && std::visit(of, law);
}

bool hooke_at_first(const Law& law) {
  const auto of = []<class T>(const T&) {
    return requires { requires T::linear; }
    || requires { requires T::hooke_at_first; };
  };
  return !over_temperature(law) && std::visit(of, law);
}

std::span<const Remembered> memory_of(const Law& law) {
  const auto of =
      []<class T>([[maybe_unused]] const T& law_of_type) -> std::span<const Remembered> {
    if constexpr (requires(const T& m) { remembered_by(m); })
      return remembered_by(law_of_type);
    else if constexpr (requires(const T& m) { remembered_by(named(m)); })
      return remembered_by(named(law_of_type));
    else if constexpr (Remembers<T>)
      return T::memory;
    return {};
  };
  return std::visit(of, law);
}

bool needs_duration(const Law& law) {
  return std::visit(
      []<class T>(const T& m) {
        bool timed = requires { m.series; };
        for (const auto& p : std::decay_t<decltype(named(m))>::params()) timed = timed || p.timed;
        return timed;
      },
      law);
}

bool has_finite_form(const Law& law) {
  return std::visit(
      []<class T>(const T&) {
        return (Directional<T> && !T::finite_strain) || requires { requires T::logarithmic; };
      },
      law);
}

Law in_finite_strain(const Law& law) {
  const auto form = []<class T>(const T& m) -> Law {
    if constexpr (requires(T of) { of.finite = true; }) {
      T in_logarithm = m;
      in_logarithm.finite = true;
      return Logarithmic<T>{std::move(in_logarithm)};
    } else if constexpr (requires { requires T::logarithmic; })
      return Logarithmic<T>{m};
    else if constexpr (Directional<T> && !T::finite_strain)
      return GreenLagrange<T>{m};
    else
      return m;
  };
  return std::visit(form, law);
}

std::optional<Law> relaxing(const Law& law, const Relaxation& series) {
  const auto form = [&]<class T>([[maybe_unused]] const T& m) -> std::optional<Law> {
    if constexpr (Relaxable<T>)
      if constexpr (std::constructible_from<Law, Relaxing<T>>) return Law(Relaxing<T>{m, series});
    return std::nullopt;
  };
  return std::visit(form, law);
}

bool relaxes_alike(const Law& law) {
  return std::visit([]<class T>(const T&) { return relaxes_as_one<T>; }, law);
}

bool directional(const Law& law) {
  return std::visit([]<class T>(const T&) { return Directional<T>; }, law);
}

bool over_temperature(const Law& law) {
  return std::visit([](const auto& m) { return depends_on_temperature(named(m)); }, law);
}

bool takes_temperature(const Law& law) {
  const auto of = []<class T>(const T& m) {
    return requires { requires std::decay_t<decltype(named(m))>::takes_temperature; };
  };
  return over_temperature(law) || std::visit(of, law);
}

std::string complaint(const Law& law) {
  const auto of = [](const auto& m) -> std::string {
    if constexpr (requires { complaint_of(named(m)); }) return complaint_of(named(m));
    return {};
  };
  return std::visit(of, law);
}

std::vector<Tangent3> stiffnesses_of(const Law& law) {
  return std::visit(
      []<class T>([[maybe_unused]] const T& m) -> std::vector<Tangent3> {
        if constexpr (!Directional<T>) {
          return {};
        } else {
          std::vector<Tangent3> all;
          Memory memory;
          for (const double temperature : temperatures_of(named(m))) {
            memory.temperature = &temperature;
            all.push_back(own_stiffness(m, memory));
          }
          if (all.empty()) all.push_back(stiffness(m));
          return all;
        }
      },
      law);
}

double density(const Law& law) {
  return std::visit([](const auto& m) { return named(m).density; }, law);
}

Isotropic unloaded(const Law& law) {
  return std::visit([](const auto& m) { return unloaded(m); }, law);
}

std::string_view key_of(const Law& law) {
  return std::visit([](const auto& m) { return m.key; }, law);
}

std::string range_problem(const Law& law) {
  const auto of = [](const auto& m) {
    std::string problem = core::range_problem(named(m));
    if constexpr (requires { m.series; })
      if (problem.empty()) problem = core::range_problem(m.series);
    return problem;
  };
  return std::visit(of, law);
}

Response response(const Law& law, const Strain& strain, const Memory& memory) {
  return expanded_answer(law, strain, memory);
}
template <std::same_as<Strain3> S>
Response3 response(const Law& law, const S& strain, const Memory& memory) {
  return expanded_answer(law, strain, memory);
}
template Response3 response(const Law&, const Strain3&, const Memory&);

StressOf<4> stress(const Law& law, const Strain& strain, const Memory& memory) {
  return expanded_stress(law, strain, memory);
}

StressOf<6> stress(const Law& law, const Strain3& strain, const Memory& memory) {
  return expanded_stress(law, strain, memory);
}

Response plane_stress_response(const Law& law, const Strain& strain, double* strain_33,
                               const Memory& memory) {
  const Expanded by(finite_strain(law), memory);
  const Strain elastic = by.elastic(strain);
  double found = 0;
  const auto of = [&]<class T>(const T& m) {
    if constexpr (Directional<T>) {
      Response across = proportional_plane_stress(stiffness_at(m, memory), elastic, found);
      if (T::finite_strain) across.ok = 1 + 2 * found > 0;
      return across;
    } else if constexpr (Remembers<T>) {
      return respond_plane_stress(m, elastic, found, memory);
    } else if constexpr (OverTemperature<T>) {
      return respond_plane_stress(at_point(m, memory), elastic, found);
    } else {
      return respond_plane_stress(m, elastic, found);
    }
  };
  const Response r = by.response(Response(std::visit(of, law)));
  if (strain_33) *strain_33 = by.total(found);
  return r;
}

}  // namespace osculate::material

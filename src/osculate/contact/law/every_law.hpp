#pragma once
// What the laws of the catalogue have in common.
#include <concepts>
#include <string_view>
#include <variant>

#include "osculate/contact/law/law.hpp"
#include "osculate/core/param.hpp"

namespace osculate::contact {

/// What every law offers; more may be: see law.hpp, what a law need not have.
template <class T>
concept IsLaw = requires {
  { T::key } -> std::convertible_to<std::string_view>;
  { T::params().front() } -> std::convertible_to<core::Param<T>>;
};
/// Its numbers in a few words, for summaries: {KEY} is a parameter, {} the one without a key, what
/// stands in [] is left out where a parameter in it has the value of a new law.
template <class T>
concept HasWords = requires {
  { T::words } -> std::convertible_to<std::string_view>;
};
template <class T>
concept IsNormalLaw = IsLaw<T> && HasWords<T> && requires(const T& law, double gap, bool held) {
  { law.onset_gap() } -> std::same_as<double>;
  { law.response(gap, held) } -> std::same_as<NormalResponse>;
  { law.energy(gap, held) } -> std::same_as<double>;
};
template <class T>
concept IsFrictionLaw = IsLaw<T> && HasWords<T> &&
    requires(const T& law, double number, const Vec<2>& trial, const Sliding& sliding) {
  { law.stiffness } -> std::convertible_to<double>;
  { law.predicted_limit(number, number, sliding) } -> std::same_as<SlipLimit>;
  { law.template response<3>(trial, number, sliding) } -> std::same_as<TangentialResponse<3>>;
};
template <class T, class Spring>
concept IsDampingLaw = IsLaw<T> &&
    requires(const T& law, const Spring& spring, double number, const Closing& closing) {
  { law.response(spring, number, closing) } -> std::same_as<NormalResponse>;
  { law.stiffest(number, number) } -> std::same_as<double>;
};

/// Calls `visit(T{})` with a new law of each kind, in the order of the list.
template <class Laws, class Visit>
constexpr void for_each_law(const Visit& visit) {
  [&]<class... Value>(const std::variant<Value...>*) {
    (visit(Value{}), ...);
  }(static_cast<const Laws*>(nullptr));
}

}  // namespace osculate::contact

#pragma once
// What describes itself by its parameters (core::Param), as keys of the model file.
#include <fmt/format.h>

#include <cmath>

#include "osculate/core/param.hpp"
#include "osculate/deck/check.hpp"
#include "osculate/deck/spec.hpp"

namespace osculate::deck {

/// A number with the bounds of a range.
[[nodiscard]] inline Spec within(Spec spec, const core::Range& range) {
  if (std::isfinite(range.lower))
    spec = range.with_lower ? spec.at_least(range.lower) : spec.above(range.lower);
  if (std::isfinite(range.upper))
    spec = range.with_upper ? spec.at_most(range.upper) : spec.below(range.upper);
  return spec;
}

/// What may stand under the key of one parameter.
template <class T>
[[nodiscard]] Spec param_spec(const core::Param<T>& p) {
  std::string doc(p.doc), example(p.example);
  const auto number_with = [&](std::string sentence) {
    Spec spec = within(number(std::move(sentence)), p.range);
    return p.unit == "1" ? spec : spec.in(std::string(p.unit));
  };
  if (core::is_text(T{}, p.slot) || core::is_list(T{}, p.slot)) {
    Spec spec = core::is_text(T{}, p.slot) ? text(std::move(doc))
                                           : list(std::move(doc), number("One number."));
    spec = spec.such_as(std::move(example));
    return p.otherwise.empty() ? spec : spec.otherwise_as(std::string(p.otherwise));
  }
  if (p.automatic)
    return either(std::move(doc),
                  {number_with(std::string(p.automatic->number)),
                   choice(std::string(p.automatic->word),
                          {Choice{"auto", std::string(p.automatic->means), 0, true}})})
        .otherwise("auto")
        .such_as(std::move(example));
  if (p.points) {
    const Spec point = list(std::string(p.points->point), number(std::string(p.points->coordinate)))
                           .count(2, p.curves ? 3 : 2)
                           .such_as(std::string(p.points->example));
    if (!core::number_in(T{}, p.slot)) {
      const Spec points =
          list(std::move(doc), point).count(p.points->least).such_as(std::move(example));
      return p.otherwise.empty() ? points : points.otherwise_as(std::string(p.otherwise));
    }
    return either(std::move(doc),
                  {number_with("A modulus."), list("The points of a curve.", point).count(2)})
        .otherwise("0")
        .such_as(std::move(example));
  }
  if (p.over) {
    const Spec pair = list("One pair, of a temperature and the value there.", number("A number."))
                          .count(2, 2)
                          .such_as("[20, " + example + "]");
    return either(std::move(doc),
                  {number_with("One for all temperatures."),
                   list("Pairs [T, value], T increasing; straight between them, constant beyond.",
                        pair)
                       .count(1)})
        .such_as(std::move(example));
  }
  Spec spec = number_with(std::move(doc)).such_as(std::move(example));
  if (!p.otherwise.empty()) return spec.otherwise_as(std::string(p.otherwise));
  const std::optional<double> usual = core::number_in(T{}, p.slot);
  return p.required || !usual ? spec : spec.otherwise(fmt::format("{:g}", *usual));
}

/// The map with one key a parameter; what is not required has the value of a new object.
///
/// Tested by  tests/unit/deck/test_params.cpp
template <class T>
[[nodiscard]] Spec params_spec(std::string doc) {
  std::vector<Key> keys;
  for (const core::Param<T>& p : T::params()) {
    Key key{std::string(p.key), p.required && !p.automatic, param_spec(p)};
    if (!p.one_of) {
      keys.push_back(std::move(key));
      continue;
    }
    if (keys.empty() || keys.back().name != p.one_of->key)
      keys.push_back(
          optional(std::string(p.one_of->key), map(std::string(p.one_of->doc), {})
                                                   .with(Group::Rule::exactly_one, {})
                                                   .such_as(std::string(p.one_of->example))));
    Spec& group = keys.back().spec;
    group.groups[0].keys.push_back(key.name);
    group.keys.push_back(std::move(key));
  }
  return map(std::move(doc), std::move(keys));
}

/// What may stand under the key of a type: the value of its one parameter, or a map of several.
template <class T>
[[nodiscard]] Spec described() {
  if constexpr (requires { T::doc; }) return params_spec<T>(std::string(T::doc));
  return param_spec(T::params().front());
}

/// The value of a parameter in that of an object, or nullptr where there is none.
template <class T>
[[nodiscard]] const Value* value_of(const Value& v, const core::Param<T>& p) {
  if (p.key.empty()) return &v;
  const Value* const map = p.one_of ? v.find(p.one_of->key) : &v;
  return map ? map->find(p.key) : nullptr;
}
/// Whether the value is the word `auto`.
template <class T>
[[nodiscard]] bool is_automatic(const Value& v, const core::Param<T>& p) {
  return p.automatic && v.alternative == 1;
}

/// The pairs of a table over the temperature are in order and in the range of the parameter.
template <class T>
void check_temperatures(const core::Param<T>& p, const Value& table) {
  for (std::size_t i = 0; i < table.items.size(); ++i) {
    const std::vector<Value>& pair = table.items[i].items;
    if (i > 0 && !(pair[0].number > table.items[i - 1].items[0].number))
      throw core::InputError(table.items[i].mark, "temperatures must increase");
    if (!p.range.contains(pair[1].number))
      throw core::InputError(pair[1].mark, core::out_of_range(p.key, pair[1].number, p.range));
  }
}

/// Rows of two coordinates, and perhaps the temperature of their curve.
[[nodiscard]] inline core::Curves curves_of(const Value& rows) {
  core::Curves curves;
  const std::size_t width = rows.items.front().items.size();
  for (const Value& row : rows.items) {
    if (row.items.size() != width)
      throw core::InputError(row.mark, "either all points have a temperature or none");
    const double temperature = width == 3 ? row.items[2].number : 0;
    if (!curves.empty() && temperature < curves.back().temperature)
      throw core::InputError(row.mark, "temperatures must increase from curve to curve");
    if (curves.empty() || temperature > curves.back().temperature) curves.push_back({temperature});
    curves.back().points.push_back({row.items[0].number, row.items[1].number});
  }
  return curves;
}

/// Throws core::InputError with what is wrong, if anything is, at the place of its key.
inline void require_none(const std::optional<core::Fault>& fault, const Value& v) {
  if (!fault) return;
  const Value* const key = fault->key.empty() ? &v : v.find(fault->key);
  const Value& whole = key ? *key : v;
  throw core::InputError(fault->item ? whole.items.at(*fault->item).mark : whole.mark, fault->why);
}

/// The object that a value describes. Throws core::InputError where its parameters do not go
/// together.
template <class T>
[[nodiscard]] T params_of(const Value& v) {
  T object;
  for (const core::Param<T>& p : T::params()) {
    const Value* const value = value_of(v, p);
    if (!value || is_automatic(*value, p)) continue;
    if (core::is_text(object, p.slot)) {
      core::set(object, p.slot, value->text);
      continue;
    }
    if (core::is_list(object, p.slot)) {
      std::vector<double> numbers;
      for (const Value& item : value->items) numbers.push_back(item.number);
      core::set(object, p.slot, std::move(numbers));
      continue;
    }
    if (core::Curves* const curves = core::curves_over(object, p);
        curves && !value->items.empty() &&
        (core::number_in(object, p.slot) || std::ranges::any_of(value->items, [](const Value& row) {
           return row.items.size() == 3;
         }))) {
      *curves = curves_of(*value);
      continue;
    }
    core::Table points;
    for (const Value& item : value->items)
      points.push_back({item.items[0].number, item.items[1].number});
    if (core::Table* const over = core::table_over(object, p); over && !points.empty()) {
      check_temperatures(p, *value);
      core::set(object, p.slot, points.front()[1]);
      *over = std::move(points);
      continue;
    }
    core::set(object, p.slot, value->number);
    core::set(object, p.slot, std::move(points));
  }
  require_none(core::own_fault(object), v);
  return object;
}

}  // namespace osculate::deck

#pragma once
// What describes itself by its parameters (core::Param), as keys of the model file.
#include <fmt/format.h>

#include <cmath>

#include "osculate/core/param.hpp"
#include "osculate/deck/check.hpp"
#include "osculate/deck/spec.hpp"

namespace osculate::deck {

/// The map with one key a parameter; what is not required has the value of a new object.
///
/// Tested by  tests/unit/deck/test_params.cpp
template <class T>
[[nodiscard]] Spec params_spec(std::string doc) {
  std::vector<Key> keys;
  for (const core::Param<T>& p : T::params()) {
    Spec spec = number(std::string(p.doc)).such_as(std::string(p.example));
    if (p.unit != "1") spec = spec.in(std::string(p.unit));
    if (std::isfinite(p.range.lower))
      spec = p.range.with_lower ? spec.at_least(p.range.lower) : spec.above(p.range.lower);
    if (std::isfinite(p.range.upper))
      spec = p.range.with_upper ? spec.at_most(p.range.upper) : spec.below(p.range.upper);
    if (!p.required) spec = spec.otherwise(fmt::format("{:g}", T{}.*p.slot));
    keys.push_back({std::string(p.key), p.required, std::move(spec)});
  }
  return map(std::move(doc), std::move(keys));
}

/// The object that a value of that map describes.
template <class T>
[[nodiscard]] T params_of(const Value& v) {
  T object;
  for (const core::Param<T>& p : T::params()) object.*p.slot = v.at(p.key).number;
  return object;
}

}  // namespace osculate::deck

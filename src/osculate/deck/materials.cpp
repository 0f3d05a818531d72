// The materials of the catalogue as keys of the model file: the one source of this layer that knows
// which materials there are.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/params.hpp"
#include "osculate/material/law.hpp"

namespace osculate::deck {
namespace {

/// Keys of the materials that are such, one after the other.
template <class Is>
std::string keys_of(const Is& is) {
  std::vector<std::string> keys;
  material::for_each_law([&](const auto& law) {
    if (is(law)) keys.emplace_back(law.key);
  });
  return core::join(keys);
}

/// One key a law.
BoundKeys<Material> material_keys() {
  std::vector<BoundKey<Material>> keys;
  material::for_each_law([&]<class T>(const T&) {
    keys.push_back({optional(std::string(T::key), params_spec<T>(std::string(T::doc))),
                    [](Material& m, const Value& v) {
                      m.law = {params_of<T>(v), v.mark};
                      for (const core::Param<T>& p : T::params())
                        if (const Value* const value = value_of(v, p))
                          m.marks.emplace_back(p.key, value->mark);
                    }});
  });
  return keys;
}

void check_material(const Value&, const Material& m) {
  constexpr double nearest = 1e-10;  // leaves six digits for the shape
  if (0.5 - material::unloaded(m.law.value).poisson < nearest)
    throw core::InputError(m.mark("nu"),
                           "is so near to 0.5 that the resistance to changes of volume leaves no "
                           "digits for anything else: use at most 0.4999999999");
}

}  // namespace

BoundKey<Description> materials_key() {
  Spec law = material_keys().spec("A material: exactly one law.");
  const std::vector<std::string> keys = names_of(law.keys);
  law = law.with(Group::Rule::exactly_one, keys)
            .or_else(fmt::format("; a material is NAME: {{LAW: {{E: ..., nu: ...}}}} with one of "
                                 "the laws {}; others are not available (osculate doc limits)",
                                 fmt::join(keys, ", ")))
            .such_as("{linear_elastic: {E: 2.1e5, nu: 0.3}}");
  return {optional("materials", names("The materials, by name.", law)
                                    .otherwise("{}")
                                    .such_as("{steel: {linear_elastic: {E: 2.1e5, nu: 0.3}}}")),
          [](Description& d, const Value& v) {
            d.materials = material_keys().read_all(v, check_material);
          }};
}

std::string small_strain_materials() {
  return keys_of([](const auto& law) { return !law.finite_strain; });
}
std::string remembering_materials() {
  return keys_of([]<class T>(const T&) { return material::Remembers<T>; });
}

std::vector<RememberedNumber> remembered_numbers() {
  std::vector<RememberedNumber> numbers;
  material::for_each_law([&]<class T>(const T&) {
    if constexpr (material::Remembers<T>)
      for (const material::Remembered& of : T::memory) {
        const auto known = std::ranges::find(numbers, of.name, &RememberedNumber::name);
        if (known != numbers.end()) {
          known->materials += fmt::format(", {}", T::key);
          continue;
        }
        std::string word(of.name);
        for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        numbers.push_back({std::move(word), of.name, of.doc, std::string(T::key)});
      }
  });
  return numbers;
}

}  // namespace osculate::deck

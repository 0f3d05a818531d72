// The materials of the catalogue as keys of the model file: the one source of this layer that knows
// which materials there are.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

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

/// Pairs of temperature and coefficient, or one coefficient.
BoundKey<Material> expansion_key() {
  const Spec pair = list("One pair [T, alpha].", number("Temperature, or coefficient."))
                        .count(2, 2)
                        .such_as("[100, 1.2e-5]");
  const Spec alpha =
      either("Mean coefficient of thermal expansion from the reference temperature on.",
             {number("One for all temperatures.").in("1/temperature"),
              list("Pairs [T, alpha], T increasing; straight between them, constant beyond.", pair)
                  .count(1)})
          .such_as("1.2e-5");
  const Spec reference =
      number(
          "Temperature that the coefficients of a table count from. It does not matter for one "
          "coefficient: free of stress is the initial temperature.")
          .in("temperature")
          .otherwise("0")
          .such_as("20");
  return {
      optional("expansion", map("Strain by the temperature.",
                                {required("alpha", alpha), optional("reference", reference)})
                                .such_as("{alpha: 1.2e-5}")),
      [](Material& m, const Value& v) {
        m.expansion.reference = v.at("reference").number;
        const Value& given = v.at("alpha");
        if (given.alternative == 0) m.expansion.table.push_back({0, given.number});
        for (const Value& row : given.items) {
          if (!m.expansion.table.empty() && !(row.items[0].number > m.expansion.table.back()[0]))
            throw core::InputError(row.mark, "temperatures must increase");
          m.expansion.table.push_back({row.items[0].number, row.items[1].number});
        }
      }};
}

/// The law of a value; one whose formulas stand in a library, with them.
template <class T>
T law_of(const Value& v) {
  T law = params_of<T>(v);
  if constexpr (requires { law.open(std::string()); })
    require_none(law.open(std::filesystem::path(v.mark.file).parent_path().string()), v);
  return law;
}

/// One key a law, and the expansion.
BoundKeys<Material> material_keys() {
  std::vector<BoundKey<Material>> keys;
  material::for_each_law([&]<class T>(const T&) {
    keys.push_back({optional(std::string(T::key), params_spec<T>(std::string(T::doc))),
                    [](Material& m, const Value& v) {
                      m.law = {law_of<T>(v), v.mark};
                      for (const core::Param<T>& p : T::params())
                        if (const Value* const value = value_of(v, p))
                          m.marks.emplace_back(p.key, value->mark);
                    }});
  });
  keys.push_back(expansion_key());
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
  std::vector<std::string> keys = names_of(law.keys);
  keys.pop_back();  // the expansion
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
  return keys_of([](const auto& law) { return !material::memory_of(law).empty(); });
}

std::vector<RememberedNumber> remembered_numbers() {
  std::vector<RememberedNumber> numbers;
  material::for_each_law([&]<class T>(const T&) {
    if constexpr (material::Remembers<T>)
      for (const material::Remembered& of : T::memory) {
        if (of.name.empty()) continue;
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

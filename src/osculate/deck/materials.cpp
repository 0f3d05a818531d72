// The materials of the catalogue as keys of the model file: the one source of this layer that knows
// which materials there are.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "osculate/core/text.hpp"
#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/open_law.hpp"
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

/// Strain of coefficients along three axes, or of six: 11, 22, 33, 12, 13, 23 of a tensor.
material::Strain3 strain_of(std::span<const Value> values) {
  material::Strain3 strain = material::Strain3::Zero();
  for (std::size_t k = 0; k < 3; ++k) strain[static_cast<Eigen::Index>(k)] = values[k].number;
  if (values.size() == 6)
    strain.tail<3>() << 2 * values[3].number, 2 * values[5].number, 2 * values[4].number;
  return strain;
}

/// A row of a temperature and one, three or six coefficients.
void add_row(const Value& row, std::size_t width, material::Expansion& to, double& last) {
  if (row.items.size() != width || (width != 2 && width != 4 && width != 7))
    throw core::InputError(
        row.mark, "expected a temperature and 1, 3 or 6 coefficients, in all rows the same");
  const double temperature = row.items[0].number;
  if (!(temperature > last)) throw core::InputError(row.mark, "temperatures must increase");
  last = temperature;
  if (width == 2)
    to.table.push_back({temperature, row.items[1].number});
  else
    to.directions.push_back({temperature, strain_of(std::span(row.items).subspan(1))});
}

void read_expansion(Material& m, const Value& v) {
  m.expansion.reference = v.at("reference").number;
  const Value& given = v.at("alpha");
  if (given.alternative == 0) m.expansion.table.push_back({0, given.number});
  if (given.alternative == 1) {
    double last = -std::numeric_limits<double>::infinity();
    for (const Value& row : given.items)
      add_row(row, given.items[0].items.size(), m.expansion, last);
  }
  if (given.alternative != 2) return;
  if (given.items.size() != 3 && given.items.size() != 6)
    throw core::InputError(given.mark, "expected 3 coefficients along the axes, or 6 of a tensor");
  m.expansion.directions.push_back({0, strain_of(given.items)});
}

/// Rows of temperature and coefficients, or coefficients.
BoundKey<Material> expansion_key() {
  const Spec row = list("One row [T, alpha], or with three or six coefficients.",
                        number("Temperature, or coefficient."))
                       .count(2, 7)
                       .such_as("[100, 1.2e-5]");
  const Spec alpha =
      either("Mean coefficient of thermal expansion from the reference temperature on.",
             {number("One for all temperatures and directions.").in("1/temperature"),
              list("Rows [T, alpha], T increasing; straight between them, constant beyond. By "
                   "directions [T, a1, a2, a3], or six coefficients.",
                   row)
                  .count(1),
              list("By directions, in the axes that the section's `orientation` gives: three along "
                   "them, or those of a symmetric tensor, 11, 22, 33, 12, 13, 23.",
                   number("Coefficient.").in("1/temperature"))
                  .count(3, 6)
                  .such_as("[1.2e-5, 3.0e-5, 3.0e-5]")})
          .such_as("1.2e-5");
  const Spec reference =
      number(
          "Temperature that the coefficients of a table count from. It does not matter for "
          "coefficients without a table: free of stress is the initial temperature.")
          .in("temperature")
          .otherwise("0")
          .such_as("20");
  return {optional("expansion", map("Strain by the temperature.",
                                    {required("alpha", alpha), optional("reference", reference)})
                                    .such_as("{alpha: 1.2e-5}")),
          read_expansion};
}

/// Keys of the materials that may relax.
std::string relaxing_materials() {
  return keys_of([]<class T>(const T&) { return material::Relaxable<T>; });
}

/// The law of a material, which stands before, relaxes.
void read_relaxation(Material& m, const Value& v) {
  const auto series = params_of<material::Relaxation>(v);
  std::optional<material::Law> law = material::relaxing(m.law.value, series);
  if (!law)
    throw core::InputError(
        v.mark, fmt::format("{} has none; {} may have one, and `viscoelastic` is Hooke's law with "
                            "its own series",
                            material::key_of(m.law.value), relaxing_materials()));
  if (material::relaxes_alike(m.law.value) && series.shear != series.bulk)
    throw core::InputError(
        v.mark, fmt::format("of {} shape and volume relax alike: give `bulk` the terms of `shear`",
                            material::key_of(m.law.value)));
  m.law.value = std::move(*law);
}
BoundKey<Material> relaxation_key() {
  const std::string doc = fmt::format(
      "The stresses of {} relax by Prony series (finite linear viscoelasticity); the constants of "
      "the law are those at once. Every step needs a duration.",
      relaxing_materials());
  return {optional("relaxation", params_spec<material::Relaxation>(doc).such_as(
                                     "{shear: [[0.3, 1], [0.2, 10]]}")),
          read_relaxation};
}

/// The law of a value; one whose formulas stand in a library, with them.
template <class T>
T law_of(const Value& v) {
  T law = params_of<T>(v);
  open_law(law, v);
  return law;
}

/// One key a law, the expansion and the relaxation.
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
  keys.push_back(relaxation_key());
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
  keys.resize(keys.size() - 2);  // the expansion and the relaxation
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
  for (RememberedNumber& number : numbers)
    if (number.name == material::relaxing_memory.front().name)
      number.materials += ", those with `relaxation`";
  return numbers;
}

}  // namespace osculate::deck

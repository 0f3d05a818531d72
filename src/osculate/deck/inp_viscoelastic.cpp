// `*VISCOELASTIC` of a deck.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

/// g, k and tau of the terms.
std::vector<std::array<double, 3>> prony_terms(const InpModel& m, const Card& card) {
  if (!io::inp::find_parameter(card, "TIME"))
    io::inp::fail(m.deck, card, "TIME=PRONY is expected: others are not supported");
  std::vector<std::array<double, 3>> terms;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const double g = fields.real_or_zero("the share of the shear modulus"),
                 k = fields.real_or_zero("the share of the bulk modulus"),
                 time = fields.real("the relaxation time");
    fields.expect_end();
    if (!(g >= 0 && k >= 0 && g + k > 0)) fields.fail("expected shares that are not negative");
    if (!(time > 0)) fields.fail("expected a relaxation time greater than 0");
    terms.push_back({g, k, time});
  }
  if (terms.empty()) io::inp::fail(m.deck, card, "expected lines of g, k and tau");
  return terms;
}

/// What remains of a modulus.
double remaining(const InpModel& m, const Card& card,
                 const std::vector<std::array<double, 3>>& terms, std::size_t which) {
  double rest = 1;
  for (const auto& term : terms) rest -= term[which];
  if (!(rest > 0))
    io::inp::fail(m.deck, card, "the sum of the shares is less than 1: something remains");
  return rest;
}

void put_series(const std::vector<std::array<double, 3>>& terms, std::size_t which, const char* key,
                int line, SourceNode& law) {
  SourceNode series = inp_list(line);
  for (const auto& term : terms) {
    if (term[which] == 0) continue;
    SourceNode& row = series.items.emplace_back(inp_list(line));
    row.items = {inp_number(term[which], line), inp_number(term[2], line)};
  }
  if (!series.items.empty()) put(law, key, std::move(series));
}

}  // namespace

InpAtOnce at_once_of(const InpModel& m, const Card& elastic, const Card* viscoelastic) {
  if (!viscoelastic) return {};
  std::string moduli = option_of(elastic, "MODULI");
  std::erase(moduli, ' ');
  if (moduli != "INSTANTANEOUS" && !moduli.empty() && moduli != "LONGTERM")
    io::inp::fail(
        m.deck, elastic,
        fmt::format("MODULI={} is not supported: INSTANTANEOUS or LONG TERM", printable(moduli)));
  const auto terms = prony_terms(m, *viscoelastic);
  const double shear = remaining(m, *viscoelastic, terms, 0),
               bulk = remaining(m, *viscoelastic, terms, 1);
  if (moduli == "INSTANTANEOUS") return {};
  return {1 / shear, 1 / bulk};
}

void put_relaxation(const InpModel& m, const Card& hyperelastic, const Card& viscoelastic,
                    SourceNode& material) {
  const auto terms = prony_terms(m, viscoelastic);
  const bool alike = std::ranges::all_of(terms, [](const auto& t) { return t[0] == t[1]; });
  if (hyperelastic.keyword == "HYPERFOAM" && !alike)
    io::inp::fail(m.deck, viscoelastic,
                  "of *HYPERFOAM shape and volume relax alike: each line has g = k");
  const int line = line_of(viscoelastic.at);
  SourceNode& relaxation = put(material, "relaxation", inp_map(line));
  put_series(terms, 0, "shear", line, relaxation);
  put_series(terms, 1, "bulk", line, relaxation);
}

void put_viscoelastic(const InpModel& m, const Card& elastic, const Card& viscoelastic,
                      SourceNode& law) {
  const auto terms = prony_terms(m, viscoelastic);
  const InpAtOnce at_once = at_once_of(m, elastic, &viscoelastic);
  Fields fields(m.deck, constant_line(m, elastic, "E and nu"));
  double young = fields.real("Young's modulus"), poisson = fields.real_or_zero("Poisson's ratio");
  if (at_once.shear != 1 || at_once.bulk != 1) {
    const double shear = young / (2 * (1 + poisson)) * at_once.shear,
                 bulk = young / (3 * (1 - 2 * poisson)) * at_once.bulk;
    young = 9 * bulk * shear / (3 * bulk + shear);
    poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
  }
  const int line = line_of(elastic.at);
  put(law, "E", inp_number(young, line));
  put(law, "nu", inp_number(poisson, line));
  put_series(terms, 0, "shear", line_of(viscoelastic.at), law);
  put_series(terms, 1, "bulk", line_of(viscoelastic.at), law);
}

}  // namespace osculate::deck

// The parameters of a deck's keywords: read, without effect, or refused.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_keywords.hpp"
#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;

/// Parameters that are refused where their keyword is translated, with reasons of their own.
struct Refused {
  std::string_view keyword, parameters;
};
constexpr std::array<Refused, 18> refused_later{{
    {"INSTANCE", "LIBRARY, INSTANCE"},
    {"STATIC", "RIKS"},
    {"BOUNDARY", "USER, SUBMODEL, SECTOR, OMEGA0"},
    {"CLOAD", "USER, SUBMODEL, SECTOR, OMEGA0"},
    {"DLOAD", "USER, SUBMODEL, SECTOR, OMEGA0"},
    {"DSLOAD", "USER, SUBMODEL, SECTOR, OMEGA0"},
    {"TEMPERATURE", "USER, SUBMODEL, SECTOR, OMEGA0, FILE, BSTEP"},
    {"INITIAL CONDITIONS", "USER, GEOSTATIC, SECTION POINTS, FILE"},
    {"HYPERELASTIC", "MARLOW, VAN DER WAALS, USER, TEST DATA INPUT"},
    {"HYPERFOAM", "TEST DATA INPUT"},
    {"TIE", "MULTISTAGE, FLUID PERIODIC, FLUID CYCLIC"},
    {"MODAL DYNAMIC", "STEADY STATE, CYCLIC SYMMETRY, NSET"},
    {"STEADY STATE DYNAMICS", "STEADY STATE, CYCLIC SYMMETRY, NSET"},
    {"MODAL DAMPING", "STRUCTURAL"},
    {"AMPLITUDE", "USER"},
    {"SPRING", "ORIENTATION"},
    {"DASHPOT", "ORIENTATION"},
    {"PRE-TENSION SECTION", "ELEMENT"},
}};

std::string without_blanks(std::string_view text) {
  std::string plain(text);
  std::erase(plain, ' ');
  return plain;
}

/// Whether it is that of a list such as `NSET, REF NODE`, where a value may be asked for, too
/// (`TYPE=DISPLACEMENT`).
bool is_listed(std::string_view list, const io::inp::Parameter& given) {
  for (const std::string& one : inp_parameter_names(list)) {
    const std::string plain = without_blanks(one);
    const std::size_t equals = plain.find('=');
    if (plain.substr(0, equals) != given.name) continue;
    return equals == std::string::npos ||
           plain.substr(equals + 1) == io::inp::capitals(given.value);
  }
  return false;
}

[[noreturn]] void refuse(const InpModel& m, const Card& card, const InpKeyword& known,
                         const io::inp::Parameter& given) {
  const std::vector<std::string> names = inp_parameter_names(known.parameters);
  for (const std::string& one : names)
    if (const std::size_t equals = one.find('=');
        equals != std::string::npos && without_blanks(one.substr(0, equals)) == given.name)
      io::inp::fail(m.deck, card,
                    fmt::format("{}={} is not supported: expected {}", one.substr(0, equals),
                                printable(given.value), one));
  const std::string name = printable(given.name);
  if (names.empty())
    io::inp::fail(m.deck, card, fmt::format("the parameter '{}' is not supported", name));
  io::inp::fail(m.deck, card, core::unknown_name_message("parameter", name, names));
}

}  // namespace

std::vector<std::string> inp_parameter_names(std::string_view list) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find_first_of(",;", at), list.size());
    std::string_view name = list.substr(at, end - at);
    while (name.starts_with(' ')) name.remove_prefix(1);
    if (!name.empty()) names.emplace_back(name);
    at = end + 1;
  }
  return names;
}

void check_parameters(InpModel& m) {
  std::set<std::string> ignored;
  for (const Card& card : m.deck.cards) {
    const InpKeyword* const known = find_inp_keyword(card.keyword);
    if (!known || known->use == KeywordUse::silent || known->use == KeywordUse::none) continue;
    const std::string_view all = known->parameters;
    const std::size_t bar = std::min(all.find(';'), all.size());
    const auto* const later = std::ranges::find(refused_later, known->keyword, &Refused::keyword);
    for (const io::inp::Parameter& given : card.parameters) {
      if (is_listed(all.substr(0, bar), given)) continue;
      if (later != refused_later.end() && is_listed(later->parameters, given)) continue;
      if (!is_listed(all.substr(bar), given)) refuse(m, card, *known, given);
      for (const std::string& name : inp_parameter_names(all.substr(bar)))
        if (without_blanks(name) == given.name)
          ignored.insert(fmt::format("{} of *{}", name, known->keyword));
    }
  }
  if (!ignored.empty())
    m.notes.push_back(fmt::format("of '{}' these parameters have no effect: {}", m.deck.files[0],
                                  fmt::join(ignored, ", ")));
}

}  // namespace osculate::deck

// `*USER MATERIAL` of a deck.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

/// Materials that CalculiX has compiled in and knows by the beginning of their names, in the order
/// in which its manual lists them; LIN_ISO_EL is Hooke's law.
constexpr std::array<std::string_view, 13> compiled_in{"ANISO_PLAS",
                                                       "ANISO_CREEP",
                                                       "CIARLET_EL",
                                                       "COMPRESSION_ONLY",
                                                       "ELASTIC_FIBER",
                                                       "IDEAL_GAS",
                                                       "JOHNSON_COOK",
                                                       "LIN_EL_COROT",
                                                       "MOHR_COULOMB",
                                                       "SINGLE_CRYSTAL",
                                                       "TENSION_ONLY",
                                                       "UNDO_NLGEOM_LIN_EL",
                                                       "UNDO_NLGEOM_LIN_ISO_EL"};
constexpr std::string_view hooke = "LIN_ISO_EL";
constexpr const char* variable = "OSCULATE_USER_MATERIAL";

std::vector<double> constants_of_user(const InpModel& m, const io::inp::Card& card) {
  const std::int32_t count =
      io::inp::number_of(m.deck, card.at, value_of(m, card, "CONSTANTS"), "CONSTANTS");
  const auto wanted = static_cast<std::size_t>(count);
  constexpr std::size_t width = 8;
  std::vector<double> numbers;
  for (const io::inp::Line& line : io::inp::lines_of(m.deck, card)) {
    io::inp::Fields fields(m.deck, line);
    for (std::size_t k = 0; k < width && !fields.done(); ++k)
      numbers.push_back(fields.real_or_zero("a constant"));
  }
  if (numbers.size() < wanted)
    io::inp::fail(m.deck, card,
                  fmt::format("expected {} constants, found {}", wanted, numbers.size()));
  if (numbers.size() > wanted + 1)  // one temperature, which is of no use
    io::inp::fail(m.deck, card,
                  fmt::format("expected {} constants, found {}: constants that depend on the "
                              "temperature are not supported",
                              wanted, numbers.size()));
  numbers.resize(wanted);
  return numbers;
}

void put_hooke(const InpModel& m, const io::inp::Card& user, SourceNode& law) {
  const std::vector<double> constants = constants_of_user(m, user);
  if (constants.size() != 2)
    io::inp::fail(m.deck, user, fmt::format("{} has two constants, E and nu", hooke));
  put(law, "E", inp_number(constants[0], line_of(user.at)));
  put(law, "nu", inp_number(constants[1], line_of(user.at)));
}

}  // namespace

std::string_view user_law(const InpModel& m, const io::inp::Card& material) {
  const std::string name = option_of(material, "NAME");
  if (name.starts_with(hooke)) return m.finite ? "st_venant_kirchhoff" : "linear_elastic";
  for (const std::string_view own : compiled_in)
    if (name.starts_with(own))
      io::inp::fail(m.deck, material,
                    fmt::format("{} is a material that CalculiX has compiled in, which is not "
                                "supported",
                                own));
  return "user";
}

void put_user(const InpModel& m, const io::inp::Card& material, const io::inp::Card& user,
              const io::inp::Card* depvar, SourceNode& law) {
  if (user_law(m, material) != "user") return put_hooke(m, user, law);
  const int line = line_of(user.at);
  const char* const library = std::getenv(variable);
  if (!library || !*library)
    io::inp::fail(m.deck, user,
                  fmt::format("its routine is in a shared library: name that in the environment "
                              "variable {} (docs/user_material.md)",
                              variable));
  put(law, "library", inp_text(std::filesystem::absolute(library).string(), line));
  put(law, "name", inp_text(value_of(m, material, "NAME"), line));
  SourceNode& constants = put(law, "constants", inp_list(line));
  for (const double value : constants_of_user(m, user))
    constants.items.push_back(inp_number(value, line));
  if (!depvar) return;
  const auto lines = io::inp::lines_of(m.deck, *depvar);
  if (lines.empty()) io::inp::fail(m.deck, *depvar, "expected the number of state variables");
  io::inp::Fields fields(m.deck, lines[0]);
  put(law, "state",
      inp_number(fields.number("the number of state variables"), line_of(lines[0].at)));
}

}  // namespace osculate::deck

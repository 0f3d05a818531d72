// `*ELASTIC` and `*ORIENTATION` of a deck.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

/// Constants of a TYPE in the order of the deck; a line has eight of them.
struct ElasticForm {
  std::string_view law;
  std::vector<std::string_view> constants;
};

ElasticForm form_of_type(std::string_view type) {
  if (type == "ENGINEERINGCONSTANTS")
    return {"orthotropic", {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"}};
  if (type == "ORTHO" || type == "ORTHOTROPIC")
    return {"anisotropic",
            {"D1111", "D1122", "D2222", "D1133", "D2233", "D3333", "D1212", "D1313", "D2323"}};
  if (type == "ANISO" || type == "ANISOTROPIC")
    return {"anisotropic", {"D1111", "D1122", "D2222", "D1133", "D2233", "D3333", "D1112",
                            "D2212", "D3312", "D1212", "D1113", "D2213", "D3313", "D1213",
                            "D1313", "D1123", "D2223", "D3323", "D1223", "D1323", "D2323"}};
  return {};
}

std::string type_of(const Card& card) {
  std::string type = option_of(card, "TYPE");
  std::erase(type, ' ');
  return type;
}

/// The constants of a card, and perhaps a temperature behind them.
std::vector<double> constants_of(const InpModel& m, const Card& card, std::size_t count) {
  constexpr std::size_t width = 8;
  const auto lines = io::inp::lines_of(m.deck, card);
  const std::size_t needed = (count + width - 1) / width;
  if (lines.size() < needed)
    io::inp::fail(m.deck, card,
                  fmt::format("expected {} constants in {} lines of {}, found {} lines", count,
                              needed, width, lines.size()));
  if (lines.size() > needed)
    io::inp::fail(m.deck, lines[needed].at,
                  "*ELASTIC: constants that depend on the temperature are supported of isotropic "
                  "materials alone");
  std::vector<double> numbers;
  for (std::size_t i = 0; i < needed; ++i) {
    Fields fields(m.deck, lines[i]);
    for (std::size_t k = 0; k < width && numbers.size() < count; ++k)
      numbers.push_back(fields.real_or_zero("a constant"));
  }
  return numbers;
}

/// E and nu, or both over the temperature.
void put_isotropic(const InpModel& m, const Card& card, SourceNode& law) {
  const int line = line_of(card.at);
  struct Constant {
    const char *key, *what;
    SourceNode table;
    bool same = true;
  };
  std::array<Constant, 2> constants{
      {{"E", "Young's modulus", inp_list(line)}, {"nu", "Poisson's ratio", inp_list(line)}}};
  for (const Line& one : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, one);
    const std::array<double, 2> values{fields.real(constants[0].what),
                                       fields.real_or_zero(constants[1].what)};
    const double temperature = fields.real_or_zero("a temperature");
    for (std::size_t k = 0; k < 2; ++k) {
      SourceNode& row = constants[k].table.items.emplace_back(inp_list(line_of(one.at)));
      row.items = {inp_number(temperature, row.line), inp_number(values[k], row.line)};
      constants[k].same =
          constants[k].same && row.items[1].text == constants[k].table.items[0].items[1].text;
    }
  }
  if (constants[0].table.items.empty())
    io::inp::fail(m.deck, card, "expected a line with E and nu");
  for (Constant& c : constants)
    put(law, c.key, c.same ? c.table.items[0].items[1] : std::move(c.table));
}

/// Numbers of a line that come before the temperature.
std::string_view before_temperature(const Line& line) {
  return std::string_view(line.text).substr(0, line.text.find_last_of(','));
}

const Card* orientation_card(const InpModel& m, const std::string& name) {
  for (const Card& card : m.deck.cards)
    if (card.keyword == "ORIENTATION" && option_of(card, "NAME") == name) return &card;
  return nullptr;
}

}  // namespace

bool has_constant_lines(const InpModel& m, const Card& card) {
  const auto lines = io::inp::lines_of(m.deck, card);
  return std::all_of(lines.begin(), lines.end(), [&](const Line& line) {
    return before_temperature(line) == before_temperature(lines[0]);
  });
}

const Line& constant_line(const InpModel& m, const Card& card, const char* what) {
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.size() < 2) return only_line(m, card, what);
  for (const Line& line : lines)
    if (before_temperature(line) != before_temperature(lines[0]))
      io::inp::fail(m.deck, line.at,
                    fmt::format("*{}: numbers that depend on the temperature are not supported",
                                card.keyword));
  return lines[0];
}

bool is_directional(const Card& elastic) { return !form_of_type(type_of(elastic)).law.empty(); }

bool depends_on_temperature(const InpModel& m, const Card& elastic) {
  return !is_directional(elastic) && io::inp::lines_of(m.deck, elastic).size() > 1 &&
         !has_constant_lines(m, elastic);
}

std::string_view elastic_law(const InpModel& m, const Card& elastic) {
  const std::string type = type_of(elastic);
  if (const std::string_view law = form_of_type(type).law; !law.empty()) return law;
  if (!type.empty() && type != "ISO" && type != "ISOTROPIC")
    io::inp::fail(m.deck, elastic,
                  fmt::format("TYPE={} is not supported: ISO, ORTHO, ENGINEERING CONSTANTS, ANISO",
                              printable(type)));
  return m.finite ? "st_venant_kirchhoff" : "linear_elastic";
}

void put_elastic(const InpModel& m, const Card& card, SourceNode& law) {
  const ElasticForm form = form_of_type(type_of(card));
  if (form.law.empty()) {
    if (depends_on_temperature(m, card) && !has_temperatures(m))
      io::inp::fail(m.deck, card,
                    "depends on the temperature, which is given nowhere (*INITIAL CONDITIONS, "
                    "*TEMPERATURE)");
    put_isotropic(m, card, law);
    return;
  }
  const std::vector<double> numbers = constants_of(m, card, form.constants.size());
  const int line = line_of(card.at);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::string key(form.constants[k]);
    const bool needed = form.law == "orthotropic" || key.substr(1, 2) == key.substr(3, 2);
    if (needed || numbers[k] != 0) put(law, key, inp_number(numbers[k], line));
  }
}

SourceNode inp_orientation(const InpModel& m, const Card& section) {
  return inp_orientation(m, section, option_of(section, "ORIENTATION"));
}

SourceNode inp_orientation(const InpModel& m, const Card& section, const std::string& name) {
  const Card* const card = orientation_card(m, name);
  if (!card) {
    std::vector<std::string> known;
    for (const Card& other : m.deck.cards)
      if (other.keyword == "ORIENTATION") known.push_back(option_of(other, "NAME"));
    io::inp::fail(m.deck, section,
                  core::unknown_name_message("ORIENTATION", printable(name), known));
  }
  const std::string system = option_of(*card, "SYSTEM"), kind = option_of(*card, "DEFINITION");
  if (!system.empty() && system != "RECTANGULAR" && system != "CYLINDRICAL")
    io::inp::fail(m.deck, *card,
                  fmt::format("SYSTEM={} is not supported: RECTANGULAR or "
                              "CYLINDRICAL",
                              printable(system)));
  if (!kind.empty() && kind != "COORDINATES")
    io::inp::fail(m.deck, *card,
                  fmt::format("DEFINITION={} is not supported: COORDINATES", printable(kind)));
  const auto lines = io::inp::lines_of(m.deck, *card);
  if (lines.empty()) io::inp::fail(m.deck, *card, "expected a line with two points");
  const int line = line_of(card->at);
  Fields fields(m.deck, lines[0]);
  Vec3 a = point_of(fields), b = point_of(fields);
  SourceNode axes = inp_map(line);
  const bool round = system == "CYLINDRICAL";
  if (!round) {
    const Vec3 origin = point_of(fields);
    a -= origin;
    b -= origin;
  }
  SourceNode& points = put(axes, round ? "cylindrical" : "rectangular", inp_map(line));
  put(points, round ? "from" : "x", inp_point(a, 3, line));
  put(points, round ? "to" : "xy", inp_point(b, 3, line));
  if (lines.size() > 1) {
    Fields turn(m.deck, lines[1]);
    const std::int32_t about = turn.number("the number of an axis");
    const double angle = turn.real_or_zero("an angle");
    SourceNode& turned = put(axes, "turn", inp_map(line_of(lines[1].at)));
    put(turned, "about", inp_number(about, turned.line));
    put(turned, "angle", inp_number(angle, turned.line));
  }
  return axes;
}

}  // namespace osculate::deck

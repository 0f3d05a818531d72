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

/// The constants of a card of so many a temperature.
std::vector<InpConstants> constants_of(const InpModel& m, const Card& card, std::size_t count) {
  constexpr std::size_t width = 8;
  const auto lines = io::inp::lines_of(m.deck, card);
  const std::size_t needed = (count + width - 1) / width;
  if (lines.empty() || lines.size() % needed != 0)
    io::inp::fail(m.deck, card,
                  fmt::format("expected {} constants in {} lines of {}, found {} lines", count,
                              needed, width, lines.size()));
  std::vector<InpConstants> rows;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Fields fields(m.deck, lines[i]);
    if (i % needed == 0) rows.emplace_back().line = line_of(lines[i].at);
    std::vector<double>& values = rows.back().values;
    for (std::size_t k = 0; k < width && values.size() < count; ++k)
      values.push_back(fields.real_or_zero("a constant"));
    if (values.size() == count) rows.back().temperature = fields.real_or_zero("a temperature");
  }
  return rows;
}

/// E and nu, each temperature in a line.
std::vector<InpConstants> isotropic_constants(const InpModel& m, const Card& card) {
  std::vector<InpConstants> rows;
  for (const Line& one : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, one);
    InpConstants& row = rows.emplace_back();
    row.line = line_of(one.at);
    row.values = {fields.real("Young's modulus"), fields.real_or_zero("Poisson's ratio")};
    row.temperature = fields.real_or_zero("a temperature");
  }
  if (rows.empty()) io::inp::fail(m.deck, card, "expected a line with E and nu");
  return rows;
}

std::vector<InpConstants> elastic_constants(const InpModel& m, const Card& card) {
  const ElasticForm form = form_of_type(type_of(card));
  return form.law.empty() ? isotropic_constants(m, card)
                          : constants_of(m, card, form.constants.size());
}

bool are_constant(const std::vector<InpConstants>& rows) {
  return std::ranges::all_of(rows,
                             [&](const InpConstants& row) { return row.values == rows[0].values; });
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

bool depends_on_temperature(const InpModel& m, const Card& card) {
  if (card.keyword == "ELASTIC") return !are_constant(elastic_constants(m, card));
  const bool curves = card.keyword == "PLASTIC" || card.keyword == "CYCLICHARDENING";
  if (!curves && card.keyword != "CREEP") return false;
  std::optional<double> first;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    for (int k = 0; k < (curves ? 2 : 3); ++k) (void)fields.real_or_zero("a number");
    const double temperature = fields.real_or_zero("a temperature");
    if (temperature != first.value_or(temperature)) return true;
    first = temperature;
  }
  return false;
}

void put_over_temperature(const InpModel& m, const Card& card,
                          const std::vector<InpConstants>& rows,
                          const std::vector<std::string_view>& keys, SourceNode& law) {
  if (!are_constant(rows)) require_temperatures(m, card);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const double first = rows[0].values[k];
    const bool same =
        std::ranges::all_of(rows, [&](const InpConstants& row) { return row.values[k] == first; });
    if (same) {
      put(law, std::string(keys[k]), inp_number(first, rows[0].line));
      continue;
    }
    SourceNode& table = put(law, std::string(keys[k]), inp_list(line_of(card.at)));
    for (const InpConstants& of : rows) {
      SourceNode& row = table.items.emplace_back(inp_list(of.line));
      row.items = {inp_number(of.temperature, of.line), inp_number(of.values[k], of.line)};
    }
  }
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
  std::vector<InpConstants> rows = elastic_constants(m, card);
  std::vector<std::string_view> keys =
      form.law.empty() ? std::vector<std::string_view>{"E", "nu"} : form.constants;
  if (form.law == "anisotropic")  // constants beside the diagonal may be left out
    for (std::size_t k = keys.size(); k-- > 0;) {
      if (keys[k].substr(1, 2) == keys[k].substr(3, 2)) continue;
      if (std::ranges::any_of(rows, [&](const InpConstants& row) { return row.values[k] != 0; }))
        continue;
      keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(k));
      for (InpConstants& row : rows)
        row.values.erase(row.values.begin() + static_cast<std::ptrdiff_t>(k));
    }
  put_over_temperature(m, card, rows, keys, law);
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

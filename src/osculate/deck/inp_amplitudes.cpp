// Amplitudes of a deck: tables over the time of a step or of all, and what they are within one.
#include <fmt/format.h>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

/// Constant before the first and behind the last point.
double factor_at(const InpTable& table, double time) {
  const auto& p = table.points;
  if (time <= p.front()[0]) return p.front()[1];
  for (std::size_t k = 1; k < p.size(); ++k)
    if (time <= p[k][0])
      return p[k - 1][1] + (p[k][1] - p[k - 1][1]) * (time - p[k - 1][0]) / (p[k][0] - p[k - 1][0]);
  return p.back()[1];
}

void check_amplitude(const InpModel& m, const Card& card) {
  const std::string time = option_of(card, "TIME");
  if (!time.empty() && time != "STEPTIME" && time != "TOTALTIME")
    io::inp::fail(m.deck, card, fmt::format("expected TIME=TOTAL TIME, found {}", time));
  for (const char* const other : {"DEFINITION", "VALUE", "USER"})
    if (io::inp::find_parameter(card, other) && option_of(card, other) != "TABULAR" &&
        option_of(card, other) != "RELATIVE")
      io::inp::fail(m.deck, card, fmt::format("{} is not supported", other));
}

void add_point(SourceNode& points, double fraction, double factor) {
  SourceNode& row = points.items.emplace_back(inp_list(points.line));
  row.items = {inp_number(fraction, points.line), inp_number(factor, points.line)};
}

}  // namespace

void read_amplitude(const InpModel& m, const Card& card, InpTables& tables) {
  InpTable table;
  table.name = value_of(m, card, "NAME");
  table.line = line_of(card.at);
  check_amplitude(m, card);
  table.of_total_time = option_of(card, "TIME") == "TOTALTIME";
  const auto shift = [&](const char* key) {
    const io::inp::Parameter* const given = io::inp::find_parameter(card, key);
    return given ? Fields(m.deck, {given->value, card.at}).real(key) : 0.0;
  };
  const double later = shift("SHIFTX"), more = shift("SHIFTY");
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    while (!fields.done()) {
      const double t = fields.real("a time") + later;
      const double factor = fields.real("a factor") + more;
      if (!table.points.empty() && !(t > table.points.back()[0]))
        fields.fail("expected a later time than the one before");
      table.points.push_back({t, factor});
    }
  }
  if (table.points.empty()) io::inp::fail(m.deck, card, "expected pairs of time and factor");
  tables[io::inp::capitals(table.name)] = std::move(table);
}

std::string amplitude_of(const InpModel& m, const Card& card, InpTables& tables) {
  const std::string amplitude = option_of(card, "AMPLITUDE");
  if (!amplitude.empty() && !tables.contains(amplitude)) {
    std::vector<std::string> names;
    for (const auto& [key, table] : tables) names.push_back(table.name);
    io::inp::fail(m.deck, card,
                  core::unknown_name_message("amplitude", printable(amplitude), names));
  }
  const io::inp::Parameter* const given = io::inp::find_parameter(card, "TIMEDELAY");
  if (!given) return amplitude;
  if (amplitude.empty()) io::inp::fail(m.deck, card, "TIME DELAY needs an AMPLITUDE");
  InpTable table = tables.at(amplitude);
  const double delay = Fields(m.deck, {given->value, card.at}).real("TIME DELAY as a time");
  for (auto& point : table.points) point[0] += delay;
  table.name += fmt::format("_after_{}", delay);
  const std::string name = io::inp::capitals(table.name);
  tables[name] = std::move(table);
  return name;
}

std::string amplitude_within(const InpTable& table, double from, double width, std::size_t step,
                             SourceNode& amplitudes) {
  const std::string name = plain_name(fmt::format("{}_{}", table.name, step));
  if (find(amplitudes, name)) return name;
  SourceNode& points = put(amplitudes, name, inp_list(table.line));
  add_point(points, 0, factor_at(table, from));
  for (const auto& [time, factor] : table.points) {
    const double fraction = (time - from) / width;
    constexpr double near = 1e-9;
    if (fraction > near && fraction < 1 - near) add_point(points, fraction, factor);
  }
  add_point(points, 1, factor_at(table, from + width));
  return name;
}

std::string amplitude_at_once(SourceNode& amplitudes) {
  std::string name = "at_once";
  if (find(amplitudes, name)) return name;
  SourceNode& points = put(amplitudes, name, inp_list(1));
  for (const double fraction : {0.0, 1.0}) add_point(points, fraction, 1);
  return name;
}

}  // namespace osculate::deck

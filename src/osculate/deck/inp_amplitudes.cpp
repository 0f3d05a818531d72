// Amplitudes of a deck: tables over the time of a step or of all, and what they are within one.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

/// Formula    A = A_0 + sum_n (A_n cos n w (t - t_0) + B_n sin n w (t - t_0)) , before t_0 A_0
/// Source     Abaqus, *AMPLITUDE, DEFINITION=PERIODIC
double factor_at(const InpTable::Waves& waves, double time) {
  double sum = waves.mean;
  if (time < waves.start) return sum;
  for (std::size_t k = 0; k < waves.terms.size(); ++k) {
    const double angle = static_cast<double>(k + 1) * waves.frequency * (time - waves.start);
    sum += waves.terms[k][0] * std::cos(angle) + waves.terms[k][1] * std::sin(angle);
  }
  return sum;
}

/// Constant before the first and behind the last point.
double factor_at(const InpTable& table, double time) {
  if (table.waves) return factor_at(*table.waves, time);
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
  const std::string definition = option_of(card, "DEFINITION"), value = option_of(card, "VALUE");
  if (!definition.empty() && definition != "TABULAR" && definition != "SMOOTHSTEP" &&
      definition != "EQUALLYSPACED" && definition != "PERIODIC")
    io::inp::fail(
        m.deck, card,
        fmt::format("DEFINITION={} is not supported: TABULAR, EQUALLY SPACED, PERIODIC or "
                    "SMOOTH STEP",
                    printable(definition)));
  if (!value.empty() && value != "RELATIVE")
    io::inp::fail(m.deck, card, fmt::format("VALUE={} is not supported", printable(value)));
  if (io::inp::find_parameter(card, "USER")) io::inp::fail(m.deck, card, "USER is not supported");
}

/// Between two points of a smooth step lie so many straight parts.
///
/// Formula    A(x) = A_0 + (A_1 - A_0) x^3 (10 - 15 x + 6 x^2) ; straight parts differ from it by
///            10 / sqrt(3) / 8 / n^2 of A_1 - A_0 at most, 1.8e-5 with 200
/// Source     Abaqus, *AMPLITUDE, DEFINITION=SMOOTH STEP
std::vector<std::array<double, 2>> smooth_step(const std::vector<std::array<double, 2>>& points) {
  constexpr int parts = 200;
  std::vector<std::array<double, 2>> out;
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    for (int i = 0; i < parts; ++i) {
      const double x = static_cast<double>(i) / parts;
      const double share = x * x * x * (10 - 15 * x + 6 * x * x);
      out.push_back({std::lerp(points[k][0], points[k + 1][0], x),
                     std::lerp(points[k][1], points[k + 1][1], share)});
      if (points[k][1] == points[k + 1][1]) break;
    }
  out.push_back(points.back());
  return out;
}

/// The number of terms, the circular frequency, the time at first and the mean; then the terms.
InpTable::Waves read_waves(const InpModel& m, const Card& card) {
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty())
    io::inp::fail(m.deck, card, "expected the number of terms, the circular frequency, t0 and A0");
  Fields first(m.deck, lines[0]);
  const std::int32_t count = first.number("the number of terms");
  InpTable::Waves waves;
  waves.frequency = first.real("the circular frequency");
  if (count < 1 || !(waves.frequency > 0))
    first.fail("expected at least one term and a circular frequency above 0");
  waves.start = first.real_or_zero("the starting time");
  waves.mean = first.real_or_zero("A0");
  for (std::size_t k = 1; k < lines.size(); ++k) {
    Fields fields(m.deck, lines[k]);
    while (!fields.done()) {
      const double cosine = fields.real("a factor of a cosine");
      waves.terms.push_back({cosine, fields.real_or_zero("a factor of a sine")});
    }
  }
  if (std::ssize(waves.terms) != count)
    io::inp::fail(m.deck, card,
                  fmt::format("expected {} pairs of A and B, found {}", count, waves.terms.size()));
  return waves;
}

/// Times of straight parts between the ends of a step, which differ from the waves by 3.1e-5 of the
/// shortest one's amplitude.
///
/// Formula    (2 pi / n)^2 / 8 , n = 400 parts a wave
std::vector<double> times_of_waves(const InpModel& m, const InpTable& table, double from,
                                   double to) {
  constexpr double parts = 400, most = 200000;
  const InpTable::Waves& waves = *table.waves;
  const double part =
      2 * std::numbers::pi / (waves.frequency * static_cast<double>(waves.terms.size()) * parts);
  const double begin = std::max(from, waves.start);
  std::vector<double> times;
  if (!(begin < to)) return times;
  const double count = std::ceil((to - begin) / part);
  if (count > most)
    io::inp::fail(
        m.deck, table.at,
        fmt::format("a step has {:.3g} of its shortest waves: at most {:.3g} are supported",
                    count / parts, most / parts));
  constexpr double sudden = 1e-6;  // share of the step in which the waves set in
  if (begin > from) times.insert(times.end(), {begin - sudden * (to - from), begin});
  for (int k = 1; k < static_cast<int>(count); ++k)
    times.push_back(begin + (to - begin) * k / count);
  return times;
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
  table.at = card.at;
  if (option_of(card, "DEFINITION") == "PERIODIC") {
    table.waves = read_waves(m, card);
    table.waves->start += later;
    table.waves->mean += more;
    tables[io::inp::capitals(table.name)] = std::move(table);
    return;
  }
  const bool spaced = option_of(card, "DEFINITION") == "EQUALLYSPACED";
  const double interval = spaced ? shift("FIXEDINTERVAL") : 0;
  if (spaced && !(interval > 0)) io::inp::fail(m.deck, card, "expected FIXED INTERVAL above 0");
  const double begin = spaced ? shift("BEGIN") : 0;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    while (!fields.done()) {
      const double t = later + (spaced ? begin + static_cast<double>(table.points.size()) * interval
                                       : fields.real("a time"));
      const double factor = fields.real("a factor") + more;
      if (!table.points.empty() && !(t > table.points.back()[0]))
        fields.fail("expected a later time than the one before");
      table.points.push_back({t, factor});
    }
  }
  if (table.points.empty()) io::inp::fail(m.deck, card, "expected pairs of time and factor");
  if (option_of(card, "DEFINITION") == "SMOOTHSTEP") table.points = smooth_step(table.points);
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
  if (table.waves) table.waves->start += delay;
  table.name += fmt::format("_after_{}", delay);
  const std::string name = io::inp::capitals(table.name);
  tables[name] = std::move(table);
  return name;
}

std::string amplitude_within(const InpModel& m, const InpTable& table, double from, double width,
                             std::size_t step, SourceNode& amplitudes) {
  const std::string name = plain_name(fmt::format("{}_{}", table.name, step));
  if (find(amplitudes, name)) return name;
  SourceNode& points = put(amplitudes, name, inp_list(table.line));
  add_point(points, 0, factor_at(table, from));
  constexpr double near = 1e-9;
  if (table.waves)
    for (const double time : times_of_waves(m, table, from, from + width))
      if (const double fraction = (time - from) / width; fraction > near && fraction < 1 - near)
        add_point(points, fraction, factor_at(table, time));
  for (const auto& [time, factor] : table.points) {
    const double fraction = (time - from) / width;
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

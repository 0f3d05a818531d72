#include "osculate/api/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "osculate/api/compare_frd.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/text.hpp"
#include "osculate/io/csv.hpp"
#include "osculate/io/read_vtk.hpp"

namespace osculate::api {
namespace {

/// Times are compared to the digits that increments of different lengths add up to.
bool same_time(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

// ---- histories ----------------------------------------------------------------------------------

struct History {
  explicit History(const std::string& folder)
      : table(io::read_csv((std::filesystem::path(folder) / "history.csv").string())) {
    for (const char* const column : {"step", "increment", "time"})
      if (table.find(column) < 0)
        throw core::InputError({table.file, 1, ""}, fmt::format("it has no column {}", column));
    time = table.numbers(table.find("time"));
  }
  [[nodiscard]] const std::string& step(std::size_t row) const {
    return table.rows[row][static_cast<std::size_t>(table.find("step"))];
  }
  io::CsvTable table;
  std::vector<double> time;
};

using Pairs = std::vector<std::array<std::size_t, 2>>;

/// Rows of the same step and time, in their order; times grow.
Pairs common_rows(const History& a, const History& b) {
  Pairs pairs;
  std::size_t i = 0, j = 0;
  while (i < a.time.size() && j < b.time.size()) {
    const bool same = same_time(a.time[i], b.time[j]);
    if (same && a.step(i) == b.step(j)) pairs.push_back({i++, j++});
    // The state at the end of a step may be another one's first.
    else if (same ? i + 1 < a.time.size() && same_time(a.time[i + 1], b.time[j])
                  : a.time[i] < b.time[j])
      ++i;
    else
      ++j;
  }
  return pairs;
}

void compare_histories(const History& a, const History& b, const Pairs& pairs, Comparison& out) {
  for (const std::string& column : a.table.columns) {
    if (column == "step" || column == "increment" || column == "time") continue;
    const int other = b.table.find(column);
    if (other < 0) continue;
    const std::vector<double> x = a.table.numbers(a.table.find(column)), y = b.table.numbers(other);
    QuantityDifference d{column};
    for (const auto& [i, j] : pairs) d.take_in(x[i], y[j], a.time[i]);
    out.quantities.push_back(std::move(d));
  }
}

/// Increments between those that both have are one's smaller steps; behind them the other has
/// ended.
void note_increments(const History& mine, std::size_t common, std::size_t last,
                     const std::string& folder, Comparison& out) {
  if (mine.time.size() > common)
    out.notes.push_back(
        fmt::format("only {} has {} further increments", folder, mine.time.size() - common));
  if (last + 1 == mine.time.size()) return;
  out.notes.push_back(fmt::format("only {} goes on after time {:.9g}", folder, mine.time[last]));
  out.lacks = true;
}

// ---- fields -------------------------------------------------------------------------------------

using Sets = std::vector<io::PvdDataSet>;

Sets data_sets(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(folder) / "results.pvd";
  return std::filesystem::exists(path) ? io::read_pvd(path.string()) : Sets{};
}

/// "bodies", "PAIR" ... of a run, each once.
std::vector<std::string> names_of(const Sets& sets) {
  std::vector<std::string> names;
  for (const io::PvdDataSet& set : sets)
    if (std::find(names.begin(), names.end(), set.name) == names.end()) names.push_back(set.name);
  return names;
}

std::vector<std::string> names_of(const std::string& set, const std::vector<io::Field>& fields) {
  std::vector<std::string> names;
  for (const io::Field& field : fields) names.push_back(set + " " + field.name);
  return names;
}

/// Fields of one data set at one time in both. Numbers of nodes and cells are compared, too: with
/// others the fields are of other places.
void compare_fields(const std::string& name, double time, const std::vector<io::Field>& a,
                    const std::vector<io::Field>& b,
                    std::map<std::string, QuantityDifference>& found, Comparison& out) {
  for (const io::Field& x : a) {
    const auto y = std::find_if(b.begin(), b.end(), [&](const io::Field& f) {  //
      return f.name == x.name;
    });
    if (y == b.end()) continue;
    const std::string quantity = name + " " + x.name;
    QuantityDifference& d = found.try_emplace(quantity, QuantityDifference{quantity}).first->second;
    if (x.values.size() == y->values.size()) {
      for (std::size_t k = 0; k < x.values.size(); ++k) d.take_in(x.values[k], y->values[k], time);
      continue;
    }
    if (std::isinf(d.largest)) continue;
    out.notes.push_back(
        fmt::format("{}: {} values and {}", quantity, x.values.size(), y->values.size()));
    d.largest = std::numeric_limits<double>::infinity();
    d.time = time;
  }
}

void compare_data_sets(const std::string& a, const std::string& b, Comparison& out) {
  const Sets mine = data_sets(a), theirs = data_sets(b);
  out.note_alone(names_of(mine), names_of(theirs), "results", a);
  out.note_alone(names_of(theirs), names_of(mine), "results", b);
  std::set<std::string> seen;  // data sets whose names of fields have been looked at
  std::map<std::string, QuantityDifference> found;
  std::vector<bool> taken(theirs.size(), false);
  for (const io::PvdDataSet& set : mine)
    for (std::size_t j = 0; j < theirs.size(); ++j) {
      if (taken[j] || theirs[j].name != set.name || !same_time(theirs[j].time, set.time)) continue;
      taken[j] = true;
      const auto fields = [](const std::string& folder, const std::string& file) {
        return io::read_vtu_fields((std::filesystem::path(folder) / file).string());
      };
      const std::vector<io::Field> x = fields(a, set.file), y = fields(b, theirs[j].file);
      compare_fields(set.name, set.time, x, y, found, out);
      if (seen.insert(set.name).second) {
        out.note_alone(names_of(set.name, x), names_of(set.name, y), "fields", a);
        out.note_alone(names_of(set.name, y), names_of(set.name, x), "fields", b);
      }
      break;
    }
  for (auto& [name, difference] : found) out.quantities.push_back(std::move(difference));
}

}  // namespace

void QuantityDifference::take_in(double a, double b, double at_time) {
  for (const double value : {a, b})
    if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  if (a == b || (std::isnan(a) && std::isnan(b))) return;
  double apart = std::abs(a - b);
  if (std::isnan(apart)) apart = std::numeric_limits<double>::infinity();
  if (apart <= largest) return;
  largest = apart;
  time = at_time;
}

void Comparison::note_alone(const std::vector<std::string>& mine,
                            const std::vector<std::string>& theirs, const std::string& what,
                            const std::string& folder) {
  std::vector<std::string> alone;
  for (const std::string& name : mine)
    if (std::find(theirs.begin(), theirs.end(), name) == theirs.end()) alone.push_back(name);
  if (alone.empty()) return;
  notes.push_back(fmt::format("only {} has the {} {}", folder, what, core::join(alone)));
  lacks = true;
}

double QuantityDifference::relative() const { return largest > 0 ? largest / scale : 0; }

double Comparison::largest_relative() const {
  double largest = 0;
  for (const QuantityDifference& d : quantities) largest = std::max(largest, d.relative());
  return largest;
}

std::string Comparison::text() const {
  std::string out =
      fmt::format("{} increments in both\n{:<32} {:>12} {:>12} {:>12}  {}\n", increments,
                  "quantity", "difference", "largest", "relative", "at time");
  for (const QuantityDifference& d : quantities) {
    out += fmt::format("{:<32} {:>12.3g} {:>12.6g} {:>12.3g}", d.quantity, d.largest, d.scale,
                       d.relative());
    out += d.largest > 0 ? fmt::format("  {:.9g}\n", d.time) : "\n";
  }
  for (const std::string& note : notes) out += note + "\n";
  return out;
}

Comparison compare(const std::string& a, const std::string& b) {
  if (a.ends_with(".frd") || b.ends_with(".frd")) {
    for (const std::string& path : {a, b})
      if (frd_of(path).empty())
        throw core::InputError(
            {}, fmt::format("'{}' has not one .frd file: `output: {{frd: ...}}` writes it, and "
                            "`osculate ccx`",
                            path));
    return compare_frd(frd_of(a), frd_of(b));
  }
  const History x(a), y(b);
  const Pairs pairs = common_rows(x, y);
  if (pairs.empty())
    throw core::InputError({}, fmt::format("'{}' and '{}' have no increment in common", a, b));
  Comparison out;
  out.increments = static_cast<int>(pairs.size());
  compare_histories(x, y, pairs, out);
  compare_data_sets(a, b, out);
  out.note_alone(x.table.columns, y.table.columns, "columns", a);
  out.note_alone(y.table.columns, x.table.columns, "columns", b);
  note_increments(x, pairs.size(), pairs.back()[0], a, out);
  note_increments(y, pairs.size(), pairs.back()[1], b, out);
  return out;
}

}  // namespace osculate::api

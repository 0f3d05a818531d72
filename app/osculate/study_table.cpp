#include "study_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "osculate/core/error.hpp"
#include "osculate/core/text.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/io/csv.hpp"
#include "osculate/io/plot.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::app {
namespace {

double last(const std::vector<double>& values) { return values.back(); }
double smallest(const std::vector<double>& values) { return std::ranges::min(values); }
double largest(const std::vector<double>& values) { return std::ranges::max(values); }

using Pick = double (*)(const std::vector<double>&);

StudyOutput output_of(const std::string& name) {
  for (const auto& [prefix, of] :
       {std::pair<std::string_view, Pick>("last:", last), {"min:", smallest}, {"max:", largest}})
    if (name.starts_with(prefix)) return {name, name.substr(prefix.size()), of};
  return {name, name, last};
}

std::vector<std::string> headings(const StudyTable& table) {
  std::vector<std::string> names;
  for (const Range& range : table.ranges) names.push_back(range.name);
  names.insert(names.end(), {"status", "iterations"});
  for (const StudyOutput& output : table.outputs) names.push_back(output.name);
  names.emplace_back("folder");
  return names;
}

std::string table_text(const StudyTable& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    return fmt::format("{}\n", fmt::join(cells, ","));
  };
  std::vector<std::string> cells;
  for (const std::string& name : headings(table)) cells.push_back(io::csv_text(name));
  std::string text = line(cells);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const StudyRow& row = table.rows[i];
    if (row.status.empty()) continue;
    cells.clear();
    for (const deck::Setting& setting : table.points[i])
      cells.push_back(io::csv_text(setting.value));
    cells.insert(cells.end(), {io::csv_text(row.status), fmt::format("{}", row.iterations)});
    for (const double value : row.outputs) cells.push_back(io::csv_number(value));
    cells.push_back(io::csv_text(name_of(table.points[i])));
    text += line(cells);
  }
  return text;
}

/// The parameters that make a curve, `side=0.2, sampling=mortar`; the output where there are none.
std::string curve_label(const StudyTable& table, std::size_t point, std::size_t along,
                        bool together, const std::string& output) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < table.ranges.size() && !together; ++k)
    if (k != along && table.ranges[k].values.size() > 1)
      words.push_back(table.points[point][k].name + "=" + table.points[point][k].value);
  return words.empty() ? output : core::join(words);
}

io::LinePlot plot_of(const StudyTable& table, std::size_t along, std::size_t output) {
  const Range& range = table.ranges[along];
  const bool together = table.points.size() == range.values.size();
  const std::string& name = table.outputs[output].name;
  io::LinePlot plot{table.title, {range.name, range.logarithmic, {}}, {name, false, {}}, {}, {}};
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.rows[i].status != "done") continue;
    const std::string label = curve_label(table, i, along, together, name);
    auto curve = std::ranges::find(plot.curves, label, &io::PlotCurve::label);
    if (curve == plot.curves.end())
      curve = plot.curves.insert(curve, {label, {}, {}, io::PlotStyle::line_and_marks});
    const auto at = std::ranges::find(range.values, table.points[i][along].value);
    curve->x.push_back(range.numbers[static_cast<std::size_t>(at - range.values.begin())]);
    curve->y.push_back(table.rows[i].outputs[output]);
  }
  return plot;
}

}  // namespace

std::vector<StudyOutput> outputs_of(const std::vector<std::string>& asked,
                                    const std::vector<std::string>& columns) {
  std::vector<StudyOutput> outputs;
  for (const std::string& name : asked.empty() ? columns : asked) {
    outputs.push_back(output_of(name));
    const std::string& column = outputs.back().column;
    if (!std::ranges::count(columns, column))
      throw core::InputError(
          {}, columns.empty() ? fmt::format("--column {}: the model asks for no history", name)
                              : "--column: " + core::unknown_name_message("column of the history",
                                                                          column, columns));
    if (std::ranges::count(asked, name) > 1)
      throw core::InputError({}, fmt::format("--column: '{}' is given twice", name));
  }
  return outputs;
}

StudyRow row_of(const std::string& folder, const std::string& fault,
                std::span<const StudyOutput> outputs) {
  StudyRow row;
  row.outputs.assign(outputs.size(), std::numeric_limits<double>::quiet_NaN());
  row.status = "failed: " + (fault.empty() ? "it has left no results" : fault);
  const std::string file = folder + "/summary.json";
  if (!fault.empty() || !std::filesystem::exists(file)) return row;
  const nlohmann::json summary = nlohmann::json::parse(result::read_text(file), nullptr, false);
  if (!summary.is_object() || !summary.contains("total")) return row;
  row.status = summary.value("status", row.status);
  row.iterations = summary["total"].value("iterations", 0);
  row.seconds = summary.value("/seconds/total"_json_pointer, 0.0);
  if (row.status != "done") return row;
  const io::CsvTable history = io::read_csv(folder + "/history.csv");
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (const int column = history.find(outputs[k].column); column >= 0 && !history.rows.empty())
      row.outputs[k] = outputs[k].of(history.numbers(column));
  return row;
}

void check_headings(const StudyTable& table) {
  std::vector<std::string> names = headings(table);
  std::ranges::sort(names);
  if (const auto twice = std::ranges::adjacent_find(names); twice != names.end())
    throw core::InputError(
        {},
        fmt::format("the table would have two columns '{}': call the parameter otherwise", *twice));
}

void write_table(const StudyTable& table, const std::string& folder) {
  io::write_file(folder + "/table.csv", table_text(table));
  const auto along = std::ranges::find_if(
      table.ranges, [](const Range& range) { return range.numbers.size() > 1; });
  if (along == table.ranges.end()) return;
  for (std::size_t k = 0; k < table.outputs.size(); ++k)
    io::write_file(
        folder + "/" + file_name(table.outputs[k].name) + ".svg",
        io::plot_svg(plot_of(table, static_cast<std::size_t>(along - table.ranges.begin()), k)));
}

}  // namespace osculate::app

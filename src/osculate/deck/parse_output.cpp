#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "osculate/core/text.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

bool needs_rigid(Quantity q) {
  return (q >= Quantity::rx && q <= Quantity::rz) || (q >= Quantity::rmx && q <= Quantity::rmz) ||
         (q >= Quantity::wx && q <= Quantity::wz);
}

void require_quantity(const HistoryRequest& request, const std::string& word,
                      const Description& d) {
  if (is_spatial(request.of.value) && dimension(d) == 2) throw only_in_space(request.of.mark, word);
  const bool contact = request.target == HistoryTarget::contact;
  if (contact && !is_contact_quantity(request.of.value))
    throw core::InputError(request.of.mark,
                           fmt::format("'{}' belongs to sets and rigid bodies, but '{}' is a "
                                       "contact pair",
                                       word, request.on.value));
  if (!contact && is_contact_quantity(request.of.value)) {
    std::vector<std::string> pairs;
    for (const Contact& c : d.contact) pairs.push_back(c.name.value);
    throw core::InputError(
        request.of.mark,
        fmt::format("'{}' belongs to contact pairs: {}", word,
                    core::unknown_name_message("pair", printable(request.on.value), pairs)));
  }
  if (request.target == HistoryTarget::set && needs_rigid(request.of.value))
    throw core::InputError(
        request.of.mark,
        fmt::format("'{}' needs a rigid body, and {} is not one", word, quoted(request.on.value)));
}

HistoryRequest request_of(const Value& v, const Description& d) {
  HistoryRequest request;
  request.mark = v.mark;
  request.on = name_of(v.at("on"));
  request.of = word_of<Quantity>(v, "of");
  const std::string& on = request.on.value;
  request.target = d.find_contact(on) ? HistoryTarget::contact
                   : d.find_rigid(on) ? HistoryTarget::rigid
                                      : HistoryTarget::set;
  const std::string& word = v.at("of").text;
  const Value* const name = v.find("name");
  request.column = name ? name->text : on + "." + word;
  if (!name && on.find_first_of(",\"\r\n") != std::string::npos)
    throw core::InputError(request.on.mark, quoted(on) + " cannot head a column; give a `name`");
  require_quantity(request, word, d);
  return request;
}

void require_unique_columns(const std::vector<HistoryRequest>& requests,
                            const std::vector<std::string>& always) {
  std::map<std::string, int> lines;
  for (const HistoryRequest& request : requests) {
    const std::string& column = request.column;
    if (std::find(always.begin(), always.end(), column) != always.end())
      throw core::InputError(
          request.mark, fmt::format("column '{}' is always there; choose another name", column));
    const auto [at, fresh] = lines.emplace(column, request.mark.line);
    if (!fresh)
      throw core::InputError(request.mark, fmt::format("column {} is given twice, first on line {}",
                                                       quoted(column), at->second));
  }
}

Name column_of(const Value& v, const std::vector<std::string>& columns) {
  if (std::find(columns.begin(), columns.end(), v.text) == columns.end())
    throw core::InputError(v.mark,
                           core::unknown_name_message("column", printable(v.text), columns));
  return name_of(v);
}

Plot plot_of(const Value& v, const std::vector<std::string>& columns) {
  Plot plot;
  if (const Value* const title = v.find("title")) plot.title = title->text;
  plot.x = column_of(v.at("x"), columns);
  const Value& y = v.at("y");
  if (y.alternative == 0) plot.y.push_back(column_of(y, columns));
  for (const Value& item : y.items) plot.y.push_back(column_of(item, columns));
  return plot;
}

}  // namespace

std::vector<std::string> energy_columns(const Description& description) {
  const auto has_inertia = [](const Step& step) { return step.dynamics.has_value(); };
  const std::vector<Step>& steps = description.steps;
  if (std::none_of(steps.begin(), steps.end(), has_inertia)) return {};
  std::vector<std::string> columns{std::string(model::fraction_quantity)};
  for (const std::string_view name : model::energy_quantities)
    columns.push_back(name == "elapsed" ? std::string(name) : fmt::format("energy.{}", name));
  if (std::any_of(steps.begin(), steps.end(),
                  [](const Step& step) { return step.dynamics && step.dynamics->time_steps; }))
    columns.emplace_back(model::time_step_quantity);
  return columns;
}

Output parse_output(const Value& v, const Description& description) {
  Output output;
  const Value& fields = v.at("fields");
  if (fields.alternative == 0)
    output.every = fields.code;
  else
    output.fields = word_of<FieldTimes>(fields).value;
  for (const Value& item : v.at("history").items)
    output.history.push_back(request_of(item, description));
  std::vector<std::string> columns{"step", "increment", "time"};
  for (std::string& column : energy_columns(description)) columns.push_back(std::move(column));
  require_unique_columns(output.history, columns);
  for (const HistoryRequest& request : output.history) columns.push_back(request.column);
  for (const Value& item : v.at("plots").items) output.plots.push_back(plot_of(item, columns));
  output.report = flag(v, "report");
  output.compress = flag(v, "compress");
  output.contact_points = flag(v, "contact_points");
  const Value& checkpoint = v.at("checkpoint");
  output.checkpoint = checkpoint.alternative == 0 ? checkpoint.code : 0;
  return output;
}

}  // namespace osculate::deck

#include "data_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "osculate/core/text.hpp"

namespace osculate::verification {
namespace {

using deck::SourceNode;
using deck::Spec;
using deck::Value;
using enum deck::Group::Rule;

// ---- keys ---------------------------------------------------------------------------------------

enum class At { all, end, first, largest, max, min, median, sum };

/// Keys of a value; those that another one may stand under as often as `depth` says.
std::vector<deck::Key> value_keys(int depth) {
  const Spec constant = deck::number("A number.");
  const Spec point = deck::list("A point.", constant).count(2, 2);
  std::vector<Spec> factor{constant},
      term{constant, deck::list("A line through [time, value].", point).count(2)};
  std::vector<deck::Key> condition{deck::optional("above", constant),
                                   deck::optional("below", constant)};
  if (depth > 0) {
    const std::vector<deck::Key> keys = value_keys(depth - 1);
    const Spec other = deck::map("A value.", keys).with(exactly_one, {"of", "uniform"});
    factor.push_back(other);
    term.push_back(other);
    condition.insert(condition.end(), keys.begin(), keys.end());
  }
  const Spec word = deck::choice(
      "Which one.",
      {deck::word("end", At::end, "the last"), deck::word("first", At::first, "the first"),
       deck::word("largest", At::largest, "the largest absolute value"),
       deck::word("max", At::max, "the largest"), deck::word("min", At::min, "the smallest"),
       deck::word("median", At::median, "the middle one"), deck::word("sum", At::sum, "all")});
  return {deck::optional("run", deck::text("Another run of the case.")),
          deck::optional("of", deck::text("A column.")),
          deck::optional("uniform", deck::names("Of stresses and `pressure`.", constant)),
          deck::optional("at", deck::either("A time or a word.", {constant, word})),
          deck::optional("after", deck::number("A time.")),
          deck::optional("step", deck::text("A step.")),
          deck::optional("where", deck::map("Condition.", condition)),
          deck::optional("scale", deck::number("A factor.")),
          deck::optional("over", deck::either("A divisor.", factor)),
          deck::optional("less", deck::either("What is subtracted.", term))};
}

Spec case_spec() {
  std::vector<deck::Key> keys = value_keys(2);
  const Spec reference = deck::either(
      "The reference.", {deck::number("A number."), deck::map("A value.", value_keys(1))});
  const std::vector<std::string> relations{"is", "at_most", "at_least", "info"};
  for (const std::string& relation : relations) keys.push_back(deck::optional(relation, reference));
  keys.push_back(deck::required("quantity", deck::text("What the row says.")));
  keys.push_back(
      deck::optional("within", deck::number("Deviation allowed.").at_least(0).otherwise("0")));
  keys.push_back(deck::optional("source", deck::text("Of the reference.").as(deck::TextRule::any)));
  const Spec row = deck::map("A row of the table.", keys)
                       .with(exactly_one, {"of", "uniform"})
                       .with(exactly_one, relations);
  const Spec run =
      deck::map("A run.", {deck::optional("name", deck::text("What other rows call it.")),
                           deck::optional("model", deck::text("File of the model.")),
                           deck::optional("set", deck::text("Taken away before.")),
                           deck::optional("each", deck::text("Likewise.")),
                           deck::optional("rows", deck::list("Rows.", row).otherwise("[]"))});
  return deck::map("A case.", {deck::optional("requirement", deck::text("One sentence.")),
                               deck::optional("long", deck::boolean("Only with --long.")),
                               deck::optional("source", deck::text("Of rows that name none.")),
                               deck::required("runs", deck::list("Runs.", run).count(1))});
}

// ---- reading ------------------------------------------------------------------------------------

/// A case.yaml with one run for each combination of `each`, and what each changes in its model.
struct DataCase {
  Value value;
  std::vector<SourceNode> changes;
};

using Words = std::vector<std::pair<std::string, std::string>>;

std::string replaced(std::string text, const Words& words) {
  for (const auto& [name, word] : words)
    for (std::size_t at = 0; (at = text.find("{" + name + "}", at)) != std::string::npos;
         at += word.size())
      text.replace(at, name.size() + 2, word);
  return text;
}

/// The node with {NAME} replaced by its word everywhere; `whole`: a word may stand for a map or a
/// list.
SourceNode replaced(SourceNode node, const Words& words, bool whole) {
  const std::string text = replaced(node.text, words);
  if (text != node.text) {
    if (whole && text.find_first_of("{[") == 0) return deck::read_yaml(text, "case.yaml");
    node.quoted = false;
    node.text = text;
  }
  for (SourceNode& item : node.items) item = replaced(std::move(item), words, whole);
  for (deck::SourceEntry& entry : node.entries) {
    entry.key = replaced(std::move(entry.key), words);
    entry.value = replaced(std::move(entry.value), words, whole);
  }
  return node;
}

/// The value of a key, which is taken away.
SourceNode taken(SourceNode& map, std::string_view key) {
  SourceNode out;
  std::erase_if(map.entries, [&](deck::SourceEntry& entry) {
    if (entry.key == key) out = std::move(entry.value);
    return out.kind != SourceNode::Kind::nothing && entry.key == key;
  });
  return out;
}

/// Every combination of one item from each list.
std::vector<Words> combinations(const SourceNode& each, const std::string& file) {
  std::vector<Words> all{{}};
  if (each.kind == SourceNode::Kind::nothing) return all;
  const Spec spec =
      deck::list("", deck::list("", deck::names("", deck::text("").as(deck::TextRule::any))));
  for (const Value& choices : deck::check(spec, each, file, "each").items) {
    std::vector<Words> longer;
    for (const Words& words : all)
      for (const Value& choice : choices.items) {
        longer.push_back(words);
        for (const deck::ValueEntry& e : choice.entries)
          longer.back().emplace_back(e.key, e.value.text);
      }
    all = std::move(longer);
  }
  return all;
}

DataCase read_case(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  SourceNode root = deck::read_yaml(text, file);
  DataCase out;
  for (deck::SourceEntry& entry : root.entries) {
    if (entry.key != "runs") continue;
    std::vector<SourceNode> runs;
    for (SourceNode& run : entry.value.items) {
      const SourceNode each = taken(run, "each"), set = taken(run, "set");
      for (const Words& words : combinations(each, file)) {
        runs.push_back(replaced(run, words, false));
        out.changes.push_back(replaced(set, words, true));
      }
    }
    entry.value.items = std::move(runs);
  }
  out.value = deck::check(case_spec(), root, file);
  return out;
}

// ---- values -------------------------------------------------------------------------------------

std::string text_of(const Value& map, std::string_view key) {
  const Value* const value = map.find(key);
  return value ? value->text : "";
}

std::string column_of(const Value& value) {
  if (const Value* const of = value.find("of")) return of->text;
  std::string name = "uniform";
  for (const deck::ValueEntry& e : value.at("uniform").entries)
    name += fmt::format(" {} {}", e.key, e.value.number);
  return name;
}

struct Runs {
  const std::map<std::string, DataRun>& named;
  const DataRun* own = nullptr;  ///< where a value names none
};

const DataRun& run_of(const Value& value, const Runs& runs) {
  const std::string name = text_of(value, "run");
  if (name.empty() && runs.own) return *runs.own;
  const auto found = runs.named.find(name);
  if (found != runs.named.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [other, run] : runs.named) known.push_back(other);
  throw core::InputError(value.mark, core::unknown_name_message("run", name, known));
}

double number_of(const Value& value, const Runs& runs);
std::vector<double> series_of(const Value& value, const Runs& runs);

/// Of a line through points [time, value].
double on_line(const std::vector<Value>& points, double time) {
  std::size_t i = 1;
  while (i + 1 < points.size() && time > points[i].items.at(0).number) ++i;
  const double t0 = points.at(i - 1).items.at(0).number, t1 = points.at(i).items.at(0).number;
  const double v0 = points[i - 1].items.at(1).number, v1 = points[i].items.at(1).number;
  return v0 + (time - t0) / (t1 - t0) * (v1 - v0);
}

/// What stands under `over` or `less`, for each of the increments.
std::vector<double> operand(const Value& value, const DataRun& run, const Runs& runs) {
  if (!value.entries.empty() && !value.find("at")) return series_of(value, runs);
  std::vector<double> out;
  const bool line = !value.items.empty();
  const double one = line ? 0 : value.entries.empty() ? value.number : number_of(value, runs);
  for (const double time : run.time) out.push_back(line ? on_line(value.items, time) : one);
  return out;
}

/// At every increment: of / over x scale - less.
std::vector<double> series_of(const Value& value, const Runs& runs) {
  const DataRun& run = run_of(value, runs);
  const auto column = run.columns.find(column_of(value));
  if (column == run.columns.end()) {
    std::vector<std::string> known;
    for (const auto& [name, values] : run.columns) known.push_back(name);
    throw core::InputError(value.at("of").mark,
                           core::unknown_name_message("column", column_of(value), known));
  }
  std::vector<double> out = column->second;
  const auto combine = [&](const char* key, const auto& result) {
    const Value* const other = value.find(key);
    if (!other) return;
    const std::vector<double> by = operand(*other, run, {runs.named, &run});
    if (by.size() != out.size())
      throw core::InputError(other->mark, "another run needs `at`: its increments are others");
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = result(out[i], by[i]);
  };
  combine("over", std::divides<>());
  if (const Value* const scale = value.find("scale"))
    for (double& v : out) v *= scale->number;
  combine("less", std::minus<>());
  return out;
}

double at_time(const std::vector<double>& times, const std::vector<double>& values, double time) {
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    if (times[i] <= time && time <= times[i + 1])
      return std::lerp(values[i], values[i + 1], (time - times[i]) / (times[i + 1] - times[i]));
  return std::numeric_limits<double>::quiet_NaN();
}

double reduced(std::vector<double> values, At at) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0, largest = 0;
  for (const double v : values) {
    sum += v;
    largest = std::max(largest, std::abs(v));
  }
  if (at == At::sum) return sum;
  if (at == At::largest) return largest;
  if (at == At::first) return values.front();
  if (at == At::max) return *std::max_element(values.begin(), values.end());
  if (at == At::min) return *std::min_element(values.begin(), values.end());
  if (at == At::median) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }
  return values.back();
}

double number_of(const Value& value, const Runs& runs) {
  const DataRun& run = run_of(value, runs);
  const std::vector<double> values = series_of(value, runs);
  const Value *const at = value.find("at"), *const after = value.find("after");
  const Value* const where = value.find("where");
  const std::string step = text_of(value, "step");
  const std::vector<double> held = where ? series_of(*where, {runs.named, &run}) : values;
  std::vector<double> times, left;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (after && !(run.time[i] > after->number)) continue;
    if (!step.empty() && run.step[i] != step) continue;
    if (where && where->find("above") && !(held[i] > where->at("above").number)) continue;
    if (where && where->find("below") && !(held[i] < where->at("below").number)) continue;
    times.push_back(run.time[i]);
    left.push_back(values[i]);
  }
  if (left.empty() && run.finished)
    throw core::InputError(value.mark, "no increment of the run is meant by this");
  if (at && at->alternative == 0) return at_time(times, left, at->number);
  return reduced(left, at ? static_cast<At>(at->code) : At::end);
}

// ---- runs and rows ------------------------------------------------------------------------------

/// What the values below this one ask of the run of that name; `own`: where none is named.
void collect(const Value& value, const std::string& name, bool own,
             std::vector<DataColumn>& columns) {
  const bool asks = value.find("of") || value.find("uniform");
  const std::string of = text_of(value, "run");
  if (asks && (of.empty() ? own : of == name)) {
    const std::string column = column_of(value);
    if (std::none_of(columns.begin(), columns.end(),
                     [&](const DataColumn& c) { return c.name == column; }))
      columns.push_back({column, &value});
  }
  const bool inside = asks && !of.empty() ? of == name : own;
  for (const deck::ValueEntry& entry : value.entries) collect(entry.value, name, inside, columns);
  for (const Value& item : value.items) collect(item, name, own, columns);
}

Row row_of(const Value& row, const Runs& runs, const std::string& source) {
  const DataRun& run = run_of(row, runs);
  Row out{row.at("quantity").text, number_of(row, runs), 0, Relation::info, 0, source};
  if (const Value* const own = row.find("source")) out.source = own->text;
  for (const auto& [key, relation] : {std::pair{"is", Relation::equal},
                                      {"at_most", Relation::at_most},
                                      {"at_least", Relation::at_least},
                                      {"info", Relation::info}})
    if (const Value* const reference = row.find(key)) {
      out.relation = relation;
      if (relation == Relation::equal) out.tolerance = row.at("within").number;
      out.reference = reference->entries.empty() ? reference->number
                                                 : number_of(*reference, {runs.named, &run});
    }
  const std::string column = column_of(row);
  const bool of_the_end = column == "finished" || column.starts_with("free_");
  if (out.relation != Relation::info && !run.finished && !of_the_end)
    out.computed = std::numeric_limits<double>::quiet_NaN();
  return out;
}

CaseResult run_case(const CaseContext& context) {
  const DataCase data = read_case(context.folder + "/case.yaml");
  const std::vector<Value>& list = data.value.at("runs").items;
  std::vector<DataRun> own(list.size());
  std::map<std::string, DataRun> named;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string model = text_of(list[i], "model"), name = text_of(list[i], "name");
    if (model.empty()) continue;
    std::vector<DataColumn> columns;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (k == i || !name.empty()) collect(list[k].at("rows"), name, k == i, columns);
    own[i] = run_data(context.folder + "/" + model, data.changes[i], columns, context.workers);
    if (!name.empty()) named[name] = own[i];
  }
  CaseResult out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Runs runs{named, list[i].find("model") ? &own[i] : nullptr};
    for (const Value& row : list[i].at("rows").items)
      out.rows.push_back(row_of(row, runs, text_of(data.value, "source")));
  }
  return out;
}

}  // namespace

std::vector<Case> data_cases(const std::string& folder) {
  std::vector<Case> cases;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = (entry.path() / "case.yaml").string();
    if (!std::filesystem::exists(file)) continue;
    Case out{entry.path().filename().string(), "its case.yaml cannot be read", false, run_case};
    try {
      const Value value = read_case(file).value;
      out.requirement = text_of(value, "requirement");
      out.slow = value.find("long") && value.at("long").code != 0;
    } catch (const core::InputError&) {  // said when it runs
    }
    cases.push_back(std::move(out));
  }
  return cases;
}

}  // namespace osculate::verification

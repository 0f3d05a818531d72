#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "data_case.hpp"
#include "osculate/core/text.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/fields.hpp"

namespace osculate::verification {
namespace {

using deck::SourceNode;

/// The node under a path; the last key of it may be new.
SourceNode& node_at(SourceNode& root, const deck::SourceEntry& change) {
  SourceNode* node = &root;
  for (std::size_t begin = 0; begin <= change.key.size();) {
    const std::size_t dot = std::min(change.key.find('.', begin), change.key.size());
    const std::string key = change.key.substr(begin, dot - begin);
    begin = dot + 1;
    if (node->kind == SourceNode::Kind::list) {
      const std::size_t index = key.size() == 1 && key[0] >= '0' && key[0] <= '9'
                                    ? static_cast<std::size_t>(key[0] - '0')
                                    : node->items.size();
      if (index >= node->items.size())
        throw core::InputError({"case.yaml", change.line, change.key},
                               "no item '" + key + "' in the model");
      node = &node->items[index];
      continue;
    }
    const auto found = std::find_if(node->entries.begin(), node->entries.end(),
                                    [&](const deck::SourceEntry& e) { return e.key == key; });
    const bool last = begin > change.key.size();
    if (found == node->entries.end() && !(last && node->kind == SourceNode::Kind::map))
      throw core::InputError({"case.yaml", change.line, change.key},
                             "no key '" + key + "' in the model");
    node = found != node->entries.end()
               ? &found->value
               : &node->entries.emplace_back(deck::SourceEntry{key, change.line, {}}).value;
  }
  return *node;
}

/// The columns NAME.QUANTITY that are asked of the history of the model.
std::vector<const DataColumn*> of_history(const std::vector<DataColumn>& columns) {
  std::vector<const DataColumn*> out;
  for (const DataColumn& column : columns)
    if (!column.asked->find("uniform") && column.name.find('.') != std::string::npos &&
        !column.name.starts_with("energy.") && !column.name.ends_with("_gap") &&
        !column.name.ends_with(model::imaginary_suffix))  // beside the real part
      out.push_back(&column);
  return out;
}

std::string output_text(const std::vector<const DataColumn*>& history) {
  std::string list;
  for (const DataColumn* const column : history) {
    const std::size_t dot = column->name.rfind('.');
    list += fmt::format("{}{{on: {}, of: {}}}", list.empty() ? "" : ", ",
                        column->name.substr(0, dot), column->name.substr(dot + 1));
  }
  return "{history: [" + list + "]}";
}

deck::AnyBuilt build_changed(const std::string& path, const SourceNode& changes,
                             const std::vector<DataColumn>& columns) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw core::InputError({path, 0, ""}, "cannot be read");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  SourceNode root = deck::read_yaml(text, path);
  for (const deck::SourceEntry& change : changes.entries) {
    SourceNode& node = node_at(root, change);
    const int line = node.line;  // of the model: errors name its file
    node = change.value;
    node.line = line;
  }
  const std::vector<const DataColumn*> history = of_history(columns);
  node_at(root, {"output", 0, {}}) = deck::read_yaml(output_text(history), "case.yaml");
  try {
    const deck::Description description = deck::parse_model(root, path);
    return deck::build_any(description, deck::load_mesh(description));
  } catch (const core::InputError& error) {  // of what the case asks: said where it does
    std::size_t k = 0;
    if (std::sscanf(error.mark().key.c_str(), "output.history[%zu]", &k) != 1) throw;
    throw core::InputError(history.at(k)->asked->mark, error.what());
  }
}

/// Order of convergence from the last three residuals above rounding; 0 if there are not three.
double observed_order(const std::vector<solve::IterationRecord>& it) {
  std::size_t last = it.size();
  while (last > 0 && it[last - 1].residual < 1e-13) --last;
  if (last < 3) return 0;
  const double a = it[last - 3].residual, b = it[last - 2].residual, c = it[last - 1].residual;
  return std::log(c / b) / std::log(b / a);
}

/// Largest deviation of the nodal stresses, and of the pressure of contact, from uniform ones.
template <int Dim>
double deviation_from(const deck::Value& uniform, const model::BasicSystem<Dim>& system,
                      const model::BasicModel<Dim>& model, const model::BasicState<Dim>& state) {
  constexpr std::array<std::string_view, 6> tensor{"xx", "yy", "zz", "xy", "yz", "xz"};
  double worst = 0;
  const model::BasicNodalFields<Dim> fields = model::nodal_fields(system, model, state);
  for (const auto& stress : fields.stress)
    for (std::size_t i = 0; i < stress.size(); ++i)
      if (const deck::Value* const exact = uniform.find(tensor[i]))
        worst = std::max(worst, std::abs(stress[i] - exact->number));
  if (const deck::Value* const exact = uniform.find("pressure"))
    for (const auto& pair : system.contact())
      for (const auto& point : pair.points)
        worst = std::max(worst, std::abs(-point.normal_traction - exact->number));
  return worst;
}

template <int Dim>
void add_gaps(const std::string& pair, const pairing::PairEvaluation<Dim>& contact,
              std::map<std::string, std::vector<double>>& columns) {
  double least = 1e300, largest = -1e300;
  for (const pairing::PointResult<Dim>& p : contact.points) {
    least = std::min(least, p.gap);
    largest = std::max(largest, p.gap);
  }
  columns[pair + ".least_gap"].push_back(least);
  columns[pair + ".largest_gap"].push_back(largest);
}

template <int Dim>
DataRun run_built(deck::BasicBuilt<Dim>& built, const std::vector<DataColumn>& columns,
                  const Workers& workers) {
  workers.work_on(built.options);
  DataRun out;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    out.time.push_back(state.rates.empty() ? progress.time : state.rates.energies.elapsed);
    out.step.push_back(record ? built.model.steps[static_cast<std::size_t>(progress.step)].name
                              : "");
    for (const model::HistoryRequest& request : built.history)
      out.columns[request.name].push_back(
          request.imaginary ? 0 : model::history_value(system, built.model, state, request));
    for (const DataColumn& column : columns)
      if (const deck::Value* const uniform = column.asked->find("uniform"))
        out.columns[column.name].push_back(deviation_from(*uniform, system, built.model, state));
    for (std::size_t i = 0; i < built.model.pairs.size(); ++i)
      add_gaps(built.model.pairs[i].name, system.contact()[i], out.columns);
    out.columns["increments"].push_back(record ? 1 : 0);
    out.columns["cutbacks"].push_back(record ? record->cutbacks : 0);
    out.columns["iterations"].push_back(
        record ? static_cast<double>(record->iterations.size()) + record->wasted_iterations : 0);
    out.columns["order"].push_back(record ? observed_order(record->iterations) : 0);
    return true;
  };
  observer.harmonic = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                          const model::Progress& progress, const model::HarmonicPart& part) {
    for (const model::HistoryRequest& request : built.history)
      if (request.imaginary == part.imaginary)
        out.columns[request.name].push_back(
            model::history_value(system, built.model, state, request));
    if (part.imaginary) return true;
    out.time.push_back(progress.time);
    out.step.push_back(built.model.steps[static_cast<std::size_t>(progress.step)].name);
    for (const char* const counted : {"increments", "cutbacks", "iterations", "order"})
      out.columns[counted].push_back(counted == std::string_view("increments") ? 1 : 0);
    return true;
  };
  const model::BasicAnalysisResult<Dim> result = model::run(built.model, built.options, observer);
  out.finished = result.outcome == solve::Outcome::converged;
  const std::size_t at =
      std::min(result.message.find("free to move along ("), result.message.size());
  double free_x = 0, free_y = 0;
  std::sscanf(result.message.c_str() + at, "free to move along (%lf, %lf", &free_x, &free_y);
  out.columns["finished"].assign(out.time.size(), out.finished ? 1 : 0);
  out.columns["free_x"].assign(out.time.size(), free_x);
  out.columns["free_y"].assign(out.time.size(), free_y);
  return out;
}

}  // namespace

DataRun run_data(const std::string& model, const deck::SourceNode& changes,
                 const std::vector<DataColumn>& columns, const Workers& workers) {
  deck::AnyBuilt any = build_changed(model, changes, columns);
  return std::visit([&](auto& built) { return run_built(built, columns, workers); }, any);
}

}  // namespace osculate::verification

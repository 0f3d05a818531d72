// Analyses: osculate.run and osculate.check.
#include "osculate/api/run.hpp"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "convert.hpp"
#include "data_sets.hpp"
#include "osculate/api/compare.hpp"
#include "osculate/api/tangent_check.hpp"
#include "osculate/cell/cell_type.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::python {
namespace {

py::array field_array(io::Field&& field) {
  const auto components = static_cast<py::ssize_t>(field.components);
  const auto size = static_cast<py::ssize_t>(field.values.size());
  if (components == 1) return array_of(std::move(field.values));
  return array_of(std::move(field.values), {size / components, components});
}

py::dict fields_of(std::vector<io::Field>&& fields) {
  py::dict out;
  for (io::Field& field : fields) out[py::str(field.name)] = field_array(std::move(field));
  return out;
}

/// What Python hears of a run while it goes on. The first exception of a callback, and Ctrl-C, end
/// the run with what has converged, and are kept for its caller.
class Listener {
 public:
  Listener(py::object on_increment, py::object say, bool signals)
      : on_increment_(std::move(on_increment)), say_(std::move(say)), signals_(signals) {}

  void attach(api::RunOptions& options) {
    options.interrupted = options.abandoned = [this] { return ended(); };
    if (!on_increment_.is_none())
      options.converged = [this](const api::LiveIncrement& live) { return converged(live); };
    if (!say_.is_none())
      options.say = [this](std::string_view text) {
        if (!guarded([&] { return say_(py::str(text.data(), text.size())), true; })) failed_ = true;
      };
  }

  [[nodiscard]] bool refused() const { return refused_; }
  [[nodiscard]] py::object error() const { return error_ ? error_ : py::none(); }

 private:
  /// With Python's lock; an exception is false.
  template <class Call>
  bool guarded(const Call& call) {
    const py::gil_scoped_acquire lock;
    if (error_) return false;
    try {
      return call();
    } catch (py::error_already_set& error) {
      error_ = error.value();
      if (error.trace()) PyException_SetTraceback(error_.ptr(), error.trace().ptr());
      return false;
    }
  }

  /// Signals reach the main thread alone. Python's lock is asked for every 50 ms at most: another
  /// thread may hold it for milliseconds.
  bool ended() {
    if (failed_) return true;
    const auto now = std::chrono::steady_clock::now();
    if (!signals_ || now < next_look_) return false;
    next_look_ = now + std::chrono::milliseconds(50);
    failed_ = !guarded([] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return true;
    });
    return failed_;
  }

  /// Ends with the increment, also where the callback raises: nobody asks for fields afterwards.
  struct Told {
    const api::LiveIncrement*& live;
    explicit Told(const api::LiveIncrement*& told) : live(told) {}
    Told(const Told&) = delete;
    Told& operator=(const Told&) = delete;
    ~Told() { live = nullptr; }
  };

  static bool truth(const py::object& answer) {
    const int is = PyObject_IsTrue(answer.ptr());
    if (is < 0) throw py::error_already_set();
    return is == 1;
  }

  bool converged(const api::LiveIncrement& live) {
    const bool go_on = guarded([&] {
      py::dict history;
      for (std::size_t i = 0; i < live.columns.size(); ++i)
        history[py::str(live.columns[i])] = live.row[i];
      const model::Progress& p = live.progress;
      auto fields = std::make_shared<const api::LiveIncrement*>(&live);
      const Told told{*fields};
      const py::cpp_function sets([fields] {
        if (*fields == nullptr)
          throw std::runtime_error("fields of an increment can be asked for while it is told only");
        py::list out;
        for (result::DataSet& set : (*fields)->fields()) out.append(data_set(std::move(set)));
        return out;
      });
      const py::object answer =
          on_increment_(live.step, p.increment, p.time, p.fraction, live.iterations, history, sets);
      refused_ = !answer.is_none() && !truth(answer);
      return !refused_;
    });
    if (!go_on) failed_ = true;
    return go_on;
  }

  py::object on_increment_, say_, error_;
  bool signals_, refused_ = false;
  bool failed_ = false;
  std::chrono::steady_clock::time_point next_look_{};
};

std::vector<deck::Setting> settings_of(
    const std::vector<std::pair<std::string, std::string>>& given) {
  std::vector<deck::Setting> settings;
  for (const auto& [name, value] : given) settings.push_back({name, value});
  return settings;
}

std::optional<deck::SourceNode> document_of(const py::object& document, const std::string& model) {
  if (document.is_none()) return std::nullopt;
  return source_of(document, model);
}

py::tuple run(const std::string& model, const py::object& document, const std::string& folder,
              const std::vector<std::pair<std::string, std::string>>& settings,
              const std::string& until, int threads, bool restart, int max_iterations,
              double max_minutes, const py::object& on_increment, const py::object& say,
              bool signals) {
  const std::optional<deck::SourceNode> source = document_of(document, model);
  api::RunOptions options;
  options.model = model;
  options.document = source ? &*source : nullptr;
  options.folder = folder;
  options.settings = settings_of(settings);
  options.until = until;
  options.threads = threads;
  options.restart = restart;
  options.max_iterations = max_iterations;
  options.max_minutes = max_minutes;
  Listener listener(on_increment, say, signals);
  listener.attach(options);
  api::RunOutcome outcome;
  {
    const py::gil_scoped_release unlocked;
    outcome = api::run(options);
  }
  return py::make_tuple(outcome.status == api::RunStatus::done, in_python(outcome.message),
                        outcome.folder, outcome.summary_json, listener.refused(), listener.error());
}

py::tuple check(const std::string& model, const py::object& document,
                const std::vector<std::pair<std::string, std::string>>& settings) {
  const std::optional<deck::SourceNode> source = document_of(document, model);
  api::CheckReport report;
  {
    const py::gil_scoped_release unlocked;
    report = api::check(model, settings_of(settings), source ? &*source : nullptr);
  }
  return py::make_tuple(report.text, report.json);
}

/// JSON of the mesh files that a model names: their contents as they are now.
std::string mesh_contents(const std::string& model, const py::object& document,
                          const std::vector<std::pair<std::string, std::string>>& settings) {
  const std::optional<deck::SourceNode> source = document_of(document, model);
  const std::vector<deck::Setting> values = settings_of(settings);
  const deck::Description description =
      source ? deck::parse_model(*source, model, values) : deck::read_model(model, values);
  return result::json_text(result::mesh_contents(description.mesh));
}

/// Text and JSON of `osculate tangent`, and whether every part of the tangent is right.
py::tuple tangent(const std::string& model, const py::object& document,
                  const std::vector<std::pair<std::string, std::string>>& settings,
                  const std::string& folder, int state, int threads) {
  const std::optional<deck::SourceNode> source = document_of(document, model);
  api::TangentReport report;
  {
    const py::gil_scoped_release unlocked;
    report = api::check_tangent(model, threads, state, result::result_folder(model, folder),
                                settings_of(settings), source ? &*source : nullptr);
  }
  const bool passed =
      std::ranges::all_of(report.rows, [](const api::TangentRow& row) { return row.passed(); });
  return py::make_tuple(api::to_text(report), api::to_json(report), passed);
}

/// What `osculate compare` says: text, whether one lacks something, the largest relative
/// difference, and of each quantity its name, largest difference, scale, relative difference and
/// time.
py::tuple compare(const std::string& a, const std::string& b) {
  api::Comparison found;
  {
    const py::gil_scoped_release unlocked;
    found = api::compare(a, b);
  }
  py::list quantities;
  for (const api::QuantityDifference& q : found.quantities)
    quantities.append(py::make_tuple(q.quantity, q.largest, q.scale, q.relative(), q.time));
  return py::make_tuple(found.text(), found.lacks, found.largest_relative(), quantities);
}

}  // namespace

py::tuple data_set(result::DataSet&& set) {
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  for (const mesh::Block& block : set.cells) {
    const std::span<const std::int8_t> order = cell::vtk_nodes(block.type);
    for (Index c = 0; c < block.size(); ++c) {
      for (const std::int8_t k : order) connectivity.push_back(block.cell(c)[k]);
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      types.push_back(static_cast<std::uint8_t>(cell::info(block.type).vtk_type));
    }
  }
  std::vector<double> points;
  for (const Vec3& x : set.points) points.insert(points.end(), {x.x(), x.y(), x.z()});
  const auto count = static_cast<py::ssize_t>(set.points.size());
  return py::make_tuple(set.part, array_of(std::move(points), {count, 3}),
                        array_of(std::move(connectivity)), array_of(std::move(offsets)),
                        array_of(std::move(types)), fields_of(std::move(set.point_fields)),
                        fields_of(std::move(set.cell_fields)));
}

void add_run(py::module_& m) {
  m.def("run", run);
  m.def("check", check);
  m.def("mesh_contents", mesh_contents);
  m.def("tangent", tangent);
  m.def("compare", compare);
}

}  // namespace osculate::python

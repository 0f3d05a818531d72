#include "osculate/api/project.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <optional>

#include "osculate/core/error.hpp"
#include "osculate/core/pieces.hpp"
#include "osculate/deck/parse_surface.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/io/csv_records.hpp"
#include "osculate/projection/projector.hpp"

namespace osculate::api {
namespace {

using projection::ClosestPoint;
using projection::Feature;
using projection::Mode;
using projection::Status;
using Clock = std::chrono::steady_clock;

constexpr std::string_view header =
    "id,feature,facet,xi1,xi2,x,y,z,distance,unique,margin,status\n";
constexpr std::size_t piece = 64;  ///< rows a thread takes at a time

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// ---- a row ------------------------------------------------------------------------------------

/// Empty where it is NaN: it does not apply.
void append_number(std::string& row, double value) {
  if (!std::isnan(value)) io::append_csv_number(row, value);
  row += ',';
}

template <int Dim>
void append_row(std::string& row, std::int64_t id, const ClosestPoint<Dim>& foot) {
  fmt::format_to(std::back_inserter(row), "{},", id);
  if (foot.feature != Feature::none) row += projection::name(foot.feature);
  row += ',';
  if (foot.facet >= 0) fmt::format_to(std::back_inserter(row), "{}", foot.facet);
  row += ',';
  append_number(row, foot.xi[0]);
  append_number(row, foot.xi[1]);
  for (int k = 0; k < 3; ++k)
    append_number(row, k < Dim ? foot.point[k % Dim] : ClosestPoint<Dim>::none);
  append_number(row, foot.distance);
  const bool judged = !std::isnan(foot.margin);
  row += judged ? (foot.unique ? "1," : "0,") : ",";
  append_number(row, foot.margin);
  row += projection::name(foot.status);
  row += '\n';
}

// ---- where the rows go ------------------------------------------------------------------------

/// A file that takes its place in the end, or standard output.
class Output {
 public:
  explicit Output(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  void write(std::string_view text) {
    if (file_) return file_->write(text);
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail();
  }
  void commit() {
    if (file_) return file_->commit();
    errno = 0;
    if (std::fflush(stdout) != 0) fail();
  }

 private:
  [[noreturn]] static void fail() {
    throw io::WriteError("standard output", "cannot write", errno);
  }
  std::optional<io::AtomicFile> file_;
};

/// The output must not take the place of what it is made from.
void require_other_file(const std::string& output, const std::string& input) {
  std::error_code ignored;
  if (!output.empty() && std::filesystem::equivalent(output, input, ignored))
    throw core::InputError({output, 0, ""},
                           "the output would take the place of its input; choose another name");
}

io::CsvPick picked(const io::CsvRecords& table, int dimension) {
  io::CsvPick pick{table.file(), table.columns(), {}};
  for (const char* const name : {"x", "y", "z"})
    if (pick.wanted.size() < static_cast<std::size_t>(dimension))
      pick.wanted.push_back(table.find(name));
  return pick;
}

// ---- all rows ---------------------------------------------------------------------------------

/// Says how far it is, not more often than a person can read; asked from several threads.
class Progress {
 public:
  explicit Progress(const ProjectOptions& options) : options_(options) {}
  void add(std::size_t points) {
    const std::int64_t sum = points_ += static_cast<std::int64_t>(points);
    if (!options_.progress) return;
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (!lock || seconds_since(last_) < 1) return;
    last_ = Clock::now();
    options_.progress(fmt::format("{} points, {:.0f} per second", sum,
                                  static_cast<double>(sum) / seconds_since(start_)));
  }
  [[nodiscard]] double seconds() const { return seconds_since(start_); }

 private:
  const ProjectOptions& options_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  std::atomic<std::int64_t> points_{0};
  std::mutex mutex_;
};

/// Rows of one piece of a block.
struct Piece {
  std::string rows;
  std::array<std::int64_t, 4> status{}, feature{};
};

template <int Dim>
class Table {
 public:
  Table(const projection::Projector<Dim>& projector, const io::CsvPick& pick,
        const ProjectOptions& options)
      : projector_(projector),
        pick_(pick),
        options_(options),
        mode_(options.fast ? Mode::fast : Mode::certified) {}

  /// Writes the rows of one block; false: interrupted.
  bool project(std::span<const io::CsvRecord> block, Output& output, Progress& progress,
               ProjectOutcome& outcome) {
    pieces_.resize((block.size() + piece - 1) / piece);
    std::atomic<bool> stopped{false};
    core::for_pieces(
        block.size(), piece, options_.threads, [&](std::size_t begin, std::size_t end) {
          if (options_.interrupted && options_.interrupted()) stopped = true;
          if (stopped) return;
          fill(block.subspan(begin, end - begin), outcome.points + static_cast<std::int64_t>(begin),
               pieces_[begin / piece]);
          progress.add(end - begin);
        });
    if (stopped) return false;
    for (const Piece& p : pieces_) {
      output.write(p.rows);
      for (std::size_t i = 0; i < 4; ++i) {
        outcome.status[i] += p.status[i];
        outcome.feature[i] += p.feature[i];
      }
    }
    outcome.points += static_cast<std::int64_t>(block.size());
    return true;
  }

 private:
  void fill(std::span<const io::CsvRecord> records, std::int64_t first, Piece& out) const {
    out.rows.clear();
    out.status = {};
    out.feature = {};
    std::array<double, static_cast<std::size_t>(Dim)> values{};
    for (const io::CsvRecord& record : records) {
      io::read_numbers(pick_, record, values);
      const ClosestPoint<Dim> foot = projector_.closest(Vec<Dim>(values.data()), mode_);
      append_row<Dim>(out.rows, first++, foot);
      ++out.status[static_cast<std::size_t>(foot.status)];
      ++out.feature[static_cast<std::size_t>(foot.feature)];
    }
  }

  const projection::Projector<Dim>& projector_;
  const io::CsvPick& pick_;
  const ProjectOptions& options_;
  Mode mode_;
  std::vector<Piece> pieces_;
};

std::string summary(const ProjectOutcome& o) {
  const auto of = [](const std::array<std::int64_t, 4>& count, auto which) {
    return count[static_cast<std::size_t>(which)];
  };
  return fmt::format(
      "{} points in {:.3g} s ({:.0f} per second): {} face, {} edge, {} corner; {} ambiguous, {} "
      "outside_domain, {} invalid",
      o.points, o.seconds, static_cast<double>(o.points) / std::max(o.seconds, 1e-9),
      of(o.feature, Feature::face), of(o.feature, Feature::edge), of(o.feature, Feature::corner),
      of(o.status, Status::ambiguous), of(o.status, Status::outside_domain),
      of(o.status, Status::invalid));
}

template <int Dim>
projection::Projector<Dim> projector_of(projection::Target<Dim> target, const std::string& name) {
  try {
    return projection::Projector<Dim>(std::move(target));
  } catch (const core::InputError& error) {
    if (!error.mark().file.empty()) throw;
    throw core::InputError({name, 0, ""}, error.what());
  }
}

template <int Dim>
ProjectOutcome project_onto(projection::Target<Dim> target, const ProjectOptions& options) {
  const projection::Projector<Dim> projector =
      projector_of<Dim>(std::move(target), options.surface);
  io::CsvRecords table(options.points);
  const io::CsvPick pick = picked(table, Dim);
  Output output(options.output);
  output.write(header);
  Table<Dim> rows(projector, pick, options);
  Progress progress(options);
  ProjectOutcome outcome;
  for (;;) {
    const std::span<const io::CsvRecord> block = table.next();
    if (block.empty()) break;
    if (!rows.project(block, output, progress, outcome)) {
      outcome.complete = false;
      outcome.message =
          fmt::format("interrupted after {} points{}", outcome.points,
                      options.output.empty() ? std::string{}
                                             : fmt::format("; {} was not written", options.output));
      return outcome;
    }
  }
  output.commit();
  outcome.seconds = progress.seconds();
  outcome.message = summary(outcome);
  return outcome;
}

}  // namespace

ProjectOutcome project(const ProjectOptions& options) {
  deck::SurfaceInput surface = deck::read_surface(options.surface);
  if (options.say)
    for (const std::string& warning : surface.warnings) options.say("warning: " + warning);
  require_other_file(options.output, options.points);
  require_other_file(options.output, options.surface);
  if (surface.dimension() == 2)
    return project_onto<2>(std::move(std::get<projection::Target<2>>(surface.target)), options);
  return project_onto<3>(std::move(std::get<projection::Target<3>>(surface.target)), options);
}

}  // namespace osculate::api

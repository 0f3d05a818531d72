#include "osculate/result/live_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "osculate/core/error.hpp"
#include "osculate/io/csv.hpp"
#include "osculate/result/checkpoint.hpp"
#include "osculate/result/result_folder.hpp"
#include "osculate/result/summary.hpp"

namespace osculate::result {
namespace {

namespace fs = std::filesystem;

/// What a file is known by. Its number alone does not tell it from one that was there before: file
/// systems give it out again at once. Empty: there is none, or a link or the like, which are not
/// followed.
std::string identity_of(const std::string& path, bool with_content) {
  struct statx found {};
  if (::statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, STATX_BASIC_STATS | STATX_BTIME,
              &found) != 0 ||
      !S_ISREG(found.stx_mode))
    return {};
  std::string text =
      fmt::format("{}:{}:{}:{}.{}", found.stx_dev_major, found.stx_dev_minor, found.stx_ino,
                  found.stx_btime.tv_sec, found.stx_btime.tv_nsec);  // zeros: it is not known
  if (with_content)
    text +=
        fmt::format(":{}:{}.{}", found.stx_size, found.stx_mtime.tv_sec, found.stx_mtime.tv_nsec);
  return text;
}

/// A file that is closed again.
struct OpenedToLook {
  int number;
  ~OpenedToLook() {
    if (number >= 0) ::close(number);
  }
};

/// A number as JSON can hold it.
nlohmann::json finite_number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

/// The whole lines of a file from byte `at` on, which is moved behind them.
std::string new_lines(const std::string& path, std::uint64_t& at) {
  std::error_code error;
  if (fs::file_size(path, error) < at && !error) at = 0;
  std::string text = own_text(path, at).value_or("");
  const std::size_t end = text.rfind('\n');
  text.resize(end == std::string::npos ? 0 : end + 1);
  at += text.size();
  return text;
}

/// The last lines of a file.
nlohmann::json last_lines(const std::string& path) {
  constexpr std::size_t most = 8, bytes = 4096;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  nlohmann::json lines = nlohmann::json::array();
  if (error) return lines;
  std::uint64_t from = size > bytes ? size - bytes : 0;
  std::string text = new_lines(path, from);
  if (size > bytes) text.erase(0, text.find('\n') + 1);
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  if (lines.size() > most)
    lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(lines.size() - most));
  return lines;
}

/// The names in the first line of a table.
nlohmann::json columns_of_table(const std::string& path) {
  for (std::uint64_t most = 4096;; most *= 4) {
    const std::string text = own_text(path, 0, most).value_or("");
    if (const std::size_t end = text.find('\n'); end != std::string::npos)
      return io::parse_csv(text.substr(0, end + 1), path).columns;
    if (text.size() < most) return nlohmann::json::array();
  }
}

/// What an entry of a journal can be told from another one by, which may stand at the same place
/// in another file: its sizes and checksum, which it begins with, and its end.
std::string mark_of(const std::string& journal, std::uint64_t from, std::uint64_t to) {
  constexpr std::uint64_t head = 24, tail = 4096;
  return own_text(journal, from, std::min(head, to - from)).value_or("") +
         own_text(journal, std::max(from, to - std::min(tail, to)), std::min(tail, to - from))
             .value_or("");
}

nlohmann::json entry_json(const JournalEntry& entry) {
  const model::Progress& p = entry.progress;
  nlohmann::json row = {p.step + 1, p.increment, finite_number(p.time)};
  for (const double value : entry.row) row.push_back(finite_number(value));
  nlohmann::json json = {{"step", p.step + 1}, {"row", row}, {"frame", !entry.frame.empty()}};
  if (!entry.record) return json;
  json["increment"] = increment_json(static_cast<double>(p.step), *entry.record);
  json["increment"]["curvature_share"] = finite_number(entry.curvature_share);
  const nlohmann::json note = nlohmann::json::parse(entry.note, nullptr, false);
  if (note.is_object()) json["increment"].update(note);
  return json;
}

}  // namespace

std::optional<std::string> own_text(const std::string& path, std::uint64_t from,
                                    std::uint64_t most) {
  const OpenedToLook file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)};
  struct stat found {};
  if (file.number < 0 || ::fstat(file.number, &found) != 0 || !S_ISREG(found.st_mode))
    return std::nullopt;
  const auto size = static_cast<std::uint64_t>(found.st_size);
  std::string text(static_cast<std::size_t>(std::min(most, size - std::min(from, size))), '\0');
  std::size_t read = 0;
  while (read < text.size()) {
    const ssize_t n = ::pread(file.number, text.data() + read, text.size() - read,
                              static_cast<off_t>(from + read));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    read += static_cast<std::size_t>(n);
  }
  text.resize(read);
  return text;
}

struct LiveFolder::Known {
  std::string run;           ///< whose files these are
  std::string owner;         ///< of the lock, the last one seen
  std::string summary_at;    ///< identity of the summary that was read
  nlohmann::json summary{};  ///< its status, message and model
  bool running = false;
  int cuts = 0;  ///< of the journal, by who goes on from a checkpoint
  std::uint64_t journal_at = 0;
  std::string mark;        ///< of the entry that ends there
  std::string unreadable;  ///< why the journal cannot be read
  nlohmann::json entries = nlohmann::json::array();
  std::vector<std::uint64_t> places;  ///< of the entries in the journal
  std::uint64_t iterations_at = 0;
  nlohmann::json iterations = nlohmann::json::array();  ///< of the last increment
};

LiveFolder::LiveFolder(std::string folder)
    : folder_(std::move(folder)), known_(std::make_unique<Known>()) {
  std::error_code error;
  if (!fs::is_directory(folder_, error))
    throw core::InputError({}, fmt::format("there is no folder '{}'", folder_));
  const std::string path = folder_ + "/summary.json";
  const nlohmann::json summary = nlohmann::json::parse(own_text(path).value_or(""), nullptr, false);
  if (summary.is_object() && summary.contains("runs"))
    throw core::InputError({}, fmt::format("folder '{}' holds a study: name the folder of one of "
                                           "its runs",
                                           folder_));
  if (!summary.is_object() || !summary.contains("status") || !summary.contains("model"))
    throw core::InputError({}, fmt::format("folder '{}' holds no run of osculate", folder_));
}

LiveFolder::~LiveFolder() = default;

/// Which run the folder has, and how it stands: a new one begins with other files, or has another
/// owner, or has cut the journal.
void LiveFolder::look_at_run() {
  Known& k = *known_;
  const std::string owner = owner_of_lock(folder_);
  k.running = !owner.empty();
  if (k.running) k.owner = owner;
  const std::string path = folder_ + "/summary.json", journal = folder_ + "/journal.bin";
  if (const std::string at = identity_of(path, true); at != k.summary_at && !at.empty()) {
    const nlohmann::json read = nlohmann::json::parse(own_text(path).value_or(""), nullptr, false);
    if (read.is_object()) {
      for (const char* const key : {"status", "message", "model"})
        k.summary[key] = read.contains(key) && read[key].is_string() ? read[key] : "";
      k.summary_at = at;
    }
  }
  if (!k.places.empty() && mark_of(journal, k.places.back(), k.journal_at) != k.mark) ++k.cuts;
  const std::string run =
      fmt::format("{} {} {} {}", identity_of(folder_ + "/iterations.csv", false),
                  identity_of(journal, false), k.owner, k.cuts);
  if (k.run == run) return;
  k.run = run;
  k.journal_at = k.iterations_at = 0;
  k.entries = k.iterations = nlohmann::json::array();
  k.places.clear();
  k.mark.clear();
  k.unreadable.clear();
}

void LiveFolder::read_journal() {
  Known& k = *known_;
  const std::string journal = folder_ + "/journal.bin";
  if (identity_of(journal, false).empty()) return;
  try {
    for (;;) {
      const std::uint64_t before = k.journal_at;
      const std::optional<JournalEntry> entry = next_journal_entry(folder_, k.journal_at);
      if (!entry) break;
      k.places.push_back(before);
      k.entries.push_back(entry_json(*entry));
    }
  } catch (const core::InputError& error) {
    k.unreadable = error.what();
  }
  if (!k.places.empty()) k.mark = mark_of(journal, k.places.back(), k.journal_at);
}

void LiveFolder::read_iterations() {
  Known& k = *known_;
  const std::string text = new_lines(folder_ + "/iterations.csv", k.iterations_at);
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    if (text.compare(begin, 4, "step") == 0) continue;  // the names of the columns
    nlohmann::json row = nlohmann::json::array();
    const std::string line = text.substr(begin, end - begin) + ",";
    for (std::size_t cell = 0, comma = 0; (comma = line.find(',', cell)) != std::string::npos;
         cell = comma + 1)
      row.push_back(finite_number(std::strtod(line.c_str() + cell, nullptr)));
    if (row.size() < 2) continue;
    if (!k.iterations.empty() &&
        (k.iterations.back()[0] != row[0] || k.iterations.back()[1] != row[1]))
      k.iterations = nlohmann::json::array();
    k.iterations.push_back(std::move(row));
  }
}

nlohmann::json LiveFolder::state(const std::string& run, std::size_t from) {
  look_at_run();
  read_journal();
  read_iterations();
  const Known& k = *known_;
  const std::size_t count = k.entries.size(), begin = run == k.run ? std::min(from, count) : 0;
  const std::string said = k.summary.value("status", "");
  nlohmann::json state = k.summary;
  state["status"] = k.running ? "running" : said == "running" ? "killed" : said;
  if (k.summary.value("message", "").empty()) state["message"] = k.unreadable;
  state["run"] = k.run;
  state["columns"] = columns_of_table(folder_ + "/history.csv");
  state["from"] = begin;
  state["entries"] = nlohmann::json::array();
  for (std::size_t i = begin; i < count; ++i) state["entries"].push_back(k.entries[i]);
  state["iterations"] = k.iterations;
  state["log"] = last_lines(folder_ + "/log.txt");
  return state;
}

std::optional<std::string> LiveFolder::frame(std::size_t entry) {
  look_at_run();
  read_journal();
  const Known& k = *known_;
  if (entry >= k.places.size()) return std::nullopt;
  std::uint64_t at = k.places[entry];
  const std::optional<JournalEntry> found = next_journal_entry(folder_, at);
  if (!found || found->frame.empty()) return std::nullopt;
  return json_text(nlohmann::json::from_cbor(found->frame));
}

}  // namespace osculate::result

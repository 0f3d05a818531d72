#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "commands.hpp"
#include "http_server.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/report.hpp"
#include "osculate/result/live_folder.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::app {
namespace {

/// Of a result folder itself, or of a model file or deck that stands for its results.
std::string folder_of(const std::string& given) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(given, error)) return given;
  std::string folder = result::result_folder(given, "");
  if (std::filesystem::is_directory(folder, error)) return folder;
  throw core::InputError({}, fmt::format("there are no results of '{}' yet: no folder '{}'; name "
                                         "the one it was run with -o into",
                                         given, folder));
}

/// The folder's own name, however it was given: `m.results/` and `.` have one, too.
std::string title_of(const std::string& folder) {
  std::error_code error;
  std::filesystem::path path = std::filesystem::absolute(folder, error).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  return path.filename().string();
}

/// The files that are shown as they are. No other name is looked for: none leads out of the folder.
struct ShownFile {
  const char *name, *type;
};
constexpr ShownFile shown_files[] = {
    {"report.json", "application/json"},        {"summary.json", "application/json"},
    {"history.csv", "text/csv; charset=utf-8"}, {"iterations.csv", "text/csv; charset=utf-8"},
    {"log.txt", "text/plain; charset=utf-8"},
};

/// None: the request has no such parameter, or something else than a number there.
std::optional<std::size_t> number_in(const HttpRequest& request, const std::string& name) {
  const auto found = request.parameters.find(name);
  if (found == request.parameters.end()) return std::nullopt;
  const char *const begin = found->second.data(), *const end = begin + found->second.size();
  std::size_t value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

HttpAnswer answer_of(const std::string& folder, result::LiveFolder& live,
                     const HttpRequest& request) {
  constexpr const char* json = "application/json";
  const HttpAnswer nothing{404, "text/plain", "there is nothing of this name\n"};
  if (request.path == "/")
    return {200, "text/html; charset=utf-8", io::live_html(title_of(folder))};
  if (request.path == "/state.json") {
    const auto run = request.parameters.find("run");
    return {200, json,
            result::json_text(live.state(run == request.parameters.end() ? "" : run->second,
                                         number_in(request, "from").value_or(0)))};
  }
  if (request.path == "/frame.json") {
    const std::optional<std::size_t> entry = number_in(request, "entry");
    std::optional<std::string> frame = entry ? live.frame(*entry) : std::nullopt;
    return frame ? HttpAnswer{200, json, std::move(*frame)} : nothing;
  }
  for (const ShownFile& file : shown_files) {
    if (request.path != std::string("/") + file.name) continue;
    const std::filesystem::path path = std::filesystem::path(folder) / file.name;
    if (std::optional<std::string> text = result::own_text(path.string()))
      return {200, file.type, std::move(*text)};
  }
  return nothing;
}

/// Signals that end the program wait until they are asked for, in its threads, too.
sigset_t held_signals() {
  sigset_t signals{};
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

void view(const std::string& given, int port) {
  const std::string folder = folder_of(given);
  result::LiveFolder live(folder);
  const sigset_t signals = held_signals();
  const HttpServer server(port, [&](const HttpRequest& request) {  //
    return answer_of(folder, live, request);
  });
  print(stdout, "http://127.0.0.1:{}/\n", server.port());
  std::fflush(stdout);
  int signal = 0;
  while (sigwait(&signals, &signal) != 0) {
  }
}

}  // namespace

void add_view(CLI::App& app, int&) {
  CLI::App* const command = app.add_subcommand(
      "view", "Show a run in a browser while it goes on: convergence and picture, then its report");
  struct Flags {
    std::string folder;
    int port = 0;
  };
  auto flags = std::make_shared<Flags>();
  command->add_option("folder", flags->folder, "Result folder, or the model file or deck it is of")
      ->required();
  command->add_option("--port", flags->port, "Port of 127.0.0.1 (default: one that is free)")
      ->check(CLI::Range(0, 65535));
  command->callback([flags] { view(flags->folder, flags->port); });
}

}  // namespace osculate::app

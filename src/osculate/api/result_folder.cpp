#include "osculate/api/result_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "osculate/core/error.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::api {
namespace fs = std::filesystem;
namespace {

/// Name of the model file an earlier run was made of, empty if this is no result folder.
std::string model_of(const fs::path& folder) {
  std::ifstream file(folder / "summary.json");
  if (!file) return {};
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  return json.is_object() && json.contains("model") && json["model"].is_string()
             ? json["model"].get<std::string>()
             : std::string{};
}

void require_writable(const std::string& folder) {
  const fs::path probe = fs::path(folder) / "writable.part";
  std::error_code ignored;
  try {
    io::write_file(probe.string(), "?");
    fs::remove(probe, ignored);
  } catch (const io::WriteError& error) {
    fs::remove(probe, ignored);
    throw core::InputError({}, fmt::format("cannot write to folder '{}': {}", folder,
                                           std::generic_category().message(error.error_number())));
  }
}

/// Nothing but what a killed run was about to write.
bool only_parts(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() != ".part") return false;
  return !error;
}

}  // namespace

std::string result_folder(const std::string& model, const std::string& wanted) {
  return wanted.empty() ? fs::path(model).stem().string() + ".results" : wanted;
}

std::string choose_folder(const std::string& model, const std::string& wanted) {
  const fs::path folder = result_folder(model, wanted);
  std::error_code error;
  if (!fs::exists(folder, error)) return folder.string();
  if (!fs::is_directory(folder, error))
    throw core::InputError({}, fmt::format("'{}' exists and is not a folder", folder.string()));
  if (fs::is_empty(folder, error) || only_parts(folder)) return folder.string();
  const std::string earlier = model_of(folder);
  if (earlier != fs::path(model).filename().string())
    throw core::InputError(
        {}, fmt::format(
                "folder '{}' is not empty and holds no results of '{}'; name another one with -o",
                folder.string(), fs::path(model).filename().string()));
  return folder.string();
}

namespace {

void create(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw core::InputError({},
                           fmt::format("cannot create folder '{}': {}", folder, error.message()));
  require_writable(folder);
}

}  // namespace

void claim_folder(const std::string& folder, const std::string& model) {
  create(folder);
  const std::string name = fs::path(model).filename().string();
  write_text(folder + "/summary.json",
             nlohmann::json{{"model", name}, {"status", "running"}}.dump(1) + "\n");
}

void open_folder(const std::string& folder, bool keep) {
  create(folder);
  if (keep) return;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::string extension = entry.path().extension().string();
    const bool ours = extension == ".vtu" || extension == ".pvd" || name == "history.csv" ||
                      name == "report.json" || name == "report.html" || name == "log.txt" ||
                      name == "journal.bin" || name == "checkpoint.bin" ||
                      name == "checkpoint.previous.bin" || extension == ".part";
    if (ours) fs::remove(entry.path(), error);
  }
}

void write_text(const std::string& path, const std::string& text) {
  io::AtomicFile file(path);
  file.write(text);
  file.commit();
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw core::InputError({}, fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace osculate::api

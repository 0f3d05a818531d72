#include "osculate/result/result_folder.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/deck/mesh_description.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/io/utf8.hpp"

namespace osculate::result {
namespace fs = std::filesystem;
namespace {

constexpr const char* lock_name = "running.lock";
constexpr const char* list_name = "written.txt";
constexpr const char* probe_name = "writable.part";

/// Whose results a folder has; empty texts where it does not say.
struct Owner {
  std::string model, path, content;
};

Owner owner_of(const fs::path& folder) {
  std::ifstream file(folder / "summary.json");
  if (!file) return {};
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  const auto text = [&](const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_string()
               ? json[key].get<std::string>()
               : std::string{};
  };
  return {text("model"), text("model_path"), text("model_content")};
}

/// FNV-1a of the file's bytes, 16 digits; empty if it cannot be read.
std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::array<char, 65536> part{}; file;) {
    file.read(part.data(), part.size());  // a folder: bad, while its iterators would throw
    for (std::streamsize i = 0; i < file.gcount(); ++i)
      hash =
          (hash ^ static_cast<unsigned char>(part[static_cast<std::size_t>(i)])) * 1099511628211ULL;
  }
  if (file.bad()) return {};
  return fmt::format("{:016x}", hash);
}

/// As JSON can hold it: in a name that is no UTF-8 the bytes that are not ASCII by their numbers.
std::string json_name(const std::string& name) {
  if (io::is_plain_text(name)) return name;
  std::string text;
  for (const char c : name)
    text += c >= ' ' && c <= '~' ? std::string(1, c)
                                 : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return text;
}

std::string name_of(const std::string& model) {
  return json_name(fs::path(model).filename().string());
}

std::string path_of(const std::string& model) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(model, error);
  return error ? std::string{} : json_name(path.string());
}

/// Folders of earlier versions say the name alone.
bool same_model(const Owner& owner, const std::string& model) {
  if (owner.model != name_of(model)) return false;
  return owner.path.empty() || owner.path == path_of(model) ||
         (!owner.content.empty() && owner.content == content_of(model));
}

void require_writable(const std::string& folder) {
  const fs::path probe = fs::path(folder) / probe_name;
  std::error_code ignored;
  try {
    io::write_file(probe.string(), "?");
    fs::remove(probe, ignored);
  } catch (const io::WriteError& error) {
    fs::remove(probe, ignored);
    throw io::WriteError(folder, "cannot write to this folder", error.error_number());
  }
}

/// A file of the folder itself, not one somewhere else.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name.find('/') == std::string::npos;
}

/// The files whose names all runs give.
bool is_common_file(std::string_view name) {
  constexpr std::array names{"history.csv",    "report.json", "report.html",
                             "log.txt",        "journal.bin", "checkpoint.bin",
                             "iterations.csv", "results.pvd", "checkpoint.previous.bin",
                             list_name,        probe_name,    "last_iterate.vtu"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What a killed run was about to write, or tried whether it can.
bool is_part(std::string_view name) {
  constexpr std::string_view part = ".part";
  if (name == probe_name) return true;
  if (!name.ends_with(part)) return false;
  name.remove_suffix(part.size());
  return name == "summary.json" || is_common_file(name);
}

/// Nothing but what a killed run was about to write, and its lock.
bool only_parts(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (const std::string name = entry.path().filename().string();
        name != lock_name && !is_part(name))
      return false;
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
  const Owner earlier = owner_of(folder);
  if (same_model(earlier, model)) return folder.string();
  const std::string name = name_of(model);
  if (earlier.model == name)
    throw core::InputError({}, fmt::format("folder '{}' holds the results of another '{}' ({}); "
                                           "name another one with -o",
                                           folder.string(), name, earlier.path));
  throw core::InputError(
      {},
      fmt::format("folder '{}' is not empty and holds no results of '{}'; name another one with -o",
                  folder.string(), name));
}

FieldList::FieldList(const std::string& folder) : path_(folder + "/" + list_name) {
  std::ifstream file(path_);
  for (std::string name; std::getline(file, name);)
    if (is_plain_name(name)) names_.insert(name);
}

void FieldList::add(const std::string& name) {
  if (names_.contains(name)) return;
  if (!file_) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path_, error);
    file_.emplace(path_, error ? 0 : size);
  }
  file_->append(name + "\n");
  names_.insert(name);
}

nlohmann::json owner_json(const std::string& model) {
  return {{"model", name_of(model)},
          {"model_path", path_of(model)},
          {"model_content", content_of(model)}};
}

nlohmann::json mesh_contents(const deck::MeshSource& mesh) {
  nlohmann::json contents = nlohmann::json::object();
  for (const deck::MeshFile& file : mesh.files)
    contents[json_name(file.file.value)] = content_of(file.path);
  return contents;
}

namespace {

void create(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw io::WriteError(folder, "cannot create folder", error.value());
  require_writable(folder);
}

}  // namespace

namespace {

std::string now_text() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  std::array<char, 32> text{};
  if (!localtime_r(&now, &local)) return {};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &local)};
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

/// Whether the open file is still the one of that name: the last owner may just have removed it.
bool is_at(int file, const std::string& path) {
  struct stat by_file {
  }, by_name{};
  return fstat(file, &by_file) == 0 && stat(path.c_str(), &by_name) == 0 &&
         by_file.st_ino == by_name.st_ino && by_file.st_dev == by_name.st_dev;
}

/// Whether the file could be locked; who only looks who has it (owner_of_lock) has it for no time.
bool lock_soon(int file) {
  constexpr int tries = 5;
  constexpr timespec pause{0, 10'000'000};
  for (int i = 1;; ++i) {
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK || i == tries) return false;
    ::nanosleep(&pause, nullptr);
  }
}

}  // namespace

std::string owner_of_lock(const std::string& folder) {
  const std::string path = folder + "/" + lock_name;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return {};
  const bool taken = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  std::array<char, 512> text{};
  const ssize_t size = taken ? ::read(file, text.data(), text.size()) : 0;
  ::close(file);
  if (!taken) return {};
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : "?";
}

FolderLock::FolderLock(const std::string& folder, bool create_it)
    : path_(folder + "/" + lock_name) {
  if (create_it) create(folder);
  for (;;) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) return;  // no folder, or none to write to: others say so
    if (!lock_soon(file_)) {
      const bool taken = errno == EWOULDBLOCK;
      ::close(file_);
      file_ = -1;
      if (!taken) return;
      const std::string owner = read_text(path_);
      throw core::InputError({}, fmt::format("folder '{}' is in use{}{}; wait for its end, or name "
                                             "another one with -o",
                                             folder, owner.empty() ? "" : " by ", owner));
    }
    if (is_at(file_, path_)) break;
    ::close(file_);
  }
  const std::string owner =
      fmt::format("process {} on {} since {}", ::getpid(), host_name(), now_text());
  if (::ftruncate(file_, 0) != 0 ||
      ::write(file_, owner.data(), owner.size()) != static_cast<ssize_t>(owner.size()))
    return;  // the lock holds all the same
}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());
  ::close(file_);
}

void claim_folder(const std::string& folder, const nlohmann::json& owner) {
  create(folder);
  nlohmann::json summary = owner;
  summary["status"] = "running";
  write_text(folder + "/summary.json", json_text(summary, 1) + "\n");
}

void open_folder(const std::string& folder, bool keep) {
  create(folder);
  if (keep) return;
  std::error_code error;
  std::vector<fs::path> old;
  const FieldList listed(folder);
  for (const std::string& name : listed.names()) {
    old.emplace_back(name);
    old.emplace_back(name + ".part");
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (const std::string name = entry.path().filename().string();
        name != list_name && (is_common_file(name) || is_part(name)))
      old.emplace_back(name);
  old.emplace_back(list_name);  // the last one: a run that is killed before can be cleared again
  for (const fs::path& name : old) fs::remove(folder / name, error);
}

std::string json_text(const nlohmann::json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
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

}  // namespace osculate::result

#include "osculate/io/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace osculate::io {
namespace {

std::string error_text(int error_number) {
  return error_number == 0 ? "unknown reason" : std::generic_category().message(error_number);
}

}  // namespace

WriteError::WriteError(std::string path, const std::string& action, int error_number)
    : std::runtime_error(path + ": " + action + ": " + error_text(error_number)),
      path_(std::move(path)),
      error_number_(error_number) {}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), place_(path_) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::is_directory(status)) throw WriteError(path_, "cannot write", EISDIR);
  const bool replaceable = !fs::exists(status) || fs::is_regular_file(status);
  if (fs::is_symlink(fs::symlink_status(path_, error)) && fs::is_regular_file(status)) {
    const fs::path target = fs::canonical(path_, error);
    if (!error) place_ = target.string();
  }
  part_ = replaceable ? place_ + ".part" : std::string{};
  errno = 0;
  file_ = std::fopen(replaceable ? part_.c_str() : path_.c_str(), "wb");
  if (file_ == nullptr) throw WriteError(path_, "cannot write", errno);
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  if (!part_.empty()) std::remove(part_.c_str());
}

void AtomicFile::fail(const std::string& action) {
  const int error_number = errno;
  if (file_ != nullptr) std::fclose(file_);
  file_ = nullptr;
  if (!part_.empty()) std::remove(part_.c_str());
  throw WriteError(path_, action, error_number);
}

void AtomicFile::write(std::string_view data) {
  if (file_ == nullptr) throw WriteError(path_, "cannot write after the end", EBADF);
  errno = 0;
  if (std::fwrite(data.data(), 1, data.size(), file_) != data.size()) fail("cannot write");
}

void AtomicFile::finish(bool on_disk) {
  if (file_ == nullptr) throw WriteError(path_, "cannot write after the end", EBADF);
  errno = 0;
  if (std::fflush(file_) != 0) fail("cannot write");
  if (on_disk && ::fsync(::fileno(file_)) != 0 && errno != EINVAL) fail("cannot write");
  std::FILE* const file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail("cannot write");
}

void AtomicFile::commit() {
  finish(false);
  if (part_.empty()) return;
  if (std::rename(part_.c_str(), place_.c_str()) != 0) fail("cannot replace");
}

void AtomicFile::commit_keeping(const std::string& previous, bool on_disk) {
  finish(on_disk);
  if (part_.empty()) return;
  if (!previous.empty()) std::remove(previous.c_str());
  // A second name for the old file; where links are not known the old file is moved.
  if (!previous.empty() && ::link(place_.c_str(), previous.c_str()) != 0 && errno != ENOENT &&
      std::rename(place_.c_str(), previous.c_str()) != 0)
    fail("cannot keep the previous file");
  if (std::rename(part_.c_str(), place_.c_str()) != 0) fail("cannot replace");
}

void write_file(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace osculate::io

#pragma once
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

namespace osculate::io {

/// A file could not be written: disk full, no permission, no such folder. `what()` names the file
/// and the reason given by the system.
class WriteError : public std::runtime_error {
 public:
  WriteError(std::string path, const std::string& action, int error_number);
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int error_number() const { return error_number_; }

 private:
  std::string path_;
  int error_number_;
};

/// Writes to `path.part` and renames it in the end, so that `path` is either the old or the whole
/// new content at any time. Without commit() the partial file is removed. A link stays a link: the
/// file it leads to is replaced. A device or pipe is never replaced but written to directly.
///
/// Tested by  tests/unit/io/test_atomic_file.cpp
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();
  void write(std::string_view data);
  /// Puts the file in its place; nothing may be written afterwards.
  void commit();
  /// The same; what was there before is kept under the name `previous` (in the same folder; empty:
  /// it is not). At any moment one of the two is whole. With `on_disk` it is on the disk, not only
  /// in the system's memory, when this returns.
  void commit_keeping(const std::string& previous, bool on_disk = true);

 private:
  void finish(bool on_disk);
  [[noreturn]] void fail(const std::string& action);
  std::string path_;
  std::string place_;  ///< what is replaced: `path`, or where that link leads to
  std::string part_;   ///< empty: written to directly
  std::FILE* file_ = nullptr;
};

/// All at once. Throws WriteError.
void write_file(const std::string& path, std::string_view content);

}  // namespace osculate::io

#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "osculate/io/atomic_file.hpp"

namespace osculate::io {

/// A file that grows by whole pieces: a piece that cannot be written (disk full) is taken back, so
/// that the file ends with the last good one.
///
/// Errors     WriteError
/// Tested by  tests/unit/io/test_chunk_file.cpp
class AppendFile {
 public:
  /// Keeps the first `keep` bytes of a file that is there (0: begins anew).
  explicit AppendFile(std::string path, std::uint64_t keep = 0);
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();
  /// In the file (not yet on the disk) when it returns.
  void append(std::string_view piece);
  /// On the disk when it returns.
  void sync();
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  std::string path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace osculate::io

#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "osculate/io/atomic_file.hpp"

namespace osculate::io {

/// A file that grows by whole pieces: a piece that cannot be written (disk full) is taken back, so
/// that the file ends with the last good one. With a tail it ends with that after every piece: the
/// next piece takes its place, in one write, and is followed by it. A process that is killed may be
/// stopped in a write where a page of the file ends: where one goes beyond a page (one or
/// two in 4 kB) the file is written beside and put in its place.
///
/// Errors     WriteError
/// Tested by  tests/unit/io/test_chunk_file.cpp
class AppendFile {
 public:
  /// Keeps the first `keep` bytes of a file that is there (0: begins anew), which the tail follows
  /// there already.
  explicit AppendFile(std::string path, std::uint64_t keep = 0, std::string tail = {});
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();
  /// In the file (not yet on the disk) when it returns.
  void append(std::string_view piece);
  /// On the disk when it returns.
  void sync();
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  [[nodiscard]] bool within_a_page(std::size_t bytes) const;
  void replace(std::string_view piece);
  [[nodiscard]] std::size_t write(std::string_view bytes, std::uint64_t at) const;
  std::string path_, tail_;
  int file_ = -1;
  std::uint64_t size_ = 0;  ///< without the tail
};

}  // namespace osculate::io

#include "osculate/io/append_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace osculate::io {

AppendFile::AppendFile(std::string path, std::uint64_t keep) : path_(std::move(path)), size_(keep) {
  constexpr mode_t readable = 0666;
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, readable);
  if (file_ < 0) throw WriteError(path_, "cannot write", errno);
  if (::ftruncate(file_, static_cast<off_t>(keep)) == 0 || errno == EINVAL) return;  // a device
  const int reason = errno;
  ::close(file_);
  throw WriteError(path_, "cannot write", reason);
}

AppendFile::~AppendFile() { ::close(file_); }

void AppendFile::append(std::string_view piece) {
  std::string_view rest = piece;
  while (!rest.empty()) {
    const ssize_t written = ::write(file_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int reason = written < 0 ? errno : ENOSPC;
      // What has been written of this piece is worth nothing; where even that cannot be undone
      // there is nothing better to do.
      [[maybe_unused]] const int undone = ::ftruncate(file_, static_cast<off_t>(size_));
      throw WriteError(path_, "cannot write", reason);
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ += piece.size();
}

void AppendFile::sync() {
  if (::fdatasync(file_) != 0 && errno != EINVAL && errno != EROFS)
    throw WriteError(path_, "cannot write", errno);
}

}  // namespace osculate::io

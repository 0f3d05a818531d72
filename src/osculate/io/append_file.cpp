#include "osculate/io/append_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace osculate::io {

AppendFile::AppendFile(std::string path, std::uint64_t keep, std::string tail)
    : path_(std::move(path)), tail_(std::move(tail)), size_(keep) {
  constexpr mode_t readable = 0666;
  const int how = tail_.empty() ? O_WRONLY | O_APPEND : O_RDWR;
  file_ = ::open(path_.c_str(), how | O_CREAT | O_CLOEXEC, readable);
  if (file_ < 0) throw WriteError(path_, "cannot write", errno);
  const auto length = static_cast<off_t>(keep + tail_.size());
  if (::ftruncate(file_, length) == 0 || errno == EINVAL) return;  // a device
  const int reason = errno;
  ::close(file_);
  throw WriteError(path_, "cannot write", reason);
}

AppendFile::~AppendFile() { ::close(file_); }

/// How much of it; less than all: errno says why.
std::size_t AppendFile::write(std::string_view bytes, std::uint64_t at) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const char* const from = bytes.data() + done;
    const ssize_t n =
        tail_.empty() ? ::write(file_, from, bytes.size() - done)
                      : ::pwrite(file_, from, bytes.size() - done, static_cast<off_t>(at + done));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = ENOSPC;
    if (n <= 0) return done;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

bool AppendFile::within_a_page(std::size_t bytes) const {
  constexpr std::uint64_t page = 4096;
  return bytes == 0 || size_ / page == (size_ + bytes - 1) / page;
}

void AppendFile::replace(std::string_view piece) {
  std::string all(size_, '\0');
  std::size_t done = 0;
  while (done < all.size()) {
    const ssize_t n =
        ::pread(file_, all.data() + done, all.size() - done, static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw WriteError(path_, "cannot read", n == 0 ? EIO : errno);
    done += static_cast<std::size_t>(n);
  }
  write_file(path_, all.append(piece) + tail_);
  ::close(std::exchange(file_, -1));
  file_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
  if (file_ < 0) throw WriteError(path_, "cannot write", errno);
  size_ += piece.size();
}

void AppendFile::append(std::string_view piece) {
  if (!tail_.empty() && !within_a_page(piece.size() + tail_.size())) return replace(piece);
  const std::string with_tail = tail_.empty() ? std::string{} : std::string(piece) + tail_;
  const std::string_view all = tail_.empty() ? piece : with_tail;
  if (write(all, size_) != all.size()) {
    const int reason = errno;
    // What has been written of this piece is worth nothing; where even that cannot be undone
    // there is nothing better to do.
    [[maybe_unused]] const std::size_t again = tail_.empty() ? 0 : write(tail_, size_);
    [[maybe_unused]] const int undone =
        ::ftruncate(file_, static_cast<off_t>(size_ + tail_.size()));
    throw WriteError(path_, "cannot write", reason);
  }
  size_ += piece.size();
}

void AppendFile::sync() {
  if (::fdatasync(file_) != 0 && errno != EINVAL && errno != EROFS)
    throw WriteError(path_, "cannot write", errno);
}

}  // namespace osculate::io

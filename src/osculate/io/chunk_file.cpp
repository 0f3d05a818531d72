#include "osculate/io/chunk_file.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "osculate/core/error.hpp"

namespace osculate::io {
namespace {

constexpr std::uint64_t byte_order = 0x0102030405060708ull;
constexpr std::size_t word = sizeof(std::uint64_t);

std::string word_bytes(std::uint64_t value) {
  std::string bytes(word, '\0');
  std::memcpy(bytes.data(), &value, word);
  return bytes;
}

std::uint64_t word_at(std::string_view bytes) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data(), word);
  return value;
}

std::uint64_t checksum_of(const Chunk& chunk) {
  return checksum(chunk.bytes, checksum(chunk.name, checksum(word_bytes(chunk.bytes.size()))));
}

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw core::InputError({path, 0, ""}, reason);
}

std::string first_bytes(const std::string& path, std::uint64_t limit) {
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) refuse(path, std::generic_category().message(errno == 0 ? EIO : errno));
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
  std::string text(static_cast<std::size_t>(std::min(limit, size)), '\0');
  file.seekg(0);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::size_t>(file.gcount()) != text.size()) refuse(path, "cannot be read");
  if (limit != UINT64_MAX && size < limit)
    refuse(path, fmt::format("is cut off: {} bytes of {}", size, limit));
  return text;
}

void require_head(const std::string& path, std::string_view text, std::string_view kind,
                  int version) {
  const std::string head = chunk_file_head(kind, version);
  if (text.starts_with(head)) return;
  const std::string first = fmt::format("osculate {} ", kind);
  if (!text.starts_with(first)) refuse(path, fmt::format("is no {} of osculate", kind));
  const std::string line(text.substr(0, std::min(text.find('\n'), first.size() + 12)));
  if (line + "\n" != head.substr(0, head.find('\n') + 1))
    refuse(path, fmt::format("is of another version: '{}', expected '{}'", line,
                             head.substr(0, head.find('\n'))));
  refuse(path, text.size() < head.size() ? "is cut off" : "is of a machine of another byte order");
}

}  // namespace

std::uint32_t checksum(std::string_view bytes, std::uint32_t before) {
  return bytes.empty() ? before : libdeflate_crc32(before, bytes.data(), bytes.size());
}

std::string chunk_file_head(std::string_view kind, int version) {
  return fmt::format("osculate {} {}\n", kind, version) + word_bytes(byte_order);
}

std::string packed(const Chunk& chunk) {
  return word_bytes(chunk.name.size()) + word_bytes(chunk.bytes.size()) +
         word_bytes(checksum_of(chunk)) + chunk.name + chunk.bytes;
}

std::optional<Chunk> next_chunk(const std::string& path, std::string_view kind, int version,
                                std::uint64_t& at) {
  const std::uint64_t head = chunk_file_head(kind, version).size();
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
  const std::uint64_t from = std::max(at, head);
  if (!file || size < from || size - from < 3 * word) return std::nullopt;
  if (at == 0) require_head(path, first_bytes(path, head), kind, version);
  const auto bytes_at = [&](std::uint64_t place, std::uint64_t count) {
    std::string bytes(static_cast<std::size_t>(count), '\0');
    file.seekg(static_cast<std::streamoff>(place));
    file.read(bytes.data(), static_cast<std::streamsize>(count));
    return bytes;
  };
  const std::string sizes = bytes_at(from, 3 * word);
  const std::uint64_t name = word_at(sizes), bytes = word_at(std::string_view(sizes).substr(word)),
                      begin = from + 3 * word;
  if (name > size - begin || bytes > size - begin - name) return std::nullopt;
  Chunk chunk{bytes_at(begin, name), bytes_at(begin + name, bytes)};
  if (!file || checksum_of(chunk) != word_at(std::string_view(sizes).substr(2 * word)))
    return std::nullopt;
  at = begin + name + bytes;
  return chunk;
}

std::vector<Chunk> read_chunks(const std::string& path, std::string_view kind, int version,
                               std::uint64_t limit) {
  const std::string text = first_bytes(path, limit);
  require_head(path, text, kind, version);
  std::string_view rest(text);
  rest.remove_prefix(chunk_file_head(kind, version).size());
  std::vector<Chunk> chunks;
  while (!rest.empty()) {
    if (rest.size() < 3 * word) refuse(path, "is cut off");
    const std::uint64_t name = word_at(rest), bytes = word_at(rest.substr(word)),
                        sum = word_at(rest.substr(2 * word));
    rest.remove_prefix(3 * word);
    if (name > rest.size() || bytes > rest.size() - name)
      refuse(path, fmt::format("is cut off or damaged after {} bytes", text.size() - rest.size()));
    Chunk chunk{std::string(rest.substr(0, name)), std::string(rest.substr(name, bytes))};
    if (checksum_of(chunk) != sum)
      refuse(path, fmt::format("is damaged: the checksum of part {} (of {} bytes) does not match",
                               chunks.size() + 1, bytes));
    rest.remove_prefix(name + bytes);
    chunks.push_back(std::move(chunk));
  }
  return chunks;
}

}  // namespace osculate::io

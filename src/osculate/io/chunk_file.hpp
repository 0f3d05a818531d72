#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osculate::io {

/// A named run of bytes in a file.
struct Chunk {
  std::string name;
  std::string bytes;
};

/// CRC-32 of bytes, going on from that of the bytes before them (0: none).
[[nodiscard]] std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0);

/// First line of a chunk file, e.g. `osculate checkpoint 1`, and the byte order of the machine.
[[nodiscard]] std::string chunk_file_head(std::string_view kind, int version);

/// A chunk as it stands in the file: name, length and checksum (CRC-32 of all three), then bytes.
[[nodiscard]] std::string packed(const Chunk& chunk);

/// Reads the chunks of the first `limit` bytes. Nothing is taken that its checksum does not vouch
/// for.
///
/// Errors     core::InputError: the file is not there, of another kind or version or byte order,
///            ends inside a chunk (or before `limit`), or a chunk does not match its checksum
/// Tested by  tests/unit/io/test_chunk_file.cpp
[[nodiscard]] std::vector<Chunk> read_chunks(const std::string& path, std::string_view kind,
                                             int version, std::uint64_t limit = UINT64_MAX);

/// The chunk that begins at byte `at` (0: the first one) of a file that may still grow; moves `at`
/// behind it. None: there is no whole one yet.
///
/// Errors     core::InputError: the file is of another kind or version or byte order
/// Tested by  tests/unit/io/test_chunk_file.cpp
[[nodiscard]] std::optional<Chunk> next_chunk(const std::string& path, std::string_view kind,
                                              int version, std::uint64_t& at);

}  // namespace osculate::io

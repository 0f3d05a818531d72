#pragma once
// Inside of the public library; included by its sources only.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/archive.hpp"
#include "osculate/embed/values.hpp"

namespace osculate::embed {

/// What bytes are of.
enum class Kind : std::uint8_t { history = 1, active_set = 2, multipliers = 3 };

/// FNV-1a.
[[nodiscard]] std::uint64_t fingerprint(std::string_view bytes);

/// The values behind a head that says what they are, and before a fingerprint of all.
[[nodiscard]] std::vector<std::byte> packed(Kind kind, int dimension, std::uint64_t key,
                                            const std::string& values);
/// The values again. Throws Refused where the head says that they are something else, or of
/// another format or contact, and where the fingerprint is another.
[[nodiscard]] std::string unpacked(Kind kind, int dimension, std::uint64_t key,
                                   std::span<const std::byte> bytes);

/// Loads all of `bytes` into the values. Throws Refused where they are too few or too many.
template <class... T>
void load(const std::string& bytes, T&... values) {
  core::Loader loader(bytes);
  refusing("", [&] { loader(values...); });
  if (!loader.at_end()) throw Refused("there are more bytes than values");
}

}  // namespace osculate::embed

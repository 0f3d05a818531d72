#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osculate::core {

/// The candidate with the smallest edit distance to `name`; empty when none is close
/// (distance above half of the longer word).
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       std::span<const std::string> candidates);

/// `unknown <what> '<name>'; did you mean 'x'?` or `...; known: a, b, c`.
[[nodiscard]] std::string unknown_name_message(std::string_view what, std::string_view name,
                                               std::span<const std::string> candidates);

/// `a, b, c` (at most `most` of them, then `, ...`).
[[nodiscard]] std::string join(std::span<const std::string> words,
                               std::string_view separator = ", ", std::size_t most = 20);
/// `a, b and c`, with the last word in place of `and`.
[[nodiscard]] std::string join_with(std::span<const std::string> words, std::string_view last);

}  // namespace osculate::core

#pragma once
#include <string>
#include <string_view>

namespace osculate::deck {

/// Throws core::InputError for text that is not UTF-8, holds control characters, or is indented
/// with tabs; names the line.
void require_plain_text(std::string_view text, const std::string& file);

}  // namespace osculate::deck

#pragma once
#include <string_view>

namespace osculate::io {

/// Well-formed UTF-8 without control characters (tab included): fit to be shown to a person and to
/// be written into XML and JSON.
[[nodiscard]] bool is_plain_text(std::string_view text);

}  // namespace osculate::io

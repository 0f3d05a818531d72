#pragma once
#include <string>
#include <string_view>

namespace osculate::io {

/// Text of an element or of a quoted attribute in HTML, XML or SVG.
inline std::string escape_markup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace osculate::io

#pragma once
#include <span>
#include <string>

namespace osculate::io {

/// The report page: one HTML file that opens without network, with the viewer (web/dist/report.js)
/// and the data inside.
///
/// Requires   `data_json` is one JSON object as described in docs/report_data.md; its `title`
///            becomes the title of the page. Everything else is read by the page itself, which
///            leaves out the sections whose data are missing.
/// Errors     core::InputError naming the line if `data_json` is not JSON or not an object
/// Tested by  tests/unit/io/test_report.cpp
[[nodiscard]] std::string report_html(const std::string& data_json);
/// The same of data that is known to be such an object, with this title.
[[nodiscard]] std::string report_html(const std::string& data_json, const std::string& title);

/// The same viewer without data, for a server that it asks for them again and again (`osculate
/// view`, docs/view.md).
[[nodiscard]] std::string live_html(const std::string& title);

/// Base64 (RFC 4648, with padding) of the values as little-endian IEEE single precision: the
/// compact form of the arrays in the report data, `{"f32": "...", "shape": [...]}`.
///
/// Returns    4 ceil(4 n / 3) characters, for n values
/// Tested by  tests/unit/io/test_report.cpp
[[nodiscard]] std::string base64_f32(std::span<const float> values);

}  // namespace osculate::io

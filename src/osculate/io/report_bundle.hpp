#pragma once
#include <string_view>

namespace osculate::io {

/// The built viewer web/dist/report.js; compiled in by cmake/embed.cmake.
[[nodiscard]] std::string_view report_bundle();

/// The frame of the page, web/page.html, with the places @TITLE@, @CONNECT@, @DATA@ and @BUNDLE@.
[[nodiscard]] std::string_view report_template();

}  // namespace osculate::io

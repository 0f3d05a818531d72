#pragma once
#include <functional>
#include <string_view>

namespace osculate::core {

enum class LogLevel { debug, info, warning, error };

/// Where messages go. Passed in, never global; an empty sink drops everything.
struct Log {
  std::function<void(LogLevel, std::string_view)> sink;
  void operator()(LogLevel level, std::string_view text) const {
    if (sink) sink(level, text);
  }
};

}  // namespace osculate::core

#pragma once
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "osculate/core/error.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {

inline std::string test_file(const std::string& name) {
  const std::string path = OSCULATE_SOURCE_DIR "/tests/unit/deck/" + name;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// `text` with the one place that reads `from` changed.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::runtime_error("'" + from + "' must occur exactly once");
  return text.replace(at, from.size(), to);
}

/// The message that a model text is refused with; empty when it is accepted.
inline std::string refusal(const std::string& text) {
  try {
    (void)parse_model(text, "model.yaml");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace osculate::deck

#pragma once
#include <string>

#include "osculate/core/error.hpp"
#include "osculate/deck/parse.hpp"

/// The message that a model text is refused with; empty when it is accepted.
inline std::string refusal(const std::string& text) {
  try {
    (void)osculate::deck::parse_model(text, "model.yaml");
  } catch (const osculate::core::InputError& error) {
    return error.what();
  }
  return {};
}

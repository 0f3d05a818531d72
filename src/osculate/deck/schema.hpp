#pragma once
#include <string>

#include "osculate/deck/spec.hpp"

namespace osculate::deck {

/// JSON schema (draft 2020-12) of a specification, indented text.
[[nodiscard]] std::string json_schema(const Spec& spec, const std::string& title);

/// JSON schema of the model file: what `osculate schema` prints.
///
/// Tested by  tests/unit/deck/test_schema.cpp
[[nodiscard]] std::string model_schema();

}  // namespace osculate::deck

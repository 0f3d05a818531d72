#pragma once
#include <string>
#include <string_view>

#include "osculate/deck/spec.hpp"

namespace osculate::deck {

/// The sentence of a key with its unit and its words: the description in the JSON schema.
[[nodiscard]] std::string summary(const Spec& spec);

/// What `osculate doc KEY` prints: what the key is, its type, range, unit, default, an example,
/// and the keys below it. KEY is a path such as `contact.friction.coulomb.mu`; indices and the
/// user's own names may be in it or not; its end is enough (all keys that end so are then
/// explained). Empty: the whole file.
///
/// Errors     core::InputError for a key that does not exist, with the nearest name
/// Tested by  tests/unit/deck/test_explain.cpp
[[nodiscard]] std::string explain(const Spec& spec, std::string_view key);
[[nodiscard]] std::string explain_model_key(std::string_view key);

/// All keys as one page of Markdown: a heading for each that has keys below it, with a line for
/// each of those: type, range, default, meaning, unit, words. Headings are linked to by their
/// letters, digits, _ and -, as forges and Sphinx do.
///
/// Tested by  tests/unit/deck/test_explain.cpp
[[nodiscard]] std::string reference(const Spec& spec, std::string_view title);
[[nodiscard]] std::string model_reference();

}  // namespace osculate::deck

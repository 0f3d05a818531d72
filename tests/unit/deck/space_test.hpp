#pragma once
// Models in space: built, or refused with a message.
#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {

/// A change of a good model and its message.
struct Case {
  std::string from, to, message;
};

inline Built3 built_from(const std::string& text) {
  const Description description = parse_model(text, "model.yaml");
  return build3(description, load_mesh(description));
}

inline std::string any_refusal(const std::string& text) {
  try {
    const Description description = parse_model(text, "model.yaml");
    (void)build_any(description, load_mesh(description));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

inline void expect_refusals(const std::string& model, const std::vector<Case>& cases) {
  ASSERT_EQ(any_refusal(model), "");
  for (const Case& c : cases)
    EXPECT_EQ(any_refusal(edited(model, c.from, c.to)), c.message) << c.to;
}

}  // namespace osculate::deck

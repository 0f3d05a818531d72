#include <algorithm>
#include <cctype>

#include "deck_test.hpp"
#include "osculate/deck/explain.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

std::string unknown(const std::string& key) {
  try {
    (void)explain_model_key(key);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Explain, OneKey) {
  EXPECT_EQ(explain_model_key("contact.friction.coulomb.mu"),
            "contact[].friction.coulomb.mu: a number >= 0, required\n"
            "  Coefficient of friction.\n"
            "  Example: mu: 0.3\n");
  EXPECT_EQ(explain_model_key("materials.NAME.linear_elastic.density"),
            "materials.NAME.linear_elastic.density: a number >= 0, default 0\n"
            "  Mass per reference volume.\n"
            "  Unit: mass/length^3\n"
            "  Example: density: 7.85e-9\n");
}

TEST(Explain, WordsAndTheirMeaning) {
  EXPECT_EQ(explain_model_key("contact.enforcement"),
            "contact[].enforcement: penalty, augmented_lagrange, lagrange_multiplier or a map, "
            "default penalty\n"
            "  How the contact conditions are imposed.\n"
            "  Words:\n"
            "    penalty              by the stiffnesses alone\n"
            "    augmented_lagrange   by repeated correction of the penalty's tractions\n"
            "    lagrange_multiplier  exactly, by unknown tractions\n"
            "  Keys:\n"
            "    augmented_lagrange   Correction of the penalty's tractions. (a map, required)\n"
            "  Example: enforcement: augmented_lagrange\n");
}

TEST(Explain, KeysBelow) {
  EXPECT_EQ(
      explain_model_key("contact.friction"),
      "contact[].friction: none or a map, default none\n"
      "  Law in the tangential direction.\n"
      "  Words:\n"
      "    none                 no friction\n"
      "  Keys:\n"
      "    coulomb              Coulomb's law with an elastic stick range. (a map)\n"
      "    tresca               One shear traction for every pressure, with an elastic stick "
      "range. (a map)\n"
      "    rough                No sliding while in contact. (a map)\n"
      "    rate_and_state       Friction by sliding speed and by the age of the contact. (a map)\n"
      "    viscous              Shear traction in proportion to the sliding speed. (a map)\n"
      "    user                 The largest shear traction by a function of a shared library "
      "(user_law.h, docs/user_law.md). (a map)\n"
      "    Exactly one of: coulomb, tresca, rough, rate_and_state, viscous, user\n"
      "  Example: friction: {coulomb: {mu: 0.3, penalty: 2.1e6}}\n");
  const std::string root = explain_model_key("");
  for (const Key& key : model_spec().keys)
    EXPECT_NE(root.find("\n    " + key.name + " "), std::string::npos) << key.name;
}

TEST(Explain, ManyWaysToNameAKey) {
  const std::string mu = explain_model_key("contact.friction.coulomb.mu");
  for (const char* const key : {"contact[0].friction.coulomb.mu", "contact[].friction.coulomb.mu"})
    EXPECT_EQ(explain_model_key(key), mu) << key;
  const std::string both = mu + "\n" + explain_model_key("contact.all.friction.coulomb.mu") + "\n" +
                           explain_model_key("contact.pairs.friction.coulomb.mu") + "\n" +
                           explain_model_key("steps.contact.friction.coulomb.mu");
  for (const char* const key : {"coulomb.mu", "friction.coulomb.mu"})
    EXPECT_EQ(explain_model_key(key), both) << key;
  const std::string young = explain_model_key("materials.NAME.neo_hooke.E");
  EXPECT_EQ(explain_model_key("materials.steel.neo_hooke.E"), young);
  EXPECT_EQ(explain_model_key("materials.neo_hooke.E"), young);
  // A last part that occurs more than once: all of them.
  EXPECT_NE(explain_model_key("mu").find("friction.rate_and_state.mu: "), std::string::npos);
  EXPECT_NE(explain_model_key("mu").find(mu), std::string::npos);
  const std::string all = explain_model_key("E");
  for (const char* const law : {"linear_elastic", "st_venant_kirchhoff", "neo_hooke"})
    EXPECT_NE(all.find(std::string("materials.NAME.") + law + ".E: "), std::string::npos) << law;
}

TEST(Explain, EveryKeyHasItsText) {
  walk(model_spec(), "", [](const std::string& path, const Spec& spec) {
    if (path.empty() || path.ends_with("[]") || path.ends_with("NAME")) return;
    const std::string text = explain_model_key(path);
    EXPECT_TRUE(text.starts_with(path + ": ")) << path;
    for (const Key& key : spec.keys)
      EXPECT_NE(text.find(key.spec.doc), std::string::npos) << path << "." << key.name;
  });
}

TEST(Explain, UnknownKeysNameTheNearest) {
  EXPECT_EQ(unknown("frictoin"), "unknown key 'frictoin'; did you mean 'friction'?");
  EXPECT_EQ(unknown("contact[].frictoin"),
            "unknown key 'contact[].frictoin'; did you mean 'contact[].friction'?");
  EXPECT_EQ(unknown("qqqqqqqq"), "unknown key 'qqqqqqqq'; without a key, all are listed");
  EXPECT_EQ(unknown(".."), "unknown key '..'; without a key, all are listed");
}

/// What lies between two marks, wherever they come.
std::vector<std::string> between(const std::string& text, const std::string& a,
                                 const std::string& b) {
  std::vector<std::string> all;
  for (std::size_t at = text.find(a); at != std::string::npos; at = text.find(a, at + 1)) {
    const std::size_t from = at + a.size();
    all.push_back(text.substr(from, text.find(b, from) - from));
  }
  return all;
}

TEST(Reference, EveryLinkHasItsHeadingAndEveryHeadingItsLink) {
  const std::string page = model_reference();
  std::vector<std::string> anchors;
  for (std::string heading : between(page, "# `", "`")) {
    std::erase_if(heading, [](char c) { return c == '.' || c == '[' || c == ']'; });
    std::transform(heading.begin(), heading.end(), heading.begin(), ::tolower);
    anchors.push_back(heading);
  }
  std::vector<std::string> links = between(page, "](#", ")");
  EXPECT_GT(anchors.size(), 100U);
  std::sort(anchors.begin(), anchors.end());
  std::sort(links.begin(), links.end());
  EXPECT_EQ(anchors, links);
  EXPECT_EQ(std::adjacent_find(anchors.begin(), anchors.end()), anchors.end());
}

TEST(Reference, KeysHaveTheirLines) {
  const std::string page = model_reference();
  EXPECT_NE(page.find("\n#### `contact[].friction.coulomb`\n"), std::string::npos);
  EXPECT_NE(page.find("- **mu** (a number \\>= 0, required): Coefficient of friction.\n"),
            std::string::npos)
      << page.substr(page.find("`contact[].friction.coulomb`"), 300);
  EXPECT_NE(
      page.find("- **density** (a number \\>= 0, default 0): Mass per reference volume. Unit: "
                "mass/length^3.\n"),
      std::string::npos);
  EXPECT_NE(page.find("  - `augmented_lagrange`: by repeated correction of the penalty's"),
            std::string::npos);
  EXPECT_EQ(page.find("\n- **${"), std::string::npos);
  EXPECT_NE(page.find("\\${name}"), std::string::npos);  // no formula
}

}  // namespace
}  // namespace osculate::deck

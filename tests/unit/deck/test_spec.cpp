#include <map>
#include <set>

#include "deck_test.hpp"
#include "osculate/deck/check.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

template <class Visitor>
void each(const Visitor& visit) {
  walk(model_spec(), "", visit);
}

TEST(Spec, EveryKeyHasASentence) {
  int count = 0;
  each([&](const std::string& path, const Spec& spec) {
    ++count;
    ASSERT_FALSE(spec.doc.empty()) << path;
    EXPECT_TRUE(spec.doc.back() == '.' || spec.type == Type::choice) << path << ": " << spec.doc;
    EXPECT_TRUE((spec.doc.front() >= 'A' && spec.doc.front() <= 'Z') || spec.doc.starts_with("x "))
        << path << ": " << spec.doc;
    for (const Choice& c : spec.choices) EXPECT_FALSE(c.doc.empty()) << path << " " << c.name;
  });
  EXPECT_GT(count, 150);
}

TEST(Spec, DefaultsAndExamplesAreValid) {
  each([](const std::string& path, const Spec& spec) {
    for (const std::string& yaml : {spec.fallback, spec.example}) {
      if (yaml.empty()) continue;
      try {
        (void)check_text(spec, yaml);
      } catch (const core::InputError& error) {
        ADD_FAILURE() << path << ": " << yaml << ": " << error.what();
      }
    }
  });
}

TEST(Spec, KeysAreUniqueAndGroupsNameKeys) {
  each([](const std::string& path, const Spec& spec) {
    std::set<std::string> seen;
    for (const Key& key : spec.keys) {
      EXPECT_TRUE(seen.insert(key.name).second) << path << "." << key.name;
      EXPECT_FALSE(key.required && !key.spec.fallback.empty())
          << path << "." << key.name << " is required and has a default";
    }
    for (const Group& group : spec.groups)
      for (const std::string& key : group.keys) EXPECT_TRUE(find_key(spec, key)) << path << key;
    const bool container = spec.type == Type::list || spec.type == Type::names;
    EXPECT_EQ(spec.parts.size() == 1, container) << path;
  });
}

TEST(Spec, CodesOfWordsAreUnique) {
  each([](const std::string& path, const Spec& spec) {
    std::map<int, std::string> codes;
    for (const Choice& c : spec.choices)
      if (c.available) {
        EXPECT_TRUE(codes.emplace(c.code, c.name).second) << path << ": " << c.name;
      }
  });
}

/// The full models use every key that can be used, so that no key goes untested.
TEST(Spec, FullModelUsesEveryKey) {
  std::set<std::string> used;
  const auto visit = [&](const auto& self, const SourceNode& node) -> void {
    for (const SourceNode& item : node.items) self(self, item);
    for (const SourceEntry& entry : node.entries) {
      used.insert(entry.key);
      self(self, entry.value);
    }
  };
  for (const char* const file : {"full.yaml",
                                 "parts.yaml",
                                 "solid.yaml",
                                 "shapes.yaml",
                                 "all.yaml",
                                 "channel.yaml",
                                 "sampling.yaml",
                                 "laws.yaml",
                                 "enforcement.yaml",
                                 "dynamics.yaml",
                                 "dynamics_space.yaml",
                                 "impacts.yaml",
                                 "ring.yaml",
                                 "files.yaml",
                                 "time.yaml",
                                 "heat.yaml",
                                 "changes.yaml",
                                 "swings.yaml",
                                 "sector.yaml",
                                 "constraints.yaml",
                                 "user.yaml",
                                 "bodies_change.yaml",
                                 "thin.yaml"})
    visit(visit, read_yaml(test_file(file), file));
  each([&](const std::string&, const Spec& spec) {
    for (const Key& key : spec.keys) {
      const bool tolerance = key.name == "residual";
      EXPECT_TRUE(used.contains(key.name) || !key.spec.available || tolerance) << key.name;
    }
  });
}

TEST(Spec, Descriptions) {
  EXPECT_EQ(describe(number("x").above(0)), "a number");
  EXPECT_EQ(describe(point_spec("x")), "a list of 2 numbers");
  EXPECT_EQ(describe(either("x", {integer("n"), choice("c", {Choice{"all", "a", 0, true}})})),
            "an integer or all");
  EXPECT_EQ(describe_range(number("x").above(0).at_most(2.5)), "> 0 and <= 2.5");
  EXPECT_EQ(describe_range(number("x")), "");
}

}  // namespace
}  // namespace osculate::deck

// What describes itself by its parameters has its keys, ranges and values in the model file from
// there, and from nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "deck_test.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/params.hpp"
#include "osculate/material/law.hpp"

namespace osculate::deck {
namespace {
using ::testing::HasSubstr;

/// A law that the program does not know.
struct Foam {
  double plateau = 0, share = 0.25, hardening = 3;
  static constexpr auto params() {
    return std::array<core::Param<Foam>, 3>{
        {{"plateau", "force/length^2", "Stress of the plateau.", &Foam::plateau, {.lower = 0}},
         {"share",
          "1",
          "Share of the pores.",
          &Foam::share,
          {.lower = 0, .upper = 1, .with_upper = true},
          false,
          "0.9"},
         {"hardening", "1", "Exponent.", &Foam::hardening, {}, false}}};
  }
};

std::string problem(const char* yaml) {
  try {
    (void)check_text(params_spec<Foam>("A foam."), yaml);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Params, BecomeKeysWithTheirRangesAndDefaults) {
  const Spec spec = params_spec<Foam>("A foam.");
  EXPECT_EQ(spec.doc, "A foam.");
  EXPECT_EQ(key_names(spec), (std::vector<std::string>{"plateau", "share", "hardening"}));
  EXPECT_TRUE(find_key(spec, "plateau")->required);
  EXPECT_EQ(find_key(spec, "plateau")->spec.unit, "force/length^2");
  EXPECT_EQ(find_key(spec, "share")->spec.unit, "");
  EXPECT_EQ(find_key(spec, "share")->spec.fallback, "0.25");
  EXPECT_EQ(describe_range(find_key(spec, "plateau")->spec), "> 0");
  EXPECT_EQ(describe_range(find_key(spec, "share")->spec), "> 0 and <= 1");
  EXPECT_EQ(describe_range(find_key(spec, "hardening")->spec), "");
}

TEST(Params, AreReadFromThem) {
  const Foam foam =
      params_of<Foam>(check_text(params_spec<Foam>("A foam."), "{plateau: 2, hardening: -1}"));
  EXPECT_EQ(foam.plateau, 2);
  EXPECT_EQ(foam.share, 0.25);
  EXPECT_EQ(foam.hardening, -1);
  EXPECT_THAT(problem("{share: 0.5}"), HasSubstr("required key 'plateau' is missing"));
  EXPECT_THAT(problem("{plateau: 0}"), HasSubstr("> 0"));
  EXPECT_THAT(problem("{plateau: 1, share: 1.5}"), HasSubstr("<= 1"));
  EXPECT_THAT(problem("{plateau: 1, shore: 0.5}"), HasSubstr("share"));
}

/// A law with everything else that a parameter may be.
struct Creep {
  double rate = 0, threshold = std::numeric_limits<double>::infinity();
  std::optional<double> time, strain;
  core::Table hardening;
  static constexpr core::Automatic from_body{"Rate.", "From the body.", "as the body has it"};
  static constexpr core::OneOf decay{"decay", "How it fades.", "{time: 3}"};
  static constexpr core::PointWords words{"One point [strain, stress].", "A number.", "[0, 1]"};
  static constexpr auto params() {
    return std::array<core::Param<Creep>, 5>{{{.key = "rate",
                                               .unit = "1/time",
                                               .doc = "How fast.",
                                               .slot = &Creep::rate,
                                               .range = {.lower = 0},
                                               .required = false,
                                               .automatic = &from_body},
                                              {.key = "time",
                                               .unit = "time",
                                               .doc = "In time.",
                                               .slot = &Creep::time,
                                               .range = {.lower = 0},
                                               .required = false,
                                               .one_of = &decay,
                                               .timed = true},
                                              {.key = "strain",
                                               .unit = "1",
                                               .doc = "By strain.",
                                               .slot = &Creep::strain,
                                               .required = false,
                                               .one_of = &decay},
                                              {.key = "threshold",
                                               .unit = "force/length^2",
                                               .doc = "Least stress.",
                                               .slot = &Creep::threshold,
                                               .range = {.lower = 0},
                                               .required = false,
                                               .otherwise = "none"},
                                              {.key = "hardening",
                                               .unit = "1",
                                               .doc = "Stress over strain.",
                                               .slot = &Creep::hardening,
                                               .example = "[[0, 1], [1, 2]]",
                                               .points = &words}}};
  }
  [[nodiscard]] std::optional<core::Fault> fault() const {
    if (strain && rate > 5) return core::Fault{"too fast", "decay"};
    for (std::size_t i = 1; i < hardening.size(); ++i)
      if (!(hardening[i][0] > hardening[i - 1][0]))
        return core::Fault{"strains must grow", "hardening", i};
    return std::nullopt;
  }
};

Creep creep(const std::string& yaml) {
  return params_of<Creep>(check_text(params_spec<Creep>("Creep."), yaml));
}

TEST(Params, MayBeOptionalTablesGroupsAndLeftToTheProgram) {
  const Spec spec = params_spec<Creep>("Creep.");
  EXPECT_EQ(key_names(spec), (std::vector<std::string>{"rate", "decay", "threshold", "hardening"}));
  EXPECT_EQ(find_key(spec, "rate")->spec.fallback, "auto");
  EXPECT_EQ(key_names(find_key(spec, "decay")->spec), (std::vector<std::string>{"time", "strain"}));
  EXPECT_EQ(find_key(spec, "threshold")->spec.note, "none");
  EXPECT_TRUE(find_key(spec, "hardening")->required);

  const Creep least = creep("{hardening: [[0, 1], [0.5, 2]]}");
  EXPECT_EQ(least.rate, 0);
  EXPECT_FALSE(least.time || least.strain);
  EXPECT_EQ(least.threshold, std::numeric_limits<double>::infinity());
  EXPECT_EQ(least.hardening, (core::Table{{0, 1}, {0.5, 2}}));
  const Creep all =
      creep("{rate: 2, decay: {time: 4}, threshold: 7, hardening: [[0, 1], [0.5, 2]]}");
  EXPECT_EQ(all.rate, 2);
  EXPECT_EQ(all.time, 4);
  EXPECT_FALSE(all.strain);
  EXPECT_EQ(all.threshold, 7);
}

TEST(Params, ThatDoNotGoTogetherAreRefusedWhereTheyStand) {
  const auto problem_of = [](const std::string& yaml) -> std::string {
    try {
      (void)creep(yaml);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(problem_of("{rate: 6, hardening: [[0, 1], [1, 2]], decay: {strain: 4}}"),
            "text:1: decay: too fast");
  EXPECT_EQ(problem_of("{hardening: [[0, 1], [0, 2]]}"), "text:1: hardening[1]: strains must grow");
  EXPECT_THAT(problem_of("{hardening: [[0, 1], [1, 2]], decay: {strain: 4, time: 1}}"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(problem_of("{hardening: [[0, 1]]}"), HasSubstr("at least 2 values"));
  EXPECT_THAT(problem_of("{rate: 0, hardening: [[0, 1], [1, 2]]}"), HasSubstr("must be > 0"));
}

/// Every law of the catalogue is a key of `materials`, with its sentence and its parameters.
TEST(Params, OfAllMaterialsAreInTheModelFile) {
  const Spec one = find_key(model_spec(), "materials")->spec.parts[0];
  int laws = 0;
  material::for_each_law([&]<class T>(const T&) {
    const Key* const law = find_key(one, T::key);
    ASSERT_NE(law, nullptr) << T::key;
    EXPECT_EQ(law->spec.doc, T::doc);
    for (const core::Param<T>& p : T::params()) {
      const Key* const key = find_key(law->spec, p.key);
      ASSERT_NE(key, nullptr) << p.key;
      EXPECT_EQ(key->required, p.required);
      EXPECT_EQ(key->spec.doc, p.doc);
    }
    ++laws;
  });
  EXPECT_EQ(one.keys.size(), static_cast<std::size_t>(laws) + 2);  // expansion, relaxation
}

}  // namespace
}  // namespace osculate::deck

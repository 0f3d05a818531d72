// What describes itself by its parameters has its keys, ranges and values in the model file from
// there, and from nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

/// Every law of the catalogue is a key of `materials`, with its sentence and its parameters.
TEST(Params, OfAllMaterialsAreInTheModelFile) {
  const Spec one = find_key(model_spec(), "materials")->spec.parts.at(0);
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
  EXPECT_EQ(one.keys.size(), static_cast<std::size_t>(laws));
}

}  // namespace
}  // namespace osculate::deck

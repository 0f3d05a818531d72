// Damaged model files are refused with a message or accepted; nothing else happens.
#include <random>

#include "deck_test.hpp"
#include "effort.hpp"

namespace osculate::deck {
namespace {

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text, const std::string& donor) {
    const int changes = 1 + below(4);
    for (int i = 0; i < changes; ++i) change(text, donor);
    return text;
  }

 private:
  int below(std::size_t n) {
    return n == 0 ? 0 : static_cast<int>(random_() % static_cast<unsigned>(n));
  }

  void change(std::string& text, const std::string& donor) {
    static constexpr std::string_view specials = "{}[]:,-&*#?|>!%@`'\"\n\t ~0.\x01\xff\xc3";
    const auto at = static_cast<std::size_t>(below(text.size()));
    const auto length = static_cast<std::size_t>(below(12));
    switch (below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, 1, specials[static_cast<std::size_t>(below(specials.size()))]);
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 3:
        text.insert(at, text.substr(static_cast<std::size_t>(below(text.size())), length));
        break;
      case 4:
        text.insert(at, donor.substr(static_cast<std::size_t>(below(donor.size())), 3 * length));
        break;
      default:
        text.resize(at);
        break;
    }
  }

  std::mt19937 random_;
};

TEST(Mutation, EveryRefusalIsAnInputErrorOfTheFile) {
  const std::string block = test_file("block.yaml"), full = test_file("full.yaml");
  Mutator mutate(20240917);
  constexpr int tries = testing::sanitized ? 500 : 4000;
  int accepted = 0, refused = 0;
  for (int i = 0; i < tries; ++i) {
    const std::string text = i % 2 == 0 ? mutate(block, full) : mutate(full, block);
    try {
      (void)parse_model(text, "model.yaml");
      ++accepted;
    } catch (const core::InputError& error) {
      ++refused;
      ASSERT_TRUE(std::string(error.what()).starts_with("model.yaml:")) << error.what();
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    } catch (const std::exception& error) {
      FAIL() << error.what() << "\n" << text;
    }
  }
  // Both happen, so the mutations are neither harmless nor all of one kind.
  EXPECT_GT(accepted, testing::sanitized ? 10 : 100);
  EXPECT_GT(refused, testing::sanitized ? 125 : 1000);
}

TEST(Mutation, EveryPrefixOfAModel) {
  const std::string full = test_file("full.yaml");
  for (std::size_t n = 0; n <= full.size(); n += testing::sanitized ? 7 : 1) {
    try {
      (void)parse_model(full.substr(0, n), "model.yaml");
    } catch (const core::InputError&) {
    }
  }
  SUCCEED();
}

}  // namespace
}  // namespace osculate::deck

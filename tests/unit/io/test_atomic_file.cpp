// Files that take their place when they are whole; links, pipes and folders keep theirs.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "osculate/io/atomic_file.hpp"

namespace osculate::io {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("osculate_atomic_") +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(at(name)).rdbuf();
    return text.str();
  }
};

TEST_F(AtomicFileTest, TheOldContentStaysUntilTheNewIsWhole) {
  write_file(at("a"), "old");
  {
    AtomicFile file(at("a"));
    file.write("half");
    EXPECT_EQ(read("a"), "old");
  }
  EXPECT_EQ(read("a"), "old");
  EXPECT_FALSE(fs::exists(at("a.part")));
  write_file(at("a"), "new");
  EXPECT_EQ(read("a"), "new");
}

TEST_F(AtomicFileTest, ALinkStaysALink) {
  write_file(at("target"), "old");
  fs::create_symlink("target", at("link"));
  write_file(at("link"), "new");
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(read("target"), "new");
}

TEST_F(AtomicFileTest, APipeIsWrittenToAndNotReplaced) {
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  const int reader = open(at("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_file(at("pipe"), "text");
  char got[8] = {};
  EXPECT_EQ(::read(reader, got, sizeof got), 4);
  EXPECT_STREQ(got, "text");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
  EXPECT_FALSE(fs::exists(at("pipe.part")));
}

TEST_F(AtomicFileTest, AFolderIsRefusedAtOnce) {
  EXPECT_THROW(AtomicFile{folder_.string()}, WriteError);
  EXPECT_FALSE(fs::exists(folder_.string() + ".part"));
}

}  // namespace
}  // namespace osculate::io

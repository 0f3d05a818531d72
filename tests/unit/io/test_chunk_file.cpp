// Chunks that vouch for themselves, and files that grow by whole pieces.
#include "osculate/io/chunk_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "osculate/core/error.hpp"
#include "osculate/io/append_file.hpp"

namespace osculate::io {
namespace {
namespace fs = std::filesystem;

class ChunkFile : public ::testing::Test {
 protected:
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("osculate_chunk_") +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string path_ = (folder_ / "f.bin").string();
  const std::string good_ = chunk_file_head("test", 3) + packed({"a", "first"}) +
                            packed({"empty", ""}) + packed({"b", std::string(300, 'x')});
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  [[nodiscard]] std::string read() const {
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }
  /// The message, empty if the file is taken.
  [[nodiscard]] std::string refusal(int version = 3, std::uint64_t limit = UINT64_MAX) const {
    try {
      (void)read_chunks(path_, "test", version, limit);
    } catch (const core::InputError& error) {
      EXPECT_EQ(std::string(error.what()).find(path_ + ": "), 0u) << error.what();
      return std::string(error.what()).substr(path_.size() + 2);
    }
    return {};
  }
};

TEST_F(ChunkFile, GivesBackWhatWasWritten) {
  write(good_);
  const std::vector<Chunk> chunks = read_chunks(path_, "test", 3);
  ASSERT_EQ(chunks.size(), 3u);
  EXPECT_EQ(chunks[0].name, "a");
  EXPECT_EQ(chunks[0].bytes, "first");
  EXPECT_EQ(chunks[1].bytes, "");
  EXPECT_EQ(chunks[2].bytes, std::string(300, 'x'));
}

/// Whichever bit is flipped and wherever the file is cut, except between two chunks.
TEST_F(ChunkFile, EveryFlippedBitAndEveryCutIsNoticed) {
  for (std::size_t at = 0; at < good_.size(); ++at) {
    std::string broken = good_;
    broken[at] = static_cast<char>(broken[at] ^ (1 << (at % 8)));
    write(broken);
    EXPECT_NE(refusal(), "") << at;
  }
  const std::size_t head = chunk_file_head("test", 3).size();
  const std::size_t first = head + packed({"a", "first"}).size();
  const std::size_t second = first + packed({"empty", ""}).size();
  for (std::size_t size = 0; size < good_.size(); ++size) {
    write(good_.substr(0, size));
    EXPECT_EQ(refusal() == "", size == head || size == first || size == second) << size;
  }
}

TEST_F(ChunkFile, SaysWhatIsWrong) {
  EXPECT_EQ(refusal(), "No such file or directory");
  write(good_);
  EXPECT_EQ(refusal(4), "is of another version: 'osculate test 3', expected 'osculate test 4'");
  write("something else");
  EXPECT_EQ(refusal(), "is no test of osculate");
  std::string swapped = good_;
  std::swap(swapped[16], swapped[17]);
  write(swapped);
  EXPECT_EQ(refusal(), "is of a machine of another byte order");
  write(good_);
  EXPECT_EQ(refusal(3, good_.size() + 7), "is cut off: " + std::to_string(good_.size()) +
                                              " bytes of " + std::to_string(good_.size() + 7));
}

TEST_F(ChunkFile, WhatComesBehindTheLimitDoesNotMatter) {
  write(good_ + "half a chu");
  EXPECT_NE(refusal(), "");
  EXPECT_EQ(read_chunks(path_, "test", 3, good_.size()).size(), 3u);
}

TEST_F(ChunkFile, OfAFileThatGrowsWholeChunksAreReadOneByOne) {
  std::uint64_t at = 0;
  EXPECT_FALSE(next_chunk(path_, "test", 3, at));  // not yet there
  const std::size_t first = good_.find("first") + 5;
  for (std::size_t size = 0; size < first; ++size) {
    write(good_.substr(0, size));
    EXPECT_FALSE(next_chunk(path_, "test", 3, at)) << size;
    EXPECT_EQ(at, 0u);
  }
  write(good_.substr(0, good_.size() - 1));
  std::vector<std::string> names;
  while (const std::optional<Chunk> chunk = next_chunk(path_, "test", 3, at))
    names.push_back(chunk->name + "=" + chunk->bytes);
  EXPECT_EQ(names, (std::vector<std::string>{"a=first", "empty="}));
  write(good_);
  const std::optional<Chunk> last = next_chunk(path_, "test", 3, at);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->bytes, std::string(300, 'x'));
  EXPECT_EQ(at, good_.size());
  EXPECT_FALSE(next_chunk(path_, "test", 3, at));
}

TEST_F(ChunkFile, OfAFileThatGrowsNothingDamagedIsTaken) {
  for (std::size_t i = chunk_file_head("test", 3).size(); i < good_.find("first") + 5; ++i) {
    std::string damaged = good_;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x40);
    write(damaged);
    std::uint64_t at = 0;
    EXPECT_FALSE(next_chunk(path_, "test", 3, at)) << i;
  }
  write(good_);
  std::uint64_t at = 0;
  EXPECT_THROW((void)next_chunk(path_, "test", 4, at), core::InputError);
  EXPECT_THROW((void)next_chunk(path_, "other", 3, at), core::InputError);
}

TEST_F(ChunkFile, AnAppendFileKeepsAsMuchAsItIsTold) {
  {
    AppendFile file(path_);
    file.append("one ");
    file.append("two ");
    EXPECT_EQ(file.size(), 8u);
  }
  {
    AppendFile file(path_, 4);
    file.append("three");
    file.sync();
  }
  EXPECT_EQ(read(), "one three");
  AppendFile anew(path_);
  EXPECT_EQ(read(), "");
}

/// Of a process that is killed a write may end where a page of the file does.
TEST_F(ChunkFile, AnAppendFileWithATailIsReplacedWhereAPageEnds) {
  constexpr std::size_t page = 4096;
  const std::string tail = "the end\n", link = path_ + ".same";
  std::string all = "head\n";
  write(all + tail);
  AppendFile file(path_, all.size(), tail);
  fs::create_hard_link(path_, link);
  int replaced = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string before = read(), piece = std::to_string(i) + " of 3000\n";
    const bool within = all.size() / page == (all.size() + piece.size() + tail.size() - 1) / page;
    file.append(piece);
    all += piece;
    ASSERT_EQ(read(), all + tail);
    ASSERT_EQ(fs::hard_link_count(path_) > 1, within) << i;
    if (within) continue;
    ++replaced;
    std::ostringstream old;
    old << std::ifstream(link, std::ios::binary).rdbuf();
    EXPECT_EQ(old.str(), before);
    fs::remove(link);
    fs::create_hard_link(path_, link);
  }
  EXPECT_GE(replaced, static_cast<int>(all.size() / page));
}

TEST_F(ChunkFile, AnAppendFileThatCannotBeWrittenSaysSo) {
  try {
    AppendFile file("/dev/full");
    file.append("x");
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot write: No space left on device");
  }
  EXPECT_THROW(AppendFile("/nowhere/at/all"), WriteError);
}

TEST_F(ChunkFile, AnAtomicFileKeepsThePreviousOne) {
  const std::string previous = (folder_ / "previous.bin").string();
  for (const char* const text : {"1", "2", "3"}) {
    AtomicFile file(path_);
    file.write(text);
    file.commit_keeping(previous);
  }
  EXPECT_EQ(read(), "3");
  std::ostringstream kept;
  kept << std::ifstream(previous).rdbuf();
  EXPECT_EQ(kept.str(), "2");
}

}  // namespace
}  // namespace osculate::io

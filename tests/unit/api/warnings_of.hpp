#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "osculate/api/run.hpp"

namespace osculate::api {

/// Warnings of a run.
inline std::vector<std::string> warnings_of(const std::string& text,
                                            RunStatus end = RunStatus::done) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("osculate_warnings_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "model.yaml") << text;
  std::vector<std::string> found;
  RunOptions options;
  options.model = (folder / "model.yaml").string();
  options.folder = (folder / "out").string();
  options.say = [&](std::string_view line) {
    if (line.starts_with("warning")) found.emplace_back(line);
  };
  EXPECT_EQ(run(options).status, end);
  fs::remove_all(folder);
  return found;
}

}  // namespace osculate::api

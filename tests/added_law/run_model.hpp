#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "osculate/api/run.hpp"

namespace osculate {

/// The columns of the last line of a table.
inline std::map<std::string, double> last_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line, head, word, last;
  std::getline(in, head);
  while (std::getline(in, line)) last = line;
  std::map<std::string, double> values;
  std::istringstream names(head), numbers(last);
  while (std::getline(names, word, ',')) {
    std::string number;
    std::getline(numbers, number, ',');
    values[word] = std::strtod(number.c_str(), nullptr);
  }
  return values;
}

/// What a run of a model has left: the end of its history, and its log.
struct Results {
  std::map<std::string, double> history;
  std::string log;
};

/// Runs the model in a folder of this process.
inline Results results_of(const std::string& model) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("osculate_added_law_" + std::to_string(::getpid()));
  std::filesystem::create_directories(path);
  std::ofstream(path / "model.yaml") << model;
  api::RunOptions options;
  options.model = (path / "model.yaml").string();
  options.folder = (path / "model.results").string();
  const api::RunOutcome outcome = api::run(options);
  EXPECT_EQ(outcome.status, api::RunStatus::done) << outcome.message;
  std::ifstream log(std::filesystem::path(outcome.folder) / "log.txt");
  Results results{last_line(std::filesystem::path(outcome.folder) / "history.csv"),
                  {std::istreambuf_iterator<char>(log), {}}};
  std::filesystem::remove_all(path);
  return results;
}

}  // namespace osculate

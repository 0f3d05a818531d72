#pragma once
#include <cstdint>
#include <string>

#include "osculate/io/append_file.hpp"
#include "osculate/model/analysis.hpp"

namespace osculate::result {

/// `iterations.csv`: a row an iteration, in the file as soon as it is done, also of attempts that
/// are dropped afterwards (docs/results.md): what can be watched of an increment that is under way.
///
/// Errors     io::WriteError
/// Tested by  tests/system/test_view.py
class IterationFile {
 public:
  /// Goes on behind the rows that are there if asked for, else begins anew.
  IterationFile(const std::string& folder, bool go_on);
  /// `aim`: where the increment is to end; `number`: in the attempt.
  void add(const model::Progress& aim, int number, const solve::IterationRecord& iteration);

 private:
  io::AppendFile file_;
};

}  // namespace osculate::result

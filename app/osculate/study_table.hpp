#pragma once
#include <span>
#include <string>
#include <vector>

#include "study_points.hpp"

namespace osculate::app {

/// What a study asks each run for: a number out of a column of its history.csv.
struct StudyOutput {
  std::string name;    ///< as it was asked for, `max:floor.slip`
  std::string column;  ///< `floor.slip`
  double (*of)(const std::vector<double>& values) = nullptr;
};
/// None asked for: the last values of all columns.
///
/// Errors     core::InputError for a column that the model does not have, and for one asked for
///            twice
[[nodiscard]] std::vector<StudyOutput> outputs_of(const std::vector<std::string>& asked,
                                                  const std::vector<std::string>& columns);

struct StudyRow {
  std::string status;  ///< `done`, `stopped` or `failed: WHY`; empty: still to come
  int iterations = 0;
  double seconds = 0;           ///< of the clock
  std::vector<double> outputs;  ///< NaN of a run that is not done
};
/// What stands in the folder of a run that has ended, by itself or by `fault`.
[[nodiscard]] StudyRow row_of(const std::string& folder, const std::string& fault,
                              std::span<const StudyOutput> outputs);

struct StudyTable {
  std::string title;
  std::vector<Range> ranges;
  std::vector<StudyOutput> outputs;
  std::vector<Point> points;
  std::vector<StudyRow> rows;  ///< of the points
};
/// Errors     core::InputError for a parameter that is called as another column
void check_headings(const StudyTable& table);
/// FOLDER/table.csv, and for each output FOLDER/OUTPUT.svg: over the first parameter that is a
/// number and varies, with a curve for each combination of the others. Rows to come are left out.
void write_table(const StudyTable& table, const std::string& folder);

}  // namespace osculate::app

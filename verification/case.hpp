#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/io/plot.hpp"
#include "osculate/io/scene.hpp"
#include "workers.hpp"

namespace osculate::verification {

/// How a computed number is held against its reference. `info` rows never fail: they show where a
/// published number cannot be reproduced, or a number worth knowing.
enum class Relation { equal, at_most, at_least, info };

/// One line of the table.
struct Row {
  std::string quantity;
  double computed = 0;
  double reference = 0;
  Relation relation = Relation::equal;
  double tolerance = 0;  ///< allowed |deviation| for `equal`; deviation is relative to the
                         ///< reference, absolute where the reference is 0
  std::string source;
};

/// A curve for the docs: written as CSV when the command asks for it.
struct Curve {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

/// A picture for the docs: written as SVG when the command asks for it.
struct Picture {
  std::string name;  ///< of the file, after the name of the case
  io::LinePlot plot;
};

/// Deformed bodies for the docs: written as SVG when the command asks for it.
struct Drawing {
  std::string name;  ///< of the file, after the name of the case
  io::Scene scene;
};

struct CaseResult {
  std::vector<Row> rows;
  std::vector<Curve> curves;
  std::vector<Picture> pictures;
  std::vector<Drawing> drawings;
};

struct CaseContext {
  std::string folder;  ///< of the case: models and reference data
  Workers workers{};
};

struct Case {
  std::string name;         ///< folder name
  std::string requirement;  ///< one sentence
  bool slow = false;        ///< only with --long
  std::function<CaseResult(const CaseContext&)> run;
};

/// The cases that are computed here and those that are data in this folder, sorted by name. Of one
/// that is both the rows stand one behind the other.
[[nodiscard]] std::vector<Case> all_cases(const std::string& folder);

[[nodiscard]] double deviation(const Row& row);
[[nodiscard]] bool passes(const Row& row);
[[nodiscard]] std::string_view relation_text(Relation relation);

}  // namespace osculate::verification

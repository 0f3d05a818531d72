#pragma once
#include <string>
#include <vector>

namespace osculate::io {

/// One axis of a plot. A logarithmic axis shows positive values only.
struct PlotAxis {
  std::string label;
  bool logarithmic = false;
  std::vector<double> ticks;  ///< where to write numbers; empty = chosen by the plot
};

enum class PlotStyle { line_and_marks, line, marks };

/// y over x, joined in the given order; values that are not finite (or not positive on a
/// logarithmic axis) are left out and interrupt the line.
struct PlotCurve {
  std::string label;
  std::vector<double> x, y;
  PlotStyle style = PlotStyle::line_and_marks;
};

/// A dashed horizontal line: a reference value.
struct PlotLevel {
  std::string label;
  double y = 0;
};

struct LinePlot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotCurve> curves;
  std::vector<PlotLevel> levels;
};

/// The plot as one self-contained SVG picture on a white ground. The key stands beside the axes, so
/// that labels never cover curves; the picture is as wide as its longest label needs.
///
/// Errors     std::invalid_argument if a curve has not as many x as y
/// Tested by  tests/unit/io/test_plot.cpp
[[nodiscard]] std::string plot_svg(const LinePlot& plot);

}  // namespace osculate::io

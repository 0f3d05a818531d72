#include "osculate/io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "osculate/io/markup.hpp"

namespace osculate::io {
namespace {

// Pixels.
constexpr double plot_width = 470, plot_height = 300, letter = 6.6, line_height = 20;
constexpr double top = 44, below = 56, key_gap = 20, key_sign = 34, margin = 14;

/// Colours that people with any colour vision can tell apart (Okabe and Ito).
constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#000000"};

/// Characters, not bytes.
std::size_t length_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

/// Where the values of an axis lie: `from` and `to` in the scale of the axis (its logarithm).
struct Scale {
  bool logarithmic = false;
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();
  std::vector<double> ticks;

  [[nodiscard]] bool shows(double v) const { return std::isfinite(v) && (!logarithmic || v > 0); }
  [[nodiscard]] double of(double v) const { return logarithmic ? std::log10(v) : v; }
  [[nodiscard]] double share(double v) const { return (of(v) - from) / (to - from); }
  void include(double v) {
    if (!shows(v)) return;
    from = std::min(from, of(v));
    to = std::max(to, of(v));
  }
};

/// The largest of 1, 2, 5, 10 times a power of ten that gives at most seven ticks.
double tick_step(double span) {
  const double power = std::pow(10, std::floor(std::log10(span / 6)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (span <= 6 * factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<double> chosen_ticks(const Scale& s) {
  std::vector<double> ticks;
  const double decades = s.to - s.from;
  if (s.logarithmic && decades >= 1) {
    const double step = std::max(1.0, std::ceil(decades / 7));
    for (double k = std::ceil(s.from - 1e-9); k <= s.to + 1e-9; k += step)
      ticks.push_back(std::pow(10, k));
    if (decades > 2) return ticks;
    ticks.clear();
    for (double k = std::floor(s.from); k <= s.to; ++k)
      for (const double factor : {1.0, 2.0, 5.0})
        if (const double v = std::log10(factor) + k; v >= s.from - 1e-9 && v <= s.to + 1e-9)
          ticks.push_back(factor * std::pow(10, k));
    return ticks;
  }
  const double lo = s.logarithmic ? std::pow(10, s.from) : s.from;
  const double hi = s.logarithmic ? std::pow(10, s.to) : s.to;
  const double step = tick_step(hi - lo);
  for (double k = std::ceil(lo / step - 1e-9); k <= hi / step + 1e-9; ++k)
    ticks.push_back(k * step);
  return ticks;
}

/// Room at both ends, so that no mark sits on the frame.
Scale finished(Scale s, const PlotAxis& axis) {
  for (const double tick : axis.ticks) s.include(tick);
  if (!(s.from <= s.to)) s.from = 0, s.to = 1;
  const double least = s.logarithmic ? 0.1 : 1e-9 * std::max(1e-30, std::abs(s.to));
  const double room = std::max(0.06 * (s.to - s.from), s.to - s.from < least ? 10 * least : 0);
  s.from -= room;
  s.to += room;
  s.ticks = axis.ticks.empty() ? chosen_ticks(s) : axis.ticks;
  std::erase_if(s.ticks, [&](double v) { return !s.shows(v); });
  return s;
}

/// Shortest text of a tick: 0.002, 1e-5 instead of 1e-05.
std::string tick_text(double value, double span) {
  if (std::abs(value) < 1e-9 * span) return "0";
  std::string text = fmt::format("{:.6g}", value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const int power = std::stoi(text.substr(e + 1));
  return fmt::format("{}e{}", text.substr(0, e), power);
}

std::vector<std::string> tick_texts(const Scale& s) {
  std::vector<std::string> texts;
  const double span = s.logarithmic || s.ticks.empty() ? 0 : s.to - s.from;
  for (const double v : s.ticks) texts.push_back(tick_text(v, span));
  return texts;
}

/// The picture's geometry, and what has been drawn so far.
struct Canvas {
  Scale x, y;
  double left = 0;
  std::string body;

  [[nodiscard]] double px(double v) const { return left + plot_width * x.share(v); }
  [[nodiscard]] double py(double v) const { return top + plot_height * (1 - y.share(v)); }

  void text(double at_x, double at_y, std::string_view anchor, std::string_view words,
            std::string_view more = "") {
    body += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", at_x,
                        at_y, anchor, more, escape_markup(words));
  }
  void line(double x1, double y1, double x2, double y2, std::string_view style) {
    body += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1,
                        y1, x2, y2, style);
  }
};

constexpr std::string_view grid_style = "stroke=\"#e4e4e4\"";
constexpr std::string_view tick_style = "stroke=\"#444\"";
constexpr std::string_view level_style =
    "stroke=\"#444\" stroke-width=\"1.3\" stroke-dasharray=\"6 4\"";

/// One of five outlines about (x, y), open where no line joins them: it may lie upon another.
std::string mark(std::size_t kind, PlotStyle style, double x, double y) {
  const char* const colour = colours[kind % colours.size()];
  const std::string paint =
      style == PlotStyle::marks
          ? fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", colour)
          : fmt::format("fill=\"{}\"", colour);
  const double r = style == PlotStyle::marks ? 4.8 : 3.8;
  std::string path;
  switch (kind % 5) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {}/>\n", x, y, r, paint);
    case 1:
      path = fmt::format("M{:.1f} {:.1f}h{}v{}h{}z", x - r, y - r, 2 * r, 2 * r, -2 * r);
      break;
    case 2:
      path = fmt::format("M{:.1f} {:.1f}l{} {}h{}z", x, y - 1.3 * r, 1.3 * r, 2.2 * r, -2.6 * r);
      break;
    case 3:
      path = fmt::format("M{:.1f} {:.1f}l{} {}l{} {}l{} {}z", x, y - 1.4 * r, 1.4 * r, 1.4 * r,
                         -1.4 * r, 1.4 * r, -1.4 * r, -1.4 * r);
      break;
    default:
      path = fmt::format("M{:.1f} {:.1f}l{} {}h{}z", x, y + 1.3 * r, 1.3 * r, -2.2 * r, -2.6 * r);
  }
  return fmt::format("<path d=\"{}\" {}/>\n", path, paint);
}

void draw_axes(Canvas& c, const LinePlot& plot) {
  const double bottom = top + plot_height, right = c.left + plot_width;
  const std::vector<std::string> at_x = tick_texts(c.x), at_y = tick_texts(c.y);
  double free_from = -1;  // numbers of the x axis that would touch the last one are left out
  for (std::size_t i = 0; i < at_x.size(); ++i) {
    const double p = c.px(c.x.ticks[i]), half = 0.5 * letter * static_cast<double>(at_x[i].size());
    c.line(p, top, p, bottom, grid_style);
    c.line(p, bottom, p, bottom + 5, tick_style);
    if (p - half < free_from) continue;
    c.text(p, bottom + 19, "middle", at_x[i]);
    free_from = p + half + letter;
  }
  for (std::size_t i = 0; i < at_y.size(); ++i) {
    const double p = c.py(c.y.ticks[i]);
    c.line(c.left, p, right, p, grid_style);
    c.line(c.left - 5, p, c.left, p, tick_style);
    c.text(c.left - 9, p + 4, "end", at_y[i]);
  }
  c.body += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#444\"/>\n",
      c.left, top, plot_width, plot_height);
  c.text(c.left, top - 18, "start", plot.title, " font-size=\"14\" font-weight=\"600\"");
  c.text(c.left + 0.5 * plot_width, bottom + 42, "middle", plot.x.label);
  c.text(0, 0, "middle", plot.y.label,
         fmt::format(" transform=\"translate({} {}) rotate(-90)\"", margin + 6,
                     top + 0.5 * plot_height));
}

void draw_curve(Canvas& c, const PlotCurve& curve, std::size_t kind) {
  std::string path, marks;
  bool down = false;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!c.x.shows(curve.x[i]) || !c.y.shows(curve.y[i])) {
      down = false;
      continue;
    }
    const double x = c.px(curve.x[i]), y = c.py(curve.y[i]);
    path += fmt::format("{}{:.1f} {:.1f}", down ? "L" : "M", x, y);
    marks += mark(kind, curve.style, x, y);
    down = true;
  }
  if (curve.style != PlotStyle::marks && !path.empty())
    c.body += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n",
                          path, colours[kind % colours.size()]);
  if (curve.style != PlotStyle::line) c.body += marks;
}

/// Curves, then levels, one line each. Returns the right end of the longest.
double draw_key(Canvas& c, const LinePlot& plot) {
  const double left = c.left + plot_width + key_gap;
  double y = top + 10, right = left;
  const auto entry = [&](const std::string& label) {
    c.text(left + key_sign, y + 4, "start", label);
    right = std::max(right, left + key_sign + letter * static_cast<double>(length_of(label)));
    y += line_height;
  };
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const PlotStyle style = plot.curves[k].style;
    if (style != PlotStyle::marks)
      c.line(left, y, left + 26, y,
             fmt::format("stroke=\"{}\" stroke-width=\"1.6\"", colours[k % colours.size()]));
    if (style != PlotStyle::line) c.body += mark(k, style, left + 13, y);
    entry(plot.curves[k].label);
  }
  for (const PlotLevel& level : plot.levels) {
    c.line(left, y, left + 26, y, level_style);
    entry(level.label);
  }
  return right;
}

Canvas canvas_for(const LinePlot& plot) {
  Canvas c;
  c.x.logarithmic = plot.x.logarithmic;
  c.y.logarithmic = plot.y.logarithmic;
  for (const PlotCurve& curve : plot.curves) {
    if (curve.x.size() != curve.y.size())
      throw std::invalid_argument("plot '" + plot.title + "': the curve '" + curve.label +
                                  "' has not as many x as y");
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!c.x.shows(curve.x[i]) || !c.y.shows(curve.y[i])) continue;
      c.x.include(curve.x[i]);
      c.y.include(curve.y[i]);
    }
  }
  for (const PlotLevel& level : plot.levels) c.y.include(level.y);
  c.x = finished(std::move(c.x), plot.x);
  c.y = finished(std::move(c.y), plot.y);
  std::size_t longest = 0;
  for (const std::string& text : tick_texts(c.y)) longest = std::max(longest, text.size());
  c.left = margin + 2 * line_height + letter * static_cast<double>(longest) - 10;
  return c;
}

}  // namespace

std::string plot_svg(const LinePlot& plot) {
  Canvas c = canvas_for(plot);
  draw_axes(c, plot);
  for (const PlotLevel& level : plot.levels)
    if (c.y.shows(level.y))
      c.line(c.left, c.py(level.y), c.left + plot_width, c.py(level.y), level_style);
  for (std::size_t k = 0; k < plot.curves.size(); ++k) draw_curve(c, plot.curves[k], k);
  const double title_end = c.left + 1.2 * letter * static_cast<double>(length_of(plot.title));
  const double width = std::ceil(std::max(draw_key(c, plot), title_end) + margin);
  const double entries = static_cast<double>(plot.curves.size() + plot.levels.size());
  const double height = std::max(top + plot_height + below, top + line_height * (entries + 1));
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "font-family=\"sans-serif\" font-size=\"12.5\" fill=\"#222\">\n<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n{3}</svg>\n",
      width, height, escape_markup(plot.title), c.body);
}

}  // namespace osculate::io

#include "osculate/io/scene.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "osculate/io/markup.hpp"

namespace osculate::io {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Pixels.
constexpr double panel_width = 340, margin = 14, title_height = 30, caption_height = 22;
constexpr double key_width = 180, key_height = 12;
constexpr int key_steps = 24;

using Colour = std::array<double, 3>;

/// Blue to yellow, of growing lightness, so that it reads without colour vision too.
constexpr std::array<Colour, 5> scale{
    {{72, 104, 190}, {44, 140, 190}, {46, 170, 150}, {130, 200, 90}, {250, 230, 50}}};

Colour colour_of(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (scale.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), scale.size() - 2);
  const double t = at - static_cast<double>(k);
  Colour c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = (1 - t) * scale[k][i] + t * scale[k + 1][i];
  return c;
}

std::string hex(const Colour& c, double light) {
  const auto byte = [&](double v) {
    return static_cast<int>(std::lround(std::clamp(v * light, 0.0, 255.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c[0]), byte(c[1]), byte(c[2]));
}

/// Rows: to the right, upwards, towards the eye.
Eigen::Matrix3d view_of(const Scene& scene) {
  const Vec3 sideways = scene.up.cross(scene.towards_eye);
  if (!(sideways.norm() > 1e-9 * scene.up.norm() * scene.towards_eye.norm()))
    throw std::invalid_argument("the scene is seen along its upward direction");
  Eigen::Matrix3d view;
  view.row(2) = scene.towards_eye.normalized();
  view.row(0) = sideways.normalized();
  view.row(1) = view.row(2).cross(view.row(0));
  return view;
}

struct Range {
  double from = infinity, to = -infinity;
  void include(double v) {
    from = std::min(from, v);
    to = std::max(to, v);
  }
  [[nodiscard]] double span() const { return to > from ? to - from : 1; }
};

bool drawable(const SceneFace& face) {
  return std::isfinite(face.value) && std::all_of(face.corners.begin(), face.corners.end(),
                                                  [](const Vec3& c) { return c.allFinite(); });
}

/// What all panels share.
struct Frame {
  Eigen::Matrix3d view;
  Range x, y, value;
  double pixels = 1;  ///< per unit of length
  [[nodiscard]] double height() const { return pixels * y.span(); }
};

Frame frame_of(const Scene& scene) {
  Frame frame;
  frame.view = view_of(scene);
  for (const ScenePanel& panel : scene.panels)
    for (const SceneFace& face : panel.faces) {
      if (!drawable(face)) continue;
      for (const Vec3& corner : face.corners) {
        const Vec3 seen = frame.view * corner;
        frame.x.include(seen.x());
        frame.y.include(seen.y());
      }
      if (face.coloured) frame.value.include(face.value);
    }
  frame.pixels = std::min(panel_width / frame.x.span(), 2 * panel_width / frame.y.span());
  return frame;
}

struct Seen {
  double depth = 0;
  std::string text;
};

/// The polygon of a face; empty if it is turned away.
Seen seen_face(const SceneFace& face, const Frame& frame, double left, double top) {
  std::array<Vec3, 4> at;
  Vec3 centre = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    at[k] = frame.view * face.corners[k];
    centre += 0.25 * at[k];
  }
  const Vec3 normal = (at[2] - at[0]).cross(at[3] - at[1]);
  if (!(normal.z() > 0)) return {};
  const Vec3 light = Vec3(-0.4, 0.6, 1).normalized();
  const double brightness = 0.5 + 0.5 * std::max(0.0, normal.normalized().dot(light));
  const Colour grey{214, 214, 220};
  const std::string fill =
      hex(face.coloured ? colour_of((face.value - frame.value.from) / frame.value.span()) : grey,
          brightness);
  std::string points;
  for (const Vec3& p : at)
    points += fmt::format("{:.1f},{:.1f} ", left + frame.pixels * (p.x() - frame.x.from),
                          top + frame.pixels * (frame.y.to - p.y()));
  points.pop_back();
  // a rigid face lies under the deformable ones that touch it
  const double depth = centre.z() - (face.coloured ? 0.0 : (at[2] - at[0]).norm());
  return {depth, fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\"/>\n", points, fill,
                             face.coloured ? fill : "#909096")};
}

std::string panel_text(const ScenePanel& panel, const Frame& frame, double left, double top) {
  std::vector<Seen> seen;
  for (const SceneFace& face : panel.faces)
    if (drawable(face))
      if (Seen s = seen_face(face, frame, left, top); !s.text.empty()) seen.push_back(std::move(s));
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Seen& a, const Seen& b) { return a.depth < b.depth; });
  std::string text;
  for (const Seen& s : seen) text += s.text;
  return text + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                            left + 0.5 * frame.pixels * frame.x.span(),
                            top + frame.height() + caption_height - 6,
                            escape_markup(panel.caption));
}

std::string key_text(const Scene& scene, const Frame& frame, double top) {
  if (!(frame.value.to >= frame.value.from)) return {};
  std::string text = fmt::format("<text x=\"{}\" y=\"{:.1f}\">{}: {:.3g}</text>\n", margin,
                                 top + key_height, escape_markup(scene.label), frame.value.from);
  const double left = margin + 7.0 * static_cast<double>(scene.label.size()) + 70;
  for (int k = 0; k < key_steps; ++k)
    text += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{}\" "
        "fill=\"{}\"/>\n",
        left + key_width * k / key_steps, top, key_width / key_steps + 0.5, key_height,
        hex(colour_of((k + 0.5) / key_steps), 1));
  return text + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{:.3g}</text>\n", left + key_width + 8,
                            top + key_height, frame.value.to);
}

}  // namespace

std::string scene_svg(const Scene& scene) {
  if (scene.columns < 1) throw std::invalid_argument("a scene needs at least one column");
  const Frame frame = frame_of(scene);
  const auto columns = static_cast<std::size_t>(scene.columns);
  const std::size_t rows = (scene.panels.size() + columns - 1) / columns;
  const double across = panel_width + margin, down = frame.height() + caption_height + margin;
  const double width = margin + across * static_cast<double>(columns);
  const double key = title_height + down * static_cast<double>(rows);
  const double height = key + key_height + margin;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" "
      "stroke-width=\"0.4\" stroke-linejoin=\"round\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"20\" font-size=\"15\">{3}</text>\n",
      width, height, margin, escape_markup(scene.title));
  for (std::size_t k = 0; k < scene.panels.size(); ++k)
    text += panel_text(scene.panels[k], frame, margin + across * static_cast<double>(k % columns),
                       title_height + down * static_cast<double>(k / columns));
  return text + key_text(scene, frame, key) + "</svg>\n";
}

}  // namespace osculate::io

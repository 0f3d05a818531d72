#pragma once
// Pictures of projection domains as faces of a scene and lines of a plot.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "case.hpp"
#include "osculate/api/domain.hpp"

namespace osculate::verification {

/// The cells of some parts, seen from both sides; coloured by value(place, part), grey where that
/// is NaN.
template <class Wanted, class Value>
void add_faces(const result::DomainPicture& picture, const Wanted& wanted, const Value& value,
               std::vector<io::SceneFace>& faces) {
  for (std::size_t b = 0; b < picture.blocks.size(); ++b) {
    const auto nodes = static_cast<std::size_t>(cell::info(picture.blocks[b].type).nodes);
    for (std::size_t c = 0; nodes > 2 && c < picture.parts[b].size(); ++c) {
      if (!wanted(picture.parts[b][c])) continue;
      const Index* const corner = picture.blocks[b].cell(static_cast<Index>(c));
      io::SceneFace face;
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto node = static_cast<std::size_t>(corner[std::min(k, nodes - 1)]);
        face.corners[k] = picture.points[node];
        sum += 0.25 * value(picture.places[node], picture.parts[b][c]);
      }
      face.coloured = std::isfinite(sum);
      face.value = face.coloured ? sum : 0;
      faces.push_back(face);
      std::reverse(face.corners.begin(), face.corners.end());
      faces.push_back(face);
    }
  }
}

/// The line cells of one part as one curve, broken where they do not go on.
inline io::PlotCurve lines_of(const result::DomainPicture& picture, result::DomainPart part,
                              std::string label) {
  io::PlotCurve curve{std::move(label), {}, {}, io::PlotStyle::line};
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  Index last = -1;
  for (std::size_t b = 0; b < picture.blocks.size(); ++b)
    for (std::size_t c = 0; c < picture.parts[b].size(); ++c) {
      if (picture.parts[b][c] != part) continue;
      const Index* const ends = picture.blocks[b].cell(static_cast<Index>(c));
      const auto add = [&](double x, double y) {
        curve.x.push_back(x);
        curve.y.push_back(y);
      };
      const auto add_point = [&](Index node) {
        const Vec3& p = picture.points[static_cast<std::size_t>(node)];
        add(p.x(), p.y());
      };
      if (ends[0] != last) {
        add(gap, gap);
        add_point(ends[0]);
      }
      add_point(ends[1]);
      last = ends[1];
    }
  return curve;
}

}  // namespace osculate::verification

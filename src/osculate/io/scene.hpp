#pragma once
#include <array>
#include <string>
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::io {

/// A small quadrilateral of a surface, its corners counter-clockwise seen from outside. A triangle
/// has its last corner twice.
struct SceneFace {
  std::array<Vec3, 4> corners;
  double value = 0;      ///< what it is coloured by
  bool coloured = true;  ///< else grey (rigid bodies)
};

/// One state of the bodies.
struct ScenePanel {
  std::string caption;
  std::vector<SceneFace> faces;
};

/// Bodies in space in several states, all seen from the same side and in the same scale.
struct Scene {
  std::string title;
  std::string label;  ///< of the values
  Vec3 towards_eye = {0, -1, 0}, up = {0, 0, 1};
  int columns = 1;
  std::vector<ScenePanel> panels;
};

/// The scene as one self-contained SVG picture on a white ground: parallel projection, faces turned
/// away left out, the others drawn from far to near by the depth of their centres (grey ones moved
/// back by their diagonal, as they lie under what touches them; so faces should be small), shaded
/// and coloured. Faces with a corner or value
/// that is not finite are left out.
///
/// Errors     std::invalid_argument if `up` is along `towards_eye` or there are no columns
/// Tested by  tests/unit/io/test_scene.cpp
[[nodiscard]] std::string scene_svg(const Scene& scene);

}  // namespace osculate::io

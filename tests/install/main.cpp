// The consumer's program: plain arrays in, plain numbers out.
#include <cmath>
#include <cstdio>

#include "osculate/geometry/curve_frame.hpp"
#include "osculate/geometry/curve_jet.hpp"

namespace {

/// A unit circle walked clockwise has the disc on its right: the normal points outwards and the
/// curvature is -1. Values cross the library border in small fixed-size matrices.
bool frame_of_a_circle_is_right() {
  osculate::geometry::CurveJet<2> jet;
  jet.r = {0.0, 1.0};
  jet.r1 = {1.0, 0.0};
  jet.r2 = {0.0, -1.0};
  const osculate::geometry::CurveFrame frame = osculate::geometry::curve_frame(jet);
  return frame.valid && frame.kappa == -1.0 && frame.normal.x() == 0.0 && frame.normal.y() == 1.0;
}

/// The library may use AVX where this program does not: the layout of values must not depend on it.
bool alignment_is_the_same_everywhere() { return alignof(osculate::Mat<2, 2>) == 32; }

}  // namespace

int main() {
  int failed = 0;
  const auto check = [&failed](bool good, const char* what) {
    std::printf("%s: %s\n", good ? "ok" : "FAILED", what);
    failed += good ? 0 : 1;
  };
  check(frame_of_a_circle_is_right(), "frame of a circle");
  check(alignment_is_the_same_everywhere(), "alignment of small matrices");
  return failed == 0 ? 0 : 1;
}

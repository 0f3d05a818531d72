#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "../cases.hpp"
#include "../domain_scene.hpp"
#include "osculate/geometry/point_class.hpp"
#include "osculate/projection/local_domain.hpp"
#include "osculate/projection/reach.hpp"
#include "osculate/projection/reach_bound.hpp"
#include "shapes.hpp"

namespace osculate::verification {
namespace {

using projection::Composed;
using projection::FacetMesh;
using projection::Target;

void add(CaseResult& out, std::string quantity, double computed, double reference, double tolerance,
         std::string source) {
  out.rows.push_back(
      {std::move(quantity), computed, reference, Relation::equal, tolerance, std::move(source)});
}

/// The seven regions at a corner of the cube x > 0, y < 0, z < 0 (KSCPP, Fig. 8) against the
/// closest point.
struct CubeCorner {
  std::array<Vec3, 3> edge{Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)};  ///< OA, OB, OC

  /// 0 to 2 sides, 3 to 5 edges, 6 the corner.
  [[nodiscard]] std::array<bool, 7> regions(const Vec3& p) const {
    std::array<bool, 7> in{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = edge[k], &b = edge[(k + 1) % 3], &c = edge[(k + 2) % 3];
      in[k] = p.dot(a) < 0 && p.dot(b) > 0 && p.dot(c) > 0;  // the side with the normal -a
      const projection::EdgeFaces faces{a, {Vec3(-c), Vec3(-b)}, {b, c}};
      in[3 + k] = p.dot(a) > 0 && in_edge_wedge(faces, Vec3(p - p.dot(a) * a));
    }
    in[6] = projection::in_normal_cone<3>(edge, p);
    return in;
  }
};

void look_at_the_cube(CaseResult& out) {
  const CubeCorner cube;
  const Composed<3> surface(testing::box(Vec3(1, 1, 1)));
  const Vec3 corner(0, 1, 1);  // the box 0..1 seen from this corner is the cube of Fig. 8
  std::mt19937 random(2008);
  std::uniform_real_distribution<double> number(-0.5, 0.5);
  int outside = 0, once = 0, right = 0, inside = 0, none = 0, nearest_side = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p(number(random), number(random), number(random));
    const std::array<bool, 7> in = cube.regions(p);
    const auto count = std::count(in.begin(), in.end(), true);
    const Vec3 foot = surface.nearest(Vec3(corner + p)).r - corner;
    if (p.x() > 0 && p.y() < 0 && p.z() < 0) {
      ++inside;
      none += count == 0;
      nearest_side += (foot - p).norm() < std::min({p.x(), -p.y(), -p.z()}) * (1 + 1e-12);
      continue;
    }
    ++outside;
    once += count == 1;
    std::size_t zeros = 0;
    for (int d = 0; d < 3; ++d) zeros += std::abs(foot[d]) < 1e-12;
    const auto region =
        static_cast<std::size_t>(std::find(in.begin(), in.end(), true) - in.begin());
    right += zeros == (region < 3 ? 1u : region < 6 ? 2u : 3u);
  }
  const auto share = [](int part, int all) { return static_cast<double>(part) / all; };
  const std::string source = "KSCPP 4.2, Fig. 8";
  add(out, "cube corner, outside: share of points in one of 7 regions", share(once, outside), 1, 0,
      source);
  add(out, "cube corner, outside: closest point on that feature", share(right, outside), 1, 0,
      source);
  add(out, "cube corner, inside: share of points in no region", share(none, inside), 1, 0,
      "errata: inside the nearest of the three faces");
  add(out, "cube corner, inside: closest point on the nearest face", share(nearest_side, inside), 1,
      0, "errata: inside the nearest of the three faces");
}

void look_at_figure_6(CaseResult& out) {
  const Composed<2> curve{Target<2>(geometry::Curve(figure_6()))};
  const std::array<std::string, 3> names{"AB", "BC", "CD"};
  const std::array<double, 3> above{0, 1, 0}, below{0, 0, 1};  // 1/bound
  for (int p = 0; p < 3; ++p) {
    const projection::SmoothPiece& piece = curve.pieces()[static_cast<std::size_t>(p)];
    const auto k = static_cast<std::size_t>(p);
    const projection::LocalDomain d = projection::local_domain(
        curve_frame(curve.jet(p, 0.37 * piece.lo + 0.63 * piece.hi)));  // [eq:KSCPP:32]
    add(out, "Fig. 6, " + names[k] + ": 1/bound above", 1 / d.above, above[k], 1e-12,
        "KSCPP Table 1");
    add(out, "Fig. 6, " + names[k] + ": 1/bound below", -1 / d.below, below[k], 1e-12,
        "KSCPP Table 1");
  }
  const result::DomainReport r =
      api::survey_domain(Target<2>(geometry::Curve(figure_6())), "Fig. 6");
  const auto& place = r.picture.places.front();
  add(out, "Fig. 6: continuous bound on AB above", place.even_above, 1, 1e-9, "KSCPP Table 1");
  add(out, "Fig. 6: continuous bound on AB below", place.even_below, 1, 1e-9, "KSCPP Table 1");
  add(out, "Fig. 6: reach above", r.above.reach.value, 1, 1e-8, "KSCPP Table 1");
  add(out, "Fig. 6: reach below", r.below.reach.value, 1, 1e-8, "KSCPP Table 1");
  Picture picture{"figure_6", {}};
  picture.plot.title = "Line and arcs: bounds jump with the curvature, the smallest one does not";
  picture.plot.x.label = "x";
  picture.plot.y.label = "y";
  picture.plot.curves = {lines_of(r.picture, result::DomainPart::surface, "curve ABCD"),
                         lines_of(r.picture, result::DomainPart::sheet_above, "centre, r + n/k"),
                         lines_of(r.picture, result::DomainPart::sheet_below, "centre, r - n/|k|"),
                         lines_of(r.picture, result::DomainPart::even_above, "r + R n, above"),
                         lines_of(r.picture, result::DomainPart::even_below, "r - R n, below")};
  for (const std::size_t k : {1u, 2u}) picture.plot.curves[k].style = io::PlotStyle::marks;
  out.pictures.push_back(std::move(picture));
}

/// Largest way of the foot point on a path that goes parallel to the polyline, per step of the
/// path: continuous on the outside of a corner, not on the inside.
double largest_jump(const Composed<2>& curve, const Vec2& from, const Vec2& to, int steps) {
  Vec2 last = curve.nearest(from).r;
  double jump = 0;
  for (int i = 1; i <= steps; ++i) {
    const Vec2 foot = curve.nearest(Vec2(from + (to - from) * i / steps)).r;
    jump = std::max(jump, (foot - last).norm());
    last = foot;
  }
  return jump;
}

void look_at_figure_7(CaseResult& out) {
  const FacetMesh<2> mesh = polyline({Vec2(0, 0), Vec2(2, 1), Vec2(4, 0), Vec2(6, 1)});
  const Composed<2> curve{Target<2>(mesh)};
  const double step = 2.0 / 1000;
  const std::string source = "KSCPP 4.1.2, Fig. 7";
  // over B: from the domain of AB through the corner's to that of BC
  out.rows.push_back({"Fig. 7, over B: largest way of the foot / step of the path",
                      largest_jump(curve, Vec2(1, 1.5), Vec2(3, 1.5), 1000) / step, 1,
                      Relation::at_most, 0, source});
  const Vec2 b(2, 1);
  int at_b = 0;
  constexpr int directions = 100;
  for (int i = 1; i < directions; ++i) {
    const Vec2 n1 = Vec2(-1, 2).normalized(), n2 = Vec2(1, 2).normalized();
    const Vec2 x = b + 0.4 * projection::turned<2>(n1, n2, static_cast<double>(i) / directions);
    at_b += (curve.nearest(x).r - b).norm() < 1e-12;
  }
  add(out, "Fig. 7: share of the wedge over B that B is nearest to",
      static_cast<double>(at_b) / (directions - 1), 1, 0, source);
  // over C two feet are equally near half way between the sides
  const double jump = largest_jump(curve, Vec2(3.5, 1), Vec2(4.5, 1), 1000);
  add(out, "Fig. 7, over C at height 1: jump of the foot across the bisector", jump, 0.8, 0.01,
      "mirror images, by hand");
  const result::DomainReport r = api::survey_domain(Target<2>(mesh), "Fig. 7");
  add(out, "Fig. 7: reach above (kink at C)", r.above.reach.value, 0, 0, source);
  add(out, "Fig. 7: reach below (kink at B)", r.below.reach.value, 0, 0, source);
  Picture picture{"figure_7", {}};
  picture.plot.title = "A polygon: wedges of the corners and ends";
  picture.plot.x.label = "x";
  picture.plot.y.label = "y";
  picture.plot.curves = {lines_of(r.picture, result::DomainPart::surface, "curve ABCD"),
                         lines_of(r.picture, result::DomainPart::edge_above, "corners, above"),
                         lines_of(r.picture, result::DomainPart::edge_below, "corners, below")};
  out.pictures.push_back(std::move(picture));
}

/// A curved edge: circle of radius 2 (KSCPP, Fig. 9), local bound against the distance.
void look_at_figure_9(CaseResult& out) {
  const auto circle = [](double t) { return testing::circle_in_space(2, t); };
  const geometry::CurveJet<3> j = circle(0.3);
  const geometry::SpaceCurveFrame f = space_curve_frame(j);
  for (const int degrees : {0, 60, 120}) {
    const double phi = degrees * std::numbers::pi / 180;
    const double reference = std::max(0.0, 0.5 * std::cos(phi));
    add(out, "Fig. 9: 1/bound at phi = " + std::to_string(degrees) + " degrees",
        1 / projection::local_limit(f, phi), reference, 1e-12, "KSCPP:42");  // [eq:KSCPP:42]
    // where the distance to neighbours stops being larger, by bisection
    double near = 0, far = 40;
    for (int i = 0; i < 60; ++i) {
      const double r = 0.5 * (near + far);
      const Vec3 x = point_around(j, f, r, phi);
      (((circle(0.3 + 1e-3).r - x).norm() > r) ? near : far) = r;
    }
    add(out, "Fig. 9: the same from the distance of neighbours", far == 40 ? 0 : 1 / far, reference,
        1e-6, "the distance itself");
  }
}

void look_at_the_monkey_saddle(CaseResult& out) {
  const geometry::NurbsPatch patch = monkey_saddle();
  const std::string source = "z = x^3 - 3 x y^2, by hand";
  const Vec2 middle = 0.5 * (patch.lo() + patch.hi());
  const geometry::SurfaceJet j = patch.jet(middle);
  const geometry::SurfaceFrame f = surface_frame(j);
  const geometry::PrincipalCurvatures k = principal_curvatures(f);
  add(out, "monkey saddle: larger curvature at its centre", k.value[0], 0, 1e-12, source);
  add(out, "monkey saddle: smaller curvature at its centre", k.value[1], 0, 1e-12, source);
  const geometry::FlatPoint point = flat_point(j, f, 1);
  double square = 0;
  for (const std::size_t i : {0u, 1u, 2u, 3u})
    square += (i % 3 == 0 ? 1 : 3) * point.cubic[i] * point.cubic[i];
  add(out, "monkey saddle: order of contact with the tangent plane", point.contact_order, 2, 0,
      source);
  add(out, "monkey saddle: lines in the tangent plane",
      point.form == geometry::CubicForm::three_lines ? 3 : 0, 3, 0, source);
  add(out, "monkey saddle: size of the cubic form", std::sqrt(square), 12, 1e-12, source);
  const result::DomainReport r =
      api::survey_domain(Target<3>(geometry::Surface(patch)), "monkey", {.cells = 20});
  add(out, "monkey saddle: planar points found", static_cast<double>(r.flat.size()), 1, 0, source);
  add(out, "monkey saddle: reach above / reach below", r.above.reach.value / r.below.reach.value, 1,
      1e-6, "reflection in its centre");
  Drawing drawing{"monkey_saddle", {}};
  drawing.scene.title = "Monkey saddle z = x^3 - 3 x y^2: planar in its middle";
  drawing.scene.label = "curvature";
  drawing.scene.towards_eye = {0.3, -1, 0.8};
  drawing.scene.columns = 2;
  const auto panel = [&](const std::string& caption, const auto& value) {
    io::ScenePanel next{caption, {}};
    add_faces(
        r.picture, [](result::DomainPart part) { return part == result::DomainPart::surface; },
        value, next.faces);
    drawing.scene.panels.push_back(std::move(next));
  };
  panel("k1, the larger",
        [](const result::DomainPlace& p, result::DomainPart) { return p.larger; });
  panel("-k2, the smaller",
        [](const result::DomainPlace& p, result::DomainPart) { return -p.smaller; });
  out.drawings.push_back(std::move(drawing));
}

void look_at_reach(CaseResult& out) {
  const projection::Reach<2> e = reach(Composed<2>{Target<2>(geometry::Curve(ellipse(3, 0.5)))});
  add(out, "ellipse 3 x 0.5, inside: smallest 1/k", e.above.curvature.value, 0.25 / 3, 1e-9,
      "b^2/a");
  add(out, "ellipse 3 x 0.5, inside: bottleneck/2", e.above.bottleneck.value, 0.5, 1e-9, "b");
  add(out, "ellipse 3 x 0.5, inside: reach", e.above.reach.value, 0.25 / 3, 1e-9, "b^2/a");
  add(out, "ellipse 3 x 0.5: 1 - k zeta at its centre from (0, 0.5)",
      projection::distance_bend(curve_frame(ellipse(3, 0.5).jet(1)), 0.5), 1 - 0.5 * 0.5 / 9, 1e-12,
      "two closest points, and both pass");  // [eq:KSCPP:31]
  const projection::Reach<3> t =
      reach(Composed<3>{Target<3>(geometry::Surface(geometry::Torus{}))});
  add(out, "torus R = 2, r = 1: reach inside", t.below.reach.value, 1, 1e-8, "r");
  add(out, "torus R = 2, r = 1: reach outside", t.above.reach.value, 1, 1e-8, "R - r");
}

/// The reach from below against its exact values (below and above): without anything found from
/// above to go by it must not pass them, with it come close.
template <int Dim>
void prove(CaseResult& out, const std::string& name, const Target<Dim>& target, double below,
           double above, const std::string& source) {
  const projection::ReachBound alone =
      reach_bound<Dim>(target, projection::Reach<Dim>{}, {.effort = 20000});
  const projection::ReachBound told = reach_bound<Dim>(target, reach(Composed<Dim>{target}));
  const auto rows = [&](const std::string& side, double untold, double least, double exact) {
    const std::string quantity = name + ", " + side + ": ";
    if (std::isinf(exact)) {
      add(out, quantity + "1 / proved reach", 1 / least, 0, 0, source);
      return;
    }
    out.rows.push_back({quantity + "reach proved alone", untold, exact * (1 + 1e-9),
                        Relation::at_most, 0, source});
    out.rows.push_back({quantity + "proved reach", least, exact * (0.99 - 1e-8), Relation::at_least,
                        0, source + ", less 1 %"});
  };
  rows("below", alone.below.least, told.below.least, below);
  rows("above", alone.above.least, told.above.least, above);
}

void prove_the_reach(CaseResult& out) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  prove<2>(out, "ellipse 3 x 0.5", geometry::Curve(ellipse(3, 0.5)), infinite, 0.25 / 3, "b^2/a");
  prove<2>(out, "circle of radius 2 by four arcs", geometry::Curve(ellipse(2, 2)), infinite, 2,
           "the radius");
  prove<2>(out, "Fig. 6", geometry::Curve(figure_6()), 1, 1, "KSCPP Table 1");
  prove<2>(out, "Fig. 7", polyline({Vec2(0, 0), Vec2(2, 1), Vec2(4, 0), Vec2(6, 1)}), 0, 0,
           "KSCPP 4.1.2, Fig. 7");
  prove<3>(out, "sphere of radius 0.7", geometry::Surface(geometry::Sphere{Vec3(1, 2, 3), 0.7}),
           0.7, infinite, "the radius");
  prove<3>(out, "torus R = 2, r = 0.6 of NURBS", geometry::Surface(torus_patch(2, 0.6)), 0.6, 1.4,
           "r and R - r");
  prove<3>(out, "plates at the distance 0.4", parallel_plates(), infinite, 0.2,
           "half the distance");
}

/// The surface grey, wedges and cones above it coloured.
io::ScenePanel features(const result::DomainReport& r, const std::string& caption, bool cones) {
  using result::DomainPart;
  io::ScenePanel panel{caption, {}};
  add_faces(
      r.picture,
      [&](DomainPart part) {
        return part == DomainPart::surface || part == DomainPart::edge_above ||
               (cones && part == DomainPart::corner_above);
      },
      [](const result::DomainPlace&, DomainPart part) {
        return part == DomainPart::surface ? std::numeric_limits<double>::quiet_NaN()
                                           : (part == DomainPart::edge_above ? 0.0 : 1.0);
      },
      panel.faces);
  return panel;
}

void draw_the_cube(CaseResult& out) {
  api::DomainOptions options;
  options.samples = 400;
  options.length = 1.4;
  options.cells = 10;
  const result::DomainReport r =
      api::survey_domain(Target<3>(testing::box(Vec3(1, 1, 1))), "cube", options);
  Drawing drawing{"cube_corner", {}};
  drawing.scene.title = "A cube: wedges of its edges and cones of its corners, cut off";
  drawing.scene.label = "edge 0, corner 1";
  drawing.scene.towards_eye = {-1, 0.8, 0.7};
  drawing.scene.columns = 2;
  drawing.scene.panels = {features(r, "edges", false), features(r, "edges and corners", true)};
  out.drawings.push_back(std::move(drawing));
}

/// The rim of a bore: its wedge ends at the axis, the centre of curvature of the edge.
void draw_the_rim(CaseResult& out) {
  api::DomainOptions options;
  options.samples = 400;
  options.length = 6;
  options.cells = 4;
  options.kink = 2;  // between the quadratic facets round the bore
  const result::DomainReport r = api::survey_domain(Target<3>(half_bore()), "rim", options);
  io::ScenePanel panel = features(r, "half of a bore of radius 1 and its upper rim", false);
  std::erase_if(panel.faces, [](const io::SceneFace& face) {  // keep the rim's
    return face.coloured &&
           !std::all_of(face.corners.begin(), face.corners.end(), [](const Vec3& p) {
             return p.y() > -1e-6 && p.z() > -1e-6 && p.head<2>().norm() < 1.001;
           });
  });
  for (io::SceneFace& face : panel.faces)
    face.value = 0.25 * (face.corners[0] + face.corners[1] + face.corners[2] + face.corners[3]).z();
  Drawing drawing{"curved_edge", {}};
  drawing.scene.title = "Domain of a curved edge";
  drawing.scene.label = "height";
  drawing.scene.towards_eye = {0.5, -1, 0.6};
  drawing.scene.panels.push_back(std::move(panel));
  out.drawings.push_back(std::move(drawing));
}

}  // namespace

CaseResult projection_domains(const CaseContext&) {
  CaseResult out;
  look_at_the_cube(out);
  look_at_figure_6(out);
  look_at_figure_7(out);
  look_at_figure_9(out);
  look_at_the_monkey_saddle(out);
  look_at_reach(out);
  prove_the_reach(out);
  draw_the_cube(out);
  draw_the_rim(out);
  return out;
}

}  // namespace osculate::verification

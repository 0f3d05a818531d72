// The proved bound of the reach: known values, brute force, and what it says when it cannot prove.
#include "osculate/projection/reach_bound.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "effort.hpp"
#include "osculate/geometry/surface_frame.hpp"
#include "osculate/projection/piece_bend.hpp"
#include "reach_sample.hpp"
#include "sample_surfaces.hpp"

namespace osculate::projection {
namespace {

using cell::CellType;
using geometry::NurbsCurve;
using geometry::NurbsPatch;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A torus of four by four rational biquadratic pieces, normals out of the tube.
NurbsPatch ring(double radius, double tube) {
  constexpr double w = std::numbers::sqrt2 / 2;
  const std::array<std::array<double, 2>, 9> way{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
  const std::vector<double> knots{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  NurbsPatch patch;
  patch.degree = {2, 2};
  patch.count = {9, 9};
  patch.knots = {knots, knots};
  for (std::size_t i = 0; i < way.size(); ++i)
    for (std::size_t j = 0; j < way.size(); ++j) {
      const double r = radius + tube * way[j][0];
      patch.control.emplace_back(r * way[i][0], r * way[i][1], tube * way[j][1]);
      patch.weights.push_back((i % 2 == 0 ? 1 : w) * (j % 2 == 0 ? 1 : w));
    }
  return patch;
}

/// A plate of n x n facets over 0..1 x 0..2 at the height z, its normals up or down.
void add_plate(FacetMesh<3>& mesh, int n, double z, bool up, CellType type = CellType::quad4) {
  const auto base = static_cast<Index>(mesh.nodes.size());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.nodes.emplace_back(1.0 * i / n, 2.0 * j / n, z);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = base + j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      if (type == CellType::tri3) {
        mesh.facets.push_back(up ? MeshFacet{type, {a, b, c}} : MeshFacet{type, {a, c, b}});
        mesh.facets.push_back(up ? MeshFacet{type, {a, c, d}} : MeshFacet{type, {a, d, c}});
      } else {
        mesh.facets.push_back(up ? MeshFacet{type, {a, b, c, d}} : MeshFacet{type, {a, d, c, b}});
      }
    }
}

FacetMesh<3> plates(int n, bool facing, CellType type = CellType::quad4) {
  FacetMesh<3> mesh;
  add_plate(mesh, n, 0, true, type);
  add_plate(mesh, n, 0.4, !facing, type);
  return mesh;
}

/// What was found, if nothing had been found: the bound has to stop by itself.
template <int Dim>
Reach<Dim> nothing_found() {
  return {};
}

/// The true reach below and above; the bound must not pass them, and come close with and without
/// knowing what was found.
template <int Dim>
void expect_enclosed(const std::string& name, const Target<Dim>& target, double below, double above,
                     double part = 0.9) {
  SCOPED_TRACE(name);
  constexpr double rounding = 1e-9;
  const Reach<Dim> found = reach(Composed<Dim>(target));
  const ReachBound told = reach_bound<Dim>(target, found);
  const ReachBound untold =
      reach_bound<Dim>(target, nothing_found<Dim>(), {.effort = testing::sanitized ? 5000 : 20000});
  const auto check = [&](const SideBound& bound, double value, double least) {
    EXPECT_LE(bound.least, value * (1 + rounding));
    EXPECT_GE(bound.least, least);
  };
  const auto most = [](double value) { return std::isinf(value) ? 1e3 : value; };
  EXPECT_EQ(told.below.gap, Gap::none);
  EXPECT_EQ(told.above.gap, Gap::none);
  check(told.below, below, std::isinf(below) ? infinite : 0.99 * below * (1 - 1e-7));
  check(told.above, above, std::isinf(above) ? infinite : 0.99 * above * (1 - 1e-7));
  check(untold.below, below, part * most(below));
  check(untold.above, above, part * most(above));
}

TEST(ReachBound, EnclosesKnownValuesOfCurves) {
  expect_enclosed<2>("ellipse", Shape<2>(ellipse(3, 0.5)), infinite, 0.25 / 3);
  expect_enclosed<2>("ellipse by its waist", Shape<2>(ellipse(1, 0.9)), infinite, 0.81);
  expect_enclosed<2>("circle", Shape<2>(geometry::Circle{Vec2(1, 2), 2}), 2, infinite);
  expect_enclosed<2>("line", Shape<2>(geometry::InfiniteLine{}), infinite, infinite);
  const double angle = 0.05, turn = 2 * std::numbers::pi;
  expect_enclosed<2>("arc with a gap",
                     Shape<2>(geometry::Arc{Vec2(0, 0), 1, angle, turn - angle, false}),
                     std::sin(angle), std::tan(angle));
  FacetMesh<2> gap{{Vec2(0, 0), Vec2(1, 0), Vec2(1.2, 0.4), Vec2(0.1, 0.4)}, {}};
  gap.facets = {{CellType::line2, {0, 1}}, {CellType::line2, {2, 3}}};
  expect_enclosed<2>("two plates in the plane", gap, 0.5, 0.2);
}

TEST(ReachBound, EnclosesKnownValuesOfSurfaces) {
  expect_enclosed<3>("sphere", Shape<3>(geometry::Sphere{Vec3(1, 2, 3), 0.7}), 0.7, infinite);
  expect_enclosed<3>("bore", Shape<3>(geometry::Cylinder{.radius = 0.6, .inside = true}), infinite,
                     0.6);
  expect_enclosed<3>("torus", Shape<3>(geometry::Torus{}), 1, 1);
  expect_enclosed<3>("torus of NURBS", Shape<3>(ring(2, 0.6)), 0.6, 1.4);
  expect_enclosed<3>("plates", plates(1, true), infinite, 0.2);
  expect_enclosed<3>("plates of many facets", plates(4, true), infinite, 0.2);
  expect_enclosed<3>("plates of triangles", plates(3, true, CellType::tri3), infinite, 0.2);
  expect_enclosed<3>("plates with the same side up", plates(2, false), 0.2, 0.2);
  expect_enclosed<3>("saddle", saddle(1, 1), 1, 1);
  expect_enclosed<3>("saddle of many facets", saddle(3, 3), 1, 1);
}

TEST(ReachBound, CornersAreZeroOnOneSideAndNothingOnTheOther) {
  const FacetMesh<3> cube = box(Vec3(1, 2, 0.5));
  const ReachBound b = reach_bound<3>(cube, reach(Composed<3>(cube)));
  EXPECT_EQ(b.below.least, 0);  // found to be zero: nothing to prove
  EXPECT_EQ(b.above.least, infinite);
  const Target<2> line = polyline({Vec2(0, 0), Vec2(2, 1), Vec2(4, 0), Vec2(6, 1)});
  const ReachBound kinks = reach_bound<2>(line, reach(Composed<2>(line)));
  EXPECT_EQ(kinks.below.least, 0);
  EXPECT_EQ(kinks.above.least, 0);
  const Target<2> square = polyline({Vec2(0, 0), Vec2(0, 1), Vec2(1, 1), Vec2(1, 0)}, true);
  EXPECT_EQ(reach_bound<2>(square, reach(Composed<2>(square))).above.least, infinite);
}

TEST(ReachBound, EdgeOverAFace) {
  // a roof upside down over a plate: its ridge comes to 0.5 of it
  FacetMesh<3> mesh;
  mesh.nodes = {Vec3(-2, -2, 0),    Vec3(2, -2, 0),   Vec3(2, 2, 0),      Vec3(-2, 2, 0),
                Vec3(-1, -1, 1.2),  Vec3(-1, 1, 1.2), Vec3(0.1, -1, 0.5), Vec3(0.1, 1, 0.5),
                Vec3(1.3, -1, 1.1), Vec3(1.3, 1, 1.1)};
  mesh.facets = {{CellType::quad4, {0, 1, 2, 3}},
                 {CellType::quad4, {4, 5, 7, 6}},
                 {CellType::quad4, {6, 7, 9, 8}}};
  const ReachBound b = reach_bound<3>(mesh, reach(Composed<3>(mesh)));
  EXPECT_LE(b.above.least, 0.25);
  EXPECT_GE(b.above.least, 0.2474);
}

TEST(ReachBound, NotBeyondBruteForceOnRandomCurves) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int c = 0; c < 12; ++c) {
    SCOPED_TRACE(c);
    NurbsCurve curve = testing::nurbs_wave(3 + c % 2, 7);
    for (Vec2& p : curve.control) {
      const double x = number(random), y = number(random);
      p += 0.35 * Vec2(x, y);
    }
    const Target<2> target = Shape<2>(curve);
    const Reach<2> found = reach(Composed<2>(target));
    const ReachBound told = reach_bound<2>(target, found);
    const ReachBound untold = reach_bound<2>(target, nothing_found<2>(), {.effort = 5000});
    for (const int side : {-1, 1}) {
      const double brute = dense_bound(curve, side, 600);
      const SideBound& known = side > 0 ? told.above : told.below;
      const SideBound& alone = side > 0 ? untold.above : untold.below;
      const double value = side > 0 ? found.above.reach.value : found.below.reach.value;
      EXPECT_LE(known.least, brute * (1 + 1e-9));
      EXPECT_LE(alone.least, brute * (1 + 1e-9));
      EXPECT_GE(known.least, 0.99 * value * (1 - 1e-7));
      EXPECT_GE(alone.least, 0.98 * value);
    }
  }
}

/// The same over a grid of a patch.
double dense_bound(const NurbsPatch& patch, int side, int n) {
  std::vector<Vec3> r, v;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const geometry::SurfaceJet jet =
          patch.jet(patch.lo() + (Vec2(i, j) / n).cwiseProduct(patch.hi() - patch.lo()));
      r.push_back(jet.r);
      v.push_back(side * surface_frame(jet).normal);
    }
  return smallest_ball<3>(r, v);
}

TEST(ReachBound, NotBeyondBruteForceOnRandomPatches) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int c = 0; c < 4; ++c) {
    SCOPED_TRACE(c);
    NurbsPatch patch = testing::nurbs_hills({3, 2}, {5, 4});
    for (Vec3& p : patch.control) {
      const double x = number(random), y = number(random), z = number(random);
      p += 0.2 * Vec3(x, y, z);
    }
    const Target<3> target = Shape<3>(patch);
    const Reach<3> found = reach(Composed<3>(target), {.samples = 1000});
    const ReachBound told = reach_bound<3>(target, found);
    const ReachBound untold = reach_bound<3>(target, nothing_found<3>(), {.effort = 5000});
    for (const int side : {-1, 1}) {
      const double brute = dense_bound(patch, side, 40);
      const double value = side > 0 ? found.above.reach.value : found.below.reach.value;
      const SideBound& known = side > 0 ? told.above : told.below;
      EXPECT_LE(known.least, brute * (1 + 1e-9));
      EXPECT_LE((side > 0 ? untold.above : untold.below).least, brute * (1 + 1e-9));
      if (known.gap == Gap::none) {
        EXPECT_GE(known.least, 0.99 * value * (1 - 1e-7));
      }
    }
  }
}

TEST(ReachBound, TurnsMovesAndScales) {
  const Mat<3, 3> turned = Eigen::AngleAxisd(0.8, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (const double scale : {1e-9, 1e9}) {
    FacetMesh<3> other = saddle(2, 2);
    for (Vec3& p : other.nodes) p = scale * (turned * p + Vec3(3, -2, 5));
    Reach<3> found;
    found.below.reach.value = found.above.reach.value = scale;
    const ReachBound b = reach_bound<3>(other, found);
    EXPECT_NEAR(b.below.least / scale, 0.99, 1e-9);
    EXPECT_NEAR(b.above.least / scale, 0.99, 1e-9);
    const ReachBound alone = reach_bound<3>(other, nothing_found<3>(), {.effort = 2000});
    EXPECT_LE(alone.below.least / scale, 1 + 1e-9);
    EXPECT_GE(alone.below.least / scale, 0.95);
  }
}

TEST(ReachBound, SaysWhyNothingIsProved) {
  const auto gap_of = [](const Target<3>& target) {
    return reach_bound<3>(target, nothing_found<3>(), {.effort = 20000}).above;
  };
  EXPECT_EQ(gap_of(Shape<3>(geometry::Cone{.half_angle = 0.5, .to = 2})).gap, Gap::shape);
  // a plate with a notch: three quarters of a square
  FacetMesh<3> notched;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 2; ++i) notched.nodes.emplace_back(i, j, 0);
  notched.facets = {{CellType::quad4, {0, 1, 4, 3}},
                    {CellType::quad4, {1, 2, 5, 4}},
                    {CellType::quad4, {3, 4, 7, 6}}};
  EXPECT_EQ(gap_of(notched).gap, Gap::notch);
  EXPECT_EQ(gap_of(notched).least, 0);
  // two plates through each other
  FacetMesh<3> crossed;
  crossed.nodes = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0),
                   Vec3(0, -1, -1), Vec3(0, 1, -1), Vec3(0, 1, 1), Vec3(0, -1, 1)};
  crossed.facets = {{CellType::quad4, {0, 1, 2, 3}}, {CellType::quad4, {4, 5, 6, 7}}};
  EXPECT_EQ(gap_of(crossed).gap, Gap::touch);
  EXPECT_EQ(gap_of(crossed).least, 0);
  // a pole: one edge of the patch is a point
  NurbsPatch cap;
  cap.degree = {2, 1};
  cap.count = {3, 2};
  cap.knots = {{{0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}}};
  for (const Vec2& p : {Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
    cap.control.emplace_back(p.x(), p.y(), 0);
    cap.control.emplace_back(0, 0, 1);
    cap.weights.insert(cap.weights.end(), {1, 1});
  }
  EXPECT_EQ(gap_of(Shape<3>(cap)).gap, Gap::pole);
  EXPECT_EQ(gap_of(Shape<3>(cap)).least, 0);
  for (const Gap gap :
       {Gap::irregular, Gap::kink, Gap::notch, Gap::pole, Gap::touch, Gap::effort, Gap::shape})
    EXPECT_GT(name(gap).size(), 10u);
}

TEST(ReachBound, KinksThatOpenToTheOtherSideAreFoundWithoutHelp) {
  const auto gap_of = [](const auto& mesh, int side) {
    constexpr int dim = std::is_same_v<std::decay_t<decltype(mesh)>, FacetMesh<2>> ? 2 : 3;
    const ReachBound b = reach_bound<dim>(mesh, nothing_found<dim>());
    return side > 0 ? b.above : b.below;
  };
  EXPECT_EQ(gap_of(box(Vec3(1, 2, 0.5)), -1).gap, Gap::kink);
  EXPECT_EQ(gap_of(box(Vec3(1, 2, 0.5)), 1).least, infinite);
  const FacetMesh<2> roof = polyline({Vec2(0, 0), Vec2(1, 1), Vec2(2, 0)});
  EXPECT_EQ(gap_of(roof, -1).gap, Gap::kink);
  EXPECT_EQ(gap_of(roof, 1).gap, Gap::none);
  FacetMesh<2> twisted = roof;
  twisted.facets[1].nodes = {2, 1};
  EXPECT_EQ(gap_of(twisted, 1).gap, Gap::irregular);
  FacetMesh<3> folded;
  folded.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(2, 0, 0.1)};
  folded.facets = {{CellType::quad4, {0, 1, 2, 3}}, {CellType::tri3, {1, 2, 4}}};
  EXPECT_EQ(gap_of(folded, 1).gap, Gap::irregular);
}

TEST(ReachBound, SidesOfABodyThatTouchOneAnotherAreNotProved) {
  FacetMesh<2> mesh;  // a polyline that comes back to a node's place without sharing it
  mesh.nodes = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0.5, 0)};
  mesh.facets = {{CellType::line2, {0, 1}}, {CellType::line2, {2, 3}}};
  const ReachBound b = reach_bound<2>(mesh, nothing_found<2>());
  EXPECT_EQ(b.above.least, 0);
  EXPECT_EQ(b.above.gap, Gap::touch);
}

/// The middle part of a span of a patch as a piece, 1/size of it both ways.
template <class Body>
void at_smaller_and_smaller_pieces(const NurbsPatch& patch, const Body& body) {
  const CellComplex<3> all = make_complex(patch);
  Piece<3> piece = all.set.pieces.front();
  const Control<3> whole = control_of(piece, all.set.control);
  std::vector<ControlPoint<3>> control(whole.begin(), whole.end());
  for (int level = 0; level < 7; ++level) {
    body(level, piece, control);
    for (const int direction : {0, 1}) {
      std::array<Piece<3>, 2> halves;
      std::array<std::vector<ControlPoint<3>>, 2> points;
      cut(piece, control, direction, halves, points);
      const auto taken = static_cast<std::size_t>((level + direction) % 2);
      piece = halves[taken];
      control = points[taken];
    }
  }
}

TEST(LargestBend, ExceedsTheCurvatureByTheSquareOfTheSize) {
  for (const NurbsPatch& patch : {testing::nurbs_hills({3, 2}, {5, 4}), ring(2, 0.6)})
    for (const int side : {-1, 1}) {
      double last = infinite;
      int orders = 0;
      at_smaller_and_smaller_pieces(patch, [&](int level, const Piece<3>& piece,
                                               const std::vector<ControlPoint<3>>& control) {
        const Cone<3> n = normal_cone<3>(piece, control);
        const double bound = largest_bend<3>(piece, control, {Vec3(side * n.axis), n.angle});
        double largest = -infinite;
        constexpr int grid = 12;
        for (int i = 0; i <= grid; ++i)
          for (int j = 0; j <= grid; ++j) {
            const Vec2 xi = piece.cell_xi(Vec2(i, j) / grid);
            const geometry::PrincipalCurvatures k =
                principal_curvatures(surface_frame(patch.jet(xi)));
            largest = std::max(largest, side > 0 ? k.value[0] : -k.value[1]);
          }
        const double excess = bound - largest;
        EXPECT_GE(excess, -1e-9 * std::abs(largest)) << level;
        if (level >= 4 && last < infinite) {
          EXPECT_GT(std::log2(last / excess), 1.6) << level;  // order 2
          ++orders;
        }
        last = excess;
      });
      EXPECT_EQ(orders, 3);
    }
}

TEST(LargestBend, OfASideIsTheBendOfTheCurve) {
  const CellComplex<3> all = make_complex(testing::nurbs_cylinder(2, 3));
  for (const Piece<3>& piece : all.set.pieces) {
    const Control<3> control = control_of(piece, all.set.control);
    const Cone<3> n = normal_cone<3>(piece, control);
    for (const std::size_t side : {2u, 3u}) {  // the circles
      EXPECT_LT(largest_side_bend(piece, control, side, n), -0.45);
      const double inwards = largest_side_bend(piece, control, side, {Vec3(-n.axis), n.angle});
      EXPECT_GE(inwards, 0.5);
      EXPECT_LT(inwards, 0.53);
    }
    EXPECT_NEAR(largest_side_bend(piece, control, 0, n), 0, 1e-12);  // straight
  }
}

TEST(ReachFeatures, ArcIsTheSameAsNurbs) {
  for (const bool inside : {false, true}) {
    const geometry::Arc arc{Vec2(1, -2), 1.5, 0.3, 4.9, inside};
    const NurbsCurve curve = as_nurbs(arc);
    EXPECT_LT((curve.jet(curve.lo()).r - arc.jet(arc.lo()).r).norm(), 1e-14);
    EXPECT_LT((curve.jet(curve.hi()).r - arc.jet(arc.hi()).r).norm(), 1e-14);
    for (const double t : {0.1, 0.37, 0.5, 0.93}) {
      const geometry::CurveJet<2> j = curve.jet(curve.lo() + t * (curve.hi() - curve.lo()));
      EXPECT_NEAR((j.r - arc.center).norm(), 1.5, 1e-14);
      EXPECT_NEAR(curve_frame(j).kappa, curve_frame(arc.jet(arc.lo())).kappa, 1e-12);
    }
  }
}

TEST(ReachFeatures, BordersEdgesAndCornersOfAPlateAndABox) {
  const auto count = [](const ReachFeatures<3>& features, FeatureKind kind) {
    return std::count_if(features.list.begin(), features.list.end(),
                         [&](const ReachFeature<3>& f) { return f.kind == kind; });
  };
  FacetMesh<3> plate;
  add_plate(plate, 2, 0, true);
  const ReachFeatures<3> open = features_of(make_complex<3>(plate), 1, 1e-4);
  EXPECT_EQ(count(open, FeatureKind::face), 4);
  EXPECT_EQ(count(open, FeatureKind::edge), 8);
  EXPECT_EQ(count(open, FeatureKind::point), 8);
  EXPECT_EQ(count(open, FeatureKind::rim), 16);
  const ReachFeatures<3> sharp = features_of(make_complex<3>(box(Vec3(1, 2, 3))), 1, 1e-4);
  EXPECT_EQ(count(sharp, FeatureKind::face), 6);
  EXPECT_EQ(count(sharp, FeatureKind::edge), 12);
  EXPECT_EQ(count(sharp, FeatureKind::point), 8);
  EXPECT_EQ(count(sharp, FeatureKind::rim), 0);
}

}  // namespace
}  // namespace osculate::projection

// Shapes and keys by their words in model files, and what the C interface has beside contact.
#include <cmath>
#include <cstring>
#include <numbers>

#include "c_host.hpp"
#include "osculate/deck/explain.hpp"

namespace osculate {
namespace {

using testing::CContact;
using testing::CHost;
using testing::good;
using testing::made;
using testing::Sample;

struct ShapeNumbers {
  const char* shape;
  std::vector<std::pair<const char*, std::vector<double>>> numbers;
};

/// Closest points of a shape by its words in C, and by its struct in C++.
template <int Dim>
void expect_shape(const ShapeNumbers& words, const Shape<Dim>& shape) {
  SCOPED_TRACE(words.shape);
  const auto surface = made<testing::CSurface>(osculate_surface_create, Dim);
  good(osculate_surface_add_shape(surface.get(), words.shape));
  for (const auto& [key, values] : words.numbers)
    good(osculate_surface_set_list(surface.get(), key, values.data(), values.size()));
  const auto closest = made<testing::CClosest>(osculate_closest_points_create, surface.get(),
                                               static_cast<const double*>(nullptr), std::size_t{0});
  std::vector<double> points;
  for (int i = 0; i < 5 * Dim; ++i) points.push_back(0.3 * i - 1 + std::sin(5.0 * i));
  const ClosestPointArrays<Dim> a = ClosestPoints<Dim>(shape).find(points);
  std::vector<double> foot(points.size()), distance(5), margin(5), xi(10);
  std::vector<std::int32_t> status(5), feature(5), facet(5), unique(5);
  const osculate_closest_arrays out{status.data(), feature.data(),  facet.data(),  xi.data(),
                                    foot.data(),   distance.data(), margin.data(), unique.data()};
  good(osculate_find_closest(closest.get(), points.data(), points.size(), osculate_certified, 2,
                             &out));
  const auto same = [](const auto& ours, const auto& theirs, std::size_t size) {
    EXPECT_EQ(std::memcmp(ours.data(), theirs.data(), size), 0);
  };
  same(a.point, foot, points.size() * sizeof(double));
  same(a.distance, distance, 5 * sizeof(double));
  same(a.margin, margin, 5 * sizeof(double));
  same(a.xi, xi, 10 * sizeof(double));
  same(a.facet, facet, 5 * sizeof(std::int32_t));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(status[i], static_cast<int>(a.status[i]));
    EXPECT_EQ(feature[i], static_cast<int>(a.feature[i]));
    EXPECT_EQ(unique[i], a.unique[i]);
  }
}

TEST(CInterface, ShapesByTheirWordsHaveTheBitsOfTheCppLibrary) {
  constexpr double degree = std::numbers::pi / 180.0;
  const double w = std::sqrt(0.5);
  expect_shape<2>({"line", {{"point", {1, 2}}, {"normal", {1, 3}}}}, Line{{1, 2}, {1, 3}});
  expect_shape<2>({"segment", {{"from", {1, 2}}, {"to", {-1, 3}}}}, Segment{{1, 2}, {-1, 3}});
  expect_shape<2>({"circle", {{"center", {1, 2}}, {"radius", {3}}, {"inside", {1}}}},
                  Circle{{1, 2}, 3, true});
  expect_shape<2>({"arc", {{"center", {1, 2}}, {"radius", {3}}, {"from", {10}}, {"to", {200}}}},
                  Arc{{1, 2}, 3, 10 * degree, 200 * degree});
  expect_shape<2>(
      {"nurbs",
       {{"degree", {2}}, {"knots", {0, 0, 0, 1, 1, 1}}, {"control", {1, 0, 1, 1, 1, w, 0, 1, 1}}}},
      NurbsCurve{2, {0, 0, 0, 1, 1, 1}, {{1, 0}, {1, 1}, {0, 1}}, {1, w, 1}});
  expect_shape<3>({"plane", {{"point", {1, 2, 3}}, {"normal", {1, 1, 3}}}},
                  Plane{{1, 2, 3}, {1, 1, 3}});
  expect_shape<3>({"sphere", {{"center", {1, 2, 3}}, {"radius", {0.5}}}}, Sphere{{1, 2, 3}, 0.5});
  expect_shape<3>(
      {"cylinder", {{"point", {1, 2, 3}}, {"axis", {0, 1, 1}}, {"radius", {0.5}}, {"length", {4}}}},
      Cylinder{{1, 2, 3}, {0, 1, 1}, 0.5, false, 4});
  expect_shape<3>({"cone",
                   {{"apex", {1, 2, 3}},
                    {"axis", {0, 1, 1}},
                    {"half_angle", {30}},
                    {"from", {0.5}},
                    {"to", {4}},
                    {"inside", {0}}}},
                  Cone{{1, 2, 3}, {0, 1, 1}, 30 * degree, false, 0.5, 4});
  expect_shape<3>(
      {"torus",
       {{"center", {1, 2, 3}}, {"axis", {0, 1, 1}}, {"radius", {3}}, {"tube_radius", {0.5}}}},
      Torus{{1, 2, 3}, {0, 1, 1}, 3, 0.5});
  expect_shape<3>(
      {"nurbs_patch",
       {{"degree", {2, 1}},
        {"knots[0]", {0, 0, 0, 1, 1, 1}},
        {"knots[1]", {0, 0, 1, 1}},
        {"count", {3, 2}},
        {"control", {0, 0, 0, 1, 0, 1, 0, 1, 1, 0, 1, w, 1, 1, 1, w, 2, 0, 0, 1, 2, 1, 0, 1}}}},
      NurbsSurface{{2, 1},
                   {{{0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}}},
                   {3, 2},
                   {{0, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {2, 0, 0}, {2, 1, 0}},
                   {1, 1, w, w, 1, 1}});
}

/// A node above a rigid ball on its frame, as in tests/install/main.cpp.
TEST(CInterface, AShapeStandsOnAFrame) {
  const auto ball = made<testing::CSurface>(osculate_surface_create, 3);
  good(osculate_surface_add_shape(ball.get(), "sphere"));
  good(osculate_surface_set(ball.get(), "radius", 2));
  const std::int32_t frame[] = {0, 1, 2, 3}, top[] = {4};
  good(osculate_surface_set_frame(ball.get(), frame, 4, 0));
  const auto node = made<testing::CSurface>(osculate_surface_create, 3);
  good(osculate_surface_add_points(node.get(), top, 1));
  const auto contact = made<CContact>(osculate_contact_create, 3);
  good(osculate_contact_set_master(contact.get(), ball.get()));
  good(osculate_contact_set_slave(contact.get(), node.get()));
  good(osculate_contact_set(contact.get(), "normal.penalty", 50));
  good(osculate_contact_set_word(contact.get(), "weight", "node"));
  const std::vector<double> x{5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1, 5, 0, 1.9};
  CHost host(contact.get(), x);
  host.evaluate(x);
  EXPECT_NEAR(host.force()[14], -5, 1e-12);
  EXPECT_NEAR(host.points()[0].gap, -0.1, 1e-14);
}

// ---- names --------------------------------------------------------------------------------------

/// What is set by a name of a model file is what the name means there.
TEST(CInterface, KeysAreThoseOfModelFiles) {
  const auto contact = made<CContact>(osculate_contact_create, 3);
  ASSERT_EQ(osculate_contact_set(contact.get(), "?", 1), osculate_refused);
  std::string known = osculate_error();
  known = known.substr(known.find("known: ") + 7);
  EXPECT_EQ(known.substr(0, 14), "normal.penalty");
  for (const char* key :
       {"normal.penalty", "normal.exponential.pressure", "normal.table", "normal.damping.viscous",
        "normal.tolerance", "friction.coulomb.decay.distance", "friction.rate_and_state.a",
        "friction.viscous.coefficient", "sampling.gauss", "sampling.subdomains", "edges.angle",
        "tangent.main", "offset.master", "smoothing.angle", "search.depth"}) {
    EXPECT_NO_THROW((void)deck::explain_model_key(std::string("contact.") + key)) << key;
    ASSERT_EQ(osculate_contact_set_list(contact.get(), key, nullptr, 0),
              std::string(key) == "normal.table" ? osculate_ok : osculate_refused);
    if (std::string(key) != "normal.table") {
      EXPECT_EQ(std::string(osculate_error()).find("unknown"), std::string::npos) << key;
    }
  }
}

TEST(CInterface, PenaltiesAreThoseOfTheCppLibrary) {
  const osculate_layer soft{2000, 0.3, 2, 1}, stiff{210000, 0.3, 1, 2};
  const Layer s{2000, 0.3, 2, 1}, m{210000, 0.3, 1, 2};
  double normal = 0, shear = 0;
  good(osculate_automatic_penalties(&soft, 1, &stiff, 1, &normal, &shear));
  const Penalties expected = automatic_penalties({&s, 1}, {&m, 1});
  EXPECT_EQ(normal, expected.normal);
  EXPECT_EQ(shear, expected.shear);
  EXPECT_EQ(osculate_penalty_factor(12), penalty_factor(12));
}

TEST(CInterface, DerivativesAreChecked) {
  const Sample<3> s = Sample<3>();
  const CContact contact = testing::c_sample(s);
  CHost host(contact.get(), s.x);
  const std::vector<double> x = s.moved(0.001, 0);
  osculate_derivative_check out{};
  good(osculate_check_derivative(host.evaluator.get(), x.data(), x.size(), host.history.get(),
                                 nullptr, nullptr, nullptr, 1e-3, &out));
  const Evaluator<3> evaluator = s.make();
  const DerivativeCheck expected = check_derivative<3>(evaluator, x, evaluator.initial_history(s.x),
                                                       {}, evaluator.initial_multipliers(), 1e-3);
  EXPECT_EQ(out.order, expected.order);
  EXPECT_EQ(out.error, expected.error);
  EXPECT_EQ(out.passed, 1);
  EXPECT_TRUE(expected.passed());
}

}  // namespace
}  // namespace osculate

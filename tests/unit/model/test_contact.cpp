// Contact pairs in analyses: patch tests, balance, friction, the same bits.
#include <Eigen/Geometry>

#include "contact_tools.hpp"
#include "osculate/model/fields.hpp"

namespace osculate::model {
namespace {

constexpr double young = 100, eps_n = 500, eps_t = 300;

template <class Dimension>
class ContactOf : public ::testing::Test {};
TYPED_TEST_SUITE(ContactOf, Dimensions, DimensionNames);

TYPED_TEST(ContactOf, AForceOnARigidBodyIsCarriedByItsContact) {
  constexpr int Dim = TypeParam::value;
  const Numbers load = either<Dim>({0.5, -8}, {0.5, 0.3, -8});
  const auto force = Eigen::Map<const Vec<Dim>>(load.data());
  for (const Tool<Dim>& tool : tools<Dim>()) {
    SCOPED_TRACE(tool.name);
    BasicModel<Dim> m =
        block_under(tool, rubber<Dim>(young),
                    {0.5, pairing::Weight::reference_area, contact::ResidualForm::full});
    load_body(m, load);
    drive_body(m, either<Dim>({0}, {0, 0, 0}), Dim);
    (void)run_to_end(m, [&](const Converged<Dim>& c) {
      const Forces& f = c.system.forces();
      EXPECT_LT(resultant(m, f.internal).norm(), 1e-11);
      EXPECT_LT(resultant(m, f.contact).norm(), 1e-11);
      EXPECT_EQ(resultant(m, f.external), force);
      Vec<Dim> support = Vec<Dim>::Zero();
      for (const Index n : nodes_of(m, "block.bottom"))
        support += reactions(c.system).template segment<Dim>(Dim * n);
      EXPECT_LT((support + force).norm(), 1e-7);
      for (int d = 0; d < Dim; ++d) {
        EXPECT_NEAR(c.of_body(with_axis("rf", d)), 0, 1e-7);
        EXPECT_NEAR(c.of_pair(with_axis("force_", d)), force[d], 1e-7);
      }
    });
  }
}

/// A weight on a rigid plate sinks until the block carries it; its moment turns it.
TYPED_TEST(ContactOf, ALoadedRigidPlateFindsItsPlace) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1}, {4, 2, 2}}, elastic<Dim>(young, 0.25));
  hold(m, "block.bottom");
  const Vec<Dim> at = either<Dim>(Vec3(1, 0.5, 1));
  pairing::Boundary<Dim> plate;
  if constexpr (Dim == 2)
    plate = add_shape<2>(m, geometry::InfiniteLine{{0, 1}, {0, -1}}, at);
  else
    plate = add_shape<3>(m, geometry::Plane{{0, 0, 1}, {0, 0, -1}}, at);
  PairChoices choices;
  choices.eps_n = 1000;
  add_pair<Dim>(m, std::move(plate), boundary_of(m, "block.top"), choices);
  drive_body(m, either<Dim>({0}, {0, 0}));
  if (Dim == 3) drive_body(m, {0}, 5);
  load_body(m, either<Dim>({0, -3, -0.05}, {0, 0, -3, 0.02, -0.05}));
  (void)run_to_end(m, [&](const Converged<Dim>& c) {
    for (const std::string what : {Dim == 2 ? "rmz" : "rmx", Dim == 2 ? "rmz" : "rmy"})
      EXPECT_NEAR(c.of_body(what), 0, 1e-7) << what;
    EXPECT_NEAR(c.of_body(with_axis("rf", up<Dim>)), 0, 1e-7);
    EXPECT_NEAR(c.of_pair(with_axis("force_", up<Dim>)), -3, 1e-7);
    EXPECT_LT(c.of_body(with_axis("u", up<Dim>)), 0);
    EXPECT_LT(c.of_body(Dim == 2 ? "rz" : "ry"), 0);
    EXPECT_GT(Dim == 2 ? -c.of_body("rz") : c.of_body("rx"), 0);
    EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.bottom"), with_axis("rf", up<Dim>)), 3, 1e-7);
  });
}

// ---- a block on a floor -------------------------------------------------------------------------

/// A fixed rigid floor at height 0 with its body below; its reference is the origin.
template <int Dim>
using Floor = std::function<pairing::Boundary<Dim>(BasicModel<Dim>&)>;

pairing::FacetSurface add_grid(Model3& m, const mesh::GridSpec& grid, bool flip = false) {
  const std::size_t first = m.mesh.nodes.size();
  mesh::append_grid(m.mesh, grid);
  take_over(m, first);
  add_rigid<3>(m, {0, 0, 0}, nodes_of(m, grid.name));
  return boundary_of(m, grid.name, flip);
}

std::vector<Floor<2>> floors(Vec2) {
  return {[](Model& m) {
            return add_shape<2>(m, geometry::InfiniteLine{}, {0, 0});
          },
          [](Model& m) {
            return add_shape<2>(m, geometry::InfiniteLine{{5, -7}, {0, 3}}, {0, 0}, {2, 7});
          },
          [](Model& m) {
            pairing::Chain chain = add_polyline(m, {{-1, 0}, {0.3, 0}, {1.7, 0}, {3, 0}});
            m.rigid.back().reference = {0, 0};
            return chain;
          }};
}
std::vector<Floor<3>> floors(Vec3) {
  using cell::CellType;
  return {
      [](Model3& m) {
        return add_shape<3>(m, geometry::Plane{}, {0, 0, 0});
      },
      [](Model3& m) {
        return add_shape<3>(m, geometry::Plane{{5, -3, -1}, {0, 0, 3}}, {0, 0, 0}, {2, 7, 1});
      },
      [](Model3& m) {
        return add_grid(m, {"g", {-1, -1, 0}, {4, 0, 0}, {0, 4, 0}, {3, 3}, CellType::quad4});
      },
      [](Model3& m) {
        return add_grid(m, {"g", {-1, -1, 0}, {0, 4, 0}, {4, 0, 0}, {3, 3}, CellType::tri3}, true);
      }};
}

template <int Dim>
solid::Section<Dim> uniaxial() {
  solid::Section<Dim> section = elastic<Dim>(young);
  if constexpr (Dim == 2) section.assumption = solid::Assumption::plane_stress;
  return section;
}

/// The block is the slave, the floor does not move.
template <int Dim>
BasicModel<Dim> block_on(const Floor<Dim>& floor, const PairChoices& choices = {}) {
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1}, {2, 2, 2}, 0.2}, uniaxial<Dim>());
  pairing::Boundary<Dim> master = floor(m);
  add_pair<Dim>(m, std::move(master), boundary_of(m, "block.bottom"), choices);
  drive_body(m, Numbers(body::motions<Dim>, 0.0));
  return m;
}

/// Uniform pressure through the pair: p = E u / (h + E / eps_N).
TYPED_TEST(ContactOf, PatchTestThroughAPair) {
  constexpr int Dim = TypeParam::value;
  const double p = young * 0.02 / (1 + young / eps_n), wide = 0.3 * p / young;
  for (const Floor<Dim>& floor : floors(Vec<Dim>{})) {
    BasicModel<Dim> m = block_on(floor);
    for (int d = 0; d < up<Dim>; ++d) {
      std::vector<Index> side = nodes_of(m, d == 0 ? "block.left" : "block.front");
      prescribe(m, side, d, 0);
    }
    prescribe(m, nodes_of(m, "block.top"), up<Dim>, -0.02);
    (void)run_to_end(m, [&](const Converged<Dim>& c) {
      const BasicNodalFields<Dim> f = nodal_fields(c.system, m, c.state);
      for (const Index n : nodes_of(m, "block"))
        for (std::size_t i = 0; i < f.stress[0].size(); ++i)
          EXPECT_NEAR(f.stress[static_cast<std::size_t>(n)][i], i == up<Dim> ? -p : 0.0, 1e-11)
              << n << " " << i;
      for (int d = 0; d < Dim; ++d) {
        EXPECT_NEAR(c.of_pair(with_axis("force_", d)), d == up<Dim> ? 2 * p : 0, 1e-11);
        EXPECT_NEAR(c.of_body(with_axis("rf", d)), d == up<Dim> ? 2 * p : 0, 1e-11);
      }
      EXPECT_NEAR(c.of_pair("normal_force"), 2 * p, 1e-11);
      EXPECT_NEAR(c.of_pair("shear_force"), 0, 1e-15);
      EXPECT_NEAR(c.of_pair("max_pressure"), p, 1e-11);
      EXPECT_NEAR(c.of_pair("max_penetration"), p / eps_n, 1e-13);
      EXPECT_NEAR(c.of_pair("area"), 2, 1e-14);
      EXPECT_EQ(c.of_pair("closed"), Dim == 2 ? 3 : 9);
      EXPECT_EQ(c.of_pair("open"), 0);
      EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.top"), with_axis("rf", up<Dim>)), -2 * p, 1e-11);
      EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.right"), "ux"), 2 * wide, 1e-13);
      EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.bottom"), with_axis("u", up<Dim>)), -p / eps_n,
                  1e-13);
      // The block has become wider, and with it the centre of pressure is farther away.
      EXPECT_NEAR(c.of_body(Dim == 2 ? "rmz" : "rmy"), (Dim == 2 ? 2 : -2) * p * (1 + wide), 1e-11);
      if constexpr (Dim == 3) {
        EXPECT_NEAR(c.of_body("rmx"), p * (1 + wide), 1e-11);
      }
    });
  }
}

/// The other way round: the meshed surface is the slave.
TYPED_TEST(ContactOf, NodesOfARigidSurfaceAreSlaves) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1}, {4, 2, 2}}, elastic<Dim>(young, 0.25));
  pairing::Boundary<Dim> floor;
  if constexpr (Dim == 2) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 12; ++i) points.emplace_back(-0.5 + 0.25 * i, 0);
    floor = add_polyline(m, points);
  } else {
    floor = add_grid(m, {"g", {-0.5, -0.5, 0}, {3, 0, 0}, {0, 2, 0}, {12, 8}});
  }
  PairChoices choices;
  choices.weight = pairing::Weight::node;
  choices.eps_n = 100;
  add_pair<Dim>(m, boundary_of(m, "block.bottom"), std::move(floor), choices);
  drive_body(m, Numbers(body::motions<Dim>, 0.0));
  hold(m, "block.top");
  for (PrescribedDof& p : m.steps[0].prescribed)
    if (p.dof < body_dof(m, 0, 0) && p.dof % Dim == up<Dim>) p.ramp.target = -0.01;
  (void)run_to_end(m, [&](const Converged<Dim>& c) {
    const double force = c.of_pair(with_axis("force_", up<Dim>));  // on the slave, the floor
    const std::string reaction = with_axis("rf", up<Dim>);
    EXPECT_LT(force, -0.1);
    EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.top"), reaction), force, 1e-9);
    EXPECT_NEAR(c.of_body(reaction), -force, 1e-9);
  });
}

/// The lower half of a cylinder along y: a quarter to each side of its lowest line.
geometry::NurbsPatch half_cylinder() {
  geometry::NurbsPatch patch;
  patch.degree = {2, 1};
  patch.count = {5, 2};
  patch.knots = {{{0, 0, 0, 1, 1, 2, 2, 2}, {0, 0, 1, 1}}};
  const std::array<Vec2, 5> xz{{{4, 4}, {4, 1}, {1, 1}, {-2, 1}, {-2, 4}}};
  for (std::size_t k = 0; k < 5; ++k)
    for (const double y : {-1.0, 2.0}) {
      patch.control.emplace_back(xz[k].x(), y, xz[k].y());
      patch.weights.push_back(k % 2 == 0 ? 1 : std::sqrt(0.5));
    }
  return patch;
}

/// A circular cylinder and a rational patch that is the same surface press the same way.
TEST(Contact3, ACylinderAndItsNurbsPatchPressAlike) {
  ASSERT_EQ(geometry::validate(half_cylinder()), "");
  const auto run = [&](const geometry::Surface& shape) {
    Model3 m = block<3>({{0, 0, 0}, {2, 1, 1}, {4, 2, 2}}, elastic<3>(young, 0.25));
    hold(m, "block.bottom");
    pairing::FacetSurface tool = add_shape<3>(m, shape, {1, 0, 4});
    PairChoices choices;
    choices.mu = 0.2;
    choices.eps_n = 1000;
    choices.eps_t = 200;
    add_pair<3>(m, std::move(tool), boundary_of(m, "block.top"), choices);
    drive_body(m, {0.03, 0, -0.05, 0, 0, 0});
    m.steps[0].increments = 2;
    std::vector<double> forces;
    (void)run_to_end(m, [&](const Converged<3>& c) {
      for (const char* what : {"force_x", "force_z"}) forces.push_back(c.of_pair(what));
      for (const char* what : {"rfx", "rfz", "rmy"}) forces.push_back(c.of_body(what));
    });
    return forces;
  };
  const std::vector<double> nurbs = run(half_cylinder());
  const std::vector<double> cylinder = run(geometry::Cylinder{{1, 0, 4}, {0, 1, 0}, 3});
  ASSERT_EQ(nurbs.size(), cylinder.size());
  EXPECT_LT(cylinder.at(1), -0.01);
  EXPECT_GT(cylinder.at(0), 1e-4);
  for (std::size_t i = 0; i < nurbs.size(); ++i) EXPECT_NEAR(nurbs[i], cylinder[i], 1e-9) << i;
}

/// The block moved as a whole by (a, b, -d): sticking shear eps_T (a, b) against the motion,
/// at most mu p. Slip is the whole way in contact.
TEST(Contact3, ReportsShearAndSlipInItsTwoDirections) {
  const double a = 0.003, b = -0.004, d = 0.01, p = eps_n * d;
  using Rule = pairing::Sampling::Rule;
  const std::array<std::pair<double, pairing::Sampling>, 4> runs{
      {{1.0, {}}, {0.1, {}}, {1.0, {Rule::gauss, 2, 1}}, {0.1, {Rule::lobatto, 3, 2}}}};
  for (const auto& [mu, sampling] : runs) {
    PairChoices choices;
    choices.mu = mu;
    choices.sampling = sampling;
    Model3 m = block_on<3>(floors(Vec3{})[0], choices);
    const std::array<double, 3> u{a, b, -d};
    for (int i = 0; i < 3; ++i)
      prescribe(m, nodes_of(m, "block"), i, u[static_cast<std::size_t>(i)]);
    const double shear = std::min(eps_t * 0.005, mu * p);
    const int status = mu == 1.0 ? 1 : 2;
    (void)run_to_end(m, [&](const Converged<3>& c) {
      const ContactFields3 f = contact_fields(c.system, m, 0);
      EXPECT_EQ(f.nodes.size(), 9u);
      for (std::size_t k = 0; k < f.nodes.size(); ++k) {
        EXPECT_NEAR(f.copen[k], -d, 1e-15);
        EXPECT_NEAR(f.cpress[k], p, 1e-12);
        EXPECT_NEAR(f.cshear[k], -shear * a / 0.005, 1e-12);
        EXPECT_NEAR(f.cshear2[k], -shear * b / 0.005, 1e-12);
        EXPECT_NEAR(f.cslip[k], a, 1e-14);
        EXPECT_NEAR(f.cslip2[k], b, 1e-14);
        EXPECT_NEAR(f.csforce[k], f.carea[k] * shear, 1e-12);
        EXPECT_EQ(f.cstatus[k], status);
      }
      EXPECT_NEAR(c.of_pair("shear_force"), 2 * shear, 1e-12);
      EXPECT_NEAR(c.of_pair("force_y"), -2 * shear * b / 0.005, 1e-12);
      EXPECT_NEAR(c.of_pair("slip"), 0.005, 1e-14);
      const double work = 2 * shear * (0.005 - shear / eps_t);  // what is not elastic
      EXPECT_NEAR(c.of_pair("friction_work"), work, 1e-14);
      EXPECT_NEAR(c.record.iterations.back().counts.friction_work, work, 1e-14);
      EXPECT_NEAR(c.of_body("rfx"), -2 * shear * a / 0.005, 1e-12);
    });
  }
}

/// All points slide, which holds nothing: the tangent of going on is singular. The block springs
/// back until the elastic part of the friction is gone.
TYPED_TEST(ContactOf, ABlockLetGoWhileItSlidesStaysWhereFrictionHoldsIt) {
  constexpr int Dim = TypeParam::value;
  const double d = 0.01, mu = 0.1, p = eps_n * d;
  const Vec<Dim> u = either<Dim>(Vec3(0.003, Dim == 2 ? 0 : -0.004, -d));
  const double way = u.template head<Dim - 1>().norm();
  BasicModel<Dim> m = block_on(floors(Vec<Dim>{})[0], {mu});
  Step free = m.steps[0];
  free.name = "free";
  for (int i = 0; i < Dim; ++i) prescribe(m, nodes_of(m, "block"), i, u[i]);
  m.steps.push_back(free);
  prescribe(m, nodes_of(m, "block"), up<Dim>, -d);
  const double rest = (way - mu * p / eps_t) / way;
  (void)run_to_end(m, [&](const Converged<Dim>& c) {
    for (const Index n : nodes_of(m, "block"))
      for (int i = 0; i < Dim - 1; ++i) EXPECT_NEAR(c.state.u[Dim * n + i], rest * u[i], 1e-13);
    EXPECT_EQ(c.of_pair("stick"), Dim == 2 ? 3 : 9);
  });
}

// ---- the same bits ------------------------------------------------------------------------------

TYPED_TEST(ContactOf, TheSameBitsWithAnyNumberOfThreads) {
  constexpr int Dim = TypeParam::value;
  const std::array<int, 3> cells = Dim == 2 ? std::array{30, 1, 20} : std::array{9, 6, 6};
  std::vector<BasicState<Dim>> states;  // more cells than one tile
  for (const int threads : {1, 2, 2, 1}) {
    BasicModel<Dim> m = block_under(tools<Dim>()[0], rubber<Dim>(young), {0.3}, cells);
    drive_body(m, either<Dim>({0.2, -0.05, 0.1}, {0.2, 0.1, -0.05, 0.02, 0.03, 0.1}));
    states.push_back(run_to_end(
                         m, [](const Converged<Dim>&) {}, threads)
                         .state);
  }
  for (const BasicState<Dim>& state : states) {
    EXPECT_EQ(state.u, states.front().u);
    for (std::size_t i = 0; i < state.pairs[0].points.size(); ++i) {
      EXPECT_EQ(state.pairs[0].points[i].traction, states.front().pairs[0].points[i].traction);
      EXPECT_EQ(state.pairs[0].points[i].xi, states.front().pairs[0].points[i].xi);
    }
  }
}

}  // namespace
}  // namespace osculate::model

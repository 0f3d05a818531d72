#include <numbers>

#include "block_model.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

Section<3> small(Formulation formulation, double young, double poisson) {
  return {Kinematics::small, formulation, material::LinearElastic{young, poisson, 0}};
}

/// A small dense model of nx x ny x nz hex8 cells in a block.
struct HexBlock {
  Section<3> section;
  std::array<int, 3> cells;
  std::vector<Vec3> nodes;

  HexBlock(const Section<3>& s, const std::array<int, 3>& count,
           const std::function<Vec3(const Vec3&)>& map)
      : section(s), cells(count) {
    for (int k = 0; k <= cells[2]; ++k)
      for (int j = 0; j <= cells[1]; ++j)
        for (int i = 0; i <= cells[0]; ++i)
          nodes.push_back(map({static_cast<double>(i) / cells[0], static_cast<double>(j) / cells[1],
                               static_cast<double>(k) / cells[2]}));
  }
  [[nodiscard]] int node(int i, int j, int k) const {
    return i + (cells[0] + 1) * (j + (cells[1] + 1) * k);
  }
  [[nodiscard]] Eigen::Index dofs() const { return 3 * static_cast<Eigen::Index>(nodes.size()); }

  template <class Visit>
  void over_cells(const Eigen::VectorXd& u, const Visit& visit) const {
    for (int k = 0; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i) {
          const std::array<int, 8> c{node(i, j, k),
                                     node(i + 1, j, k),
                                     node(i + 1, j + 1, k),
                                     node(i, j + 1, k),
                                     node(i, j, k + 1),
                                     node(i + 1, j, k + 1),
                                     node(i + 1, j + 1, k + 1),
                                     node(i, j + 1, k + 1)};
          Coordinates<3> x(8, 3), v(8, 3);
          for (std::size_t n = 0; n < 8; ++n) {
            x.row(static_cast<Eigen::Index>(n)) = nodes[static_cast<std::size_t>(c[n])];
            v.row(static_cast<Eigen::Index>(n)) = u.segment<3>(3 * c[n]);
          }
          visit(c, x, v);
        }
  }

  void assemble(const Eigen::VectorXd& u, Eigen::VectorXd& force, Eigen::MatrixXd& tangent) const {
    force.setZero(dofs());
    tangent.setZero(dofs(), dofs());
    ElementResult<3> r;
    over_cells(u,
               [&](const std::array<int, 8>& c, const Coordinates<3>& x, const Coordinates<3>& v) {
                 evaluate(section, cell::CellType::hex8, x, v, true, r);
                 ASSERT_EQ(r.status, Status::ok);
                 for (std::size_t a = 0; a < 8; ++a) {
                   const auto ra = 3 * static_cast<Eigen::Index>(a);
                   force.segment<3>(3 * c[a]) += r.force.segment<3>(ra);
                   for (std::size_t b = 0; b < 8; ++b)
                     tangent.block<3, 3>(3 * c[a], 3 * c[b]) +=
                         r.tangent.block<3, 3>(ra, 3 * static_cast<Eigen::Index>(b));
                 }
               });
  }

  /// Displacements under dead forces with some unknowns prescribed; Newton from zero.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& load, const Prescribed& prescribed,
                                      int increments = 1) const {
    return dense_solution(
        [&](const auto& u, auto& force, auto& tangent) { assemble(u, force, tangent); }, load,
        prescribed, increments, Eigen::VectorXd::Zero(dofs()));
  }
};

/// Moment about z of the face x = a/2 of one a x b x 1 cell under the nodal displacements of
/// bending with curvature k, everything but them free: with Poisson's ratio the sections warp
/// sideways.
double moment_of_one_cell(const Section<3>& s, double a, double b, double curvature) {
  const HexBlock m(s, {1, 1, 1}, [&](const Vec3& t) {
    return Vec3(a * (t.x() - 0.5), b * (t.y() - 0.5), t.z() - 0.5);
  });
  std::map<Eigen::Index, double> fixed;
  for (std::size_t n = 0; n < 8; ++n)
    fixed[3 * static_cast<Eigen::Index>(n)] = curvature * m.nodes[n].x() * m.nodes[n].y();
  fixed[1] = fixed[2] = 0;  // three rigid motions are left: along y, z and about x
  fixed[3 * m.node(0, 1, 0) + 2] = 0;
  const Eigen::VectorXd u = m.solve(Eigen::VectorXd::Zero(m.dofs()), fixed);
  Eigen::VectorXd force;
  Eigen::MatrixXd tangent;
  m.assemble(u, force, tangent);
  double moment = 0;
  for (int j = 0; j < 2; ++j)
    for (int k = 0; k < 2; ++k) {
      const int n = m.node(1, j, k);
      moment += force[3 * n] * m.nodes[static_cast<std::size_t>(n)].y();
    }
  return moment;
}

// A brick with the incompatible modes bends exactly, however long it is. Without them it is stiffer
// by the shear that bending does not have.
TEST(VolumeLocking, OneEnhancedBrickBendsExactly) {
  const double young = 5, height = 0.7, curvature = 1e-3;
  for (const double nu : {0.0, 0.3, 0.499})
    for (const double aspect : {0.5, 1.0, 10.0, 100.0}) {
      const double length = aspect * height;
      const double exact = young * height * height * height / 12 * curvature;
      const double found =
          moment_of_one_cell(small(Formulation::enhanced, young, nu), length, height, curvature);
      EXPECT_NEAR(found, exact, 1e-12 * (1 + aspect * aspect) * exact) << nu << " " << aspect;
      const double locked =
          moment_of_one_cell(small(Formulation::full, young, nu), length, height, curvature);
      EXPECT_GE(locked, (1 + 0.99 * aspect * aspect / (2 * (1 + nu))) * exact);
    }
}

/// Deflection of a cantilever of one row of bricks over that of Timoshenko's beam.
double cantilever(const Section<3>& s, int cells, double slant) {
  const double length = 10, height = 1, young = 1000, nu = 0.3, load = 1e-3;
  const HexBlock m(s, {cells, 1, 1}, [&](const Vec3& t) {
    const bool inside = t.x() > 0 && t.x() < 1;
    return Vec3(length * t.x() + (inside ? slant * (t.y() - 0.5) : 0.0), height * (t.y() - 0.5),
                t.z());
  });
  Eigen::VectorXd f = Eigen::VectorXd::Zero(m.dofs());
  std::map<Eigen::Index, double> fixed;
  for (int j = 0; j < 2; ++j)
    for (int k = 0; k < 2; ++k) {
      f[3 * m.node(cells, j, k) + 1] = load / 4;
      fixed[3 * m.node(0, j, k)] = 0;
    }
  fixed[3 * m.node(0, 0, 0) + 1] = fixed[3 * m.node(0, 0, 1) + 1] = 0;
  fixed[3 * m.node(0, 0, 0) + 2] = 0;
  const Eigen::VectorXd u = m.solve(f, fixed);
  const double inertia = height * height * height / 12;
  const double exact = load * length * length * length / (3 * young * inertia) +
                       load * length * 6 / 5 * 2 * (1 + nu) / (young * height);
  return u[3 * m.node(cells, 1, 0) + 1] / exact;
}

TEST(VolumeLocking, CantileverOfOneRowOfBricks) {
  const Section<3> enhanced = small(Formulation::enhanced, 1000, 0.3);
  EXPECT_LT(cantilever(small(Formulation::full, 1000, 0.3), 10, 0), 0.7);
  EXPECT_NEAR(cantilever(enhanced, 10, 0), 1, 5e-3);
  EXPECT_NEAR(cantilever(enhanced, 20, 0), 1, 2.5e-3);
  Section<3> finite = enhanced;  // at a small load the same
  finite.kinematics = Kinematics::finite;
  for (const material::Law& law : {material::Law{material::StVenantKirchhoff{1000, 0.3, 0}},
                                   material::Law{material::NeoHooke{1000, 0.3, 0}}}) {
    finite.law = law;
    EXPECT_NEAR(cantilever(finite, 10, 0.4), cantilever(enhanced, 10, 0.4), 1e-4);
  }
}

/// Radial displacement of the bore of a thick cylinder, held along its axis, under inner pressure
/// over Lame's solution: a quarter of it, one layer.
double cylinder(const Section<3>& s, int cells) {
  const double inner = 1, outer = 2, pressure = 1e-6;
  const HexBlock m(s, {cells, 2 * cells, 1}, [&](const Vec3& t) {
    const double r = inner + (outer - inner) * t.x(), angle = t.y() * std::numbers::pi / 2;
    return Vec3(r * std::cos(angle), r * std::sin(angle), 0.3 * t.z());
  });
  Eigen::VectorXd f = Eigen::VectorXd::Zero(m.dofs());
  const cell::CellFace& face = cell::info(cell::CellType::hex8).faces[2];  // towards the axis
  m.over_cells(f,
               [&](const std::array<int, 8>& c, const Coordinates<3>& x, const Coordinates<3>& u) {
                 if (c[0] % (cells + 1) != 0) return;
                 const PressureResult<3> load =
                     side_pressure(s, face.type, face_of(face, x), face_of(face, u) * 0, pressure);
                 for (std::size_t n = 0; n < 4; ++n)
                   f.segment<3>(3 * c[static_cast<std::size_t>(face.nodes[n])]) +=
                       load.force.segment<3>(3 * static_cast<Eigen::Index>(n));
               });
  std::map<Eigen::Index, double> fixed;
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i <= cells; ++i) {
      fixed[3 * m.node(i, 0, k) + 1] = 0;
      fixed[3 * m.node(i, 2 * cells, k)] = 0;
      for (int j = 0; j <= 2 * cells; ++j) fixed[3 * m.node(i, j, k) + 2] = 0;
    }
  const Eigen::VectorXd u = m.solve(f, fixed);
  const auto [young, nu] = material::unloaded(s.law);
  const double exact = pressure * inner * (1 + nu) / young *
                       ((1 - 2 * nu) * inner * inner + outer * outer) /
                       (outer * outer - inner * inner);
  return u[0] / exact;
}

TEST(VolumeLocking, ThickCylinderIsNoStifferWhenIncompressible) {
  for (const Formulation f : {Formulation::bbar, Formulation::enhanced})
    for (const double nu : {0.3, 0.4999, 0.499999}) {
      const double coarse = 1 - cylinder(small(f, 1, nu), 3),
                   fine = 1 - cylinder(small(f, 1, nu), 6);
      EXPECT_LT(std::abs(fine), 4e-2) << nu;
      EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 2, 0.2) << nu << " " << coarse << " " << fine;
    }
  EXPECT_LT(cylinder(small(Formulation::full, 1, 0.499999), 6), 0.1);
}

TEST(VolumeLocking, FiniteKinematicsDoNotLockEither) {
  for (const Formulation f : {Formulation::bbar, Formulation::enhanced}) {
    const Section<3> s = small(f, 1, 0.4999);
    Section<3> finite = s;
    finite.kinematics = Kinematics::finite;
    finite.law = material::NeoHooke{1, 0.4999, 0};
    EXPECT_NEAR(cylinder(finite, 3), cylinder(s, 3), 1e-4);
    finite.formulation = Formulation::full;
    EXPECT_LT(cylinder(finite, 3), 0.2);
  }
}

/// Stiffness of a cube of n x n x n distorted cells against a bulging deformation in all three
/// directions, nearly incompressible: reaction of the squeezed top between rough plates.
double squeezed(const Section<3>& s, int n, double by, int increments, double& volume) {
  const HexBlock m(s, {n, n, n}, [](const Vec3& t) { return t; });
  std::map<Eigen::Index, double> fixed;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (const int k : {0, n})
        for (int d = 0; d < 3; ++d) fixed[3 * m.node(i, j, k) + d] = k == n && d == 2 ? -by : 0.0;
  const Eigen::VectorXd u = m.solve(Eigen::VectorXd::Zero(m.dofs()), fixed, increments);
  Eigen::VectorXd force;
  Eigen::MatrixXd tangent;
  m.assemble(u, force, tangent);
  double reaction = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) reaction += force[3 * m.node(i, j, n) + 2];
  volume = 0;
  m.over_cells(u, [&](const std::array<int, 8>&, const Coordinates<3>& x, const Coordinates<3>& v) {
    volume += volume_weights(s, cell::CellType::hex8, Coordinates<3>(x + v)).sum();
  });
  return -reaction / by;
}

// Rubber squeezed by 20 % between rough plates: it gives way to all sides.
TEST(VolumeLocking, RubberBlockKeepsItsVolumeAtLargeStrain) {
  const auto section = [](Formulation f) {
    return Section<3>{Kinematics::finite, f, material::NeoHooke{1, 0.499, 0}};
  };
  double volume = 0;
  const double bbar = squeezed(section(Formulation::bbar), 4, 0.2, 5, volume);
  EXPECT_NEAR(volume, 1, 4e-3);  // the pressure over the bulk modulus is 1e-3
  EXPECT_GT(squeezed(section(Formulation::full), 4, 0.2, 5, volume) / bbar, 2);
  const double enhanced = squeezed(section(Formulation::enhanced), 4, 0.2, 5, volume);
  EXPECT_NEAR(volume, 1, 4e-3);
  // two ways to the same answer: they approach each other with the mesh
  const double gap = enhanced / bbar - 1;
  const double coarse = squeezed(section(Formulation::enhanced), 2, 0.2, 5, volume) /
                            squeezed(section(Formulation::bbar), 2, 0.2, 5, volume) -
                        1;
  EXPECT_GT(coarse, 0);
  EXPECT_LT(std::abs(gap), 0.5 * coarse) << gap << " " << coarse;
}

// In all three directions at once, where the nine bending modes alone would still lock: the
// stiffness stays bounded when the bulk modulus grows by a factor of a hundred.
TEST(VolumeLocking, StiffnessStaysBoundedWhenIncompressible) {
  double volume = 0;
  for (const Formulation f : {Formulation::bbar, Formulation::enhanced}) {
    const double soft = squeezed(small(f, 1, 0.4999), 3, 1e-3, 1, volume);
    const double hard = squeezed(small(f, 1, 0.499999), 3, 1e-3, 1, volume);
    EXPECT_NEAR(hard / soft, 1, 5e-3) << hard << " " << soft;
  }
  const Formulation full = Formulation::full;
  EXPECT_GT(squeezed(small(full, 1, 0.499999), 3, 1e-3, 1, volume) /
                squeezed(small(full, 1, 0.4999), 3, 1e-3, 1, volume),
            20);
}

}  // namespace
}  // namespace osculate::solid::testing

// Pressures of nearly incompressible cells of second order: none of the checkerboard, and the order
// of convergence, in a square and a cube of known solution.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <map>

#include "cell_cases.hpp"

namespace osculate::solid::testing {
namespace {

using cell::CellType;

/// A displacement without divergence, and a pressure that has nothing to do with it.
template <int Dim>
Vec<Dim> displacement_at(const Vec<Dim>& x) {
  if constexpr (Dim == 2)
    return {-1.5 * std::sin(2 * x[0]) * std::sin(1.5 * x[1]),
            -2 * std::cos(2 * x[0]) * std::cos(1.5 * x[1])};
  else
    return {std::sin(2 * x[1] + x[2]) - 0.5 * std::sin(2 * x[0]) * std::sin(x[1]),
            std::cos(x[0] + 2 * x[2]) - std::cos(2 * x[0]) * std::cos(x[1]),
            std::sin(2 * x[0] - x[1])};
}
template <int Dim>
double pressure_at(const Vec<Dim>& x) {
  return std::cos(x.sum() + x[0]);
}

/// n^Dim squares or cubes, for triangles cut in two, one side held where the solution puts it.
template <int Dim>
struct Box {
  Section<Dim> section;
  CellType type;
  int n;
  std::vector<Vec<Dim>> nodes;
  std::vector<std::vector<int>> cells;

  Box(const Section<Dim>& s, CellType t, int count) : section(s), type(t), n(count) {
    std::map<std::array<int, Dim>, int> known;
    const bool cut = cell::info(type).corners == 3;
    for (int k = 0; k < (Dim == 3 ? n : 1); ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          for (int half = 0; half < (cut ? 2 : 1); ++half) {
            cells.emplace_back();
            for (int a = 0; a < cell::info(type).nodes; ++a) {
              // from the corner of the square, in its size
              Vec<Dim> in = cell::info(type).corners == 3
                                ? Vec<Dim>(node(a))
                                : Vec<Dim>(0.5 * (node(a) + Vec<Dim>::Ones()));
              if (half == 1) in = Vec<Dim>::Ones() - in;
              std::array<int, Dim> at{};
              for (int d = 0; d < Dim; ++d) {
                const int cell_at = d == 0 ? i : d == 1 ? j : k;
                at[static_cast<std::size_t>(d)] =
                    2 * cell_at + static_cast<int>(std::lround(2 * in[d]));
              }
              const auto [found, fresh] = known.emplace(at, static_cast<int>(nodes.size()));
              if (fresh) {
                Vec<Dim> x;
                for (int d = 0; d < Dim; ++d) x[d] = at[static_cast<std::size_t>(d)] / (2.0 * n);
                nodes.push_back(x);
              }
              cells.back().push_back(found->second);
            }
          }
  }
  [[nodiscard]] Vec<Dim> node(int a) const {
    if constexpr (Dim == 2)
      return cell::area_node(type, a);
    else
      return cell::volume_node(type, a);
  }
  [[nodiscard]] Coordinates<Dim> values(const std::vector<int>& c, const Eigen::VectorXd& u) const {
    Coordinates<Dim> at(static_cast<Eigen::Index>(c.size()), Dim);
    for (std::size_t a = 0; a < c.size(); ++a)
      at.row(static_cast<Eigen::Index>(a)) = u.segment<Dim>(Dim * c[a]);
    return at;
  }
};

template <int Dim>
Mat<Dim, Dim> stress_at(double mu, const Vec<Dim>& x) {
  Mat<Dim, Dim> slope;
  constexpr double h = 1e-5;
  for (int j = 0; j < Dim; ++j) {
    const Vec<Dim> step = h * Vec<Dim>::Unit(j);
    slope.col(j) = (displacement_at<Dim>(x + step) - displacement_at<Dim>(x - step)) / (2 * h);
  }
  return mu * (slope + slope.transpose()) - pressure_at<Dim>(x) * Mat<Dim, Dim>::Identity();
}

/// The work of the exact stresses on the strains of unit displacements, over the points of a cell.
template <int Dim>
Eigen::VectorXd load_of(CellType type, const Coordinates<Dim>& x, double mu) {
  const Section<Dim> plain{.law = material::LinearElastic{1, 0, 0}};
  Eigen::VectorXd load = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index a = 0; a < x.size(); ++a) {
    Coordinates<Dim> unit = 0 * x;
    unit(a / Dim, a % Dim) = 1;
    const CellStress<Dim> moved = stress_at_points(plain, type, x, unit);
    for (int q = 0; q < moved.count; ++q) {
      const auto& p = moved.point[static_cast<std::size_t>(q)];
      Mat<Dim, Dim> strain;
      if constexpr (Dim == 2)
        strain << p.strain[0], p.strain[3], p.strain[3], p.strain[1];
      else
        strain = tensor(p.strain);
      load[a] += p.volume * stress_at<Dim>(mu, p.position).cwiseProduct(strain).sum();
    }
  }
  return load;
}

/// Solution of k u = load with u = exact where it is held.
Eigen::VectorXd solution(Eigen::SparseMatrix<double> k, Eigen::VectorXd load,
                         const std::vector<char>& held, const Eigen::VectorXd& exact) {
  const auto is_held = [&](Eigen::Index i) { return held[static_cast<std::size_t>(i)] != 0; };
  Eigen::VectorXd known = Eigen::VectorXd::Zero(exact.size());
  for (Eigen::Index i = 0; i < exact.size(); ++i)
    if (is_held(i)) known[i] = exact[i];
  load -= k * known;
  k.prune([&](Eigen::Index i, Eigen::Index j, double) {
    return i == j || !(is_held(i) || is_held(j));
  });
  for (Eigen::Index i = 0; i < exact.size(); ++i)
    if (is_held(i)) load[i] = k.coeff(i, i) * exact[i];
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(k);
  Eigen::VectorXd u = factors.solve(load);
  u += factors.solve(Eigen::VectorXd(load - k * u));
  return u;
}

/// Of the displacements at the nodes and of the pressures at the points, relative.
struct Errors {
  double displacement = 0, pressure = 0;
};

template <int Dim>
double pressure_error(const Box<Dim>& box, const Eigen::VectorXd& places,
                      const Eigen::VectorXd& u) {
  double error = 0, whole = 0;
  for (const std::vector<int>& c : box.cells) {
    const auto cell =
        stress_at_points(box.section, box.type, box.values(c, places), box.values(c, u));
    for (int q = 0; q < cell.count; ++q) {
      const auto& p = cell.point[static_cast<std::size_t>(q)];
      const double there = pressure_at<Dim>(p.position);
      error += p.volume * std::pow(p.stress.template head<3>().sum() / 3 + there, 2);
      whole += p.volume * there * there;
    }
  }
  return std::sqrt(error / whole);
}

template <int Dim>
Errors errors(Formulation formulation, CellType type, int n, double poisson) {
  const Box<Dim> box({.formulation = formulation, .law = material::LinearElastic{1, poisson, 0}},
                     type, n);
  const auto dofs = static_cast<Eigen::Index>(Dim * box.nodes.size());
  Eigen::VectorXd exact(dofs), places(dofs), load = Eigen::VectorXd::Zero(dofs);
  std::vector<char> held(static_cast<std::size_t>(dofs), 0);
  for (std::size_t k = 0; k < box.nodes.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(Dim * k);
    places.segment<Dim>(at) = box.nodes[k];
    exact.segment<Dim>(at) = displacement_at<Dim>(box.nodes[k]);
    for (std::size_t i = 0; i < Dim && box.nodes[k][0] == 0; ++i) held[Dim * k + i] = 1;
  }
  std::vector<Eigen::Triplet<double>> entries;
  ElementResult<Dim> r;
  for (const std::vector<int>& c : box.cells) {
    const Coordinates<Dim> x = box.values(c, places);
    evaluate(box.section, type, x, Coordinates<Dim>(0 * x), true, r);
    const Eigen::VectorXd own = load_of<Dim>(type, x, 0.5 / (1 + poisson));
    const auto at = [&](Eigen::Index a) {
      return Dim * c[static_cast<std::size_t>(a / Dim)] + a % Dim;
    };
    for (Eigen::Index a = 0; a < own.size(); ++a) {
      load[at(a)] += own[a];
      for (Eigen::Index b = 0; b < own.size(); ++b)
        entries.emplace_back(at(a), at(b), r.tangent(a, b));
    }
  }
  Eigen::SparseMatrix<double> k(dofs, dofs);
  k.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd u = solution(k, load, held, exact);
  return {(u - exact).norm() / exact.norm(), pressure_error(box, places, u)};
}

constexpr double nearly_half = 0.499999;

TEST(Pressure, OfQuadrilateralsConvergesWithSecondOrder) {
  for (const CellType type : {CellType::quad8, CellType::quad9}) {
    const Errors coarse = errors<2>(Formulation::bbar, type, 4, nearly_half),
                 fine = errors<2>(Formulation::bbar, type, 8, nearly_half);
    EXPECT_LT(fine.pressure, 0.005);
    EXPECT_NEAR(std::log2(coarse.pressure / fine.pressure), 2, 0.15);
    EXPECT_GT(std::log2(coarse.displacement / fine.displacement), 2.7);
    const Errors plain = errors<2>(Formulation::full, type, 8, nearly_half);
    EXPECT_GT(plain.pressure, 5);
    EXPECT_GT(plain.displacement, 10 * fine.displacement);
  }
}

TEST(Pressure, OfTrianglesConvergesWithFirstOrder) {
  const Errors coarse = errors<2>(Formulation::bbar, CellType::tri6, 8, nearly_half),
               fine = errors<2>(Formulation::bbar, CellType::tri6, 16, nearly_half);
  EXPECT_LT(fine.pressure, 0.06);
  EXPECT_NEAR(std::log2(coarse.pressure / fine.pressure), 1, 0.1);
  EXPECT_NEAR(std::log2(coarse.displacement / fine.displacement), 2, 0.2);
  EXPECT_GT(errors<2>(Formulation::full, CellType::tri6, 16, nearly_half).pressure,
            5 * fine.pressure);
}

TEST(Pressure, OfHexahedraConvergesWithSecondOrder) {
  for (const CellType type : {CellType::hex20, CellType::hex27}) {
    const Errors coarse = errors<3>(Formulation::bbar, type, 2, nearly_half),
                 fine = errors<3>(Formulation::bbar, type, 4, nearly_half);
    EXPECT_LT(fine.pressure, 0.025);
    EXPECT_NEAR(std::log2(coarse.pressure / fine.pressure), 2, 0.15);
    EXPECT_GT(std::log2(coarse.displacement / fine.displacement), 2.7);
    EXPECT_GT(errors<3>(Formulation::full, type, 4, nearly_half).pressure, 1);
  }
}

}  // namespace
}  // namespace osculate::solid::testing

#include "osculate/solid/solid_shell_strain.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <span>

#include "osculate/cell/quadrature.hpp"
#include "osculate/solid/local_modes.hpp"
#include "osculate/solid/points.hpp"

namespace osculate::solid {
namespace {

constexpr std::array<std::array<Eigen::Index, 2>, 6> axes{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// Tying points of one component: a grid of abscissae in xi and eta, at zeta = 0 or at the zeta of
/// each quadrature point.
struct Grid {
  std::vector<double> xi, eta;
  bool at_mid;
};

std::array<Grid, 6> grids(cell::CellType type) {
  const std::vector<double> two = cell::gauss_legendre(2).points,
                            three = cell::gauss_legendre(3).points;
  if (type == cell::CellType::hex8)
    return {{{two, two, false},
             {two, two, false},
             {{-1, 1}, {-1, 1}, true},
             {two, two, false},
             {{-1, 1}, {0}, true},
             {{0}, {-1, 1}, true}}};
  return {{{two, three, false},
           {three, two, false},
           {{-1, 0, 1}, {-1, 0, 1}, true},
           {},  // fitted
           {three, two, true},
           {two, three, true}}};
}

/// Lagrange polynomial of the i-th abscissa. Exactly 0 or 1 at the abscissae themselves.
double lagrange(std::span<const double> at, std::size_t i, double x) {
  double value = 1;
  for (std::size_t j = 0; j < at.size(); ++j)
    if (j != i) value *= (x - at[j]) / (at[i] - at[j]);
  return value;
}

ShellGradient gradient(cell::CellType type, const Vec3& xi) {
  const cell::VolumeShape s = cell::volume_shape(type, xi);
  return s.d.topRows(s.count);
}

/// Adds the samples of one component at one zeta, and the shares in them of the points at this zeta
/// or, if the component is sampled at the middle only, of all points.
void add_samples(ShellRule& rule, cell::CellType type, Eigen::Index component, const Grid& grid,
                 double zeta) {
  for (std::size_t i = 0; i < grid.xi.size(); ++i)
    for (std::size_t j = 0; j < grid.eta.size(); ++j) {
      for (ShellRulePoint& p : rule.points) {
        if (!grid.at_mid && p.xi.z() != zeta) continue;
        const double weight = lagrange(grid.xi, i, p.xi.x()) * lagrange(grid.eta, j, p.xi.y());
        if (weight != 0) p.shares.push_back({rule.samples.size(), component, weight});
      }
      rule.samples.push_back({component, gradient(type, {grid.xi[i], grid.eta[j], zeta})});
    }
}

constexpr Eigen::Index e12 = 3;

/// Adds samples of E12 at the quadrature points of one zeta.
void add_layer(ShellRule& rule, double zeta) {
  ShellLayer layer{{}, rule.samples.size(), {}};
  std::size_t k = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Vec3& xi = rule.points[q].xi;
    if (xi.z() != zeta) continue;
    layer.points[k] = q;
    layer.bilinear.col(static_cast<Eigen::Index>(k)) << 1, xi.x(), xi.y(), xi.x() * xi.y();
    rule.samples.push_back({e12, rule.points[q].shape});
    ++k;
  }
  assert(k == ShellLayer::count);
  rule.fitted.push_back(layer);
}

ShellRule make_rule(cell::CellType type) {
  ShellRule rule;
  rule.modes = type == cell::CellType::hex8 ? 7 : 4;
  rule.center = gradient(type, Vec3::Zero());
  const Rule<3>& full = rule_of<3>(type);
  for (std::size_t q = 0; q < full.points.size(); ++q) {
    const Vec3 xi = full.points[q];
    rule.points.push_back(
        {xi, full.weights[q], gradient(type, xi), gradient(type, {xi.x(), xi.y(), 0}), {}});
  }
  const std::array<Grid, 6> grid = grids(type);
  const std::vector<double> through = cell::gauss_legendre(2).points;
  for (std::size_t c = 0; c < 6; ++c)
    for (const double zeta : grid[c].at_mid ? std::vector<double>{0} : through)
      add_samples(rule, type, static_cast<Eigen::Index>(c), grid[c], zeta);
  if (type == cell::CellType::shell18)
    for (const double zeta : through) add_layer(rule, zeta);
  return rule;
}

/// Cartesian strain components from those in the basis of the columns of `basis`.
Mat<6, 6> cartesian_from(const Mat<3, 3>& basis) {
  const Mat<3, 3> dual = basis.inverse().transpose();  // columns G^i
  Mat<6, 6> t;
  for (std::size_t r = 0; r < 6; ++r)
    for (std::size_t c = 0; c < 6; ++c) {
      const auto [a, b] = axes[r];
      const auto [i, j] = axes[c];
      t(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          (a == b ? 0.5 : 1.0) * (dual(a, i) * dual(b, j) + dual(a, j) * dual(b, i));
    }
  return t;
}

/// Strain of a sample; its derivative, three values a node, goes to `b`.
double sample_strain(const ShellSample& s, const Coordinates<3>& reference,
                     const Coordinates<3>& displacement, bool finite,
                     Eigen::Ref<Eigen::VectorXd> b) {
  const auto [i, j] = axes[static_cast<std::size_t>(s.component)];
  const Mat<3, 3> basis = reference.transpose() * s.shape;
  const Mat<3, 3> change = displacement.transpose() * s.shape;
  const double half = i == j ? 0.5 : 1.0;
  const Mat<3, 3> now = finite ? Mat<3, 3>(basis + change) : basis;
  for (Eigen::Index k = 0; k < s.shape.rows(); ++k)
    b.segment<3>(3 * k) = half * (s.shape(k, i) * now.col(j) + s.shape(k, j) * now.col(i));
  const double linear = half * (basis.col(i).dot(change.col(j)) + basis.col(j).dot(change.col(i)));
  return finite ? linear + half * change.col(i).dot(change.col(j)) : linear;
}

/// Adds the shares of the points of a layer in its samples of E12.
void add_fit(const ShellRule& rule, const ShellLayer& layer, ShellCell& cell) {
  constexpr auto count = static_cast<Eigen::Index>(ShellLayer::count);
  Mat<4, ShellLayer::count> weighted = layer.bilinear;
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::size_t q = layer.points[static_cast<std::size_t>(k)];
    const double w = rule.points[q].weight;
    weighted.col(k) *= w * w / cell.points[q].volume;
  }
  const Mat<4, 4> normal = weighted * layer.bilinear.transpose();
  const Mat<4, ShellLayer::count> fit = normal.ldlt().solve(weighted);
  for (Eigen::Index to = 0; to < count; ++to)
    for (Eigen::Index from = 0; from < count; ++from)
      cell.points[layer.points[static_cast<std::size_t>(to)]].shares.push_back(
          {layer.first_sample + static_cast<std::size_t>(from), e12,
           layer.bilinear.col(to).dot(fit.col(from))});
}

/// Fills p.modes, each scaled by the size of the cell to Cartesian strains of about one.
void set_modes(const ShellRule& rule, const ShellRulePoint& at, const Coordinates<3>& reference,
               double determinant, ShellPoint& p) {
  const Mat<3, 3> center = reference.transpose() * rule.center;
  const Mat<3, 3> mid = reference.transpose() * at.shape_mid;
  const Vec3 xi = at.xi, length = center.colwise().norm();
  const Vec<6> thickness = xi.z() * length.z() * length.z() * mid.determinant() / determinant *
                           cartesian_from(mid).col(2);
  p.modes.resize(6, rule.modes);
  p.modes.leftCols<3>() << thickness, xi.x() * thickness, xi.y() * thickness;
  if (rule.modes == 4) {
    p.modes.col(3) = xi.x() * xi.y() * thickness;
    return;
  }
  const Mat<6, 6> t = center.determinant() / determinant * cartesian_from(center);
  const Vec<6> shear = length.x() * length.y() * t.col(3);
  p.modes.rightCols<4>() << xi.x() * length.x() * length.x() * t.col(0),
      xi.y() * length.y() * length.y() * t.col(1), xi.x() * shear, xi.y() * shear;
}

/// Responses, equations int M^T S dV = 0 and their derivative. `scale` is the size that rounding
/// errors of the equations are relative to. False where the law fails.
bool sample_modes(const Section<3>& section, const ShellCell& cell, const material::Memory& memory,
                  ShellModes& m, ShellModeVector& rest, double& scale) {
  rest.setZero(cell.rule->modes);
  m.stiffness.setZero(cell.rule->modes, cell.rule->modes);
  scale = 0;
  for (std::size_t q = 0; q < cell.rule->points.size(); ++q) {
    const ShellPoint& p = cell.points[q];
    const material::Strain3 total = p.strain + p.modes * m.alpha;
    const material::Response3& r = m.response[q] =
        material::response(section.law, total, memory.at(q));
    if (!r.ok) return false;
    const ShellModeMatrix weighted = p.volume * p.modes;
    rest.noalias() += weighted.transpose() * r.stress;
    m.stiffness.noalias() += weighted.transpose() * r.tangent * p.modes;
    const Vec<6> size = r.tangent.cwiseAbs() * total.cwiseAbs() + r.stress.cwiseAbs();
    const ShellModeVector sizes = weighted.cwiseAbs().transpose() * size;
    scale += sizes.lpNorm<Eigen::Infinity>();
  }
  return true;
}

}  // namespace

const ShellRule& shell_rule(cell::CellType type) {
  static const ShellRule eight = make_rule(cell::CellType::hex8);
  static const ShellRule eighteen = make_rule(cell::CellType::shell18);
  return type == cell::CellType::hex8 ? eight : eighteen;
}

bool fill_shell(const Section<3>& section, cell::CellType type, const Coordinates<3>& reference,
                const Coordinates<3>& displacement, ShellCell& cell) {
  const ShellRule& rule = shell_rule(type);
  const bool finite = section.kinematics == Kinematics::finite;
  cell.rule = &rule;
  cell.sample_b.resize(3 * reference.rows(), static_cast<Eigen::Index>(rule.samples.size()));
  std::array<double, max_shell_samples> value{};
  for (std::size_t s = 0; s < rule.samples.size(); ++s)
    value[s] = sample_strain(rule.samples[s], reference, displacement, finite,
                             cell.sample_b.col(static_cast<Eigen::Index>(s)));
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const ShellRulePoint& at = rule.points[q];
    ShellPoint& p = cell.points[q];
    p.basis = reference.transpose() * at.shape;
    p.change = displacement.transpose() * at.shape;
    const double determinant = p.basis.determinant();
    if (!(determinant > 0)) return false;
    if (finite && !(Mat<3, 3>(p.basis + p.change).determinant() > 0)) return false;
    p.volume = at.weight * determinant;
    p.from_convected = cartesian_from(p.basis);
    p.shares = {};
    for (const ShellShare& share : at.shares) p.shares.push_back(share);
    set_modes(rule, at, reference, determinant, p);
  }
  for (const ShellLayer& layer : rule.fitted) add_fit(rule, layer, cell);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    Vec<6> convected = Vec<6>::Zero();
    for (const ShellShare& share : cell.points[q].shares)
      convected[share.component] += share.weight * value[share.sample];
    cell.points[q].strain = cell.points[q].from_convected * convected;
  }
  return true;
}

ShellModes shell_modes(const Section<3>& section, const ShellCell& cell,
                       const material::Memory& memory) {
  ShellModes m;
  m.alpha.setZero(cell.rule->modes);
  solve_modes<ShellModeVector>(m, memory.size > 0,
                               [&](ShellModes& modes, ShellModeVector& rest, double& scale) {
                                 return sample_modes(section, cell, memory, modes, rest, scale);
                               });
  return m;
}

}  // namespace osculate::solid

#include "osculate/solid/batch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "osculate/core/processor.hpp"
#include "osculate/solid/batch_points.hpp"
#include "osculate/solid/points.hpp"
#include "osculate/solid/reduced.hpp"

namespace osculate::solid {
namespace {

using batches::mode_count;
using core::Pack;

/// Numbers that the shape of a quad4 or hex8 is made of.
template <int Dim>
constexpr std::size_t factor_count = Dim*((1 << Dim) - 1);

/// Linear modes of a quad4 or hex8, in which it does not strain or strains by one component, and
/// modes without mean strain, dual to gamma_a; columns of displacements.
template <int Dim>
struct CellBasis {
  static constexpr int nodes = corners<Dim>, dofs = Dim * nodes, modes = mode_count<Dim>;
  CornerPoint<Dim> mean;  ///< volume and mean gradients
  Mat<dofs, components<Dim>> of_strain = Mat<dofs, components<Dim>>::Zero();
  Mat<dofs, Dim* modes> of_mode = Mat<dofs, Dim * modes>::Zero();
};

template <int Dim>
CellBasis<Dim> basis_of(const Section<Dim>& section, const Coordinates<Dim>& reference) {
  using Basis = CellBasis<Dim>;
  constexpr int nodes = Basis::nodes, modes = Basis::modes;
  Basis b;
  const Mat<nodes, Dim> x = reference;
  (void)fill_mean_point<Dim>(section, reference, Coordinates<Dim>::Zero(nodes, Dim), b.mean);
  Mat<nodes, modes> h;
  for (int a = 0; a < modes; ++a)
    for (int k = 0; k < nodes; ++k) {
      const Vec<Dim> xi = node_at<Dim>(corner_cell<Dim>, k);
      h(k, a) = Dim == 3 && a < 3 ? xi.prod() / xi[a] : xi.prod();
    }
  const Mat<modes, Dim> slant = h.transpose() * x / nodes;
  const Mat<nodes, modes> gamma = h / nodes - b.mean.gradient * slant.transpose();
  const Mat<nodes, modes> plain = h * (gamma.transpose() * h).eval().inverse();
  const Mat<nodes, modes> dual = plain - x * (b.mean.gradient.transpose() * plain);
  const Eigen::Matrix<double, 1, Dim> centre = x.colwise().mean();
  for (int k = 0; k < nodes; ++k) {
    for (int a = 0; a < modes; ++a)
      for (int i = 0; i < Dim; ++i) b.of_mode(Dim * k + i, Dim * a + i) = dual(k, a);
    for (int i = 0; i < Dim; ++i)
      for (int j = i; j < Dim; ++j) {
        const auto column = static_cast<Eigen::Index>(component(i, j));
        b.of_strain(Dim * k + i, column) += 0.5 * (x(k, j) - centre[j]);
        b.of_strain(Dim * k + j, column) += 0.5 * (x(k, i) - centre[i]);
      }
  }
  return b;
}

/// The cell as it is evaluated by itself.
template <int Dim>
ElementMatrix<Dim> stiffness_of_cell(const Section<Dim>& section, cell::CellType type,
                                     const Coordinates<Dim>& reference) {
  ElementResult<Dim> result;
  evaluate(section, type, reference, Coordinates<Dim>::Zero(reference.rows(), Dim), true, result);
  if (result.status != Status::ok) result.tangent.setZero(reference.size(), reference.size());
  return result.tangent;
}

template <int Dim>
void keep_factors(const Coordinates<Dim>& reference, int lane, Pack* numbers) {
  for (int i = 0; i < Dim; ++i) {
    OfCorners<Dim, double> v;
    for (std::size_t c = 0; c < v.size(); ++c) v[c] = reference(corner_node<Dim>[c], i);
    to_products(v);
    for (std::size_t m = 1; m < v.size(); ++m)
      (numbers++)->set(lane, v[m] / static_cast<double>(v.size()));
  }
}

/// Whether the kept numbers give the forces of the stiffness, at displacements that have a share of
/// every mode.
template <int Dim>
bool gives_forces(const Batch<Dim>& batch, const ElementMatrix<Dim>& stiffness, int lane,
                  const Pack* numbers) {
  constexpr int dofs = CellBasis<Dim>::dofs;
  constexpr double tolerance = 1e-12;
  Vec<dofs> u, got;
  std::array<Pack, dofs> of_u, force;
  for (int d = 0; d < dofs; ++d) {
    u[d] = std::sin(1.0 + 2.3 * d * d);
    of_u[static_cast<std::size_t>(d)] = Pack(u[d]);
  }
  batches::linear_forces<Dim>(batch, depth_at(batch.section, 0), numbers, of_u.data(),
                              force.data());
  for (int d = 0; d < dofs; ++d) got[d] = force[static_cast<std::size_t>(d)][lane];
  const Vec<dofs> want = stiffness * u;
  return (got - want).norm() <= tolerance * stiffness.norm() * u.norm();
}

template <int Dim>
bool keep_linear(const Batch<Dim>& batch, const Coordinates<Dim>& reference, int lane,
                 Pack* numbers) {
  const CellBasis<Dim> b = basis_of(batch.section, reference);
  const ElementMatrix<Dim> k = stiffness_of_cell(batch.section, batch.type, reference);
  keep_factors<Dim>(reference, lane, numbers);
  Pack* at = numbers + factor_count<Dim>;
  constexpr int M = Dim * mode_count<Dim>;
  const Mat<CellBasis<Dim>::dofs, M> pushed = k * b.of_mode;
  const Mat<M, M> own = b.of_mode.transpose() * pushed;
  for (int r = 0; r < M; ++r)
    for (int c = r; c < M; ++c) (at++)->set(lane, own(r, c));
  return gives_forces(batch, k, lane, numbers);
}

template <int Dim>
void keep_simplex(const Batch<Dim>& batch, const Coordinates<Dim>& reference, int lane,
                  Pack* numbers) {
  const Rule<Dim>& rule = rule_of(batch.section, batch.type);
  Point<Dim, Dim + 1> p;
  const Mat<Dim + 1, Dim> x = reference, u = Mat<Dim + 1, Dim>::Zero();
  (void)fill_point<Dim, Dim + 1>(batch.section, rule.shape[0], rule.weights[0], x, u, p);
  (numbers++)->set(lane, p.volume);
  for (int k = 0; k <= Dim; ++k)
    for (int j = 0; j < Dim; ++j) (numbers++)->set(lane, p.gradient(k, j));
}

bool strained_in_plane(const Section<2>& s) { return s.assumption == Assumption::plane_strain; }
bool strained_in_plane(const Section<3>&) { return true; }

/// The stress follows from the strain alone, everywhere in the same way.
bool follows_strain(const material::Law& law) {
  return material::memory_of(law).empty() && !material::directional(law) &&
         !material::over_temperature(law) && !material::takes_temperature(law);
}

template <int Dim>
std::optional<BatchKind> kind_of(const Section<Dim>& section, cell::CellType type) {
  constexpr cell::CellType simplex = Dim == 2 ? cell::CellType::tri3 : cell::CellType::tet4;
  if (section.formulation == Formulation::solid_shell || is_ring(section)) return {};
  const bool corner = type == corner_cell<Dim>,
             plain = follows_strain(section.law) && strained_in_plane(section);
  const bool reduced = section.formulation == Formulation::reduced;
  const bool small = section.kinematics == Kinematics::small;
  if (small && (!material::linear(section.law) || material::over_temperature(section.law)))
    return {};
  if (plain && type == simplex) return BatchKind::simplex;
  if (plain && corner && reduced) return BatchKind::one_point;
  if (!corner) return {};
  if (small) return BatchKind::linear;
  const bool full =
      section.formulation == Formulation::full || section.formulation == Formulation::bbar;
  return plain && full ? std::optional(BatchKind::points) : std::nullopt;
}

template <int Dim>
std::size_t numbers_of(BatchKind kind) {
  constexpr int modes = Dim * mode_count<Dim>;
  if (kind == BatchKind::simplex) return 1 + Dim * (Dim + 1);
  return factor_count<Dim> + (kind == BatchKind::linear ? modes * (modes + 1) / 2 : 0);
}

}  // namespace

template <int Dim>
std::optional<Batch<Dim>> batch_of(const Section<Dim>& section, cell::CellType type,
                                   const Coordinates<Dim>& reference) {
  const std::optional<BatchKind> kind = kind_of(section, type);
  if (!kind) return {};
  Batch<Dim> batch{*kind, type, section, {}, numbers_of<Dim>(*kind)};
  batch.stiffness.setZero();
  if (*kind == BatchKind::linear) {
    const CellBasis<Dim> b = basis_of(section, reference);
    const ElementMatrix<Dim> k = stiffness_of_cell(section, type, reference);
    batch.stiffness = b.of_strain.transpose() * (k * b.of_strain).eval() / b.mean.volume;
  }
  return batch;
}

template <int Dim>
bool keep_in(const Batch<Dim>& batch, const Coordinates<Dim>& reference, int lane, Pack* numbers) {
  if (batch.kind == BatchKind::linear) return keep_linear(batch, reference, lane, numbers);
  if (batch.kind == BatchKind::simplex)
    keep_simplex(batch, reference, lane, numbers);
  else
    keep_factors<Dim>(reference, lane, numbers);
  return true;
}

template <int Dim>
bool batch_forces(const Batch<Dim>& batch, const Pack* numbers, const Pack* u, Pack* force) {
  const material::Law& law = batch.section.law;
  const double depth = depth_at(batch.section, 0);
  switch (batch.kind) {
    case BatchKind::linear:
      batches::linear_forces<Dim>(batch, depth, numbers, u, force);
      return true;
    case BatchKind::one_point:
      return batches::one_point_forces<Dim>(law, batch.section.kinematics == Kinematics::finite,
                                            mode_moduli(batch.section), depth, numbers, u, force);
    case BatchKind::points:
      return batch.section.formulation == Formulation::bbar
                 ? batches::points_forces<true, Dim>(law, depth, numbers, u, force)
                 : batches::points_forces<false, Dim>(law, depth, numbers, u, force);
    default:
      return batches::simplex_forces<Dim>(batch, numbers, u, force);
  }
}

bool has_eight_lanes() { return built_for_eight && core::has_avx512(); }

template <int Dim>
std::optional<EightCells> eight_cells(const Batch<Dim>& batch) {
  const auto* const law = std::get_if<material::NeoHooke>(&batch.section.law);
  const bool kind = batch.kind == BatchKind::one_point || batch.kind == BatchKind::points;
  if (Dim == 2 || !law || !kind || batch.section.kinematics != Kinematics::finite ||
      !has_eight_lanes())
    return {};
  EightCells out;
  out.one_point = batch.kind == BatchKind::one_point;
  out.mean = batch.section.formulation == Formulation::bbar;
  out.young = law->young;
  out.poisson = law->poisson;
  if (out.one_point) out.moduli = mode_moduli(batch.section);
  return out;
}

/// Small strains: f . u / 2, of a linear law.
template <int Dim>
bool batch_energy(const Batch<Dim>& batch, const Pack* numbers, const Pack* u, Pack& energy) {
  const int nodes = cell::info(batch.type).nodes;
  if (batch.section.kinematics == Kinematics::small) {
    std::array<Pack, CellBasis<Dim>::dofs> force;
    if (!batch_forces(batch, numbers, u, force.data())) return false;
    energy = Pack::Zero();
    for (int d = 0; d < Dim * nodes; ++d) energy += 0.5 * force[static_cast<std::size_t>(d)] * u[d];
    return true;
  }
  const double depth = depth_at(batch.section, 0);
  if (batch.kind == BatchKind::points) {
    return batch.section.formulation == Formulation::bbar
               ? batches::points_energy<true, Dim>(batch.section.law, depth, numbers, u, energy)
               : batches::points_energy<false, Dim>(batch.section.law, depth, numbers, u, energy);
  }
  if (batch.kind == BatchKind::one_point) {
    energy = batches::one_point_energy<Dim>(batch, mode_moduli(batch.section), depth, numbers, u);
    return true;
  }
  batches::Matrix<Dim, Pack> h;
  batches::simplex_gradient<Dim, Pack>(numbers + 1, u, h);
  energy = *numbers * batches::gradient_energy<Dim, Pack>(batch, h);
  return true;
}

namespace {

/// About the least width of a cell, as it was: of a quad4 or hex8 that of the middle lines.
template <int Dim>
Pack least_width(const Batch<Dim>& batch, const Pack* numbers) {
  Pack most = Pack::Zero();  // square of its inverse
  const auto look_at = [&](const Pack& square) { most = larger_of(most, square); };
  const auto square_of = [](const auto& v) {
    Pack sum = v(0) * v(0);
    for (int i = 1; i < Dim; ++i) sum += v(i) * v(i);
    return sum;
  };
  if (batch.kind == BatchKind::simplex)
    for (int k = 0; k <= Dim; ++k)
      look_at(square_of([&](int i) { return numbers[1 + Dim * k + i]; }));
  else
    for (int axis = 0; axis < Dim; ++axis)
      look_at(1 / square_of([&](int i) {
                return 2 * batches::Factors<Dim, Pack>{numbers}(
                               std::size_t{1} << static_cast<unsigned>(axis), i);
              }));
  return 1 / square_root_of(most);
}

}  // namespace

template <int Dim>
bool batch_stiffness(const Batch<Dim>& batch, const Pack* numbers, const Pack* u, Pack* stiffness) {
  constexpr double way = 1e-7;
  const auto dofs = static_cast<std::size_t>(Dim * cell::info(batch.type).nodes);
  const material::Law& law = batch.section.law;
  const bool linear = batch.section.kinematics == Kinematics::small && material::linear(law);
  if (!linear && !material::at_once(law)) return false;
  const Pack d = linear ? Pack(1) : way * least_width(batch, numbers), scale = 1 / d;
  std::array<Pack, CellBasis<Dim>::dofs> at, before;
  at.fill(Pack::Zero());
  if (!linear) std::copy_n(u, dofs, at.begin());
  if (!batch_forces(batch, numbers, at.data(), before.data())) return false;
  std::fill_n(stiffness, Dim * dofs, Pack::Zero());
  for (std::size_t j = Dim; j < dofs; ++j) {
    Pack* const column = stiffness + dofs * j;
    const Pack kept = std::exchange(at[j], at[j] + d);
    if (!batch_forces(batch, numbers, at.data(), column)) return false;
    at[j] = kept;
    for (std::size_t i = 0; i < dofs; ++i) {
      column[i] = scale * (column[i] - before[i]);
      stiffness[dofs * (j % Dim) + i] -= column[i];
    }
  }
  return true;
}

template bool batch_stiffness(const Batch<2>&, const Pack*, const Pack*, Pack*);
template bool batch_stiffness(const Batch<3>&, const Pack*, const Pack*, Pack*);
template bool batch_energy(const Batch<2>&, const Pack*, const Pack*, Pack&);
template bool batch_energy(const Batch<3>&, const Pack*, const Pack*, Pack&);
template std::optional<EightCells> eight_cells(const Batch<2>&);
template std::optional<EightCells> eight_cells(const Batch<3>&);
template std::optional<Batch<2>> batch_of(const Section<2>&, cell::CellType, const Coordinates<2>&);
template std::optional<Batch<3>> batch_of(const Section<3>&, cell::CellType, const Coordinates<3>&);
template bool keep_in(const Batch<2>&, const Coordinates<2>&, int, Pack*);
template bool keep_in(const Batch<3>&, const Coordinates<3>&, int, Pack*);
template bool batch_forces(const Batch<2>&, const Pack*, const Pack*, Pack*);
template bool batch_forces(const Batch<3>&, const Pack*, const Pack*, Pack*);

}  // namespace osculate::solid

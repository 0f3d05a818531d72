#pragma once
// ActiveSet and enhanced strains of solid-shells; shared by solid_shell.cpp,
// solid_shell_stress.cpp.
#include <array>
#include <cassert>
#include <vector>

#include "osculate/solid/element.hpp"

namespace osculate::solid {

inline constexpr int max_shell_nodes = 18;
inline constexpr int max_shell_points = 18;
inline constexpr int max_shell_samples = 63;
inline constexpr int max_shell_shares = 26;  ///< of one quadrature point
inline constexpr int max_shell_modes = 7;

/// dN_k/dxi_i.
using ShellGradient = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_shell_nodes, 3>;
using ShellModeMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, max_shell_modes>;
using ShellModeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_shell_modes, 1>;
using ShellModeStiffness =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_shell_modes, max_shell_modes>;
using ShellSampleMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0,
                                        3 * max_shell_nodes, max_shell_samples>;

/// One convected strain component at one tying point. Components as in `material::Strain3`.
struct ShellSample {
  Eigen::Index component;
  ShellGradient shape;
};

/// What a quadrature point takes from a sample of the component.
struct ShellShare {
  std::size_t sample;
  Eigen::Index component;
  double weight;
};

struct ShellRulePoint {
  Vec3 xi;
  double weight;
  ShellGradient shape, shape_mid;  ///< at the point; at (xi, eta, 0)
  std::vector<ShellShare> shares;  ///< those that are the same for all cells
};

/// The quadrature points at one zeta, and E12 at them: the sample of points[k] is first_sample + k.
struct ShellLayer {
  static constexpr std::size_t count = 9;
  std::array<std::size_t, count> points;
  std::size_t first_sample;
  Mat<4, count> bilinear;  ///< 1, xi, eta, xi eta at each
};

/// What is the same for all cells of a type.
struct ShellRule {
  std::vector<ShellSample> samples;
  std::vector<ShellRulePoint> points;
  std::vector<ShellLayer> fitted;  ///< where E12 is fitted in each cell (shell18)
  ShellGradient center;
  Eigen::Index modes;
};
/// Requires   type is hex8 or shell18
[[nodiscard]] const ShellRule& shell_rule(cell::CellType type);

/// All shares of a quadrature point.
class ShellShares {
 public:
  void push_back(const ShellShare& share) {
    assert(size_ < share_.size());
    share_[size_++] = share;
  }
  [[nodiscard]] const ShellShare* begin() const { return share_.data(); }
  [[nodiscard]] const ShellShare* end() const { return share_.data() + size_; }

 private:
  std::array<ShellShare, max_shell_shares> share_;
  std::size_t size_ = 0;
};

/// Reference geometry of one quadrature point.
struct ShellPoint {
  ShellShares shares;
  double volume;             ///< weight times det G
  Mat<3, 3> basis;           ///< columns G_i
  Mat<3, 3> change;          ///< columns du/dxi_i
  Mat<6, 6> from_convected;  ///< Cartesian strain components from convected ones
  ShellModeMatrix modes;     ///< Cartesian strain per mode
  material::Strain3 strain;  ///< assumed strain without modes, Cartesian
};

/// A cell at given displacements, before its modes are found.
///
/// Formula    E12 of shell18, layer by layer: the bilinear function of xi and eta nearest to the
///            strain of the displacements, sum over the quadrature points of w (E12 - fit)^2/det G
///            least. In a flat cell with straight sides J sigma^12 of a constant stress is a
///            bilinear function over J, so the stress does no work on what the fit leaves out: the
///            forces of a constant state are those of the displacements, whatever the outline. In
///            a flat affine cell the fit is the interpolation at 2 x 2 Gauss points (MITC9)
/// Source     orthogonality to constant stress: Simo & Hughes 1986
/// Tested by  tests/unit/solid/test_solid_shell_patch.cpp
struct ShellCell {
  const ShellRule* rule = nullptr;
  std::array<ShellPoint, max_shell_points> points;
  ShellSampleMatrix sample_b;  ///< derivative of each sample with respect to the displacements
};

/// False where det G is not positive at a quadrature point, or, in finite kinematics, the current
/// one.
[[nodiscard]] bool fill_shell(const Section<3>& section, cell::CellType type,
                              const Coordinates<3>& reference, const Coordinates<3>& displacement,
                              ShellCell& cell);

/// State of the enhanced modes at given displacements.
struct ShellModes {
  bool ok = true;
  ShellModeVector alpha;
  ShellModeStiffness stiffness;
  std::array<material::Response3, max_shell_points> response;  ///< at strain + modes * alpha
};

/// Finds the mode parameters by a local Newton iteration from zero to round-off (one step where
/// linear): int M^T S dV = 0. The element keeps no state.
///
/// Formula    thickness: E33 = zeta {1, xi, eta} (hex8), zeta {1, xi, eta, xi eta} (shell18) in the
///            basis at (xi, eta, 0), times det G there over det G here; membrane (hex8): xi in E11,
///            eta in E22, xi and eta in 2 E12 in the basis of the centre, times det G0/det G. So
///            every mode has no work with a constant stress
/// Returns    ok is false where the law has no answer or the iteration finds none
[[nodiscard]] ShellModes shell_modes(const Section<3>& section, const ShellCell& cell,
                                     const material::Memory& memory);

}  // namespace osculate::solid

#pragma once
#include <string>
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// Connected groups of the nodes used by bulk cells.
template <int Dim>
[[nodiscard]] std::vector<std::vector<Index>> deformable_bodies(const BasicModel<Dim>& model);

/// Combines columns to plain ones: each has a component of its own (the first ones first) that the
/// others lack.
[[nodiscard]] Eigen::MatrixXd plain_basis(Eigen::MatrixXd w);

/// A rigid motion of one body that the tangent hardly resists.
template <int Dim>
struct BasicFreeMotion {
  std::string body;
  Vec<Dim> direction = Vec<Dim>::Zero();  ///< unit vector of a translation (zero: pure rotation)
  double rotation = 0;  ///< about the body's centroid, relative to the translation
  Vec3 axis{0, 0, 1};   ///< of the rotation
  Vec<Dim> center = Vec<Dim>::Zero();
  std::vector<Index> nodes{};  ///< of the body
  double stiffness_ratio = 0;  ///< resistance relative to the body's own stiffness
  /// Bodies in contact with it that have to come along: alone it would be resisted by them.
  std::vector<std::string> along{};
  bool pushed = false;  ///< those press it on, and nothing is behind it
};

/// Rigid-body modes of every deformable body that the tangent of the last evaluation does not
/// resist in its forces: the singular values of Z^T K Z (Z = translations and rotations, scaled by
/// the body's size, as far as prescribed nodes allow them) below 1e-6 of the body's own stiffness.
/// Several modes of one body are combined to plain ones: along x, y, z, then about the axes.
///
/// Bodies that contact ties together may have motions that none of them has alone. They are those
/// of the body that the others press on in the direction of the loads (`loads`: external forces of
/// the dofs; empty: of the last evaluation), which comes first.
///
/// Tested by  tests/unit/model/test_diagnosis.cpp
template <int Dim>
[[nodiscard]] std::vector<BasicFreeMotion<Dim>> free_motions(BasicSystem<Dim>& system,
                                                             const BasicModel<Dim>& model,
                                                             const BasicState<Dim>& state,
                                                             const Eigen::VectorXd& loads = {});

/// `body 'block' is free to move along (0.9578, 0.2873)`, or empty. A body that nothing holds gets
/// one phrase for all its motions.
template <int Dim>
[[nodiscard]] std::string free_motion_message(const std::vector<BasicFreeMotion<Dim>>& motions);

/// Slave nodes of one pair that lie beyond the projection domain of the master in the last
/// evaluation (pairing::PointResult::outside_domain).
struct OutsideDomain {
  std::string pair;
  std::vector<Index> nodes;
};
template <int Dim>
[[nodiscard]] std::vector<OutsideDomain> outside_domain(const BasicSystem<Dim>& system,
                                                        const BasicModel<Dim>& model);

/// What it means, in plain words, with the first nodes by name.
template <int Dim>
[[nodiscard]] std::string outside_domain_message(const BasicModel<Dim>& model,
                                                 const OutsideDomain& found);

using FreeMotion = BasicFreeMotion<2>;
using FreeMotion3 = BasicFreeMotion<3>;

}  // namespace osculate::model

#pragma once
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// Sums over the nodes of a body.
template <int Dim>
struct Resultants {
  Vec<Dim> load = Vec<Dim>::Zero();  ///< of the external forces
  /// Where the contacts of the last evaluation would push it: the master's normals at the slave's
  /// points that are closed or touch, and minus them on the master's nodes.
  Vec<Dim> push = Vec<Dim>::Zero();
};

/// What presses on a body in a direction and against it, in the contacts that are closed or touch.
struct Pressed {
  bool onward = false, back = false;
  [[nodiscard]] int sum() const { return (onward ? 1 : 0) - (back ? 1 : 0); }
};
template <int Dim>
[[nodiscard]] Pressed pressed(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                              const std::vector<Index>& body, const Vec<Dim>& direction);

/// `loads`: external forces of the dofs (Forces::external).
template <int Dim>
[[nodiscard]] Resultants<Dim> resultants(const BasicSystem<Dim>& system,
                                         const BasicModel<Dim>& model,
                                         const std::vector<Index>& body,
                                         const Eigen::VectorXd& loads);

}  // namespace osculate::model

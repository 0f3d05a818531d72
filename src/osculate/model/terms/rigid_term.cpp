#include "osculate/model/terms/rigid_term.hpp"

#include <array>

namespace osculate::model {

template <int Dim>
void turn_moments(const BasicModel<Dim>& model, const BasicState<Dim>& trial, bool moved,
                  Assembly<Dim>& to) {
  if constexpr (Dim == 3) {
    Eigen::VectorXd& external = to.into.forces.external;
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = to.dofs.body_dof(static_cast<Index>(b), Dim);
      const Vec3 moment = external.segment<3>(first);
      if (moment.isZero(0)) continue;
      const Vec3& theta = trial.rigid[b].rotation;
      external.segment<3>(first) = body::rotation_tangent(theta).transpose() * moment;
      const std::array<Dof, 3> d{first, first + 1, first + 2};
      if (moved) to.add_stiffness(d, Mat<3, 3>(-to.share * body::moment_gradient(theta, moment)));
    }
  } else {
    (void)model, (void)trial, (void)moved, (void)to;
  }
}

template <int Dim>
void add_rigid_geometry(const BasicModel<Dim>& model, const BasicState<Dim>& trial,
                        std::span<const Vec<Dim>> x, const Eigen::VectorXd& force,
                        Assembly<Dim>& to) {
  constexpr int turns = body::rotations<Dim>;
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    Mat<turns, turns> stiffness = Mat<turns, turns>::Zero();
    for (const Index node : model.rigid[b].nodes) {
      const Vec<Dim> on_node = force.segment<Dim>(Dim * node);
      if (on_node.isZero(0)) continue;
      stiffness +=
          body::rotation_curvature(trial.rigid[b], x[static_cast<std::size_t>(node)], on_node);
    }
    std::array<Dof, turns> d{};
    for (int i = 0; i < turns; ++i)
      d[static_cast<std::size_t>(i)] = to.dofs.body_dof(static_cast<Index>(b), Dim + i);
    to.add_stiffness(d, stiffness);
  }
}

template void turn_moments(const Model&, const State&, bool, Assembly<2>&);
template void turn_moments(const Model3&, const State3&, bool, Assembly<3>&);
template void add_rigid_geometry(const Model&, const State&, std::span<const Vec<2>>,
                                 const Eigen::VectorXd&, Assembly<2>&);
template void add_rigid_geometry(const Model3&, const State3&, std::span<const Vec<3>>,
                                 const Eigen::VectorXd&, Assembly<3>&);

}  // namespace osculate::model

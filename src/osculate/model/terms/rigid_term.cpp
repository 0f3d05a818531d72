#include "osculate/model/terms/rigid_term.hpp"

#include <array>

namespace osculate::model {

namespace {

/// Of a small rotation the motion that turns from where it is, undeformed.
template <int Dim>
body::BasicRigidMotion<Dim> turning_from(const body::BasicRigidMotion<Dim>& motion) {
  if (!motion.small) return motion;
  return {motion.reference, motion.translation};
}

}  // namespace

template <int Dim>
void turn_moments(const BasicModel<Dim>& model, const BasicState<Dim>& trial, bool moved,
                  Assembly<Dim>& to, SmallRotations small) {
  if constexpr (Dim == 3) {
    Eigen::VectorXd& external = to.into.forces.external;
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = to.dofs.body_dof(static_cast<Index>(b), Dim);
      const Vec3 moment = external.segment<3>(first);
      if (moment.isZero(0)) continue;
      const body::RigidMotion3& motion = trial.rigid[b];
      external.segment<3>(first) = body::spin_tangent(motion).transpose() * moment;
      const Mat<3, 3> gradient = body::moment_gradient(
          small == SmallRotations::turn ? turning_from(motion) : motion, moment);
      const std::array<Dof, 3> d{first, first + 1, first + 2};
      if (moved) to.add_stiffness(d, Mat<3, 3>(-to.share * gradient));
    }
  } else {
    (void)model, (void)trial, (void)moved, (void)to, (void)small;
  }
}

template <int Dim>
void add_rigid_geometry(const BasicModel<Dim>& model, const BasicState<Dim>& trial,
                        std::span<const Vec<Dim>> x, const Eigen::VectorXd& force,
                        Assembly<Dim>& to, SmallRotations small) {
  constexpr int turns = body::rotations<Dim>;
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    const body::BasicRigidMotion<Dim>& motion = trial.rigid[b];
    if (motion.small && small == SmallRotations::linear) continue;
    const body::BasicRigidMotion<Dim> turning = turning_from(motion);
    Mat<turns, turns> stiffness = Mat<turns, turns>::Zero();
    for (const Index node : model.rigid[b].nodes) {
      const Vec<Dim> on_node = force.segment<Dim>(Dim * node);
      if (on_node.isZero(0)) continue;
      const Vec<Dim> place =
          motion.center() + body::arm_of(motion, x[static_cast<std::size_t>(node)]);
      stiffness += body::rotation_curvature(turning, place, on_node);
    }
    std::array<Dof, turns> d{};
    for (int i = 0; i < turns; ++i)
      d[static_cast<std::size_t>(i)] = to.dofs.body_dof(static_cast<Index>(b), Dim + i);
    to.add_stiffness(d, stiffness);
  }
}

template void turn_moments(const Model&, const State&, bool, Assembly<2>&, SmallRotations);
template void turn_moments(const Model3&, const State3&, bool, Assembly<3>&, SmallRotations);
template void add_rigid_geometry(const Model&, const State&, std::span<const Vec<2>>,
                                 const Eigen::VectorXd&, Assembly<2>&, SmallRotations);
template void add_rigid_geometry(const Model3&, const State3&, std::span<const Vec<3>>,
                                 const Eigen::VectorXd&, Assembly<3>&, SmallRotations);

}  // namespace osculate::model

#include "block_model.hpp"

#include <Eigen/LU>

namespace osculate::solid::testing {

Eigen::VectorXd dense_solution(const DenseSystem& system, const Eigen::VectorXd& load,
                               const Prescribed& prescribed, int increments, Eigen::VectorXd u) {
  Eigen::VectorXd force;
  Eigen::MatrixXd tangent;
  for (int step = 1; step <= increments; ++step) {
    const double part = static_cast<double>(step) / increments;
    for (int it = 0; it < 30; ++it) {
      system(u, force, tangent);
      Eigen::VectorXd rest = part * load - force;
      const double largest = tangent.diagonal().maxCoeff();
      for (const auto& [dof, value] : prescribed) {
        tangent.row(dof).setZero();
        tangent(dof, dof) = largest;
        rest[dof] = largest * (part * value - u[dof]);
      }
      const Eigen::VectorXd step_u = tangent.partialPivLu().solve(rest);
      u += step_u;
      if (it > 0 && step_u.norm() <= 1e-9 * u.norm()) break;
      if (it == 29) ADD_FAILURE() << "not converged, last step " << step_u.norm();
    }
  }
  return u;
}

}  // namespace osculate::solid::testing

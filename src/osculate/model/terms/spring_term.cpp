#include "osculate/model/terms/spring_term.hpp"

namespace osculate::model {

template <int Dim>
SpringMotion SpringTerm<Dim>::motion(const Spring& spring, const BasicState<Dim>& now,
                                     std::span<const Vec<Dim>> x) const {
  const Dof first = Dim * static_cast<Dof>(x.size());
  return motion_of<Dim>(spring, model.reference, x, [&](Dof dof) {
    if (dof < first) return now.u[dof];
    const auto body = static_cast<std::size_t>((dof - first) / body::motions<Dim>);
    return now.rigid[body].component(static_cast<int>((dof - first) % body::motions<Dim>));
  });
}

template <int Dim>
void SpringTerm<Dim>::add(const BasicState<Dim>& now, std::span<const Vec<Dim>> x,
                          Assembly<Dim>& to) const {
  for (const Spring& spring : model.springs) {
    const SpringMotion m = motion(spring, now, x);
    const SpringResponse r = response(spring, m.elongation);
    for (std::size_t i = 0; i < m.dofs.size(); ++i)
      to.into.forces.internal[m.dofs[i]] += r.force * m.gradient[static_cast<Eigen::Index>(i)];
    if (!to.with_tangent) continue;
    Eigen::MatrixXd k = r.slope * m.gradient * m.gradient.transpose();
    if (m.curvature.size() > 0) k += r.force * m.curvature;
    to.add_stiffness(m.dofs, Eigen::MatrixXd(to.share * k));
  }
}

template <int Dim>
double SpringTerm<Dim>::stored(const BasicState<Dim>& now, std::span<const Vec<Dim>> x) const {
  double sum = 0;
  for (const Spring& spring : model.springs)
    sum += response(spring, motion(spring, now, x).elongation).stored;
  return sum;
}

template <int Dim>
std::vector<typename SpringTerm<Dim>::Damper> SpringTerm<Dim>::dampers(
    const BasicState<Dim>& at, std::span<const Vec<Dim>> x) const {
  std::vector<Damper> out;
  for (const Spring& spring : model.springs)
    if (spring.damping > 0) out.push_back({spring.damping, motion(spring, at, x)});
  return out;
}

template struct SpringTerm<2>;
template struct SpringTerm<3>;

}  // namespace osculate::model

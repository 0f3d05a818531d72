#include "osculate/model/body_resultants.hpp"

#include <algorithm>

namespace osculate::model {
namespace {

/// By node.
template <int Dim>
std::vector<Vec<Dim>> contact_pushes(const BasicSystem<Dim>& system, const BasicModel<Dim>& model) {
  std::vector<Vec<Dim>> pushes(model.reference.size(), Vec<Dim>::Zero());
  const auto add = [&](Index node, const Vec<Dim>& push) {
    pushes[static_cast<std::size_t>(node)] += push;
  };
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    const pairing::PairEvaluation<Dim>& contact = system.contact()[p];
    const double near = 1e-9 * model.pairs[p].height;
    const std::size_t count = std::min(contact.points.size(), pair.slave.points.size());
    for (std::size_t i = 0; i < count; ++i) {
      const pairing::PointResult<Dim>& point = contact.points[i];
      if (point.status == contact::Status::open && !(point.gap <= near)) continue;
      const pairing::SlavePoint<Dim>& slave = pair.slave.points[i];
      for (std::size_t k = 0; k < static_cast<std::size_t>(slave.count); ++k)
        add(slave.nodes[k], slave.shape[k] * point.normal);
      if (point.history.facet < 0) continue;
      const auto& facet = pair.master.facets[static_cast<std::size_t>(point.history.facet)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
        add(facet.nodes[k], -point.normal / facet.count);
    }
  }
  return pushes;
}

}  // namespace

template <int Dim>
Resultants<Dim> resultants(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                           const std::vector<Index>& body, const Eigen::VectorXd& loads) {
  const std::vector<Vec<Dim>> pushes = contact_pushes(system, model);
  Resultants<Dim> sum;
  for (const Index node : body) {
    sum.push += pushes[static_cast<std::size_t>(node)];
    for (int i = 0; i < Dim; ++i)
      if (const Dof dof = system.dofs().node_dof(node, i); system.dofs().unknown_of(dof) >= 0)
        sum.load[i] += loads[dof];
  }
  return sum;
}

template <int Dim>
Pressed pressed(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                const std::vector<Index>& body, const Vec<Dim>& direction) {
  constexpr double along = 0.1;  // what is across holds nothing
  const std::vector<Vec<Dim>> pushes = contact_pushes(system, model);
  Pressed found;
  for (const Index node : body) {
    const Vec<Dim>& push = pushes[static_cast<std::size_t>(node)];
    const double share = push.dot(direction), least = along * push.norm() * direction.norm();
    found.onward = found.onward || share > least;
    found.back = found.back || share < -least;
  }
  return found;
}

template Pressed pressed(const System&, const Model&, const std::vector<Index>&, const Vec2&);
template Pressed pressed(const System3&, const Model3&, const std::vector<Index>&, const Vec3&);
template Resultants<2> resultants(const System&, const Model&, const std::vector<Index>&,
                                  const Eigen::VectorXd&);
template Resultants<3> resultants(const System3&, const Model3&, const std::vector<Index>&,
                                  const Eigen::VectorXd&);

}  // namespace osculate::model

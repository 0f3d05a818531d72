#include "osculate/solid/mass.hpp"

#include "osculate/solid/points.hpp"

namespace osculate::solid {

template <int Dim>
NodeMass consistent_mass(const Section<Dim>& section, cell::CellType type,
                         const Coordinates<Dim>& reference) {
  const Eigen::Index n = reference.rows();
  NodeMass mass = NodeMass::Zero(n, n);
  const Rule<Dim>& rule = mass_rule<Dim>(type);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const auto shape = rule.shape[q].n.head(n);
    mass +=
        volume_at(section, rule.shape[q], rule.weights[q], reference) * shape * shape.transpose();
  }
  return mass;
}

NodeMass lumped_mass(const NodeMass& consistent) {
  NodeMass lumped = NodeMass::Zero(consistent.rows(), consistent.cols());
  double sum = 0;  // one by one: the bits of a sum by packets depend on the place in memory
  for (Eigen::Index j = 0; j < consistent.cols(); ++j)
    for (Eigen::Index i = 0; i < consistent.rows(); ++i) sum += consistent(i, j);
  lumped.diagonal() = consistent.diagonal() * (sum / consistent.trace());
  return lumped;
}

template NodeMass consistent_mass(const Section<2>&, cell::CellType, const Coordinates<2>&);
template NodeMass consistent_mass(const Section<3>&, cell::CellType, const Coordinates<3>&);

}  // namespace osculate::solid

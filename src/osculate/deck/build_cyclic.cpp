#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/deck/build_displacements.hpp"
#include "osculate/deck/foot_on_facets.hpp"

namespace osculate::deck {
namespace {

/// Turns about the axis; a plane model has one across the plane.
template <int Dim>
Mat<3, 3> turn_about(const CyclicSymmetry& s, double angle) {
  const Vec3 axis = Dim == 2 ? Vec3(Vec3::UnitZ()) : Vec3(s.to - s.from);
  if (!(axis.norm() > 0)) throw core::InputError(s.mark, "the points of the axis coincide");
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Where the nodes of the dependent face are on the other one, when that is turned by `q`.
template <int Dim>
std::vector<Foot<Dim>> feet(const BuildContext<Dim>& c, const CyclicSymmetry& s,
                            const std::vector<Index>& nodes, const FacetFeet<Dim>& face,
                            const Mat<3, 3>& q) {
  std::vector<Foot<Dim>> out;
  for (const Index node : nodes) {
    const Vec3 arm = c.model().mesh.nodes[static_cast<std::size_t>(node)] - s.from;
    const Vec3 place = s.from + q.transpose() * arm;
    out.push_back(face.at(place.template head<Dim>()));
  }
  return out;
}

template <int Dim>
double farthest(const std::vector<Foot<Dim>>& feet) {
  double most = 0;
  for (const Foot<Dim>& foot : feet) most = std::max(most, foot.distance);
  return most;
}

/// u - Q sum N u_k = 0 , in all directions. Of a node on the axis that is its own foot, what is
/// left.
template <int Dim>
void add_equations(const BuildContext<Dim>& c, Index node, const Foot<Dim>& foot,
                   const Mat<3, 3>& q, const core::SourceMark& mark,
                   std::vector<MarkedEquation>& all, model::CyclicJoint& joint) {
  for (int i = 0; i < Dim; ++i) {
    model::Equation equation;
    add_displacement(c, node, Vec<Dim>(Vec<Dim>::Unit(i)), 1.0, equation);
    joint.here.push_back(equation);
    const Vec<Dim> back = q.row(i).template head<Dim>().transpose();
    model::Equation& there = joint.there.emplace_back();
    for (const auto& [other, weight] : foot.weights)
      add_displacement(c, other, back, -weight, there);
    for (const model::Equation::Term& term : there.terms) add_term(equation, term.dof, term.factor);
    std::erase_if(equation.terms, [](const model::Equation::Term& term) {
      constexpr double rounding = 1e-12;
      return std::abs(term.factor) <= rounding;
    });
    if (!equation.terms.empty()) all.push_back({std::move(equation), mark, false});
  }
}

}  // namespace

template <int Dim>
void add_cyclic_symmetry(const BuildContext<Dim>& c, std::vector<MarkedEquation>& all) {
  model::RingSector& sector = c.model().sector.emplace();
  for (const CyclicSymmetry& s : c.description.cyclic_symmetry) {
    sector.sectors = s.sectors.value;
    const CyclicSymmetry& first = c.description.cyclic_symmetry.front();
    bool back = Dim == 3 && (s.to - s.from).dot(first.to - first.from) < 0;
    const std::vector<Index> nodes = moving_nodes(c, s.dependent, Idle::refused);
    const FacetFeet<Dim> face(c.model().reference, oriented_facets(c, s.independent));
    const double angle = 2 * std::numbers::pi / s.sectors.value;
    Mat<3, 3> q = turn_about<Dim>(s, angle);
    std::vector<Foot<Dim>> found = feet(c, s, nodes, face, q);
    const Mat<3, 3> other_way = turn_about<Dim>(s, -angle);
    const std::vector<Foot<Dim>> other = feet(c, s, nodes, face, other_way);
    if (farthest(other) < farthest(found)) {
      q = other_way;
      found = other;
      back = !back;
    }
    constexpr double too_far = 0.02;
    if (!(farthest(found) <= too_far * face.size()))
      throw core::InputError(
          s.mark,
          fmt::format("turned by 360/{} degrees, '{}' does not lie on '{}': a node is {:g} "
                      "away from it",
                      s.sectors.value, s.independent.value, s.dependent.value, farthest(found)));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sector.joints.emplace_back().back = back;
      add_equations(c, nodes[i], found[i], q, s.mark, all, sector.joints.back());
    }
  }
}

template void add_cyclic_symmetry(const BuildContext<2>&, std::vector<MarkedEquation>&);
template void add_cyclic_symmetry(const BuildContext<3>&, std::vector<MarkedEquation>&);

}  // namespace osculate::deck

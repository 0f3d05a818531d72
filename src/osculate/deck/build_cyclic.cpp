#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/line_shape.hpp"
#include "osculate/deck/build_displacements.hpp"
#include "osculate/projection/projector.hpp"

namespace osculate::deck {
namespace {

/// The place of a node on the other face.
template <int Dim>
struct Foot {
  std::vector<std::pair<Index, double>> weights;
  double distance = 0;
};

std::vector<double> shape_values(cell::CellType type, const Vec2& xi) {
  std::vector<double> out;
  const auto count = static_cast<std::size_t>(cell::info(type).nodes);
  if (cell::is_facet(type)) {
    const cell::FacetShape shape = cell::facet_shape(type, xi, 0);
    out.assign(shape.n[0].begin(), shape.n[0].begin() + static_cast<std::ptrdiff_t>(count));
  } else {
    const cell::LineShape shape = cell::lagrange_line(static_cast<int>(count), xi[0]);
    out.assign(shape.n[0].begin(), shape.n[0].begin() + static_cast<std::ptrdiff_t>(count));
  }
  return out;
}

template <int Dim>
class OtherFace {
 public:
  OtherFace(const BuildContext<Dim>& c, const CyclicSymmetry& s)
      : facets_(oriented_facets(c, s.independent)), projector_(target(c, facets_)) {}

  [[nodiscard]] Foot<Dim> at(const Vec<Dim>& place) const {
    const projection::ClosestPoint<Dim> found =
        projector_.closest(place, projection::Mode::nearest);
    Foot<Dim> foot;
    if (found.facet < 0) {
      foot.distance = std::numeric_limits<double>::infinity();
      return foot;
    }
    foot.distance = std::abs(found.distance);
    const Side<Dim>& facet = facets_[static_cast<std::size_t>(found.facet)];
    const std::vector<double> n = shape_values(facet.type, found.xi);
    constexpr double none = 1e-9;
    for (std::size_t k = 0; k < n.size(); ++k)
      if (std::abs(n[k]) > none) foot.weights.emplace_back(facet.nodes()[k], n[k]);
    return foot;
  }
  [[nodiscard]] double size() const { return projector_.size(); }

 private:
  static projection::Target<Dim> target(const BuildContext<Dim>& c,
                                        const std::vector<Side<Dim>>& facets) {
    projection::FacetMesh<Dim> mesh;
    mesh.nodes = c.model().reference;
    for (const Side<Dim>& side : facets) {
      projection::MeshFacet& facet = mesh.facets.emplace_back();
      facet.type = side.type;
      std::copy(side.nodes().begin(), side.nodes().end(), facet.nodes.begin());
    }
    return mesh;
  }

  std::vector<Side<Dim>> facets_;
  projection::Projector<Dim> projector_;
};

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
                            const std::vector<Index>& nodes, const OtherFace<Dim>& face,
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
    const OtherFace<Dim> face(c, s);
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

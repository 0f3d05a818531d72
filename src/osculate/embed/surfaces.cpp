#include "osculate/embed/surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "osculate/embed/values.hpp"

namespace osculate::embed {

const FacetKind& kind_of(FacetType type) {
  using cell::CellType;
  static constexpr std::array<FacetKind, 12> kinds{{{"line2", 1, 2, CellType::line2},
                                                    {"line3", 1, 3, CellType::line3},
                                                    {"line4", 1, 4, CellType::line4},
                                                    {"line5", 1, 5, CellType::point1},
                                                    {"line6", 1, 6, CellType::point1},
                                                    {"line7", 1, 7, CellType::point1},
                                                    {"line8", 1, 8, CellType::point1},
                                                    {"tri3", 2, 3, CellType::tri3},
                                                    {"tri6", 2, 6, CellType::tri6},
                                                    {"quad4", 2, 4, CellType::quad4},
                                                    {"quad8", 2, 8, CellType::quad8},
                                                    {"quad9", 2, 9, CellType::quad9}}};
  return kinds.at(static_cast<std::size_t>(type));
}

namespace {

void check_exist(std::span<const Index> list, std::size_t nodes, const std::string& name) {
  for (const Index node : list)
    if (node < 0 || static_cast<std::size_t>(node) >= nodes)
      throw Refused(fmt::format("{}: node {} does not exist", name, node));
}

void check_differ(std::span<const Index> list, const std::string& what) {
  std::set<Index> seen;
  for (const Index node : list)
    if (!seen.insert(node).second) throw Refused(fmt::format("{} names node {} twice", what, node));
}

}  // namespace

void check_facets(const Facets& facets, int dimension, std::size_t nodes, const std::string& name) {
  const FacetKind& kind = kind_of(facets.type);
  if (kind.dimension != dimension - 1)
    throw Refused(fmt::format("{}: facets are {}, not {}", name,
                              dimension == 2 ? "lines" : "tri3, tri6, quad4, quad8 or quad9",
                              kind.name));
  const std::span<const Index> list(facets.nodes);
  const auto per = static_cast<std::size_t>(kind.nodes);
  if (list.size() % per != 0)
    throw Refused(fmt::format("{}: {} node numbers are no whole number of facets of {}", name,
                              list.size(), per));
  check_exist(list, nodes, name);
  for (std::size_t f = 0; f < list.size(); f += per)
    check_differ(list.subspan(f, per), fmt::format("{}: facet {}", name, f / per));
}

namespace {

struct ToCurve {
  geometry::Curve operator()(const Line& s) const {
    return geometry::InfiniteLine{to_vec<2>(s.point), to_vec<2>(s.normal)};
  }
  geometry::Curve operator()(const Segment& s) const {
    return geometry::lagrange_curve(std::array<Vec2, 2>{to_vec<2>(s.from), to_vec<2>(s.to)});
  }
  geometry::Curve operator()(const Circle& s) const {
    return geometry::Circle{to_vec<2>(s.center), s.radius, s.inside};
  }
  geometry::Curve operator()(const Arc& s) const {
    return geometry::Arc{to_vec<2>(s.center), s.radius, s.from, s.to, s.inside};
  }
  geometry::Curve operator()(const NurbsCurve& s) const {
    geometry::NurbsCurve curve{s.degree, s.knots, {}, s.weights};
    for (const Vector<2>& p : s.control) curve.control.push_back(to_vec<2>(p));
    return curve;
  }
};

struct ToSurface {
  geometry::Surface operator()(const Plane& s) const {
    return geometry::Plane{to_vec<3>(s.point), to_vec<3>(s.normal)};
  }
  geometry::Surface operator()(const Sphere& s) const {
    return geometry::Sphere{to_vec<3>(s.center), s.radius, s.inside};
  }
  geometry::Surface operator()(const Cylinder& s) const {
    return geometry::Cylinder{to_vec<3>(s.point), to_vec<3>(s.axis), s.radius, s.inside, s.length};
  }
  geometry::Surface operator()(const Cone& s) const {
    return geometry::Cone{
        to_vec<3>(s.apex), to_vec<3>(s.axis), s.half_angle, s.inside, s.from, s.to};
  }
  geometry::Surface operator()(const Torus& s) const {
    return geometry::Torus{to_vec<3>(s.center), to_vec<3>(s.axis), s.radius, s.tube_radius,
                           s.inside};
  }
  geometry::Surface operator()(const NurbsSurface& s) const {
    geometry::NurbsPatch patch{s.degree, s.knots, s.count, {}, s.weights};
    for (const Vector<3>& p : s.control) patch.control.push_back(to_vec<3>(p));
    return patch;
  }
};

template <class Geometry>
Geometry checked(Geometry shape, const std::string& name) {
  if (const std::string wrong = geometry::validate(shape); !wrong.empty())
    throw Refused(fmt::format("{}: {}: {}", name, geometry::key(shape), wrong));
  return shape;
}

void add_framed(const FramedShapes<2>& framed, const std::string& name, pairing::Chain& chain) {
  std::vector<geometry::Curve> curves;
  for (const CurveShape& shape : framed.shapes) curves.push_back(geometry_of(shape, name));
  if (curves.size() == 1)
    chain.facets.push_back(pairing::shape_facet(curves.front(), framed.frame));
  else
    pairing::add_curves(curves, framed.closed, framed.frame, chain);
}

void add_framed(const FramedShapes<3>& framed, const std::string& name,
                pairing::FacetSurface& surface) {
  if (framed.shapes.size() != 1)
    throw Refused(name + ": in space a frame carries one shape; take a contact for each");
  surface.facets.push_back(
      pairing::shape_facet(geometry_of(framed.shapes.front(), name), framed.frame));
}

void add_facets(const Facets& facets, pairing::Chain& chain) {
  const auto per = static_cast<std::size_t>(kind_of(facets.type).nodes);
  for (std::size_t f = 0; f < facets.nodes.size(); f += per)
    chain.facets.push_back(pairing::lagrange_facet({facets.nodes.data() + f, per}));
}

void add_facets(const Facets& facets, pairing::FacetSurface& surface) {
  const FacetKind& kind = kind_of(facets.type);
  const auto per = static_cast<std::size_t>(kind.nodes);
  for (std::size_t f = 0; f < facets.nodes.size(); f += per)
    surface.facets.push_back(pairing::surface_facet(kind.cell, {facets.nodes.data() + f, per}));
}

}  // namespace

geometry::Curve geometry_of(const CurveShape& shape, const std::string& name) {
  return checked(std::visit(ToCurve{}, shape), name);
}
geometry::Surface geometry_of(const SurfaceShape& shape, const std::string& name) {
  return checked(std::visit(ToSurface{}, shape), name);
}

template <int Dim>
pairing::Boundary<Dim> boundary_of(const Surface<Dim>& surface, std::size_t nodes,
                                   const std::string& name) {
  pairing::Boundary<Dim> boundary;
  for (const Facets& facets : surface.facets) {
    check_facets(facets, Dim, nodes, name);
    add_facets(facets, boundary);
  }
  if (!surface.framed.shapes.empty()) {
    if (!boundary.facets.empty())
      throw Refused(name + ": facets and shapes are surfaces of two contacts");
    check_exist(surface.framed.frame, nodes, name);
    check_differ(surface.framed.frame, name + ": the frame");
    add_framed(surface.framed, name, boundary);
  }
  check_exist(surface.points, nodes, name);
  pairing::connect(boundary);
  return boundary;
}

template pairing::Chain boundary_of(const Surface<2>&, std::size_t, const std::string&);
template pairing::FacetSurface boundary_of(const Surface<3>&, std::size_t, const std::string&);

}  // namespace osculate::embed

// Curves and surfaces in closed form, as classes with the names of include/osculate/shapes.hpp.
#include "osculate/shapes.hpp"

#include <pybind11/stl.h>

#include "comments.hpp"

namespace osculate::python {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using V2 = Vector<2>;
using V3 = Vector<3>;

void add_curves(py::module_& m) {
  py::class_<Line>(m, "Line", comment_of("osculate::Line").c_str())
      .def(py::init([](V2 point, V2 normal) {
             return Line{point, normal};
           }),
           py::arg("point") = V2{0, 0}, py::arg("normal") = V2{0, 1})
      .def_readonly("point", &Line::point)
      .def_readonly("normal", &Line::normal);
  py::class_<Segment>(m, "Segment", comment_of("osculate::Segment").c_str())
      .def(py::init([](V2 a, V2 b) {
             return Segment{a, b};
           }),
           py::arg("start"), py::arg("end"))
      .def_readonly("start", &Segment::from)
      .def_readonly("end", &Segment::to);
  py::class_<Circle>(m, "Circle", comment_of("osculate::Circle").c_str())
      .def(py::init([](V2 c, double r, bool inside) {
             return Circle{c, r, inside};
           }),
           py::arg("center") = V2{0, 0}, py::arg("radius") = 1.0, py::arg("inside") = false)
      .def_readonly("center", &Circle::center)
      .def_readonly("radius", &Circle::radius)
      .def_readonly("inside", &Circle::inside);
  py::class_<Arc>(m, "Arc", comment_of("osculate::Arc").c_str())
      .def(py::init([](V2 c, double r, double a, double b, bool inside) {
             return Arc{c, r, a, b, inside};
           }),
           py::arg("center") = V2{0, 0}, py::arg("radius") = 1.0, py::arg("start") = 0.0,
           py::arg("end") = 1.0, py::arg("inside") = false)
      .def_readonly("center", &Arc::center)
      .def_readonly("radius", &Arc::radius)
      .def_readonly("start", &Arc::from)
      .def_readonly("end", &Arc::to)
      .def_readonly("inside", &Arc::inside);
  py::class_<NurbsCurve>(m, "NurbsCurve", comment_of("osculate::NurbsCurve").c_str())
      .def(py::init([](int degree, std::vector<double> knots, std::vector<V2> control,
                       std::vector<double> weights) {
             if (weights.empty()) weights.assign(control.size(), 1.0);
             return NurbsCurve{degree, std::move(knots), std::move(control), std::move(weights)};
           }),
           py::arg("degree"), py::arg("knots"), py::arg("control"),
           py::arg("weights") = std::vector<double>{})
      .def_readonly("degree", &NurbsCurve::degree)
      .def_readonly("knots", &NurbsCurve::knots)
      .def_readonly("control", &NurbsCurve::control)
      .def_readonly("weights", &NurbsCurve::weights);
}

void add_round_surfaces(py::module_& m) {
  py::class_<Cylinder>(m, "Cylinder", comment_of("osculate::Cylinder").c_str())
      .def(py::init([](V3 p, V3 axis, double r, bool inside, double length) {
             return Cylinder{p, axis, r, inside, length};
           }),
           py::arg("point") = V3{0, 0, 0}, py::arg("axis") = V3{0, 0, 1}, py::arg("radius") = 1.0,
           py::arg("inside") = false, py::arg("length") = infinity)
      .def_readonly("point", &Cylinder::point)
      .def_readonly("axis", &Cylinder::axis)
      .def_readonly("radius", &Cylinder::radius)
      .def_readonly("inside", &Cylinder::inside)
      .def_readonly("length", &Cylinder::length);
  py::class_<Cone>(m, "Cone", comment_of("osculate::Cone").c_str())
      .def(py::init([](V3 apex, V3 axis, double angle, bool inside, double a, double b) {
             return Cone{apex, axis, angle, inside, a, b};
           }),
           py::arg("apex") = V3{0, 0, 0}, py::arg("axis") = V3{0, 0, 1},
           py::arg("half_angle") = 0.5, py::arg("inside") = false, py::arg("start") = 0.0,
           py::arg("end") = infinity)
      .def_readonly("apex", &Cone::apex)
      .def_readonly("axis", &Cone::axis)
      .def_readonly("half_angle", &Cone::half_angle)
      .def_readonly("inside", &Cone::inside)
      .def_readonly("start", &Cone::from)
      .def_readonly("end", &Cone::to);
  py::class_<Torus>(m, "Torus", comment_of("osculate::Torus").c_str())
      .def(py::init([](V3 c, V3 axis, double r, double tube, bool inside) {
             return Torus{c, axis, r, tube, inside};
           }),
           py::arg("center") = V3{0, 0, 0}, py::arg("axis") = V3{0, 0, 1}, py::arg("radius") = 2.0,
           py::arg("tube_radius") = 1.0, py::arg("inside") = false)
      .def_readonly("center", &Torus::center)
      .def_readonly("axis", &Torus::axis)
      .def_readonly("radius", &Torus::radius)
      .def_readonly("tube_radius", &Torus::tube_radius)
      .def_readonly("inside", &Torus::inside);
}

void add_surfaces(py::module_& m) {
  py::class_<Plane>(m, "Plane", comment_of("osculate::Plane").c_str())
      .def(py::init([](V3 point, V3 normal) {
             return Plane{point, normal};
           }),
           py::arg("point") = V3{0, 0, 0}, py::arg("normal") = V3{0, 0, 1})
      .def_readonly("point", &Plane::point)
      .def_readonly("normal", &Plane::normal);
  py::class_<Sphere>(m, "Sphere", comment_of("osculate::Sphere").c_str())
      .def(py::init([](V3 c, double r, bool inside) {
             return Sphere{c, r, inside};
           }),
           py::arg("center") = V3{0, 0, 0}, py::arg("radius") = 1.0, py::arg("inside") = false)
      .def_readonly("center", &Sphere::center)
      .def_readonly("radius", &Sphere::radius)
      .def_readonly("inside", &Sphere::inside);
  py::class_<NurbsSurface>(m, "NurbsSurface", comment_of("osculate::NurbsSurface").c_str())
      .def(py::init([](std::array<int, 2> degree, std::array<std::vector<double>, 2> knots,
                       std::array<int, 2> count, std::vector<V3> control,
                       std::vector<double> weights) {
             if (weights.empty()) weights.assign(control.size(), 1.0);
             return NurbsSurface{degree, std::move(knots), count, std::move(control),
                                 std::move(weights)};
           }),
           py::arg("degree"), py::arg("knots"), py::arg("count"), py::arg("control"),
           py::arg("weights") = std::vector<double>{})
      .def_readonly("degree", &NurbsSurface::degree)
      .def_readonly("knots", &NurbsSurface::knots)
      .def_readonly("count", &NurbsSurface::count)
      .def_readonly("control", &NurbsSurface::control)
      .def_readonly("weights", &NurbsSurface::weights);
}

}  // namespace

void add_shapes(py::module_& m) {
  add_curves(m);
  add_surfaces(m);
  add_round_surfaces(m);
}

}  // namespace osculate::python

// Closest points of many points at once.
#include <pybind11/stl.h>

#include <memory>
#include <variant>

#include "osculate/closest_points.hpp"
#include "osculate/errors.hpp"
#include "surfaces.hpp"

namespace osculate::python {
namespace {

template <int Dim>
using Prepared = std::shared_ptr<const ClosestPoints<Dim>>;
using AnyPrepared = std::variant<Prepared<2>, Prepared<3>>;

struct AnyClosestPoints {
  AnyPrepared value;
};

ClosestMode mode_of(const std::string& word) {
  if (word == "nearest") return ClosestMode::nearest;
  if (word == "fast") return ClosestMode::fast;
  if (word == "certified") return ClosestMode::certified;
  throw Refused("the mode '" + word + "' is none of nearest, fast and certified");
}

template <int Dim>
AnyClosestPoints of_facets(const std::vector<Facets>& facets, const Numbers& coordinates) {
  return {std::make_shared<const ClosestPoints<Dim>>(facets, coordinates_of<Dim>(coordinates))};
}

AnyClosestPoints prepare(const py::object& facets, const Numbers& coordinates) {
  const std::vector<Facets> list = facets_of(facets);
  return dimension_of(coordinates) == 2 ? of_facets<2>(list, coordinates)
                                        : of_facets<3>(list, coordinates);
}

template <class... T>
bool is_one_of(py::handle shape, const std::variant<T...>*) {
  return (py::isinstance<T>(shape) || ...);
}

AnyClosestPoints prepare_shape(const py::object& shape) {
  if (is_one_of(shape, static_cast<const CurveShape*>(nullptr)))
    return {std::make_shared<const ClosestPoints<2>>(shape_of<2>(shape))};
  return {std::make_shared<const ClosestPoints<3>>(shape_of<3>(shape))};
}

template <int Dim>
py::dict find(const Prepared<Dim>& surface, const Numbers& points,
              const ClosestPointOptions& options) {
  ClosestPointArrays<Dim> found;
  {
    const std::span<const double> x = coordinates_of<Dim>(points);
    const py::gil_scoped_release unlocked;
    found = surface->find(x, options);
  }
  const auto count = static_cast<py::ssize_t>(found.status.size());
  py::dict out;
  out["status"] = array_of(std::move(found.status));
  out["feature"] = array_of(std::move(found.feature));
  out["facet"] = array_of(std::move(found.facet));
  out["xi"] = array_of(std::move(found.xi), {count, 2});
  out["point"] = array_of(std::move(found.point), {count, Dim});
  out["distance"] = array_of(std::move(found.distance));
  out["margin"] = array_of(std::move(found.margin));
  out["unique"] = array_of(std::move(found.unique)).attr("view")("?");
  return out;
}

}  // namespace

void add_closest_points(py::module_& m) {
  py::class_<AnyClosestPoints>(m, "ClosestPoints")
      .def_static("of_facets", prepare)
      .def_static("of_shape", prepare_shape)
      .def_property_readonly(
          "dimension", [](const AnyClosestPoints& self) { return self.value.index() == 0 ? 2 : 3; })
      .def("find", [](const AnyClosestPoints& self, const Numbers& points, const std::string& mode,
                      int threads) {
        const ClosestPointOptions options{mode_of(mode), threads};
        return std::visit([&](const auto& surface) { return find(surface, points, options); },
                          self.value);
      });
}

}  // namespace osculate::python

#pragma once
#include <span>
#include <string>
#include <vector>

#include "convert.hpp"
#include "osculate/errors.hpp"
#include "osculate/surface.hpp"

namespace osculate::python {

[[nodiscard]] inline std::string printed(py::handle value) { return py::repr(value); }

/// The value as C++ has it.
///
/// Errors     Refused, with what it is of and what was expected, if it is of another kind
template <class T>
[[nodiscard]] T as(py::handle value, const std::string& what, const char* expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw Refused(what + ": expected " + expected + ", got " + printed(value));
  }
}

/// Facets from pairs of a type's word and an array of nodes, one row a facet.
///
/// Errors     Refused for a word that is no type, and for rows of another length
[[nodiscard]] std::vector<Facets> facets_of(const py::object& pairs);

/// One of the shapes of shapes.cpp.
///
/// Errors     Refused for another object, or a shape of the other dimension
template <int Dim>
[[nodiscard]] Shape<Dim> shape_of(py::handle shape);

/// From an object with the attributes facets, shapes, closed, frame and points (osculate.Surface).
template <int Dim>
[[nodiscard]] Surface<Dim> surface_of(const py::object& surface);

/// Coordinates of points, one behind the other. Errors: Refused unless there are Dim a point.
template <int Dim>
[[nodiscard]] std::span<const double> coordinates_of(const Numbers& numbers);

/// 2 or 3, from an array with one row a point. Errors: Refused for other shapes.
[[nodiscard]] int dimension_of(const Numbers& points);

}  // namespace osculate::python

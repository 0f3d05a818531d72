#include "surfaces.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "osculate/errors.hpp"

namespace osculate::python {
namespace {

struct TypeWord {
  std::string_view word;
  FacetType type;
  py::ssize_t nodes;
};
constexpr std::array<TypeWord, 12> types{{{"line2", FacetType::line2, 2},
                                          {"line3", FacetType::line3, 3},
                                          {"line4", FacetType::line4, 4},
                                          {"line5", FacetType::line5, 5},
                                          {"line6", FacetType::line6, 6},
                                          {"line7", FacetType::line7, 7},
                                          {"line8", FacetType::line8, 8},
                                          {"tri3", FacetType::tri3, 3},
                                          {"tri6", FacetType::tri6, 6},
                                          {"quad4", FacetType::quad4, 4},
                                          {"quad8", FacetType::quad8, 8},
                                          {"quad9", FacetType::quad9, 9}}};

using Nodes = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Whole numbers of any width; an empty list is one of no kind. What they count is checked later.
Nodes whole_numbers(py::handle list) {
  const py::array given = py::array::ensure(list);
  if (!given) throw Refused("nodes: expected an array of whole numbers");
  const char kind = given.dtype().kind();
  if (given.size() > 0 && kind != 'i' && kind != 'u')
    throw Refused(fmt::format("nodes: expected whole numbers, got an array of {}",
                              std::string(py::str(given.dtype()))));
  return Nodes::ensure(given);
}

std::vector<Index> nodes_of(py::handle list) {
  const Nodes nodes = whole_numbers(list);
  std::vector<Index> out;
  out.reserve(static_cast<std::size_t>(nodes.size()));
  for (py::ssize_t i = 0; i < nodes.size(); ++i) {
    const std::int64_t node = nodes.data()[i];
    if (node < 0 || node > std::numeric_limits<Index>::max())
      throw Refused(fmt::format("nodes: {} is no number of a node", node));
    out.push_back(static_cast<Index>(node));
  }
  return out;
}

template <class Variant, std::size_t K = 0>
bool cast_to(py::handle object, Variant& out) {
  if constexpr (K < std::variant_size_v<Variant>) {
    using T = std::variant_alternative_t<K, Variant>;
    if (!py::isinstance<T>(object)) return cast_to<Variant, K + 1>(object, out);
    out = object.cast<T>();
    return true;
  } else {
    return false;
  }
}

}  // namespace

std::vector<Facets> facets_of(const py::object& pairs) {
  std::vector<Facets> out;
  for (const py::handle pair : pairs) {
    const auto [word, list] = as<std::pair<std::string, py::object>>(
        pair, "facets", "pairs of a type and an array of nodes");
    const TypeWord* known = nullptr;
    for (const TypeWord& type : types)
      if (type.word == word) known = &type;
    if (known == nullptr)
      throw Refused(
          fmt::format("'{}' is no type of facets: they are line2 ... line8, tri3, tri6, "
                      "quad4, quad8, quad9",
                      word));
    const Nodes nodes = whole_numbers(list);
    if (nodes.ndim() == 2 && nodes.shape(1) != known->nodes)
      throw Refused(
          fmt::format("a facet {} has {} nodes, not {}", word, known->nodes, nodes.shape(1)));
    out.push_back({known->type, nodes_of(list)});
  }
  return out;
}

template <int Dim>
Shape<Dim> shape_of(py::handle shape) {
  Shape<Dim> out;
  if (!cast_to(shape, out))
    throw Refused(fmt::format("{} is no shape {}",
                              std::string(py::str(py::type::of(shape).attr("__name__"))),
                              Dim == 2 ? "of the plane" : "in space"));
  return out;
}
template Shape<2> shape_of<2>(py::handle);
template Shape<3> shape_of<3>(py::handle);

template <int Dim>
Surface<Dim> surface_of(const py::object& surface) {
  if (!py::hasattr(surface, "facets"))
    throw Refused("expected an osculate.Surface, got " + printed(surface));
  Surface<Dim> out;
  out.facets = facets_of(surface.attr("facets"));
  for (const py::handle shape : surface.attr("shapes"))
    out.framed.shapes.push_back(shape_of<Dim>(shape));
  out.framed.closed = as<bool>(surface.attr("closed"), "closed", "True or False");
  const std::vector<Index> frame = nodes_of(surface.attr("frame"));
  if (!out.framed.shapes.empty() && frame.size() != out.framed.frame.size())
    throw Refused(fmt::format("a shape stands on a frame of {} nodes, not of {}",
                              out.framed.frame.size(), frame.size()));
  if (!out.framed.shapes.empty()) std::copy(frame.begin(), frame.end(), out.framed.frame.begin());
  out.points = nodes_of(surface.attr("points"));
  return out;
}
template Surface<2> surface_of<2>(const py::object&);
template Surface<3> surface_of<3>(const py::object&);

template <int Dim>
std::span<const double> coordinates_of(const Numbers& numbers) {
  if (numbers.ndim() == 2 && numbers.shape(1) != Dim)
    throw Refused(fmt::format("expected {} coordinates a point, got {}", Dim, numbers.shape(1)));
  return {numbers.data(), static_cast<std::size_t>(numbers.size())};
}
template std::span<const double> coordinates_of<2>(const Numbers&);
template std::span<const double> coordinates_of<3>(const Numbers&);

int dimension_of(const Numbers& points) {
  if (points.ndim() != 2 || (points.shape(1) != 2 && points.shape(1) != 3))
    throw Refused("expected an array with one row of 2 or 3 coordinates a point");
  return static_cast<int>(points.shape(1));
}

}  // namespace osculate::python

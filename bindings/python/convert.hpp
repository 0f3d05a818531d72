#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "osculate/deck/source_tree.hpp"

namespace osculate::python {

namespace py = pybind11;

/// Parts of the module.
void add_run(py::module_& m);
void add_shapes(py::module_& m);
void add_closest_points(py::module_& m);
void add_contact(py::module_& m);
void add_contact_point(py::module_& m);
void add_domain(py::module_& m);
void add_element(py::module_& m);
void add_line_search(py::module_& m);
void add_model_parts(py::module_& m);

/// A dictionary as the reader of model files takes it: with its keys and no lines. Mappings, lists,
/// tuples, NumPy arrays, numbers, texts, truth values, None and paths; a text that begins with `=`
/// is an expression of `parameters`, as in a file.
///
/// Errors     core::InputError that names the key of anything else
[[nodiscard]] deck::SourceNode source_of(py::handle model, const std::string& file);

/// A text of the library with the names of Python's arguments in place of the program's options.
[[nodiscard]] std::string in_python(std::string text);

/// The values as an array that nobody copies: it owns them.
template <class T>
py::array array_of(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
  auto* const kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(std::move(shape), kept->data(), owner);
}
template <class T>
py::array array_of(std::vector<T>&& values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

/// Numbers as the library reads them, without a copy where they are doubles one behind the other.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

}  // namespace osculate::python

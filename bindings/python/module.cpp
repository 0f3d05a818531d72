// The Python module: what `osculate` (the folder beside this file) is made of.
#include <pybind11/pybind11.h>

#include <cerrno>

#include "comments.hpp"
#include "convert.hpp"
#include "osculate/cell/cell_type.hpp"
#include "osculate/contact.hpp"
#include "osculate/core/memory.hpp"
#include "osculate/core/processor.hpp"
#include "osculate/core/version.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/la/blas_at_start.hpp"

namespace osculate::python {
namespace {

py::object error_class(const char* name) {
  return py::module_::import("osculate._errors").attr(name);
}

void set_error(const py::object& type, const py::object& value) {
  PyErr_SetObject(type.ptr(), value.ptr());
}

/// Ours as Python's, with the texts of the program.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const core::InputError& error) {
    const py::object type = error_class("InputError");
    const core::SourceMark& mark = error.mark();
    set_error(type, type(in_python(error.what()), mark.file, mark.line, mark.key));
  } catch (const Refused& error) {
    const py::object type = error_class("Refused");
    set_error(type, type(error.what()));
  } catch (const io::WriteError& error) {
    const int number = error.error_number() != 0 ? error.error_number() : EIO;
    set_error(py::reinterpret_borrow<py::object>(PyExc_OSError),
              py::make_tuple(number, error.what()));
  } catch (const std::bad_alloc& error) {
    PyErr_SetString(PyExc_MemoryError, core::out_of_memory_text(error).c_str());
  }
}

py::dict cells() {
  py::dict out;
  for (const cell::CellInfo& info : cell::all_cells()) {
    if (info.gmsh_type == 0) continue;
    py::list order;
    for (const std::int8_t k : cell::vtk_nodes(info.type)) order.append(static_cast<int>(k));
    out[py::str(std::string(info.name))] =
        py::make_tuple(info.dimension, info.nodes, info.gmsh_type, info.vtk_type, order);
  }
  return out;
}

}  // namespace
}  // namespace osculate::python

PYBIND11_MODULE(_core, m) {
  using namespace osculate;  // NOLINT(google-build-using-namespace)
#if defined(__AVX2__) && defined(__x86_64__)
  if (!core::has_avx2())
    throw std::runtime_error(
        "osculate: this build needs a CPU with AVX2 and FMA (x86-64-v3); configure with "
        "-DOSCULATE_BASELINE=ON for older ones");
#endif
  la::prepare_blas();
  m.attr("version") = std::string(core::version);
  m.attr("comments") = python::all_comments();
  pybind11::register_exception_translator(python::translate);
  m.def("cells", python::cells, "name: (dimension, nodes, Gmsh's type, VTK's type, order in VTK)");
  python::add_run(m);
  python::add_shapes(m);
  python::add_closest_points(m);
  python::add_contact(m);
  python::add_contact_point(m);
  python::add_domain(m);
  python::add_element(m);
  python::add_line_search(m);
  python::add_model_parts(m);
}

// The line search of the public header, for solvers in Python.
#include "osculate/line_search.hpp"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <functional>
#include <tuple>

#include "convert.hpp"

namespace osculate::python {

void add_line_search(py::module_& m) {
  using Look = std::function<std::tuple<double, double, bool, bool>(double)>;
  m.def("line_search", [](double work, double norm, const Look& look) {
    return line_search({work, norm}, [&](double step) {
      const auto [w, n, branched, ok] = look(step);
      return LinePoint{w, n, branched, ok};
    });
  });
}

}  // namespace osculate::python

#pragma once
#include "convert.hpp"
#include "osculate/result/data_set.hpp"

namespace osculate::python {

/// As the files of results have it: connectivity in VTK's order, ends of the cells, their types.
[[nodiscard]] py::tuple data_set(result::DataSet&& set);

}  // namespace osculate::python

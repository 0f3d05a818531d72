#pragma once
#include "convert.hpp"
#include "osculate/options.hpp"

namespace osculate::python {

/// A contact from the arguments of osculate.Evaluator, by their names.
///
/// Errors     Refused for words and laws that there are not
template <int Dim>
[[nodiscard]] Contact<Dim> contact_of(const py::dict& arguments);

}  // namespace osculate::python

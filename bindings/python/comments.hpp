#pragma once
#include <string>
#include <string_view>

#include "convert.hpp"

namespace osculate::python {

/// The comment of a C++ declaration, such as `osculate::History::bytes`, and behind it what Python
/// has otherwise: a docstring. tools/docstrings.py finds the names in these sources and the
/// comments in the headers; the build fails where there is none.
[[nodiscard]] std::string comment_of(std::string_view name, std::string_view in_python = {});

/// All of them by their names, for functions and classes that are written in Python.
[[nodiscard]] py::dict all_comments();

}  // namespace osculate::python

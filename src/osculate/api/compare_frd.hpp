#pragma once
#include <string>

#include "osculate/api/compare.hpp"

namespace osculate::api {

/// Two result files of CalculiX, result by result: those of one name and time, at the nodes of one
/// number and place (to 1e-4 of the size of the model).
///
/// Errors     core::InputError for files that cannot be read, and for two without a result in
/// common Tested by  tests/system/test_compare.py
[[nodiscard]] Comparison compare_frd(const std::string& a, const std::string& b);

/// The path of a .frd file, or of the one in a folder; empty where there is not one.
[[nodiscard]] std::string frd_of(const std::string& path);

}  // namespace osculate::api

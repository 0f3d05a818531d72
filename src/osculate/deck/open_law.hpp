#pragma once
#include <filesystem>
#include <string>

#include "osculate/deck/params.hpp"

namespace osculate::deck {

/// Finds the function of a law whose formulas are one, relative to the folder of the file.
/// Addresses are for documents that the process itself hands over, which have no lines.
template <class T>
void open_law(T& law, const Value& v) {
  if constexpr (requires { law.open(std::string()); }) {
    if (v.mark.line > 0 && law.library.empty())
      throw core::InputError(v.mark, "required key 'library' is missing");
    require_none(law.open(std::filesystem::path(v.mark.file).parent_path().string()), v);
  }
}

}  // namespace osculate::deck

#include "comments.hpp"

#include <algorithm>
#include <stdexcept>

#include "comments_table.hpp"

namespace osculate::python {

std::string comment_of(std::string_view name, std::string_view in_python) {
  const auto* const found = std::ranges::find_if(
      comments, [&](const auto& entry) { return std::string_view(entry.first) == name; });
  if (found == comments.end())
    throw std::logic_error("tools/docstrings.py has no comment of " + std::string(name));
  std::string text = found->second;
  if (!in_python.empty()) text.append("\n\n").append(in_python);
  return text;
}

py::dict all_comments() {
  py::dict out;
  for (const auto& [name, text] : comments) out[name] = text;
  return out;
}

}  // namespace osculate::python

#include "convert.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

namespace osculate::python {
namespace {

using Kind = deck::SourceNode::Kind;

/// What a plain value of YAML with these letters would not be: a text.
bool needs_quotes(const std::string& text) {
  if (text.empty() || text == "true" || text == "false" || text == "null" || text == "~")
    return true;
  double number = 0;
  const char* const first = text.data() + (text[0] == '+' ? 1 : 0);
  const char* const last = text.data() + text.size();
  return std::from_chars(first, last, number).ptr == last;
}

deck::SourceNode scalar(std::string text, bool quoted = false) {
  deck::SourceNode node;
  node.kind = Kind::scalar;
  node.quoted = quoted;
  node.text = std::move(text);
  return node;
}

/// The shortest digits that are read back as the same number.
std::string digits(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  return fmt::format("{}", value);
}

class Converter {
 public:
  explicit Converter(const std::string& file) : file_(file) {}

  deck::SourceNode node(py::handle value, const std::string& path, std::size_t depth = 0) {
    if (depth > deck::TextLimits{}.depth)
      fail("",
           fmt::format("lists and maps are nested more than {} deep", deck::TextLimits{}.depth));
    if (value.is_none()) return {};
    if (py::isinstance<py::bool_>(value)) return scalar(value.cast<bool>() ? "true" : "false");
    if (PyLong_Check(value.ptr())) return scalar(py::str(value));
    if (PyFloat_Check(value.ptr())) return scalar(digits(PyFloat_AS_DOUBLE(value.ptr())));
    if (py::isinstance<py::str>(value)) {
      std::string text = value.cast<std::string>();
      const bool quoted = needs_quotes(text);
      return scalar(std::move(text), quoted);
    }
    if (py::hasattr(value, "items")) return map(value.attr("items")(), path, depth);
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
      return list(value, path, depth);
    if (py::hasattr(value, "tolist")) return node(value.attr("tolist")(), path, depth + 1);
    if (py::hasattr(value, "__fspath__")) return node(value.attr("__fspath__")(), path, depth + 1);
    fail(path, fmt::format("expected a number, text, list or dictionary, got {}",
                           std::string(py::str(py::type::of(value).attr("__name__")))));
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& message) const {
    throw core::InputError({file_, 0, path}, message);
  }

  deck::SourceNode list(py::handle values, const std::string& path, std::size_t depth) {
    deck::SourceNode out;
    out.kind = Kind::list;
    for (const py::handle value : values)
      out.items.push_back(node(value, fmt::format("{}[{}]", path, out.items.size()), depth + 1));
    return out;
  }

  deck::SourceNode map(const py::object& items, const std::string& path, std::size_t depth) {
    deck::SourceNode out;
    out.kind = Kind::map;
    for (const py::handle item : items) {
      const auto [key, value] = item.cast<std::pair<py::object, py::object>>();
      if (!py::isinstance<py::str>(key)) fail(path, "a key must be a word");
      const std::string name = key.cast<std::string>();
      if (name.empty()) fail(path, "a key must be a word");
      const std::string below = path.empty() ? name : path + "." + deck::printable(name);
      out.entries.push_back({name, 0, node(value, below, depth + 1)});
    }
    return out;
  }

  const std::string& file_;
};

}  // namespace

std::string in_python(std::string text) {
  constexpr std::array<std::array<std::string_view, 2>, 4> words{
      {{"--max-iterations", "max_iterations"},
       {"--max-minutes", "max_minutes"},
       {"--until:", "until:"},
       {"run without --restart", "run with restart=False"}}};
  for (const auto& [option, argument] : words)
    if (const std::size_t at = text.find(option); at != std::string::npos)
      text.replace(at, option.size(), argument);
  return text;
}

deck::SourceNode source_of(py::handle model, const std::string& file) {
  return Converter(file).node(model, "");
}

}  // namespace osculate::python

#include "osculate/io/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

#include "osculate/core/error.hpp"
#include "osculate/io/utf8.hpp"

namespace osculate::io {
namespace {

using Corner = std::array<double, 3>;

constexpr std::size_t header_size = 84, triangle_size = 50;

std::uint32_t triangles_of(std::string_view content) {
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + header_size - sizeof count, sizeof count);
  return count;
}

bool is_binary(std::string_view content) {
  return content.size() >= header_size &&
         content.size() == header_size + triangle_size * std::size_t{triangles_of(content)};
}

/// The mesh while triangle after triangle comes.
class Triangles {
 public:
  void begin_solid(std::string_view name) {
    const std::string known = name.empty() || !is_plain_text(name) ? "surface" : std::string(name);
    const auto is = [&](const mesh::Set& set) { return set.name == known; };
    auto found = std::find_if(mesh_.sets.begin(), mesh_.sets.end(), is);
    if (found == mesh_.sets.end()) {
      mesh_.sets.push_back({known, 2, {}, {}});
      found = mesh_.sets.end() - 1;
    }
    set_ = static_cast<std::size_t>(found - mesh_.sets.begin());
  }
  void add(const std::array<Corner, 3>& corners) {
    std::array<Index, 3> nodes{};
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = node_at(corners[k]);
    if (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0]) return;
    mesh_.sets[set_].cells.push_back({0, static_cast<Index>(connectivity_.size() / 3)});
    connectivity_.insert(connectivity_.end(), nodes.begin(), nodes.end());
  }
  [[nodiscard]] bool empty() const { return connectivity_.empty(); }
  [[nodiscard]] mesh::Mesh take() {
    for (mesh::Set& set : mesh_.sets) {
      for (const mesh::CellRef& ref : set.cells)
        for (std::size_t k = 0; k < 3; ++k)
          set.nodes.push_back(connectivity_[3 * static_cast<std::size_t>(ref.cell) + k]);
      std::sort(set.nodes.begin(), set.nodes.end());
      set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
    }
    mesh_.blocks.push_back({cell::CellType::tri3, std::move(connectivity_)});
    return std::move(mesh_);
  }

 private:
  Index node_at(Corner at) {
    for (double& x : at) x += 0.0;  // no negative zeros
    const auto [entry, fresh] = nodes_.try_emplace(at, static_cast<Index>(mesh_.nodes.size()));
    if (fresh) mesh_.nodes.emplace_back(at[0], at[1], at[2]);
    return entry->second;
  }

  mesh::Mesh mesh_;
  std::vector<Index> connectivity_;
  std::map<Corner, Index> nodes_;
  std::size_t set_ = 0;
};

/// Words of a text, and the line that the last one stands on.
class Words {
 public:
  Words(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw core::InputError({name_, line_, ""}, what);
  }
  /// Empty at the end.
  std::string_view next() {
    while (!rest_.empty() && is_blank(rest_.front())) drop(1);
    std::size_t size = 0;
    while (size < rest_.size() && !is_blank(rest_[size])) ++size;
    const std::string_view word = rest_.substr(0, size);
    drop(size);
    return word;
  }
  void expect(std::string_view word) {
    const std::string_view found = next();
    if (found == word) return;
    if (found.empty()) fail(fmt::format("the file ends where '{}' is expected", word));
    fail(fmt::format("expected '{}', found '{}'", word, shown(found)));
  }
  double number() {
    const std::string_view word = next();
    double value = 0;
    const bool plus = !word.empty() && word.front() == '+';
    const auto [end, wrong] =
        std::from_chars(word.data() + (plus ? 1 : 0), word.data() + word.size(), value);
    if (word.empty() || wrong != std::errc() || end != word.data() + word.size() ||
        !std::isfinite(value))
      fail(fmt::format("expected a coordinate, found '{}'", shown(word)));
    return value;
  }
  std::string_view rest_of_line() {
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    std::string_view text = rest_.substr(0, end);
    drop(end);
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  static std::string shown(std::string_view word) {
    constexpr std::size_t most = 40;
    return is_plain_text(word.substr(0, most)) ? std::string(word.substr(0, most)) : "...";
  }
  void drop(std::size_t count) {
    line_ += static_cast<int>(
        std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
    rest_.remove_prefix(count);
  }

  std::string_view rest_;
  const std::string& name_;
  int line_ = 1;
};

void read_facet(Words& words, Triangles& all) {
  words.expect("normal");
  for (int k = 0; k < 3; ++k) (void)words.next();  // not always a number
  words.expect("outer");
  words.expect("loop");
  std::array<Corner, 3> corners{};
  for (Corner& corner : corners) {
    words.expect("vertex");
    for (double& x : corner) x = words.number();
  }
  words.expect("endloop");
  words.expect("endfacet");
  all.add(corners);
}

void read_text(std::string_view content, const std::string& name, Triangles& all) {
  Words words(content, name);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word != "solid") words.fail("expected 'solid' and the triangles of a surface (STL)");
    all.begin_solid(words.rest_of_line());
    std::string_view inside = words.next();
    for (; inside == "facet"; inside = words.next()) read_facet(words, all);
    if (inside.empty()) words.fail("the file ends before 'endsolid'");
    if (inside != "endsolid") words.fail("expected 'facet' or 'endsolid'");
    (void)words.rest_of_line();
  }
}

void read_binary(std::string_view content, const std::string& name, Triangles& all) {
  all.begin_solid({});
  for (std::size_t t = 0; t < triangles_of(content); ++t) {
    std::array<float, 12> numbers{};  // the normal, three corners
    std::memcpy(numbers.data(), content.data() + header_size + t * triangle_size, sizeof numbers);
    std::array<Corner, 3> corners{};
    for (std::size_t k = 0; k < 9; ++k) {
      const double x = numbers[3 + k];
      if (!std::isfinite(x))
        throw core::InputError({name, 0, ""},
                               fmt::format("a coordinate of triangle {} is no number", t + 1));
      corners[k / 3][k % 3] = x;
    }
    all.add(corners);
  }
}

}  // namespace

bool looks_like_stl(std::string_view content) {
  if (is_binary(content)) return true;
  return content.starts_with("solid") && content.substr(0, 1000).find("facet") != content.npos;
}

mesh::Mesh read_stl(std::string_view content, const std::string& name) {
  Triangles all;
  if (is_binary(content))
    read_binary(content, name, all);
  else
    read_text(content, name, all);
  if (all.empty()) throw core::InputError({name, 0, ""}, "the file has no triangles");
  return all.take();
}

}  // namespace osculate::io

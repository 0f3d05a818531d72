#include "osculate/io/read_frd.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "osculate/core/error.hpp"
#include "osculate/io/gmsh.hpp"

namespace osculate::io {
namespace {

constexpr std::size_t key = 3, wide = 10, real = 12;  // columns of a line of numbers

class FrdLines {
 public:
  explicit FrdLines(const std::string& path) : path_(path), text_(read_file(path)) {}

  /// False at the end.
  bool next() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line_ = std::string_view(text_).substr(at_, end - at_);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    at_ = end + 1;
    ++number_;
    return true;
  }
  [[nodiscard]] bool begins(std::string_view with) const { return line_.starts_with(with); }
  [[nodiscard]] std::size_t length() const { return line_.size(); }
  [[nodiscard]] std::string_view column(std::size_t from, std::size_t count) const {
    std::string_view text = from < line_.size() ? line_.substr(from, count) : std::string_view{};
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    return text;
  }
  template <class T>
  [[nodiscard]] T number(std::size_t from, std::size_t count) const {
    T value{};
    const std::string_view text = column(from, count);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("expected a number, got '{}'", text));
    return value;
  }
  /// Blocks say in which format they are.
  void require_long(std::size_t column_of_format) const {
    if (column(column_of_format, 2) != "1")
      fail("only .frd files in ASCII with node numbers of ten digits are read");
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw core::InputError({path_, number_, ""}, why);
  }

 private:
  std::string path_, text_;
  std::string_view line_;
  std::size_t at_ = 0;
  int number_ = 0;
};

/// The numbers behind a node's, of ` -1` and of the ` -2` that go on.
void append_values(const FrdLines& lines, std::vector<double>& values) {
  for (std::size_t from = key + wide; from + real <= lines.length(); from += real)
    values.push_back(lines.number<double>(from, real));
}

/// Lines up to ` -3`.
template <class Use>
void read_block(FrdLines& lines, const Use& use) {
  while (lines.next()) {
    if (lines.begins(" -3")) return;
    use();
  }
  lines.fail("the file ends within a block");
}

void read_nodes(FrdLines& lines, FrdContent& out) {
  read_block(lines, [&] {
    out.nodes.push_back(lines.number<std::int64_t>(key, wide));
    Vec3 place;
    for (int k = 0; k < 3; ++k)
      place[k] = lines.number<double>(key + wide + real * static_cast<std::size_t>(k), real);
    out.places.push_back(place);
  });
}

FrdResult read_result(FrdLines& lines) {
  constexpr std::size_t time = 12, kind = 56, format = 73;  // columns
  lines.require_long(format);
  FrdResult out;
  out.time = lines.number<double>(time, real);
  const std::string_view type = lines.column(kind, 2);
  out.mode = type == "2" || type == "4";
  read_block(lines, [&] {
    if (lines.begins(" -4")) out.name = lines.column(key, 10);
    if (lines.begins(" -1")) out.nodes.push_back(lines.number<std::int64_t>(key, wide));
    if (lines.begins(" -1") || lines.begins(" -2")) append_values(lines, out.values);
  });
  if (!out.nodes.empty() && out.values.size() % out.nodes.size() != 0)
    lines.fail(fmt::format("{}: not all nodes have as many numbers", out.name));
  return out;
}

}  // namespace

FrdContent read_frd(const std::string& path) {
  FrdLines lines(path);
  FrdContent out;
  while (lines.next()) {
    if (lines.begins("    2C")) {
      lines.require_long(73);
      read_nodes(lines, out);
    } else if (lines.begins("    3C")) {
      read_block(lines, [] {});
    } else if (lines.begins("  100C")) {
      out.results.push_back(read_result(lines));
    }
  }
  if (out.nodes.empty()) throw core::InputError({path, 0, ""}, "no .frd file: it has no nodes");
  return out;
}

}  // namespace osculate::io

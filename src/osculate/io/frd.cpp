#include "osculate/io/frd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

namespace osculate::io {
namespace {

/// Twelve columns: 1.23456E-04. An exponent has two digits.
void append_real(std::string& out, double value) {
  constexpr double least = 1e-99, most = 9.99999e99;
  if (!std::isfinite(value) || std::abs(value) < least) value = 0;
  fmt::format_to(std::back_inserter(out), "{:12.5E}", std::clamp(value, -most, most));
}

/// Ten columns.
void append_number(std::string& out, std::int64_t number) {
  constexpr std::size_t columns = 10;
  const fmt::format_int text(number);
  if (text.size() < columns) out.append(columns - text.size(), ' ');
  out.append(text.data(), text.size());
}

/// Twelve columns with as many digits as they hold.
std::string time_text(double time) {
  if (!(time >= 1 && time < 1e10)) return fmt::format("{:12.5E}", time);
  return fmt::format("{:12.{}f}", time, 9 - static_cast<int>(std::log10(time)));
}

std::string user_line(std::string_view key, std::string_view value, int width = 48) {
  return fmt::format("    1U{:18}{:{}}\n", key, value.substr(0, static_cast<std::size_t>(width)),
                     width);
}

struct Written {
  cell::CellType type;
  const Index* nodes;
};
Written written_for(const FrdMesh::Cell& one, const mesh::Mesh& mesh) {
  if (one.as) return {one.as->type, one.as->nodes.data()};
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(one.ref.block)];
  return {block.type, block.cell(one.ref.cell)};
}

bool unique(std::vector<std::int64_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end() &&
         (numbers.empty() || numbers.front() > 0);
}

/// As VTK has them, but that in cells of second order the edges between the two faces come before
/// those of the second face.
std::vector<int> local_nodes(cell::CellType type, std::size_t corners, std::size_t count) {
  const std::span<const std::int8_t> vtk = cell::vtk_nodes(type);
  std::vector<int> nodes(vtk.begin(), vtk.begin() + static_cast<std::ptrdiff_t>(count));
  const bool prism = corners == 6 || corners == 8;
  if (prism && count > corners) {
    const auto second = nodes.begin() + static_cast<std::ptrdiff_t>(corners + corners / 2);
    std::rotate(second, second + static_cast<std::ptrdiff_t>(corners / 2), nodes.end());
  }
  return nodes;
}

}  // namespace

FrdCell frd_cell(cell::CellType type) {
  using enum cell::CellType;
  switch (type) {
    case hex8:
    case shell18:
      return {1, local_nodes(type, 8, 8)};
    case wedge6:
      return {2, local_nodes(type, 6, 6)};
    case tet4:
      return {3, local_nodes(type, 4, 4)};
    case hex20:
    case hex27:
      return {4, local_nodes(type, 8, 20)};
    case wedge15:
      return {5, local_nodes(type, 6, 15)};
    case tet10:
      return {6, local_nodes(type, 4, 10)};
    case line2:
      return {11, {0, 1}};
    case line3:
      return {12, {0, 1, 2}};
    case tri3:
      return {7, local_nodes(type, 3, 3)};
    case tri6:
      return {8, local_nodes(type, 3, 6)};
    case quad4:
      return {9, local_nodes(type, 4, 4)};
    case quad8:
    case quad9:
      return {10, local_nodes(type, 4, 8)};
    default:
      return {};
  }
}

std::string frd_head(const FrdHead& head) {
  std::string text = "    1C\n";
  if (!head.title.empty()) text += fmt::format("    1U{:66}\n", head.title.substr(0, 66));
  text += user_line("USER", "") + user_line("DATE", head.date) + user_line("TIME", head.time) +
          user_line("HOST", "") + user_line("PGM", head.program) +
          user_line("VERSION", "Version " + head.version) + user_line("DIR", "") +
          user_line("DBN", "");
  for (std::size_t m = 0; m < head.materials.size(); ++m)
    text += fmt::format("    1UMAT{:5}{:58}\n", m + 1, head.materials[m].substr(0, 58));
  return text;
}

FrdMesh frd_mesh(const mesh::Mesh& mesh, std::vector<FrdMesh::Cell> cells) {
  FrdMesh out;
  std::vector<char> used(mesh.nodes.size(), 0);
  for (FrdMesh::Cell& one : cells) {
    const auto [type, nodes] = written_for(one, mesh);
    const FrdCell shape = frd_cell(type);
    if (shape.type == 0) continue;
    for (const int k : shape.nodes) used[static_cast<std::size_t>(nodes[k])] = 1;
    one.number = mesh::cell_number(mesh, one.ref);
    out.cells.push_back(one);
  }
  for (std::size_t n = 0; n < used.size(); ++n)
    if (used[n] != 0) out.nodes.push_back(static_cast<Index>(n));
  std::sort(out.nodes.begin(), out.nodes.end(), [&](Index a, Index b) {
    return mesh::node_number(mesh, a) < mesh::node_number(mesh, b);
  });
  for (const Index n : out.nodes) out.numbers.push_back(mesh::node_number(mesh, n));
  if (!unique(out.numbers)) std::iota(out.numbers.begin(), out.numbers.end(), 1);
  std::vector<std::int64_t> numbers;
  for (const FrdMesh::Cell& one : out.cells) numbers.push_back(one.number);
  if (!unique(numbers))
    for (std::size_t c = 0; c < numbers.size(); ++c)
      out.cells[c].number = static_cast<std::int64_t>(c) + 1;
  std::sort(out.cells.begin(), out.cells.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  return out;
}

std::string frd_nodes(const FrdMesh& part, const mesh::Mesh& mesh) {
  std::string out = fmt::format("    2C{:30}{:38}\n", part.nodes.size(), 1);
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    out += " -1";
    append_number(out, part.numbers[i]);
    const Vec3& x = mesh.nodes[static_cast<std::size_t>(part.nodes[i])];
    for (const double value : {x.x(), x.y(), x.z()}) append_real(out, value);
    out += '\n';
  }
  return out + " -3\n";
}

std::string frd_cells(const FrdMesh& part, const mesh::Mesh& mesh) {
  std::vector<std::int64_t> number(mesh.nodes.size(), 0);
  for (std::size_t i = 0; i < part.nodes.size(); ++i)
    number[static_cast<std::size_t>(part.nodes[i])] = part.numbers[i];
  constexpr std::size_t in_a_line = 10;
  std::string out = fmt::format("    3C{:30}{:38}\n", part.cells.size(), 1);
  cell::CellType type = cell::CellType::point1;
  FrdCell shape;
  for (const FrdMesh::Cell& one : part.cells) {
    const auto [of, nodes] = written_for(one, mesh);
    if (of != type) shape = frd_cell(type = of);
    fmt::format_to(std::back_inserter(out), " -1{:10}{:5}{:5}{:5}\n", one.number, shape.type, 0,
                   one.material);
    for (std::size_t k = 0; k < shape.nodes.size(); ++k) {
      if (k % in_a_line == 0) out += k > 0 ? "\n -2" : " -2";
      append_number(out, number[static_cast<std::size_t>(nodes[shape.nodes[k]])]);
    }
    out += '\n';
  }
  return out + " -3\n";
}

std::string frd_field(const FrdMesh& part, const FrdTime& at, bool vector,
                      std::span<const std::string_view> names, std::span<const double> values) {
  const std::size_t width = names.size() - 1;
  if (values.size() != width * part.nodes.size())
    throw std::invalid_argument(fmt::format("field '{}' has {} values for {} nodes", names[0],
                                            values.size(), part.nodes.size()));
  std::string out =
      fmt::format("    1PSTEP{:26}{:12}{:12}          \n", at.piece, at.increment, at.step);
  if (at.mode)
    out += fmt::format(
        "    1PGM                1.000000E+00                                  \n"
        "    1PGK                {:.6E}                                  \n"
        "    1PHID{:27}                                  \n    1PSUBC{:26}                       "
        "           \n    1PMODE{:26}                                  \n",
        at.mode->omega_squared, -1, 0, at.mode->number);
  out += fmt::format("  100CL{:5}{}{:12}                    {:2}{:5}{:10}{:2}\n", 100 + at.set,
                     time_text(at.mode ? at.mode->frequency : at.time), part.nodes.size(),
                     at.mode       ? 2
                     : at.buckles  ? 4
                     : at.harmonic ? 1
                                   : 0,
                     at.mode ? at.mode->number : at.set, at.mode ? "MODAL" : "", 1);
  out += fmt::format(" -4  {:8}{:5}{:5}\n", names[0], width + (vector ? 1 : 0), 1);
  constexpr std::array<std::array<int, 2>, 6> places{
      {{1, 1}, {2, 2}, {3, 3}, {1, 2}, {2, 3}, {3, 1}}};
  for (std::size_t k = 0; k < width; ++k) {
    const int type = width == 1 ? 1 : vector ? 2 : 4;
    const std::array<int, 2> place = width == 1 ? std::array{0, 0}
                                     : vector   ? std::array{static_cast<int>(k) + 1, 0}
                                                : places[k];
    out += fmt::format(" -5  {:8}{:5}{:5}{:5}{:5}\n", names[k + 1], 1, type, place[0], place[1]);
  }
  if (vector) out += " -5  ALL         1    2    0    0    1ALL\n";
  out.reserve(out.size() + part.nodes.size() * (14 + 12 * width) + 4);
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    out += " -1";
    append_number(out, part.numbers[i]);
    for (std::size_t k = 0; k < width; ++k) append_real(out, values[width * i + k]);
    out += '\n';
  }
  return out + " -3\n";
}

}  // namespace osculate::io

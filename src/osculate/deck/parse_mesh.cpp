#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

constexpr double most_elements = 1e7;

Marked<std::vector<double>> breakpoints_of(const Value& v) {
  for (std::size_t i = 1; i < v.items.size(); ++i)
    if (!(v.items[i].number > v.items[i - 1].number))
      throw core::InputError(v.items[i].mark,
                             fmt::format("breakpoints must increase, got {} after {}",
                                         v.items[i].text, v.items[i - 1].text));
  return numbers_of(v);
}

/// A plain value for every interval, or a list that must have one value per interval.
template <class T, class Read>
std::vector<T> per_interval(const Value& v, std::size_t intervals, const Read& read) {
  if (v.alternative == 0) return std::vector<T>(intervals, read(v));
  if (v.items.size() != intervals)
    throw core::InputError(v.mark, fmt::format("expected one value for each of the {} intervals, "
                                               "got {}",
                                               intervals, v.items.size()));
  std::vector<T> out;
  for (const Value& item : v.items) out.push_back(read(item));
  return out;
}

std::vector<int> counts_of(const Value& v, std::size_t intervals) {
  return per_interval<int>(v, intervals, [](const Value& n) { return n.code; });
}

double total(const std::vector<int>& counts) {
  double sum = 0;
  for (const int n : counts) sum += n;
  return sum;
}

void require_size(double elements, const core::SourceMark& mark) {
  if (elements > most_elements)
    throw core::InputError(
        mark, fmt::format("{:.0f} elements are too many; at most {:.0f}", elements, most_elements));
}

Crown crown_of(const Value& v, const std::vector<double>& x) {
  Crown crown;
  crown.side = word_of<BoxSide>(v, "side").value;
  crown.radius = number_of(v.at("radius"));
  crown.at = number_if(v, "at").value_or(Number{0.5 * (x.front() + x.back()), v.mark});
  const double reach =
      std::max(std::abs(x.front() - crown.at.value), std::abs(x.back() - crown.at.value));
  if (!(std::abs(crown.radius.value) >= reach) || crown.radius.value == 0)
    throw core::InputError(crown.radius.mark,
                           fmt::format("the arc does not span the box: the radius must be at least "
                                       "{} in size, got {}",
                                       reach, crown.radius.value));
  return crown;
}

Box box_of(const Value& v) {
  Box box;
  const Value& elements = v.at("elements");
  const Value& bias = v.at("bias");
  const std::array<const char*, 2> axes{"x", "y"};
  for (std::size_t i = 0; i < 2; ++i) {
    box.breakpoints[i] = breakpoints_of(v.at(axes[i]));
    const std::size_t intervals = box.breakpoints[i].value.size() - 1;
    box.elements[i] = counts_of(elements.items[i], intervals);
    box.bias[i] = per_interval<double>(bias.items[i], intervals,
                                       [](const Value& ratio) { return ratio.number; });
  }
  require_size(total(box.elements[0]) * total(box.elements[1]), elements.mark);
  box.type = word_of<cell::CellType>(v, "type");
  if (const Value* const crown = v.find("crown"))
    box.crown = crown_of(*crown, box.breakpoints[0].value);
  box.angle = number_of(v.at("angle"));
  box.about = point_of(v.at("about"));
  return box;
}

LineMesh line_of(const Value& v) {
  LineMesh line;
  line.points = points_of(v.at("points"));
  const Value& elements = v.at("elements");
  line.elements = counts_of(elements, line.points.value.size() - 1);
  require_size(total(line.elements), elements.mark);
  line.type = word_of<cell::CellType>(v, "type");
  return line;
}

std::string path_beside(const std::string& model_file, const std::string& mesh_file) {
  namespace fs = std::filesystem;
  return (fs::path(model_file).parent_path() / fs::path(mesh_file)).string();
}

void require_mesh_format(const Name& file) {
  const std::string ending = std::filesystem::path(file.value).extension().string();
  if (ending == ".msh") return;
  throw core::InputError(file.mark, ending == ".inp"
                                        ? std::string("Abaqus decks are not read yet")
                                        : fmt::format("expected a Gmsh file that ends in .msh, got "
                                                      "{}",
                                                      quoted(file.value)));
}

}  // namespace

MeshSource parse_mesh(const Value& v, const std::string& file) {
  MeshSource mesh;
  mesh.mark = v.mark;
  if (v.alternative == 0) {
    mesh.file = name_of(v);
    require_mesh_format(*mesh.file);
    mesh.path = path_beside(file, mesh.file->value);
    return mesh;
  }
  for (const ValueEntry& entry : v.at("generate").entries) {
    GeneratedPart part;
    part.name = {entry.key, entry.key_mark};
    if (const Value* const box = entry.value.find("box"))
      part.shape = box_of(*box);
    else
      part.shape = line_of(entry.value.at("line"));
    mesh.generated.push_back(std::move(part));
  }
  return mesh;
}

}  // namespace osculate::deck

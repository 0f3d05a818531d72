// One cell or one material point by itself: what `osculate.Element` and `osculate.MaterialPoint`
// ask.
#include <pybind11/stl.h>

#include <optional>
#include <variant>

#include "convert.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/errors.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::python {
namespace {

using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

py::array array_of_rows(const Table& values) {
  std::vector<double> copy(values.data(), values.data() + values.size());
  return array_of(std::move(copy), {values.rows(), values.cols()});
}
py::array array_of_values(const Eigen::VectorXd& values) {
  return array_of(std::vector<double>(values.begin(), values.end()));
}

/// What the points remember before and after; both are copies.
class PointMemory {
 public:
  PointMemory(std::size_t points, std::size_t size, const std::optional<Numbers>& before,
              double duration)
      : points_(points), size_(size), committed_(points * size), next_(points * size) {
    if (before) {
      if (static_cast<std::size_t>(before->size()) != committed_.size())
        throw Refused("before: expected " + std::to_string(committed_.size()) + " numbers, got " +
                      std::to_string(before->size()));
      std::copy_n(before->data(), committed_.size(), committed_.begin());
      next_ = committed_;
    }
    of_.duration = duration;
    if (committed_.empty()) return;
    of_.size = size;
    of_.committed = committed_.data();
    of_.next = next_.data();
  }
  PointMemory(const PointMemory&) = delete;
  PointMemory& operator=(const PointMemory&) = delete;
  ~PointMemory() = default;

  [[nodiscard]] const material::Memory& of() const { return of_; }
  [[nodiscard]] py::array after() const {
    return array_of(std::vector<double>(next_),
                    {static_cast<py::ssize_t>(points_), static_cast<py::ssize_t>(size_)});
  }

 private:
  std::size_t points_, size_;
  std::vector<double> committed_, next_;
  material::Memory of_;
};

template <int Dim>
struct OneCell {
  solid::Section<Dim> section;
  cell::CellType type;
  solid::Coordinates<Dim> reference;
};

template <int Dim>
OneCell<Dim> the_cell(const deck::BasicBuilt<Dim>& built) {
  const auto& section = built.model.sections.at(0);
  const mesh::CellRef ref = section.cells.at(0);
  const mesh::Block& block = built.model.mesh.blocks[static_cast<std::size_t>(ref.block)];
  const int nodes = cell::info(block.type).nodes;
  OneCell<Dim> out{model::section_on(section, block.type), block.type,
                   solid::Coordinates<Dim>(nodes, Dim)};
  for (int k = 0; k < nodes; ++k)
    out.reference.row(k) =
        built.model.reference[static_cast<std::size_t>(block.cell(ref.cell)[k])].transpose();
  return out;
}

void require_solved(solid::Status status) {
  if (status == solid::Status::inverted) throw Refused("the cell is turned inside out");
  if (status == solid::Status::material_failed)
    throw Refused("the material, or a strain of the cell's own, has no answer here");
}

template <int Dim>
py::dict evaluated(const OneCell<Dim>& cell, const Numbers& displacement,
                   const std::optional<Numbers>& before, double duration) {
  const Eigen::Index nodes = cell.reference.rows();
  if (displacement.size() != nodes * Dim)
    throw Refused("displacement: expected " + std::to_string(nodes * Dim) + " numbers, got " +
                  std::to_string(displacement.size()));
  const solid::Coordinates<Dim> u = Eigen::Map<const Table>(displacement.data(), nodes, Dim);
  const PointMemory memory(solid::point_count(cell.section, cell.type),
                           material::memory_of(cell.section.law).size(), before, duration);
  solid::ElementResult<Dim> result;
  solid::evaluate(cell.section, cell.type, cell.reference, u, true, result, memory.of());
  require_solved(result.status);
  material::Memory looked_at = memory.of();
  looked_at.next = nullptr;
  const solid::CellStress<Dim> points =
      solid::stress_at_points(cell.section, cell.type, cell.reference, u, looked_at);
  require_solved(points.status);
  Table stress(points.count, solid::components<Dim>), strain(points.count, solid::components<Dim>);
  Table places(points.count, Dim);
  Eigen::VectorXd volume(points.count);
  for (int q = 0; q < points.count; ++q) {
    const solid::PointStress<Dim>& point = points.point[static_cast<std::size_t>(q)];
    stress.row(q) = point.stress;
    strain.row(q) = point.strain;
    places.row(q) = point.position;
    volume[q] = point.volume;
  }
  py::dict out;
  out["force"] = array_of_values(result.force);
  out["tangent"] = array_of_rows(result.tangent);
  out["stress"] = array_of_rows(stress);
  out["strain"] = array_of_rows(strain);
  out["points"] = array_of_rows(places);
  out["volume"] = array_of_values(volume);
  out["after"] = memory.after();
  return out;
}

/// A model of one cell, as the reader of model files understands it.
class Element {
 public:
  explicit Element(const py::object& document) {
    const deck::Description description = deck::parse_model(source_of(document, "model"), "model");
    std::visit([&](const auto& built) { cell_ = the_cell(built); },
               deck::build_any(description, deck::load_mesh(description)));
  }

  [[nodiscard]] py::dict at(const Numbers& displacement, const std::optional<Numbers>& before,
                            double duration) const {
    return std::visit(
        [&](const auto& cell) { return evaluated(cell, displacement, before, duration); }, cell_);
  }
  /// Of a point of the material, in space.
  [[nodiscard]] py::dict response(const Numbers& strain, const std::optional<Numbers>& before,
                                  double duration) const {
    constexpr Eigen::Index components = 6;
    if (strain.size() != components)
      throw Refused("strain: expected 6 numbers, got " + std::to_string(strain.size()));
    const material::Strain3 e = Eigen::Map<const material::Strain3>(strain.data());
    const PointMemory memory(1, material::memory_of(law()).size(), before, duration);
    const material::Response3 found = material::response(law(), e, memory.of());
    if (!found.ok) throw Refused("the material has no answer here " + material::complaint(law()));
    py::dict out;
    out["stress"] = array_of_values(found.stress);
    out["tangent"] = array_of_rows(found.tangent);
    out["after"] = memory.after().attr("ravel")();
    return out;
  }
  [[nodiscard]] bool finite() const {
    return std::visit(
        [](const auto& cell) { return cell.section.kinematics == solid::Kinematics::finite; },
        cell_);
  }
  [[nodiscard]] std::vector<std::string> state() const {
    std::vector<std::string> names;
    for (const material::Remembered& one : material::memory_of(law())) names.emplace_back(one.name);
    return names;
  }

 private:
  [[nodiscard]] const material::Law& law() const {
    return std::visit([](const auto& cell) -> const material::Law& { return cell.section.law; },
                      cell_);
  }
  std::variant<OneCell<2>, OneCell<3>> cell_;
};

}  // namespace

void add_element(py::module_& m) {
  py::class_<Element>(m, "Element")
      .def(py::init<const py::object&>())
      .def("at", &Element::at)
      .def("response", &Element::response)
      .def_property_readonly("finite", &Element::finite)
      .def_property_readonly("state", &Element::state);
}

}  // namespace osculate::python

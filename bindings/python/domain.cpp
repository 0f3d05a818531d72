// Projection domains: osculate.domain.
#include "osculate/api/domain.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>

#include "convert.hpp"
#include "osculate/cell/cell_type.hpp"
#include "osculate/errors.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::python {
namespace {

void check_domain_range(const char* name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw Refused(
        fmt::format("{}: expected a number from {:g} to {:g}, got {:g}", name, least, most, value));
}

/// One row a point.
py::array domain_points(const result::DomainPicture& picture, int dimension) {
  std::vector<double> values;
  for (const Vec3& p : picture.points) values.insert(values.end(), p.data(), p.data() + dimension);
  return array_of(std::move(values), {static_cast<py::ssize_t>(picture.points.size()), dimension});
}

py::dict domain_fields(const result::DomainPicture& picture) {
  using Place = result::DomainPlace;
  py::dict out;
  const auto add = [&](const char* name, double Place::*slot) {
    std::vector<double> values;
    for (const Place& place : picture.places) values.push_back(place.*slot);
    out[name] = array_of(std::move(values));
  };
  add("K1", &Place::larger);
  add("K2", &Place::smaller);
  add("GAUSS", &Place::gauss);
  add("MEAN", &Place::mean);
  add("CLASS", &Place::point_class);
  add("BOUND_ABOVE", &Place::bound_above);
  add("BOUND_BELOW", &Place::bound_below);
  add("EVEN_ABOVE", &Place::even_above);
  add("EVEN_BELOW", &Place::even_below);
  add("SINE", &Place::sine);
  return out;
}

/// [(type, nodes, part, piece), ...]
py::list domain_cells(const result::DomainPicture& picture) {
  py::list out;
  for (std::size_t b = 0; b < picture.blocks.size(); ++b) {
    const mesh::Block& block = picture.blocks[b];
    std::vector<Index> nodes(block.connectivity.begin(), block.connectivity.end()), parts;
    for (const result::DomainPart part : picture.parts[b])
      parts.push_back(static_cast<Index>(part));
    const auto count = static_cast<py::ssize_t>(parts.size());
    const auto each = static_cast<py::ssize_t>(cell::info(block.type).nodes);
    out.append(py::make_tuple(std::string(cell::info(block.type).name),
                              array_of(std::move(nodes), {count, each}), array_of(std::move(parts)),
                              array_of(std::vector<Index>(picture.pieces[b]))));
  }
  return out;
}

py::tuple domain(const std::string& surface, const std::string& name, double kink, int samples,
                 double tolerance, double length, const std::string& output,
                 const std::string& page) {
  check_domain_range("kink", kink, 1e-9, 90);
  check_domain_range("samples", samples, 10, 10000000);
  check_domain_range("tolerance", tolerance, 1e-6, 0.9);
  check_domain_range("length", length, 0, std::numeric_limits<double>::max());
  result::DomainReport report;
  {
    const py::gil_scoped_release unlocked;
    deck::SurfaceInput input = deck::read_surface(surface);
    report = api::survey_domain(
        input.target, name,
        {.kink = kink, .samples = samples, .tolerance = tolerance, .length = length});
    report.warnings.insert(report.warnings.begin(), input.warnings.begin(), input.warnings.end());
    if (!output.empty()) result::write_domain(output, report.picture);
    if (!page.empty()) io::write_file(page, result::domain_html(report));
  }
  return py::make_tuple(result::to_json(report), result::to_text(report),
                        domain_points(report.picture, report.dimension),
                        domain_fields(report.picture), domain_cells(report.picture));
}

}  // namespace

void add_domain(py::module_& m) { m.def("domain", domain); }

}  // namespace osculate::python

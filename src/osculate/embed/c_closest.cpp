// Closest points and penalties for hosts in C.
#include "osculate/embed/c_call.hpp"
#include "osculate/embed/c_handles.hpp"

namespace osculate::embed {
namespace {

static_assert(static_cast<int>(ClosestStatus::invalid) == osculate_invalid &&
              static_cast<int>(ClosestMode::certified) == osculate_certified);

template <int Dim>
ClosestPoints<Dim> closest_of(const Surface<Dim>& surface, std::span<const double> coordinates) {
  if (!surface.points.empty()) throw Refused("a surface for closest points has no points");
  const std::vector<Shape<Dim>>& shapes = surface.framed.shapes;
  if (shapes.empty()) return ClosestPoints<Dim>(surface.facets, coordinates);
  if (shapes.size() > 1 || !surface.facets.empty())
    throw Refused("closest points are those of facets, or of one shape");
  return ClosestPoints<Dim>(shapes.front());
}

template <class From, class To>
void copy_to(const std::vector<From>& from, To* to) {
  if (to != nullptr)
    std::transform(from.begin(), from.end(), to, [](From v) { return static_cast<To>(v); });
}

std::vector<Layer> layers_of(const osculate_layer* layers, std::size_t count, const char* name) {
  std::vector<Layer> out;
  for (const osculate_layer& l : array(layers, count, name))
    out.push_back({l.young, l.poisson, l.height, l.area});
  return out;
}

}  // namespace
}  // namespace osculate::embed

using namespace osculate;
using embed::answered;
using embed::given;

osculate_status osculate_closest_points_create(const osculate_surface* surface,
                                               const double* coordinates, std::size_t size,
                                               osculate_closest_points** out) {
  return answered([&] {
    const auto x = embed::array(coordinates, size, "coordinates");
    std::visit(
        [&](const auto& value) {
          embed::hand_out(osculate_closest_points{embed::closest_of(value, x)}, out);
        },
        given(surface, "surface").value);
  });
}
void osculate_closest_points_free(osculate_closest_points* closest) { delete closest; }

osculate_status osculate_find_closest(const osculate_closest_points* closest, const double* points,
                                      std::size_t size, osculate_closest_mode mode, int threads,
                                      const osculate_closest_arrays* out) {
  return answered([&] {
    const auto at = embed::array(points, size, "points");
    if (mode < osculate_nearest || mode > osculate_certified)
      throw Refused(fmt::format("there is no mode {}", static_cast<int>(mode)));
    const osculate_closest_arrays& to = given(out, "out");
    std::visit(
        [&](const auto& surface) {
          const auto a = surface.find(at, {static_cast<ClosestMode>(mode), threads});
          embed::copy_to(a.status, to.status), embed::copy_to(a.feature, to.feature);
          embed::copy_to(a.facet, to.facet), embed::copy_to(a.xi, to.xi);
          embed::copy_to(a.point, to.foot), embed::copy_to(a.distance, to.distance);
          embed::copy_to(a.margin, to.margin), embed::copy_to(a.unique, to.unique);
        },
        given(closest, "closest").value);
  });
}

osculate_status osculate_automatic_penalties(const osculate_layer* slave, std::size_t slave_count,
                                             const osculate_layer* master, std::size_t master_count,
                                             double* normal, double* shear) {
  return answered([&] {
    const Penalties p = automatic_penalties(embed::layers_of(slave, slave_count, "slave"),
                                            embed::layers_of(master, master_count, "master"));
    given(normal, "normal") = p.normal;
    given(shear, "shear") = p.shear;
  });
}
double osculate_penalty_factor(double ratio) { return penalty_factor(ratio); }

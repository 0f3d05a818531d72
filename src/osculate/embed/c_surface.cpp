// Surfaces of hosts in C.
#include "osculate/embed/c_call.hpp"
#include "osculate/embed/c_handles.hpp"
#include "osculate/embed/c_settings.hpp"

namespace osculate::embed {
namespace {

static_assert(static_cast<int>(FacetType::line8) == osculate_line8 &&
              static_cast<int>(FacetType::quad9) == osculate_quad9);

/// The words of shapes, with a new one behind each.
template <class Take>
void for_shapes(const Surface<2>&, const Take& take) {
  take("circle", Circle{}), take("arc", Arc{}), take("segment", Segment{}), take("line", Line{});
  take("nurbs", NurbsCurve{});
}
template <class Take>
void for_shapes(const Surface<3>&, const Take& take) {
  take("plane", Plane{}), take("sphere", Sphere{}), take("cylinder", Cylinder{});
  take("cone", Cone{}), take("torus", Torus{}), take("nurbs_patch", NurbsSurface{});
}

void set_shape(Line& s, NumberSetting& by) { by("point", s.point), by("normal", s.normal); }
void set_shape(Segment& s, NumberSetting& by) { by("from", s.from), by("to", s.to); }
void set_shape(Circle& s, NumberSetting& by) {
  by("center", s.center), by("radius", s.radius), by("inside", s.inside);
}
void set_shape(Arc& s, NumberSetting& by) {
  by("center", s.center), by("radius", s.radius), by("inside", s.inside);
  by("from", Degrees{s.from}), by("to", Degrees{s.to});
}
void set_shape(NurbsCurve& s, NumberSetting& by) {
  by("degree", s.degree), by("knots", s.knots), by("control", Control<2>{s.control, s.weights});
}
void set_shape(Plane& s, NumberSetting& by) { by("point", s.point), by("normal", s.normal); }
void set_shape(Sphere& s, NumberSetting& by) {
  by("center", s.center), by("radius", s.radius), by("inside", s.inside);
}
void set_shape(Cylinder& s, NumberSetting& by) {
  by("point", s.point), by("axis", s.axis), by("radius", s.radius), by("inside", s.inside);
  by("length", s.length);
}
void set_shape(Cone& s, NumberSetting& by) {
  by("apex", s.apex), by("axis", s.axis), by("half_angle", Degrees{s.half_angle});
  by("inside", s.inside), by("from", s.from), by("to", s.to);
}
void set_shape(Torus& s, NumberSetting& by) {
  by("center", s.center), by("axis", s.axis), by("radius", s.radius);
  by("tube_radius", s.tube_radius), by("inside", s.inside);
}
void set_shape(NurbsSurface& s, NumberSetting& by) {
  by("degree", s.degree), by("knots[0]", s.knots[0]), by("knots[1]", s.knots[1]);
  by("count", s.count), by("control", Control<3>{s.control, s.weights});
}

template <int Dim>
void add_named_shape(Surface<Dim>& surface, std::string_view word) {
  std::vector<std::string> known;
  bool found = false;
  for_shapes(surface, [&](const char* name, const auto& fresh) {
    known.emplace_back(name);
    if (word != name) return;
    found = true;
    surface.framed.shapes.push_back(fresh);
  });
  if (!found) throw Refused(core::unknown_name_message("shape", word, known));
}

template <int Dim>
void set_shape_numbers(Surface<Dim>& surface, std::string_view key,
                       std::span<const double> values) {
  if (surface.framed.shapes.empty()) throw Refused("a shape is added before its numbers");
  Shape<Dim> changed = surface.framed.shapes.back();
  NumberSetting by(key, values);
  std::visit([&](auto& shape) { set_shape(shape, by); }, changed);
  by.check("number of the shape");
  surface.framed.shapes.back() = std::move(changed);
}

template <int Dim>
void set_shape_frame(Surface<Dim>& surface, std::span<const Index> nodes, bool closed) {
  if (nodes.size() != Dim + 1)
    throw Refused(fmt::format("a frame has {} nodes, got {}", Dim + 1, nodes.size()));
  std::copy(nodes.begin(), nodes.end(), surface.framed.frame.begin());
  surface.framed.closed = closed;
}

}  // namespace
}  // namespace osculate::embed

using namespace osculate;
using embed::answered;
using embed::given;

osculate_status osculate_surface_create(int dimension, osculate_surface** out) {
  return answered([&] {
    if (embed::plane(dimension))
      embed::hand_out(osculate_surface{Surface<2>{}}, out);
    else
      embed::hand_out(osculate_surface{Surface<3>{}}, out);
  });
}
void osculate_surface_free(osculate_surface* surface) { delete surface; }

osculate_status osculate_surface_add_facets(osculate_surface* surface, osculate_facet_type type,
                                            const std::int32_t* nodes, std::size_t count) {
  return answered([&] {
    if (type < osculate_line2 || type > osculate_quad9)
      throw Refused(fmt::format("there is no facet type {}", static_cast<int>(type)));
    const std::span<const Index> list = embed::array(nodes, count, "nodes");
    std::visit(
        [&](auto& value) {
          value.facets.push_back({static_cast<FacetType>(type), {list.begin(), list.end()}});
        },
        given(surface, "surface").value);
  });
}

osculate_status osculate_surface_add_points(osculate_surface* surface, const std::int32_t* nodes,
                                            std::size_t count) {
  return answered([&] {
    const std::span<const Index> list = embed::array(nodes, count, "nodes");
    std::visit(
        [&](auto& value) { value.points.insert(value.points.end(), list.begin(), list.end()); },
        given(surface, "surface").value);
  });
}

osculate_status osculate_surface_add_shape(osculate_surface* surface, const char* shape) {
  return answered([&] {
    given(shape, "shape");
    std::visit([&](auto& value) { embed::add_named_shape(value, shape); },
               given(surface, "surface").value);
  });
}

osculate_status osculate_surface_set_list(osculate_surface* surface, const char* key,
                                          const double* values, std::size_t count) {
  return answered([&] {
    given(key, "key");
    const std::span<const double> numbers = embed::array(values, count, "values");
    std::visit([&](auto& value) { embed::set_shape_numbers(value, key, numbers); },
               given(surface, "surface").value);
  });
}
osculate_status osculate_surface_set(osculate_surface* surface, const char* key, double value) {
  return osculate_surface_set_list(surface, key, &value, 1);
}

osculate_status osculate_surface_set_frame(osculate_surface* surface, const std::int32_t* nodes,
                                           std::size_t count, int closed) {
  return answered([&] {
    const std::span<const Index> list = embed::array(nodes, count, "nodes");
    std::visit([&](auto& value) { embed::set_shape_frame(value, list, closed != 0); },
               given(surface, "surface").value);
  });
}

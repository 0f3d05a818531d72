#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../domain_scene.hpp"
#include "osculate/geometry/point_class.hpp"
#include "osculate/projection/local_domain.hpp"
#include "osculate/projection/reach.hpp"

namespace osculate::verification {
namespace {

using projection::Composed;
using projection::FacetMesh;

constexpr const char* source = "KSCPP 5.1";

Vec3 saddle(double x, double y) { return {x, y, 0.5 * (x * x - y * y)}; }

/// z = (x^2 - y^2)/2 over 0..1 by n x n facets through nodes on it; they hold it exactly.
FacetMesh<3> mesh_of(int n, cell::CellType type) {
  FacetMesh<3> mesh;
  const Index row = 2 * n + 1;
  for (int j = 0; j <= 2 * n; ++j)
    for (int i = 0; i <= 2 * n; ++i) mesh.nodes.push_back(saddle(0.5 * i / n, 0.5 * j / n));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index o = 2 * j * row + 2 * i;
      mesh.facets.push_back({type,
                             {o, o + 2, o + 2 + 2 * row, o + 2 * row, o + 1, o + 2 + row,
                              o + 1 + 2 * row, o + row, o + 1 + row}});
    }
  return mesh;
}

/// The same as a biquadratic NURBS patch: x and y have the control values 0, 1/2, 1 and x^2, y^2
/// 0, 0, 1.
geometry::NurbsPatch patch() {
  geometry::NurbsPatch p;
  p.degree = {2, 2};
  p.count = {3, 3};
  p.knots = {{{0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 1, 1}}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      p.control.emplace_back(0.5 * i, 0.5 * j, 0.5 * ((i == 2) - (j == 2)));
      p.weights.push_back(1);
    }
  return p;
}

struct Form {
  std::string name;
  projection::Target<3> target;
};

/// What section 5.1 gives at C = (1, 0, 0.5): the last piece along x at y = 0.
void look_at_c(const Form& form, CaseResult& out) {
  using enum Relation;
  const Composed<3> surface(form.target);
  const Vec3 c = saddle(1, 0);
  const projection::NearestPlace<3> place = surface.nearest(c);
  const geometry::SurfaceFrame f = surface_frame(surface.jet(place.piece, place.xi));
  const geometry::PrincipalCurvatures k = principal_curvatures(f);
  const double bound = projection::local_domain(k).above;
  const Vec3 end = place.r + bound * f.normal;  // [eq:KSCPP:22]
  const auto add = [&](const std::string& name, double computed, double reference) {
    out.rows.push_back({form.name + ": " + name, computed, reference, equal, 1e-12, source});
  };
  constexpr double root = std::numbers::sqrt2;
  add("distance of C from the surface", std::sqrt(place.squared_distance), 0);
  add("k1 at C", k.value[0], root / 4);
  add("k2 at C", k.value[1], -root / 2);
  add("R1 at C", bound, 2 * root);
  add("C' x", end.x(), -1);
  add("C' y", end.y(), 0);
  add("C' z", end.z(), 2.5);
}

/// Classes and the bounds of the whole surface: k1 is largest and k2 smallest at O, both 1.
result::DomainReport look_at_all(const Form& form, CaseResult& out) {
  using enum Relation;
  result::DomainReport r = api::survey_domain(form.target, form.name, {.cells = 16});
  int hyperbolic = 0;
  for (const auto& [name, count] : r.classes)
    if (name == "hyperbolic") hyperbolic = count;
  const auto add = [&](const std::string& name, double computed, double reference,
                       double tolerance) {
    out.rows.push_back({form.name + ": " + name, computed, reference, equal, tolerance,
                        "curvatures of the graph, by hand"});
  };
  add("share of hyperbolic places", static_cast<double>(hyperbolic) / r.places, 1, 0);
  add("smallest 1/k above", r.above.curvature.value, 1, 1e-9);
  add("smallest 1/k below", r.below.curvature.value, 1, 1e-9);
  add("reach above", r.above.reach.value, 1, 1e-8);
  add("reach below", r.below.reach.value, 1, 1e-8);
  add("proved reach above", r.above.proved, 1, r.tolerance + 1e-8);
  add("proved reach below", r.below.proved, 1, r.tolerance + 1e-8);
  return r;
}

Drawing drawing_of(const result::DomainPicture& picture) {
  using result::DomainPart;
  Drawing drawing{"sheets", {}};
  io::Scene& scene = drawing.scene;
  scene.title = "z = (x^2 - y^2)/2 and the borders of its projection domain";
  scene.label = "radius of curvature";
  scene.towards_eye = {0.4, -1, 0.35};
  scene.columns = 2;
  const auto panel = [&](const std::string& caption, DomainPart sheet, const auto& bound) {
    io::ScenePanel p{caption, {}};
    add_faces(
        picture, [&](DomainPart part) { return part == DomainPart::surface || part == sheet; },
        [&](const result::DomainPlace& place, DomainPart part) {
          return part == sheet ? bound(place) : std::numeric_limits<double>::quiet_NaN();
        },
        p.faces);
    scene.panels.push_back(std::move(p));
  };
  panel("above: r + R1 n", DomainPart::sheet_above,
        [](const result::DomainPlace& place) { return place.bound_above; });
  panel("below: r - |R2| n", DomainPart::sheet_below,
        [](const result::DomainPlace& place) { return place.bound_below; });
  return drawing;
}

}  // namespace

CaseResult hyperbolic_surface(const CaseContext&) {
  using enum Relation;
  using cell::CellType;
  CaseResult out;
  const FacetMesh<3> facet = mesh_of(1, CellType::quad9);
  const std::vector<Form> forms{{"quad9 facet", facet},
                                {"NURBS patch", geometry::Surface(patch())},
                                {"mesh of 4 x 4 quad9", mesh_of(4, CellType::quad9)},
                                {"mesh of 4 x 4 quad8", mesh_of(4, CellType::quad8)}};
  for (const Form& form : forms) {
    look_at_c(form, out);
    const result::DomainReport report = look_at_all(form, out);
    if (&form == &forms.front()) out.drawings.push_back(drawing_of(report.picture));
  }
  out.rows.push_back({"k2 at C as printed", -std::numbers::sqrt2 / 2, -0.700, info, 0,
                      "KSCPP 5.1, rounded wrongly"});
  return out;
}

}  // namespace osculate::verification

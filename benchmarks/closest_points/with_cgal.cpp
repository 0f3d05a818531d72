#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

#include "peers.hpp"

namespace benchmark {

Answers with_cgal(const osculate::projection::FacetMesh<3>& mesh, std::span<const Vec3> points) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  Triangles triangles;
  const auto point = [](const Vec3& x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  for (const osculate::projection::MeshFacet& f : mesh.facets) {
    const auto at = [&](std::size_t k) {
      return point(mesh.nodes[static_cast<std::size_t>(f.nodes[k])]);
    };
    triangles.emplace_back(at(0), at(1), at(2));
  }
  Answers out;
  double start = now();
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  tree.build();
  (void)tree.squared_distance(Kernel::Point_3(0, 0, 0));  // builds what it put off
  out.build_seconds = now() - start;
  start = now();
  for (const Vec3& p : points) out.distance.push_back(std::sqrt(tree.squared_distance(point(p))));
  out.seconds = now() - start;
  return out;
}

}  // namespace benchmark

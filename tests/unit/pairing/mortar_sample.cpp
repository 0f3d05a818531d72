#include "mortar_sample.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "osculate/cell/quadrature.hpp"

namespace osculate::testing {
namespace {

void add_line(ContactSample<2>& s, pairing::Chain& chain, int facets, int nodes, double from,
              double to, const MortarOptions2& o, double height) {
  const int per = nodes - 1, count = facets * per;
  const auto first = static_cast<Index>(s.x.size());
  for (int i = 0; i <= count; ++i) {
    double t = static_cast<double>(i) / count;
    if (i % per == 0) t += o.uneven * std::sin(9.0 * t) * t * (1 - t) * std::abs(to - from) / 4;
    const double x = from + t * (to - from), sign = height < 0 ? 1.0 : -0.6;
    const double y =
        height + sign * o.bend * (x - 1.7) * (x - 1.7) + 0.3 * o.bend * std::sin(3 * x);
    const double c = std::cos(o.angle), si = std::sin(o.angle);
    s.x.emplace_back(c * x - si * y, si * x + c * y);
  }
  for (int f = 0; f < facets; ++f) {
    std::vector<Index> ids{first + f * per, first + (f + 1) * per};
    for (int k = 1; k < per; ++k) ids.push_back(first + f * per + k);
    chain.facets.push_back(pairing::lagrange_facet(ids));
  }
  pairing::connect(chain);
}

/// A grid of facets; `down` turns their normals.
class MortarGrid {
 public:
  MortarGrid(ContactSample<3>& s, const MortarOptions3& o, bool slave)
      : s_(s),
        o_(o),
        type_(slave ? o.slave : o.master),
        cells_(slave ? o.slave_cells : o.master_cells),
        lo_(slave ? o.from : 0.0),
        hi_(slave ? o.to : 3.0),
        down_(slave),
        first_(s.x.size()) {
    for (int i = 0; i < cells_; ++i)
      for (int j = 0; j < cells_; ++j) add_cell(i, j);
    pairing::connect(surface);
  }
  pairing::FacetSurface surface;

 private:
  ContactSample<3>& s_;
  const MortarOptions3& o_;
  cell::CellType type_;
  int cells_;
  double lo_, hi_;
  bool down_;
  std::size_t first_;

  [[nodiscard]] Vec2 corner(int i, int j) const {
    const double a = static_cast<double>(i) / cells_, b = static_cast<double>(j) / cells_;
    const double inside = o_.keep_border ? 16 * a * (1 - a) * b * (1 - b) : 1.0;
    const double size = inside * o_.skew / cells_, sign = down_ ? 1.0 : -1.0;
    return Vec2(lo_ + (hi_ - lo_) * (a + size * std::sin(5 * b + 3 * a + sign)),
                lo_ + (hi_ - lo_) * (b + sign * size * std::cos(4 * a - 2 * b)));
  }
  Index node(const Vec2& p) {
    const double z = (down_ ? -o_.depth : 0.0) +
                     o_.bend * ((down_ ? 1.0 : -0.6) * (p.x() - 1.4) * (p.x() - 1.6) +
                                0.5 * p.x() * p.y() + 0.3 * std::sin(2 * p.y()));
    const Vec3 at = turn_of(o_.tilt) * Vec3(p.x(), p.y(), z);
    for (std::size_t n = first_; n < s_.x.size(); ++n)
      if ((s_.x[n] - at).norm() < 1e-9) return static_cast<Index>(n);
    s_.x.push_back(at);
    return static_cast<Index>(s_.x.size()) - 1;
  }
  void add_facet(const std::array<Vec2, 4>& c) {
    std::vector<Index> nodes;
    for (int k = 0; k < cell::info(type_).nodes; ++k) {
      const Vec2 xi = cell::area_node(type_, k);
      Vec2 p;
      if (cell::is_triangle(type_)) {
        p = (1 - xi.x() - xi.y()) * c[0] + xi.x() * c[1] + xi.y() * c[2];
      } else {
        const double a = 0.5 * (1 + xi.x()), b = 0.5 * (1 + xi.y());
        p = (1 - a) * (1 - b) * c[0] + a * (1 - b) * c[1] + a * b * c[2] + (1 - a) * b * c[3];
      }
      nodes.push_back(node(p));
    }
    surface.facets.push_back(pairing::surface_facet(type_, nodes));
  }
  void add_cell(int i, int j) {
    std::array<Vec2, 4> c{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
    if (down_) std::swap(c[1], c[3]);
    if (!cell::is_triangle(type_)) return add_facet(c);
    add_facet({c[0], c[1], c[2], c[2]});
    add_facet({c[0], c[2], c[3], c[3]});
  }
};

}  // namespace

ContactSample<2> make_mortar2(const MortarOptions2& o) {
  ContactSample<2> s;
  add_line(s, s.pair.master, o.master_facets, o.master_nodes, 0, o.length, o, 0);
  pairing::Chain slave;
  add_line(s, slave, o.slave_facets, o.slave_nodes, o.to, o.from, o, -o.depth);
  s.pair.slave = pairing::make_slave_side(slave);
  s.pair.normal = contact::penalty(1000);
  s.pair.sampler = pairing::ByMortar<2>{};
  pairing::prepare(s.pair, s.x);
  s.committed.points.resize(s.pair.slave.nodes.size());
  return s;
}

ContactSample<3> make_mortar3(const MortarOptions3& o) {
  ContactSample<3> s;
  s.pair.master = MortarGrid(s, o, false).surface;
  s.pair.slave = pairing::make_slave_side(MortarGrid(s, o, true).surface);
  s.pair.normal = contact::penalty(1000);
  s.pair.sampler = pairing::ByMortar<3>{};
  pairing::prepare(s.pair, s.x);
  s.committed.points.resize(s.pair.slave.nodes.size());
  return s;
}

Mat<3, 3> turn_of(const Vec3& w) {
  const double angle = w.norm();
  if (angle == 0) return Mat<3, 3>::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::VectorXd uniform_shares(const ContactSample<2>& s, const pairing::Chain& line) {
  const pairing::SlaveSide<2> side = pairing::make_slave_side(line);
  std::vector<double> areas;
  pairing::nodal_areas(side, s.x, {}, areas, nullptr);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(s.x.size()));
  for (std::size_t i = 0; i < areas.size(); ++i) out[side.nodes[i]] = areas[i];
  return out;
}

Eigen::VectorXd uniform_shares(const ContactSample<3>& s, const pairing::FacetSurface& surface) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(s.x.size()));
  for (const pairing::SurfaceFacet& facet : surface.facets) {
    const cell::Quadrature2D rule =
        cell::is_triangle(facet.type) ? cell::gauss_triangle(4) : cell::gauss_quad(5);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const cell::FacetShape shape = pairing::facet_shape(facet, rule.points[q]);
      const geometry::SurfaceJet jet = pairing::facet_jet(facet, shape, s.x);
      const double area = rule.weights[q] * jet.r1[0].cross(jet.r1[1]).norm();
      for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
        out[facet.nodes[k]] += area * shape.n[0][k];
    }
  }
  return out;
}

}  // namespace osculate::testing

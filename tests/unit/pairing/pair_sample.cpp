#include "pair_sample.hpp"

#include <cmath>

namespace osculate::testing {
namespace {

template <int Dim>
Eigen::VectorXd in_one(const std::vector<Vec<Dim>>& x) {
  Eigen::VectorXd v(Dim * static_cast<Eigen::Index>(x.size()));
  for (std::size_t n = 0; n < x.size(); ++n)
    v.segment<Dim>(Dim * static_cast<Eigen::Index>(n)) = x[n];
  return v;
}

Index sample_node(PairSample3& s, const SampleOptions3& o, double x, double y) {
  for (std::size_t n = 0; n < s.x.size(); ++n)
    if (std::abs(s.x[n].x() - x) + std::abs(s.x[n].y() - y) < 1e-9) return static_cast<Index>(n);
  s.x.emplace_back(x, y, sample_height(o, x, y));
  return static_cast<Index>(s.x.size()) - 1;
}

}  // namespace

Eigen::VectorXd flatten(const std::vector<Vec2>& x) { return in_one<2>(x); }
Eigen::VectorXd flatten(const std::vector<Vec3>& x) { return in_one<3>(x); }

template <int Dim>
std::vector<Vec<Dim>> unflatten(const Eigen::VectorXd& v) {
  std::vector<Vec<Dim>> x(static_cast<std::size_t>(v.size() / Dim));
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = v.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  return x;
}

template <int Dim>
Eigen::VectorXd assembled_force(const pairing::PairEvaluation<Dim>& e, Eigen::Index size) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(size);
  for (const pairing::ContactBlock<Dim>& b : e.blocks)
    for (int k = 0; k < b.count; ++k)
      r.segment<Dim>(Dim * b.nodes[static_cast<std::size_t>(k)]) +=
          b.force.template segment<Dim>(Dim * k);
  return r;
}

template <int Dim>
Eigen::MatrixXd assembled_tangent(const pairing::PairEvaluation<Dim>& e, Eigen::Index size) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
  for (const pairing::ContactBlock<Dim>& b : e.blocks)
    for (int i = 0; i < b.count; ++i) {
      const Eigen::Index row = Dim * b.nodes[static_cast<std::size_t>(i)];
      for (int j = 0; b.has_tangent() && j < b.count; ++j)
        k.block<Dim, Dim>(row, Dim * b.nodes[static_cast<std::size_t>(j)]) +=
            b.tangent.template block<Dim, Dim>(Dim * i, Dim * j);
      for (const pairing::NodeMatrix<Dim>& g : b.path())
        k.block<Dim, Dim>(row, Dim * g.node) +=
            b.path_rows.template middleRows<Dim>(Dim * i) * g.value;
      for (const pairing::NodeGradient<Dim>& g : b.area)
        k.block<Dim, Dim>(row, Dim * g.node) +=
            b.area_rows.template segment<Dim>(Dim * i) * g.value.transpose();
    }
  return k;
}

template <int Dim>
pairing::PairEvaluation<Dim> pair_evaluation(const ContactSample<Dim>& s, const Eigen::VectorXd& v,
                                             bool tangent) {
  pairing::PairEvaluation<Dim> e;
  pairing::evaluate<Dim>(s.pair, unflatten<Dim>(v), s.committed, tangent, e);
  return e;
}

template <int Dim>
Eigen::VectorXd pair_residual(const ContactSample<Dim>& s, const Eigen::VectorXd& v) {
  return assembled_force(pair_evaluation(s, v), v.size());
}

template <int Dim>
Eigen::MatrixXd pair_tangent(const ContactSample<Dim>& s, const Eigen::VectorXd& v) {
  return assembled_tangent(pair_evaluation(s, v, true), v.size());
}

template <int Dim>
std::vector<contact::Status> pair_status(const ContactSample<Dim>& s, const Eigen::VectorXd& v) {
  std::vector<contact::Status> status;
  for (const auto& p : pair_evaluation(s, v).points) status.push_back(p.status);
  return status;
}

template <int Dim>
std::vector<PointFacts> pair_facts(const ContactSample<Dim>& s, const Eigen::VectorXd& v) {
  std::vector<PointFacts> facts;
  for (const auto& p : pair_evaluation(s, v).points)
    if (p.status == contact::Status::open)
      facts.push_back({p.status, projection::Feature::none, -1});
    else
      facts.push_back({p.status, p.history.feature, p.history.facet});
  return facts;
}

template std::vector<Vec<2>> unflatten<2>(const Eigen::VectorXd&);
template std::vector<Vec<3>> unflatten<3>(const Eigen::VectorXd&);
template Eigen::VectorXd assembled_force(const pairing::PairEvaluation<2>&, Eigen::Index);
template Eigen::VectorXd assembled_force(const pairing::PairEvaluation<3>&, Eigen::Index);
template Eigen::MatrixXd assembled_tangent(const pairing::PairEvaluation<2>&, Eigen::Index);
template Eigen::MatrixXd assembled_tangent(const pairing::PairEvaluation<3>&, Eigen::Index);
template pairing::PairEvaluation<2> pair_evaluation(const ContactSample<2>&, const Eigen::VectorXd&,
                                                    bool);
template pairing::PairEvaluation<3> pair_evaluation(const ContactSample<3>&, const Eigen::VectorXd&,
                                                    bool);
template Eigen::VectorXd pair_residual(const ContactSample<2>&, const Eigen::VectorXd&);
template Eigen::VectorXd pair_residual(const ContactSample<3>&, const Eigen::VectorXd&);
template Eigen::MatrixXd pair_tangent(const ContactSample<2>&, const Eigen::VectorXd&);
template Eigen::MatrixXd pair_tangent(const ContactSample<3>&, const Eigen::VectorXd&);
template std::vector<contact::Status> pair_status(const ContactSample<2>&, const Eigen::VectorXd&);
template std::vector<contact::Status> pair_status(const ContactSample<3>&, const Eigen::VectorXd&);
template std::vector<PointFacts> pair_facts(const ContactSample<2>&, const Eigen::VectorXd&);
template std::vector<PointFacts> pair_facts(const ContactSample<3>&, const Eigen::VectorXd&);

contact::PointHistory<2> remembered(bool active, Index facet, projection::Feature feature,
                                    double xi, double gap, double traction, bool slipping) {
  contact::PointHistory<2> h;
  h.active = active;
  h.facet = facet;
  h.feature = feature;
  h.xi[0] = xi;
  h.gap = gap;
  h.traction[0] = traction;
  h.slipping = slipping;
  return h;
}

contact::PointHistory<3> remembered(Index facet, const Vec2& xi, double gap, const Vec2& traction,
                                    bool active) {
  contact::PointHistory<3> h;
  h.active = active;
  h.facet = facet;
  h.feature = projection::Feature::face;
  h.xi = xi;
  h.gap = gap;
  h.traction = traction;
  return h;
}

template <int Dim>
void add_sample_slave(ContactSample<Dim>& s, const std::vector<Vec<Dim>>& places) {
  std::vector<Index> nodes;
  for (const Vec<Dim>& place : places) {
    nodes.push_back(static_cast<Index>(s.x.size()));
    s.x.push_back(place);
  }
  pairing::Boundary<Dim> slave;
  if constexpr (Dim == 2) slave.facets.push_back(pairing::lagrange_facet(nodes));
  if constexpr (Dim == 3)
    slave.facets.push_back(pairing::surface_facet(cell::CellType::quad4, nodes));
  pairing::connect(slave);
  s.pair.slave = pairing::make_slave_side(slave);
  s.pair.normal = contact::penalty(1000.0);
  s.committed.points.resize(places.size());
}
template <int Dim>
void make_last_node_slave(ContactSample<Dim>& s) {
  pairing::connect(s.pair.master);
  s.pair.slave = pairing::make_slave_side(pairing::Boundary<Dim>{},
                                          std::array<Index, 1>{static_cast<Index>(s.x.size()) - 1});
  s.pair.weight = pairing::Weight::node;
  s.pair.normal = contact::penalty(1000.0);
  s.committed.points.resize(1);
  pairing::prepare(s.pair, s.x);
}

pairing::Chain line_through(std::size_t nodes) {
  pairing::Chain line;
  for (Index i = 0; i + 1 < static_cast<Index>(nodes); ++i)
    line.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{i, i + 1}));
  pairing::connect(line);
  return line;
}

template void make_last_node_slave(ContactSample<2>&);
template void make_last_node_slave(ContactSample<3>&);
template void add_sample_slave(ContactSample<2>&, const std::vector<Vec2>&);
template void add_sample_slave(ContactSample<3>&, const std::vector<Vec3>&);

PairSample make_sample(const SampleOptions& o) {
  PairSample s;
  const int per = o.nodes_per_facet - 1;
  const auto place = [&](double t) {  // t in facets
    const int whole = std::min(static_cast<int>(t), o.facets - 1);
    double at = 0;
    for (int f = 0; f < whole; ++f) at += f % 2 == 0 ? 1.0 : 3.0;
    at += (t - whole) * (whole % 2 == 0 ? 1.0 : 3.0);
    return Vec2(at, o.bend * at * (2.0 * o.facets - at));
  };
  const double c = std::cos(o.angle), si = std::sin(o.angle);
  const auto turned = [&](const Vec2& p) {
    return Vec2(c * p.x() - si * p.y(), si * p.x() + c * p.y());
  };
  for (int i = 0; i <= o.facets * per; ++i)
    s.x.push_back(turned(place(static_cast<double>(i) / per)));
  for (int f = 0; f < o.facets; ++f) {
    std::vector<Index> nodes{f * per, (f + 1) * per};
    for (int k = 1; k < per; ++k) nodes.push_back(f * per + k);
    s.pair.master.facets.push_back(pairing::lagrange_facet(nodes));
  }
  pairing::connect(s.pair.master);
  const pairing::Facet& facet = s.pair.master.facets[static_cast<std::size_t>(o.at)];
  const auto jet = pairing::facet_jet(facet, o.xi, s.x);
  const Vec2 normal = turn(jet.r1.normalized());
  // the second one is far away: it stays open
  add_sample_slave<2>(s,
                      {jet.r - o.depth * normal, jet.r + 2.0 * normal - 0.7 * jet.r1.normalized()});
  pairing::prepare(s.pair, s.x);
  return s;
}

double sample_height(const SampleOptions3& o, double x, double y) {
  return o.bend * (x * (5 - x) + 0.7 * x * y + 0.5 * y * y) + (x > 4 ? o.kink * (x - 4) : 0.0);
}

void add_sample_facet(PairSample3& s, const SampleOptions3& o, const Vec2& origin,
                      const Vec2& first, const Vec2& second) {
  std::vector<Index> nodes;
  for (int k = 0; k < cell::info(o.type).nodes; ++k) {
    Vec2 xi = cell::area_node(o.type, k);
    if (!cell::is_triangle(o.type)) xi = 0.5 * (xi + Vec2::Ones());
    const Vec2 p = origin + xi.x() * first + xi.y() * second;
    nodes.push_back(sample_node(s, o, p.x(), p.y()));
  }
  s.pair.master.facets.push_back(pairing::surface_facet(o.type, nodes));
}

PairSample3 make_sample3(const SampleOptions3& o) {
  PairSample3 s;
  const std::array<double, 4> borders{0, 1, 4, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = borders[i + 1] - borders[i];
    const Vec2 low(borders[i], -1), along(length, 0), up(0, 2);
    add_sample_facet(s, o, low, along, up);
    if (cell::is_triangle(o.type))
      add_sample_facet(s, o, Vec2(low + along + up), Vec2(-along), Vec2(-up));
  }
  pairing::connect(s.pair.master);
  const pairing::SurfaceFacet& facet = s.pair.master.facets[static_cast<std::size_t>(o.at)];
  const geometry::SurfaceJet jet = pairing::facet_jet(facet, o.xi, s.x);
  const Vec3 n = pairing::facet_normal(facet, o.xi, s.x);
  add_sample_slave<3>(s, {jet.r - o.depth * n, jet.r + Vec3(0, 0.4, 2), jet.r + Vec3(0.5, 0.5, 2.1),
                          jet.r + Vec3(0.4, 0, 2)});
  pairing::prepare(s.pair, s.x);
  return s;
}

}  // namespace osculate::testing

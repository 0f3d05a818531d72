#pragma once
// Two surfaces in mortar contact, and the assembled residual and tangent of the pair.
#include <Eigen/Core>
#include <cmath>
#include <random>

#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::testing {

template <int Dim>
struct MortarSample {
  pairing::PairDefinition<Dim> pair;
  std::vector<Vec<Dim>> x;
  pairing::PairState<Dim> committed;
};

template <int Dim>
Eigen::VectorXd flat(const std::vector<Vec<Dim>>& x) {
  Eigen::VectorXd v(Dim * static_cast<Eigen::Index>(x.size()));
  for (std::size_t n = 0; n < x.size(); ++n)
    v.segment<Dim>(Dim * static_cast<Eigen::Index>(n)) = x[n];
  return v;
}

template <int Dim>
std::vector<Vec<Dim>> unflat(const Eigen::VectorXd& v) {
  std::vector<Vec<Dim>> x(static_cast<std::size_t>(v.size() / Dim));
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = v.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  return x;
}

template <int Dim>
pairing::PairEvaluation<Dim> mortar_evaluation(const MortarSample<Dim>& s, const Eigen::VectorXd& v,
                                               bool tangent = false) {
  pairing::PairEvaluation<Dim> e;
  pairing::evaluate<Dim>(s.pair, unflat<Dim>(v), s.committed, tangent, e);
  return e;
}

template <int Dim>
Eigen::VectorXd mortar_residual(const MortarSample<Dim>& s, const Eigen::VectorXd& v) {
  const pairing::PairEvaluation<Dim> e = mortar_evaluation(s, v);
  Eigen::VectorXd r = Eigen::VectorXd::Zero(v.size());
  for (const pairing::ContactBlock<Dim>& b : e.blocks)
    for (std::size_t k = 0; k < b.nodes.size(); ++k)
      r.segment<Dim>(Dim * b.nodes[k]) +=
          b.force.template segment<Dim>(Dim * static_cast<Eigen::Index>(k));
  return r;
}

template <int Dim>
Eigen::MatrixXd mortar_tangent(const MortarSample<Dim>& s, const Eigen::VectorXd& v) {
  const pairing::PairEvaluation<Dim> e = mortar_evaluation(s, v, true);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(v.size(), v.size());
  for (const pairing::ContactBlock<Dim>& b : e.blocks)
    for (std::size_t i = 0; i < b.nodes.size(); ++i) {
      const auto at = Dim * static_cast<Eigen::Index>(i);
      if (b.tangent.size() > 0)
        for (std::size_t j = 0; j < b.nodes.size(); ++j)
          k.block<Dim, Dim>(Dim * b.nodes[i], Dim * b.nodes[j]) +=
              b.tangent.template block<Dim, Dim>(at, Dim * static_cast<Eigen::Index>(j));
      for (const pairing::NodeMatrix<Dim>& g : b.path())
        k.block<Dim, Dim>(Dim * b.nodes[i], Dim * g.node) +=
            b.path_rows.template middleRows<Dim>(at) * g.value;
    }
  return k;
}

template <int Dim>
std::vector<contact::Status> mortar_status(const MortarSample<Dim>& s, const Eigen::VectorXd& v) {
  std::vector<contact::Status> status;
  for (const pairing::PointResult<Dim>& p : mortar_evaluation(s, v).points)
    status.push_back(p.status);
  return status;
}

/// The state after the slave has lain at another place: `shift` along the master, `lift` above.
template <int Dim>
void remember(MortarSample<Dim>& s, const Vec<Dim>& shift, const Vec<Dim - 1>& carried,
              bool active) {
  std::vector<Vec<Dim>> before = s.x;
  for (const Index n : s.pair.slave.nodes) before[static_cast<std::size_t>(n)] -= shift;
  s.committed = pairing::initial_state<Dim>(s.pair, before);
  for (auto& h : s.committed.points) {
    h.active = active;
    h.traction = active ? carried : Vec<Dim - 1>(Vec<Dim - 1>::Zero());
  }
}

/// Master facets that every slave facet lies over: the combinatorial part of a configuration.
template <int Dim>
std::vector<std::vector<Index>> mortar_overlaps(const MortarSample<Dim>& s,
                                                const Eigen::VectorXd& v) {
  return mortar_evaluation(s, v).mortar.overlaps;
}

/// The lower body's top from x = 0 along +x (master) and the upper body's bottom, run through
/// backwards (slave), which reaches from `from` to `to` and lies `depth` below it.
struct MortarOptions2 {
  int slave_nodes = 2, master_nodes = 2;  ///< per facet
  int slave_facets = 3, master_facets = 4;
  double from = 0.31, to = 3.43, length = 4;
  double depth = 0.05, bend = 0.0;
  double angle = 0.3;   ///< of the whole
  double uneven = 0.0;  ///< of the nodes along the lines
};

inline void add_line(MortarSample<2>& s, pairing::Chain& chain, int facets, int nodes, double from,
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

inline MortarSample<2> make_mortar2(const MortarOptions2& o) {
  MortarSample<2> s;
  add_line(s, s.pair.master, o.master_facets, o.master_nodes, 0, o.length, o, 0);
  pairing::Chain slave;
  add_line(s, slave, o.slave_facets, o.slave_nodes, o.to, o.from, o, -o.depth);
  s.pair.slave = pairing::make_slave_side(slave);
  s.pair.normal = contact::NormalPenalty{1000};
  s.pair.mortar = true;
  pairing::prepare(s.pair, s.x);
  s.committed.points.resize(s.pair.slave.nodes.size());
  return s;
}

/// int N_k dA of every node of a line.
inline Eigen::VectorXd uniform_shares(const MortarSample<2>& s, const pairing::Chain& line) {
  const pairing::SlaveSide<2> side = pairing::make_slave_side(line);
  std::vector<double> areas;
  pairing::nodal_areas(side, s.x, {}, areas, nullptr);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(s.x.size()));
  for (std::size_t i = 0; i < areas.size(); ++i) out[side.nodes[i]] = areas[i];
  return out;
}

}  // namespace osculate::testing

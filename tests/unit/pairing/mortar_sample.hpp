#pragma once
// Two surfaces in mortar contact, in the plane and in space.
#include "pair_sample.hpp"

namespace osculate::testing {

/// The state after the slave has lain at another place: `shift` along the master, `lift` above.
template <int Dim>
void remember(ContactSample<Dim>& s, const Vec<Dim>& shift, const Vec<Dim - 1>& carried,
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
std::vector<std::vector<Index>> mortar_overlaps(const ContactSample<Dim>& s,
                                                const Eigen::VectorXd& v) {
  return pair_evaluation(s, v).mortar.overlaps;
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
ContactSample<2> make_mortar2(const MortarOptions2& o);

/// A square of the lower body's top (master, from 0 to 3) and of the upper body's bottom (slave),
/// `depth` below it. Edges are straight in the plane; `skew` moves the corners of the cells,
/// `bend` curves both surfaces.
struct MortarOptions3 {
  cell::CellType slave = cell::CellType::quad4, master = cell::CellType::quad4;
  int slave_cells = 2, master_cells = 3;  ///< along each side
  double from = 0.27, to = 2.81;          ///< of the slave
  double depth = 0.05, skew = 0.0, bend = 0.0;
  bool keep_border = false;   ///< the skew vanishes on the border
  Vec3 tilt{0.4, -0.3, 0.2};  ///< turn of the whole
};
ContactSample<3> make_mortar3(const MortarOptions3& o);

Mat<3, 3> turn_of(const Vec3& w);

/// int N_k dA of every node of a line or surface.
Eigen::VectorXd uniform_shares(const ContactSample<2>& s, const pairing::Chain& line);
Eigen::VectorXd uniform_shares(const ContactSample<3>& s, const pairing::FacetSurface& surface);

}  // namespace osculate::testing

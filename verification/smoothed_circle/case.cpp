#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "in_space.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::verification {
namespace {

constexpr double depth = 0.02, stiffness = 1000, mu = 0.3, eps_t = 2000;
constexpr int corners = 24, places = 960;

/// A point slides round a circle that is a polygon of nodes, smoothed or not. The last node is the
/// point.
struct Ride {
  pairing::PairDefinition<2> pair;
  std::vector<Vec2> x;
};

Vec2 on_circle(double turns, double radius) {
  const double angle = -2 * std::numbers::pi * turns;  // clockwise: the body is inside
  return radius * Vec2(std::cos(angle), std::sin(angle));
}

Ride make_ride(pairing::SmoothingKind kind) {
  Ride ride;
  for (int i = 0; i < corners; ++i) {
    ride.x.push_back(on_circle(static_cast<double>(i) / corners, 1));
    ride.pair.master.facets.push_back(
        pairing::lagrange_facet(std::array<Index, 2>{i, (i + 1) % corners}));
  }
  pairing::connect(ride.pair.master);
  if (kind != pairing::SmoothingKind::none) smooth(ride.pair.master, ride.x, {kind});
  ride.x.push_back(on_circle(0, 1 - depth));
  ride.pair.slave = pairing::make_slave_side(pairing::Chain{}, std::array<Index, 1>{corners});
  ride.pair.weight = pairing::Weight::node;
  ride.pair.normal = contact::penalty(stiffness);
  ride.pair.friction = contact::coulomb(mu, eps_t);
  pairing::prepare<2>(ride.pair, ride.x);
  return ride;
}

/// Standard deviation over mean.
double oscillation(const std::vector<double>& values) {
  double mean = 0, square = 0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values)
    square += (v - mean) * (v - mean) / static_cast<double>(values.size());
  return std::sqrt(square) / std::abs(mean);
}

struct Forces {
  std::vector<double> radial, along;  ///< on the point, per place of the second round
};

Forces ride_round(pairing::SmoothingKind kind) {
  Ride ride = make_ride(kind);
  pairing::PairState<2> state = pairing::initial_state<2>(ride.pair, ride.x);
  pairing::PairEvaluation<2> e;
  Forces out;
  for (int i = 1; i <= 2 * places; ++i) {
    const double turns = static_cast<double>(i) / places;
    ride.x.back() = on_circle(turns, 1 - depth);
    pairing::evaluate<2>(ride.pair, ride.x, state, false, e);
    state = pairing::commit(e);
    if (i <= places) continue;
    const Vec2 force = -e.blocks[0].force.segment<2>(0), out_of = on_circle(turns, 1);
    out.radial.push_back(force.dot(out_of));
    out.along.push_back(force.dot(Vec2(-out_of.y(), out_of.x())));
  }
  return out;
}

/// The same on a round master in space, along one of its great circles.
Forces ride_round(RoundMaster master, pairing::SmoothingKind kind) {
  RideInSpace ride = ride_on(std::move(master), kind, stiffness, contact::coulomb(mu, eps_t));
  ride.x.back() = (1 - depth) * ride.outwards(0);
  pairing::PairState<3> state = pairing::initial_state<3>(ride.pair, ride.x);
  pairing::PairEvaluation<3> e;
  Forces out;
  for (int i = 1; i <= 2 * places; ++i) {
    const double turns = static_cast<double>(i) / places;
    const Vec3 out_of = ride.outwards(turns);
    ride.x.back() = (1 - depth) * out_of;
    pairing::evaluate<3>(ride.pair, ride.x, state, false, e);
    state = pairing::commit(e);
    if (i <= places) continue;
    Vec3 force = Vec3::Zero();
    if (e.blocks[0].active()) force = -e.blocks[0].force.head<3>();
    out.radial.push_back(force.dot(out_of));
    out.along.push_back(force.dot(ride.outwards(turns + 0.25)));
  }
  return out;
}

void add_in_space(CaseResult& out, const std::string& name, const RoundMaster& master) {
  using enum Relation;
  const auto add = [&](const char* quantity, double value, double reference, Relation relation) {
    out.rows.push_back({name + quantity, value, reference, relation, 0, "round master"});
  };
  const Forces facets = ride_round(master, pairing::SmoothingKind::none);
  const Forces smooth = ride_round(master, pairing::SmoothingKind::hermite);
  add(", facets: oscillation of the radial force", oscillation(facets.radial), 0, info);
  add(", facets: oscillation of the friction", oscillation(facets.along), 0, info);
  add(", hermite: oscillation of the radial force", oscillation(smooth.radial), 0, info);
  add(", hermite: oscillation of the friction", oscillation(smooth.along), 0, info);
  add(", hermite: radial force, facets' oscillation / this",
      oscillation(facets.radial) / oscillation(smooth.radial), 20, at_least);
  add(", hermite: friction, facets' oscillation / this",
      oscillation(facets.along) / oscillation(smooth.along), 20, at_least);
}

}  // namespace

CaseResult smoothed_circle(const CaseContext&) {
  using enum Relation;
  CaseResult out;
  const auto add = [&](std::string quantity, double value, double reference, Relation relation) {
    out.rows.push_back({std::move(quantity), value, reference, relation, 0, "circle"});
  };
  const Forces polygon = ride_round(pairing::SmoothingKind::none);
  const double radial = oscillation(polygon.radial), along = oscillation(polygon.along);
  add("polygon of 24 sides: oscillation of the radial force", radial, 0, info);
  add("polygon of 24 sides: oscillation of the friction", along, 0, info);
  Curve curve{"forces", {"turns", "polygon", "hermite", "nurbs"}, {}};
  std::vector<Forces> smoothed;
  for (const auto kind : {pairing::SmoothingKind::hermite, pairing::SmoothingKind::nurbs}) {
    const char* const name = kind == pairing::SmoothingKind::hermite ? "hermite" : "nurbs";
    const Forces f = ride_round(kind);
    add(fmt::format("{}: oscillation of the radial force", name), oscillation(f.radial), 0, info);
    add(fmt::format("{}: radial force, polygon's oscillation / this", name),
        radial / oscillation(f.radial), 20, at_least);
    add(fmt::format("{}: friction, polygon's oscillation / this", name),
        along / oscillation(f.along), 20, at_least);
    smoothed.push_back(f);
  }
  for (int i = 0; i < places; ++i) {
    const auto k = static_cast<std::size_t>(i);
    curve.rows.push_back({static_cast<double>(i) / places, polygon.radial[k], smoothed[0].radial[k],
                          smoothed[1].radial[k]});
  }
  out.curves.push_back(std::move(curve));
  constexpr int along_cube = 6;
  for (const bool triangles : {false, true}) {
    const char* const type = triangles ? "tri3" : "quad4";
    add_in_space(out, fmt::format("cylinder of {} {}", corners, type), tube(corners, triangles));
    add_in_space(out, fmt::format("sphere of 6 x {} x {} {}", along_cube, along_cube, type),
                 ball(along_cube, triangles));
  }
  return out;
}

}  // namespace osculate::verification

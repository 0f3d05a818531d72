// Contact pairs in the assembled system in space.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "block3.hpp"
#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::model {
namespace {

constexpr double young = 100, eps_n = 500, eps_t = 300;

bool at(double a, double b) { return std::abs(a - b) < 1e-9; }

pairing::FacetSurface surface_of(const std::vector<std::vector<Index>>& faces) {
  pairing::FacetSurface surface;
  for (const std::vector<Index>& nodes : faces)
    surface.facets.push_back(pairing::surface_facet(cell::CellType::quad4, nodes));
  pairing::connect(surface);
  return surface;
}

std::vector<std::vector<Index>> bottom_faces(const Model3& m) {
  std::vector<std::vector<Index>> faces;
  const mesh::Block& cells = m.mesh.blocks.back();
  for (Index c = 0; c < cells.size(); ++c) {
    const Index* n = cells.cell(c);
    if (at(m.reference[static_cast<std::size_t>(n[0])].z(), 0))
      faces.push_back({n[0], n[3], n[2], n[1]});
  }
  return faces;
}

void add_pair(Model3& m, pairing::FacetSurface master, pairing::FacetSurface slave, double mu,
              pairing::Weight weight = pairing::Weight::reference_area,
              const pairing::Sampling& sampling = {}) {
  ContactPair3 pair;
  pair.name = "c";
  pair.definition.master = std::move(master);
  pair.definition.slave = pairing::make_slave_side(std::move(slave));
  pairing::sample(pair.definition.slave, sampling);
  pair.definition.normal = contact::NormalPenalty{eps_n};
  if (mu > 0) pair.definition.friction = contact::Coulomb{mu, eps_t};
  pair.definition.weight = weight;
  pairing::prepare<3>(pair.definition, m.reference);
  m.pairs.push_back(std::move(pair));
}

Model3 block(const solid::VolumeSection& section) {
  Model3 m;
  add_block(m, {{0, 0, 0}, {2, 1, 1}, {2, 2, 2}, 0.2, section});
  Step step;
  step.name = "s";
  m.steps.push_back(step);
  return m;
}

solid::VolumeSection elastic() {
  return {solid::Kinematics::small, solid::VolumeFormulation::full,
          material::LinearElastic{young, 0.3}};
}
solid::VolumeSection rubber() {
  return {solid::Kinematics::finite, solid::VolumeFormulation::full,
          material::NeoHooke{young, 0.3}};
}

/// A free rigid body above the block that overlaps its top: a dome of four facets, or a tilted
/// plane.
pairing::FacetSurface add_tool(Model3& m, bool dome) {
  std::vector<Index> nodes;
  const auto node = [&](const Vec3& x) {
    m.reference.push_back(x);
    nodes.push_back(static_cast<Index>(m.reference.size()) - 1);
  };
  pairing::FacetSurface surface;
  if (dome) {
    for (const double y : {-0.4, 0.45, 1.4})
      for (const double x : {-0.5, 0.9, 2.6})
        node({x, y, 0.95 + 0.02 * ((x - 1) * (x - 1) + (y - 0.5) * (y - 0.5))});
    std::vector<std::vector<Index>> faces;
    for (const std::size_t k : {0u, 1u, 3u, 4u})  // r_1 x r_2 points down
      faces.push_back({nodes[k], nodes[k + 3], nodes[k + 4], nodes[k + 1]});
    surface = surface_of(faces);
  } else {
    const Vec3 origin(0.2, 0.1, 1.5);
    node(origin);
    for (int d = 0; d < 3; ++d) node(origin + Vec3::Unit(d));
    surface.facets.push_back(
        pairing::shape_facet(geometry::Plane{Vec3(0.8, 0.4, -0.55), Vec3(0.02, 0.01, -1)},
                             {nodes[0], nodes[1], nodes[2], nodes[3]}));
    pairing::connect(surface);
  }
  add_rigid(m, {0.9, 0.6, 2}, nodes);
  return surface;
}

TEST(Contact3, TangentWithAFreeRigidMaster) {
  for (const bool dome : {true, false})
    for (const double mu : {0.0, 0.01, 5.0})
      for (const solid::VolumeSection& section : {elastic(), rubber()}) {
        SCOPED_TRACE(std::string(dome ? "dome" : "plane") + " mu " + std::to_string(mu));
        Model3 m = block(section);
        const std::vector<std::vector<Index>> faces = top_faces(m, 1);
        pairing::FacetSurface tool = add_tool(m, dome);
        add_pair(m, std::move(tool), surface_of(faces), mu);
        for (int d = 0; d < 3; ++d)
          prescribe(m.steps[0], nodes_where(m, [](const Vec3& x) { return at(x.z(), 0); }), d, 0);
        DeadLoad load;
        load.ramp = {0, 1, {}};
        const std::array<double, 6> unit{1, 0.5, -5, 0.3, -0.2, 0.4};
        for (int i = 0; i < 6; ++i)
          load.unit.emplace_back(body_dof(m, 0, i), unit[static_cast<std::size_t>(i)]);
        m.steps[0].dead.push_back(load);
        Probe3 probe(m);
        const solve::StateCounts counts = probe.at(probe.base, false).counts;
        EXPECT_EQ(counts.open, 0);
        EXPECT_EQ(mu == 5.0 ? counts.stick : counts.slip, 9);
        const testing::DerivativeReport report = check_tangent(probe, 1e-4);
        EXPECT_NEAR(report.order, 2.0, 0.1) << report.error;
      }
}

TEST(Contact3, TangentWithARigidSlaveAndCurrentArea) {
  for (const pairing::Weight weight :
       {pairing::Weight::node, pairing::Weight::reference_area, pairing::Weight::current_area}) {
    Model3 m = block(rubber());
    const std::vector<std::vector<Index>> faces = top_faces(m, 1);
    pairing::FacetSurface tool = add_tool(m, true);
    for (pairing::SurfaceFacet& facet : tool.facets)  // wider than the block: let all nodes touch
      for (const Index n : std::span(facet.nodes).first(4)) {
        Vec3& x = m.reference[static_cast<std::size_t>(n)];
        x.head<2>() = Vec2(std::clamp(x.x(), 0.1, 1.9), std::clamp(x.y(), 0.1, 0.9));
      }
    add_pair(m, surface_of(faces), std::move(tool), 0.3, weight);
    for (int d = 0; d < 3; ++d)
      prescribe(m.steps[0], nodes_where(m, [](const Vec3& x) { return at(x.z(), 0); }), d, 0);
    Probe3 probe(m);
    EXPECT_EQ(probe.at(probe.base, false).counts.open, 4);  // the corners of the dome
    const testing::DerivativeReport report = check_tangent(probe, 1e-4);
    EXPECT_NEAR(report.order, 2.0, 0.1) << report.error;
  }
}

/// A fixed rigid plane under the block.
void add_floor(Model3& m, double mu, const pairing::Sampling& sampling = {}) {
  const std::vector<std::vector<Index>> faces = bottom_faces(m);
  const auto first = static_cast<Index>(m.reference.size());
  m.reference.emplace_back(0, 0, 0);
  for (int d = 0; d < 3; ++d) m.reference.emplace_back(Vec3::Unit(d));
  pairing::FacetSurface floor;
  floor.facets.push_back(
      pairing::shape_facet(geometry::Plane{}, {first, first + 1, first + 2, first + 3}));
  pairing::connect(floor);
  add_rigid(m, {0, 0, 0}, {first, first + 1, first + 2, first + 3});
  add_pair(m, std::move(floor), surface_of(faces), mu, pairing::Weight::reference_area, sampling);
  for (int i = 0; i < 6; ++i)
    m.steps[0].prescribed.push_back({body_dof(m, 0, i), {0, 0, {}}, false});
}

double value(const System3& system, const Model3& m, const State3& state, HistoryRequest::Kind kind,
             const std::string& quantity) {
  return history_value(system, m, state, {"", kind, 0, {}, quantity});
}

/// Uniform pressure through the pair: p = E u / (h + E / eps_N).
TEST(Contact3, PatchTestThroughAPair) {
  Model3 m = block(elastic());
  add_floor(m, 0.0);
  std::vector<Index> on_block(m.mesh.nodes.size());
  std::iota(on_block.begin(), on_block.end(), 0);
  for (const Index n : on_block)
    for (int d = 0; d < 3; ++d) {
      const double x = m.reference[static_cast<std::size_t>(n)][d];
      if (d < 2 && at(x, 0)) prescribe(m.steps[0], {n}, d, 0);
      if (d == 2 && at(x, 1)) prescribe(m.steps[0], {n}, d, -0.02);
    }
  const double p = young * 0.02 / (1 + young / eps_n);
  int seen = 0;
  AnalysisObserver3 observer;
  observer.converged = [&](System3& system, const State3& state, const Progress&,
                           const solve::IncrementRecord* record) {
    if (!record) return true;
    ++seen;
    using Kind = HistoryRequest::Kind;
    const NodalFields3 f = nodal_fields(system, m, state);
    for (std::size_t n = 0; n < f.stress.size(); ++n)
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(f.stress[n][i], i == 2 ? -p : 0.0, 1e-11) << n << " " << i;
    const auto pair = [&](const std::string& q) { return value(system, m, state, Kind::pair, q); };
    EXPECT_NEAR(pair("force_x"), 0, 1e-11);
    EXPECT_NEAR(pair("force_z"), 2 * p, 1e-11);
    EXPECT_NEAR(pair("normal_force"), 2 * p, 1e-11);
    EXPECT_NEAR(pair("shear_force"), 0, 1e-15);
    EXPECT_NEAR(pair("max_pressure"), p, 1e-11);
    EXPECT_NEAR(pair("max_penetration"), p / eps_n, 1e-13);
    EXPECT_NEAR(pair("area"), 2, 1e-14);
    EXPECT_EQ(pair("stick") + pair("slip"), 9);
    EXPECT_EQ(pair("open"), 0);
    EXPECT_NEAR(value(system, m, state, Kind::rigid, "rfz"), 2 * p, 1e-11);
    const double wider = 1 + 0.3 * p / young;  // the block, and with it the centre of pressure
    EXPECT_NEAR(value(system, m, state, Kind::rigid, "rmx"), p * wider, 1e-11);
    EXPECT_NEAR(value(system, m, state, Kind::rigid, "rmy"), -2 * p * wider, 1e-11);
    return true;
  };
  const AnalysisResult3 result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(seen, 1);
}

/// The block moved as a whole by (a, b, -d): sticking shear eps_T (a, b) against the motion,
/// at most mu p. Slip is the whole way in contact.
TEST(Contact3, ReportsShearAndSlipInItsTwoDirections) {
  const double a = 0.003, b = -0.004, d = 0.01, p = eps_n * d;
  using Rule = pairing::Sampling::Rule;
  const std::array<std::pair<double, pairing::Sampling>, 4> runs{
      {{1.0, {}}, {0.1, {}}, {1.0, {Rule::gauss, 2, 1}}, {0.1, {Rule::lobatto, 3, 2}}}};
  for (const auto& chosen : runs) {
    const double mu = chosen.first;
    Model3 m = block(elastic());
    add_floor(m, mu, chosen.second);
    const std::array<double, 3> u{a, b, -d};
    const auto nodes = static_cast<Index>(m.mesh.nodes.size());
    for (Index n = 0; n < nodes; ++n)
      for (int i = 0; i < 3; ++i) prescribe(m.steps[0], {n}, i, u[static_cast<std::size_t>(i)]);
    const double shear = std::min(eps_t * 0.005, mu * p);
    AnalysisObserver3 observer;
    int seen = 0;
    observer.converged = [&](System3& system, const State3& state, const Progress&,
                             const solve::IncrementRecord* record) {
      if (!record) return true;
      ++seen;
      const ContactFields3 f = contact_fields(system, m, 0);
      EXPECT_EQ(f.nodes.size(), 9u);
      for (std::size_t k = 0; k < f.nodes.size(); ++k) {
        EXPECT_NEAR(f.copen[k], -d, 1e-15);
        EXPECT_NEAR(f.cpress[k], p, 1e-12);
        EXPECT_NEAR(f.cshear[k], -shear * a / 0.005, 1e-12);
        EXPECT_NEAR(f.cshear2[k], -shear * b / 0.005, 1e-12);
        EXPECT_NEAR(f.cslip[k], a, 1e-14);
        EXPECT_NEAR(f.cslip2[k], b, 1e-14);
        EXPECT_NEAR(f.csforce[k], f.carea[k] * shear, 1e-12);
        EXPECT_EQ(f.cstatus[k], mu == 1.0 ? 1 : 2);
      }
      EXPECT_NEAR(value(system, m, state, HistoryRequest::Kind::pair, "shear_force"), 2 * shear,
                  1e-12);
      EXPECT_NEAR(value(system, m, state, HistoryRequest::Kind::pair, "force_y"),
                  -2 * shear * b / 0.005, 1e-12);
      const double work = 2 * shear * (0.005 - shear / eps_t);  // what is not elastic
      EXPECT_NEAR(value(system, m, state, HistoryRequest::Kind::pair, "friction_work"), work,
                  1e-14);
      EXPECT_NEAR(record->iterations.back().counts.friction_work, work, 1e-14);
      EXPECT_NEAR(value(system, m, state, HistoryRequest::Kind::rigid, "rfx"),
                  -2 * shear * a / 0.005, 1e-12);
      return true;
    };
    const AnalysisResult3 result = run(m, {}, observer);
    EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
    EXPECT_EQ(seen, 1);
  }
}

/// All points slide, which holds nothing: the tangent of going on is singular. The block springs
/// back until the elastic part of the friction is gone.
TEST(Contact3, ABlockLetGoWhileItSlidesStaysWhereFrictionHoldsIt) {
  const double a = 0.003, b = -0.004, d = 0.01, mu = 0.1, way = 0.005, p = eps_n * d;
  Model3 m = block(elastic());
  add_floor(m, mu);
  const auto nodes = static_cast<Index>(m.mesh.nodes.size());
  Step free = m.steps[0];
  const std::array<double, 3> u{a, b, -d};
  for (Index n = 0; n < nodes; ++n) {
    for (int i = 0; i < 3; ++i) prescribe(m.steps[0], {n}, i, u[static_cast<std::size_t>(i)]);
    prescribe(free, {n}, 2, -d);
  }
  free.name = "free";
  m.steps.push_back(free);
  const double rest = (way - mu * p / eps_t) / way;
  int stuck = 0;
  AnalysisObserver3 observer;
  observer.converged = [&](System3& system, const State3& state, const Progress& progress,
                           const solve::IncrementRecord*) {
    if (progress.step != 1) return true;
    for (Index n = 0; n < nodes; ++n) {
      EXPECT_NEAR(state.u[3 * n], rest * a, 1e-13);
      EXPECT_NEAR(state.u[3 * n + 1], rest * b, 1e-13);
    }
    stuck = static_cast<int>(value(system, m, state, HistoryRequest::Kind::pair, "stick"));
    return true;
  };
  const AnalysisResult3 result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(stuck, 9);
}

}  // namespace
}  // namespace osculate::model

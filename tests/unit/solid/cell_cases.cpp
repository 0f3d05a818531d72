#include "cell_cases.hpp"

#include "osculate/solid/energy.hpp"

namespace osculate::solid::testing {
namespace {

constexpr double shell_thickness = 0.2;

PointValues values_of(const auto& p) { return {p.xi, p.position, p.stress, p.strain, p.volume}; }

CellValues values_of_points(const auto& cell) {
  CellValues out{cell.status, {}};
  for (std::size_t q = 0; q < static_cast<std::size_t>(cell.count); ++q)
    out.at.push_back(values_of(cell.point[q]));
  return out;
}

CellValues values_of_nodes(const auto& cell) {
  CellValues out{Status::ok, {}};
  for (std::size_t k = 0; k < static_cast<std::size_t>(cell.count); ++k)
    out.at.push_back({{}, {}, cell.stress[k], cell.strain[k]});
  return out;
}

bool is_plane(const CellCase& c) { return c.kind == Kind::plane; }
const SectionCase& plane(const CellCase& c) { return std::get<SectionCase>(c.of); }

}  // namespace

std::string kind_name(const ::testing::TestParamInfo<Kind>& tested) {
  constexpr std::array names{"plane", "space", "shell"};
  return names[static_cast<std::size_t>(tested.param)];
}

cell::CellType CellCase::type() const {
  return std::visit([](const auto& c) { return c.type; }, of);
}
bool CellCase::finite() const {
  return std::visit([](const auto& c) { return c.finite(); }, of);
}
bool CellCase::axisymmetric() const { return is_plane(*this) && plane(*this).axisymmetric(); }
bool CellCase::plane_stress() const {
  return is_plane(*this) && plane(*this).section.assumption == Assumption::plane_stress;
}
bool CellCase::full() const {
  return std::visit([](const auto& c) { return c.section.formulation == Formulation::full; }, of);
}
bool CellCase::bbar() const {
  return std::visit([](const auto& c) { return c.section.formulation == Formulation::bbar; }, of);
}
bool CellCase::reduced() const {
  return std::visit([](const auto& c) { return c.section.formulation == Formulation::reduced; },
                    of);
}

CellCase CellCase::as_full() const {
  CellCase out = *this;
  std::visit([](auto& c) { c.section.formulation = {}; }, out.of);
  return out;
}
CellCase CellCase::as_small() const {
  CellCase out = *this;
  std::visit(
      [](auto& c) {
        c.section.kinematics = Kinematics::small;
        c.section.law = material::LinearElastic{7, 0.3, 0};
      },
      out.of);
  return out;
}
CellCase CellCase::nearly_incompressible() const {
  CellCase out = *this;
  std::visit(
      [](auto& c) {
        std::visit([](auto& law) { osculate::testing::set_elastic(law, 7, 0.49); }, c.section.law);
      },
      out.of);
  return out;
}

void for_each_cell(Kind kind, const std::function<void(const CellCase&)>& visit) {
  const auto with_kind = [&](const auto& c) { visit({kind, c}); };
  if (kind == Kind::plane) return for_each_section(with_kind);
  kind == Kind::space ? for_each_volume(with_kind) : for_each_shell(with_kind);
}

Eigen::MatrixXd curved(const CellCase& c) {
  if (is_plane(c)) return sample_cell(c.type(), 0.12, true);
  if (c.kind == Kind::shell) return sample_shell(c.type(), shell_thickness, 0.06);
  return sample_volume(c.type(), 0.08, true);
}

Eigen::MatrixXd straight(const CellCase& c) {
  if (is_plane(c)) return sample_cell(c.type(), 0.15, false);
  return sample_volume(c.type(), 0.1, false);
}

Eigen::MatrixXd regular(const CellCase& c) {
  if (is_plane(c)) return sample_cell(c.type(), 0, false);
  return sample_volume(c.type(), 0, false);
}

Eigen::MatrixXd motion(const CellCase& c) {
  return motion(c, is_plane(c) ? 0.06 : c.kind == Kind::shell ? 0.1 * shell_thickness : 0.04);
}

Eigen::MatrixXd motion(const CellCase& c, double size, int seed) {
  if (is_plane(c)) return sample_displacement(c.type(), size, seed);
  return sample_motion(c.type(), size, seed);
}

CellResult answer(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
                  bool with_tangent, const material::Memory& memory) {
  return std::visit(
      [&](const auto& of) {
        typename std::decay_t<decltype(of)>::Result r;
        evaluate(of.section, of.type, x, u, with_tangent, r, memory);
        return CellResult{r.status, r.force, r.tangent};
      },
      c.of);
}

CellResult evaluated(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u) {
  const CellResult r = answer(c, x, u, true);
  EXPECT_EQ(r.status, Status::ok);
  return r;
}

double stiffness_scale(const CellCase& c, const Eigen::MatrixXd& x) {
  return evaluated(c, x, 0 * x).tangent.norm();
}

double energy(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
              const material::Memory& memory) {
  return std::visit(
      [&](const auto& of) { return cell_energy(of.section, of.type, x, u, memory).stored; }, c.of);
}

CellValues point_values(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
                        const material::Memory& memory) {
  return std::visit(
      [&](const auto& of) {
        return values_of_points(stress_at_points(of.section, of.type, x, u, memory));
      },
      c.of);
}

CellValues nodal_values(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u) {
  return std::visit(
      [&](const auto& of) { return values_of_nodes(nodal_stress(of.section, of.type, x, u)); },
      c.of);
}

Eigen::VectorXd weights(const CellCase& c, const Eigen::MatrixXd& x) {
  return std::visit(
      [&](const auto& of) -> Eigen::VectorXd { return volume_weights(of.section, of.type, x); },
      c.of);
}

double least_jacobian(const CellCase& c, const Eigen::MatrixXd& x) {
  return is_plane(c) ? smallest_jacobian<2>(c.type(), x) : smallest_jacobian<3>(c.type(), x);
}

std::vector<Side> sides(const CellCase& c) {
  const cell::CellInfo& info = cell::info(c.type());
  std::vector<Side> out;
  const auto add = [&](cell::CellType type, const auto& nodes) {
    const std::size_t count = static_cast<std::size_t>(cell::info(type).nodes);
    out.push_back({c, {nodes.begin(), nodes.begin() + count}});
    std::visit([&](auto& side) { side.type = type; }, out.back().as.of);
  };
  for (int e = 0; is_plane(c) && e < info.edge_count; ++e) {
    add(info.edge_type, info.edges[static_cast<std::size_t>(e)]);
    std::swap(out.back().nodes[0], out.back().nodes[1]);  // cells are on the left of their edges
  }
  if (is_plane(c) || c.type() == cell::CellType::shell18) return out;
  for (int f = 0; f < info.face_count; ++f) {
    const cell::CellFace& face = info.faces[static_cast<std::size_t>(f)];
    add(face.type, face.nodes);
  }
  return out;
}

CellResult pressure_on(const CellCase& side, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
                       double pressure) {
  return std::visit(
      [&](const auto& of) {
        const auto r = side_pressure(of.section, of.type, x, u, pressure);
        return CellResult{Status::ok, r.force, r.tangent};
      },
      side.of);
}

Eigen::VectorXd side_weights(const CellCase& side, const Eigen::MatrixXd& x) {
  return std::visit(
      [&](const auto& of) -> Eigen::VectorXd { return side_weights(of.section, of.type, x); },
      side.of);
}

Vec3 in_space(const Eigen::VectorXd& v) { return {v[0], v[1], v.size() == 3 ? v[2] : 0}; }

std::pair<Vec3, Vec3> resultant(const Eigen::VectorXd& force, const Eigen::MatrixXd& places) {
  std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
  const Eigen::Index dim = places.cols();
  for (Eigen::Index k = 0; k < places.rows(); ++k) {
    const Vec3 f = in_space(force.segment(dim * k, dim));
    sum.first += f;
    sum.second += in_space(places.row(k)).cross(f);
  }
  return sum;
}

CellPatch macneal_harder(Kind kind) {
  if (kind == Kind::plane) {
    CellPatch p{cell::CellType::quad4,
                Eigen::MatrixXd(8, 2),
                {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}};
    p.nodes << 0, 0, 0.24, 0, 0.24, 0.12, 0, 0.12, 0.04, 0.02, 0.18, 0.03, 0.16, 0.08, 0.08, 0.08;
    return p;
  }
  CellPatch p{cell::CellType::hex8, Eigen::MatrixXd(16, 3), {{8, 9, 10, 11, 12, 13, 14, 15}}};
  const cell::CellInfo& info = cell::info(p.type);
  for (int k = 0; k < 8; ++k) p.nodes.row(k) = 0.5 * (cell::volume_node(p.type, k) + Vec3::Ones());
  p.nodes.bottomRows<8>() << 0.249, 0.342, 0.192, 0.826, 0.288, 0.288, 0.850, 0.649, 0.263, 0.273,
      0.750, 0.230, 0.320, 0.186, 0.643, 0.677, 0.305, 0.683, 0.788, 0.693, 0.644, 0.165, 0.745,
      0.702;
  for (std::size_t f = 0; f < 6; ++f) {
    std::vector<Eigen::Index> c(8);  // from the outer face inwards
    for (std::size_t k = 0; k < 4; ++k) {
      c[k] = info.faces[f].nodes[3 - k];  // walked so that the inner face lies above
      c[k + 4] = c[k] + 8;
    }
    p.cells.push_back(c);
  }
  return p;
}

ShapeValues shape(const CellCase& c, const Eigen::VectorXd& xi) {
  const auto values = [](const auto& s) {
    return ShapeValues{s.n.head(s.count), s.d.topRows(s.count)};
  };
  return is_plane(c) ? values(cell::area_shape(c.type(), Vec2(xi)))
                     : values(cell::volume_shape(c.type(), Vec3(xi)));
}

Eigen::MatrixXd tensor(const CellCase& c, const Eigen::VectorXd& components) {
  if (!is_plane(c)) return tensor(Vec<6>(components));
  Eigen::MatrixXd out(2, 2);
  out << components[0], components[3], components[3], components[1];
  return out;
}

Eigen::MatrixXd rotation(const CellCase& c, double angle) {
  if (!is_plane(c)) return turn3(angle);
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

}  // namespace osculate::solid::testing

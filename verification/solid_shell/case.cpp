#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "../cases.hpp"
#include "patch.hpp"
#include "solve.hpp"

namespace osculate::verification {
namespace {

using cell::CellType;
using shell::mid_displacement;
using shell::ShellPath;
using shell::ShellProblem;

constexpr const char* same_mesh = "independent program, same mesh";

/// One number of a study, and what shell theory or an accepted solution says.
struct Quantity {
  const char* label;
  double accepted;
  double half_digit = 0;  ///< half a unit of the last digit of the listed numbers
  bool plotted = true;
};

/// A mesh, and the numbers an independent program has on it, in the order of the quantities; none
/// if the mesh only adds a point to the plot.
struct ListedMesh {
  CellType type;
  Index cells, across;  ///< cells along the sides
  std::vector<double> listed;
};

struct Study {
  const char* name;    ///< of the picture
  const char* row;     ///< name in the rows
  const char* title;   ///< of the picture
  const char* source;  ///< of the accepted values
  const char* x_label;
  std::vector<Quantity> quantities;
  std::vector<ListedMesh> meshes;
  std::function<std::vector<double>(const ListedMesh&, const Workers& workers)> run;
};

const char* name_of(CellType type) { return type == CellType::hex8 ? "hex8" : "shell18"; }

/// Within 1 % of the listed number (or half a unit of its last digit), or nearer to the accepted
/// one than it.
void add_check(const std::string& name, const Quantity& q, double computed, double listed,
               const char* source, CaseResult& result) {
  const double allowed = std::max(0.01 * std::abs(listed), q.half_digit);
  const double error = std::abs(computed - q.accepted), other = std::abs(listed - q.accepted);
  if (std::abs(computed - listed) <= allowed || error > other)
    result.rows.push_back(
        {name, computed, listed, Relation::equal, allowed / std::abs(listed), same_mesh});
  else
    result.rows.push_back(
        {name + ", error", error, other, Relation::at_most, 0,
         fmt::format("nearer to {} than {:g} of the {}", source, listed, same_mesh)});
}

struct Points {
  std::vector<double> x, y;
  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
};

/// Computed over accepted.
void add_picture(const Study& study, const std::vector<std::vector<double>>& values,
                 CaseResult& result) {
  io::LinePlot plot{study.title,
                    {study.x_label, true, {}},
                    {"computed / accepted", false, {}},
                    {},
                    {{"accepted", 1}}};
  std::set<double> ticks;
  Points listed;
  for (const CellType type : {CellType::hex8, CellType::shell18})
    for (std::size_t k = 0; k < study.quantities.size(); ++k) {
      const Quantity& q = study.quantities[k];
      if (!q.plotted) continue;
      Points points;
      for (std::size_t m = 0; m < study.meshes.size(); ++m) {
        const ListedMesh& mesh = study.meshes[m];
        if (mesh.type != type) continue;
        ticks.insert(mesh.cells);
        points.add(mesh.cells, values[m][k] / q.accepted);
        if (k < mesh.listed.size()) listed.add(mesh.cells, mesh.listed[k] / q.accepted);
      }
      plot.curves.push_back(
          {fmt::format("{}, {}", name_of(type), q.label), points.x, points.y, {}});
    }
  plot.curves.push_back({"independent program", listed.x, listed.y, io::PlotStyle::marks});
  plot.x.ticks.assign(ticks.begin(), ticks.end());
  result.pictures.push_back({study.name, plot});
}

void add_study(const Study& study, bool picture, const Workers& workers, CaseResult& result) {
  std::vector<std::vector<double>> values;
  for (const ListedMesh& mesh : study.meshes) {
    values.push_back(study.run(mesh, workers));
    if (mesh.listed.empty()) continue;
    for (std::size_t k = 0; k < study.quantities.size(); ++k) {
      const Quantity& q = study.quantities[k];
      const std::string name =
          fmt::format("{}, {} {}{}: {}", study.row, name_of(mesh.type), mesh.cells,
                      mesh.across > 1 ? fmt::format("x{}", mesh.across) : "", q.label);
      const double computed = values.back()[k];
      if (k < mesh.listed.size())
        add_check(name, q, computed, mesh.listed[k], study.source, result);
      result.rows.push_back({name, computed, q.accepted, Relation::info, 0, study.source});
    }
  }
  if (picture) add_picture(study, values, result);
}

Vec3 tip_of(const ShellProblem& p, const Eigen::VectorXd& u) {
  return mid_displacement(p.mesh, u, p.mesh.end_u(), 0);
}

constexpr CellType hex8 = CellType::hex8, shell18 = CellType::shell18;

Study cantilever() {
  return {"cantilever",
          "cantilever",
          "Cantilever under end shear",
          "Sze, Liu & Lo 2004",
          "cells along the strip",
          {{"U", 3.286}, {"W", 6.698}},
          {{hex8, 4, 1, {}},
           {hex8, 8, 1, {}},
           {hex8, 16, 1, {3.293, 6.705}},
           {hex8, 32, 1, {3.291, 6.702}},
           {shell18, 2, 1, {}},
           {shell18, 4, 1, {}},
           {shell18, 8, 1, {3.290, 6.700}},
           {shell18, 16, 1, {}}},
          [](const ListedMesh& m, const Workers& workers) {
            const ShellProblem p = shell::cantilever(m.type, m.cells);
            const Vec3 tip = tip_of(p, shell::solve(p, 10, workers).at(1));
            return std::vector<double>{-tip.x(), tip.z()};
          }};
}

Study roll_up() {
  return {"roll_up",
          "roll-up",
          "Strip wound to a circle by an end moment",
          "circle of radius EI/M",
          "cells along the strip",
          {{"U", -12},
           {"W", 0, 0.0005, false},
           {"half moment U", -12, 0, false},
           {"half moment W", 24 / std::numbers::pi, 0, false}},
          {{hex8, 8, 1, {}},
           {hex8, 16, 1, {-11.66, 0.031}},
           {hex8, 32, 1, {-11.91, 0.002}},
           {shell18, 4, 1, {}},
           {shell18, 8, 1, {-11.974}},
           {shell18, 16, 1, {-11.983}}},
          [](const ListedMesh& m, const Workers& workers) {
            const ShellProblem p = shell::roll_up(m.type, m.cells);
            const ShellPath path = shell::solve(p, 40, workers);
            const Vec3 tip = tip_of(p, path.at(1)), half = tip_of(p, path.at(0.5));
            return std::vector<double>{tip.x(), tip.z(), half.x(), half.z()};
          }};
}

Study pinched_cylinder() {
  return {"pinched_cylinder",
          "pinched cylinder",
          "Pinched cylinder with diaphragms, linear",
          "1.8248e-5, Belytschko et al. 1985",
          "cells a side of the meshed eighth",
          {{"w/w_ref", 1}},
          {{hex8, 4, 4, {}},
           {hex8, 8, 8, {0.755}},
           {hex8, 16, 16, {0.930}},
           {hex8, 32, 32, {0.988}},
           {shell18, 2, 2, {}},
           {shell18, 4, 4, {}},
           {shell18, 8, 8, {0.9985}},
           {shell18, 16, 16, {1.008}}},
          [](const ListedMesh& m, const Workers& workers) {
            const ShellProblem p = shell::pinched_cylinder(m.type, m.cells);
            const Vec3 u = mid_displacement(p.mesh, shell::solve(p, 1, workers).at(1), 0, 0);
            return std::vector<double>{-u.x() / 1.8248e-5};
          }};
}

Study scordelis_lo() {
  return {"scordelis_lo",
          "Scordelis-Lo roof",
          "Scordelis-Lo roof, linear",
          "0.3024, Belytschko et al. 1985",
          "cells a side of the meshed quarter",
          {{"w/w_ref", 1}},
          {{hex8, 4, 4, {}},
           {hex8, 8, 8, {1.0065}},
           {hex8, 16, 16, {0.9976}},
           {hex8, 32, 32, {}},
           {shell18, 2, 2, {}},
           {shell18, 4, 4, {}},
           {shell18, 8, 8, {0.995}},
           {shell18, 16, 16, {}}},
          [](const ListedMesh& m, const Workers& workers) {
            const ShellProblem p = shell::scordelis_lo(m.type, m.cells);
            return std::vector<double>{-tip_of(p, shell::solve(p, 1, workers).at(1)).z() / 0.3024};
          }};
}

Study hemisphere_linear() {
  return {"hemisphere_linear",
          "hemisphere, linear",
          "Hemisphere with a hole of 18 degrees, linear",
          "0.093 (Simo et al. 1989) to 0.094 (MacNeal & Harder 1985)",
          "cells a side of the meshed quarter",
          {{"u", 0.0935, 0}},
          {{hex8, 4, 4, {}},
           {hex8, 8, 8, {}},
           {hex8, 16, 16, {0.09329}},
           {hex8, 32, 32, {0.09343}},
           {shell18, 2, 2, {}},
           {shell18, 4, 4, {}},
           {shell18, 8, 8, {0.09305}},
           {shell18, 16, 16, {0.09347}}},
          [](const ListedMesh& m, const Workers& workers) {
            const ShellProblem p =
                shell::hemisphere(m.type, m.cells, shell::linear(6.825e7, 0.3), 2);
            const Eigen::VectorXd u = shell::solve(p, 1, workers).at(1);
            return std::vector<double>{mid_displacement(p.mesh, u, 0, 0).x()};
          }};
}

Study hemisphere_finite(std::vector<ListedMesh> meshes) {
  return {"hemisphere_finite",
          "hemisphere, P = 400",
          "Hemisphere with a hole of 18 degrees, P = 400",
          "Sze, Liu & Lo 2004",
          "cells a side of the meshed quarter",
          {{"outwards", 4.067}, {"inwards", 8.178}},
          std::move(meshes),
          [](const ListedMesh& m, const Workers& workers) {
            const ShellProblem p =
                shell::hemisphere(m.type, m.cells, shell::finite(6.825e7, 0.3), 400);
            const Eigen::VectorXd u = shell::solve(p, 10, workers).at(1);
            return std::vector<double>{mid_displacement(p.mesh, u, 0, 0).x(),
                                       -mid_displacement(p.mesh, u, p.mesh.end_u(), 0).y()};
          }};
}

/// Deflections of the inner and the outer corner (A, B) of the loaded side.
std::vector<double> corners(const ShellProblem& p, const Eigen::VectorXd& u) {
  return {mid_displacement(p.mesh, u, 0, p.mesh.end_v()).z(),
          mid_displacement(p.mesh, u, p.mesh.end_u(), p.mesh.end_v()).z()};
}

constexpr std::array<double, 3> parts{0.1, 0.2, 0.5};  ///< of the load, with accepted values

/// `path` is given the loads and deflections of the last mesh.
struct SlitPath {
  std::vector<double> load, a, b;
};
Study slit_plate(std::vector<ListedMesh> meshes, SlitPath& path) {
  return {"slit_plate",
          "slit plate",
          "Slit annular plate, lifted",
          "Sze, Liu & Lo 2004",
          "cells around",
          {{"A", 13.891},
           {"B", 17.528},
           {"A at 0.1 P", 4.277, 0, false},
           {"B at 0.1 P", 5.876, 0, false},
           {"A at 0.2 P", 6.725, 0, false},
           {"B at 0.2 P", 9.160, 0, false},
           {"A at 0.5 P", 10.468, 0, false},
           {"B at 0.5 P", 13.768, 0, false}},
          std::move(meshes),
          [&path](const ListedMesh& m, const Workers& workers) {
            const ShellProblem p = shell::slit_plate(m.type, m.cells, m.across);
            const ShellPath found = shell::solve(p, 20, workers);
            std::vector<double> values = corners(p, found.at(1));
            for (const double part : parts)
              for (const double value : corners(p, found.at(part))) values.push_back(value);
            path = {{0}, {0}, {0}};
            for (std::size_t i = 0; i < found.u.size(); ++i) {
              const std::vector<double> now = corners(p, found.u[i]);
              path.load.push_back(found.fraction[i]);
              path.a.push_back(now[0]);
              path.b.push_back(now[1]);
            }
            return values;
          }};
}

void add_slit_picture(const Study& study, const SlitPath& path, CaseResult& result) {
  Points accepted;
  for (std::size_t k = 0; k < study.quantities.size(); ++k)
    accepted.add(study.quantities[k].accepted, k < 2 ? 1 : parts[k / 2 - 1]);
  result.pictures.push_back({"slit_plate_path",
                             {"Slit annular plate, shell18 30x5",
                              {"deflection of the inner (A) and the outer corner (B)", false, {}},
                              {"load / P", false, {}},
                              {{"A", path.a, path.load, {}},
                               {"B", path.b, path.load, {}},
                               {study.source, accepted.x, accepted.y, io::PlotStyle::marks}},
                              {}}});
}

/// What the independent program leaves in its patches: membrane nu 0.3, bending nu 0.3 and 0.
using Limits = std::array<double, 3>;
constexpr Limits limits8{3e-9, 2.5e-8, 1.6e-8}, limits18{7e-5, 2e-6, 2e-7};

struct PatchState {
  const char* name;
  shell::PlateState state;
  double poisson;
};
constexpr std::array<PatchState, 3> patch_states{
    {{"membrane, nu 0.3", shell::PlateState::membrane, 0.3},
     {"bending, nu 0.3", shell::PlateState::bending, 0.3},
     {"bending, nu 0", shell::PlateState::bending, 0}}};

void add_patch(const char* name, const shell::PatchMesh& mesh, CellType type, Relation relation,
               const Workers& workers, CaseResult& result) {
  for (std::size_t k = 0; k < patch_states.size(); ++k)
    result.rows.push_back(
        {fmt::format("patch of {}, {}: {}", name, name_of(type), patch_states[k].name),
         shell::patch_error(mesh, type, patch_states[k].state, patch_states[k].poisson, workers),
         (type == hex8 ? limits8 : limits18)[k], relation, 0,
         "exact state; limit: independent program"});
}

/// Cells with curved sides, in which shell18 is not exact, refined.
void add_patch_convergence(const Workers& workers, CaseResult& result) {
  const shell::PatchMesh mesh = shell::bent(shell::five_cells(), 0.05);
  add_patch("five with curved sides", mesh, shell18, Relation::info, workers, result);
  io::LinePlot plot{"Patch of five cells with curved sides refined, shell18",
                    {"cells along a side of a quadrilateral", true, {1, 2, 4, 8}},
                    {"largest error / largest displacement", true, {}},
                    {},
                    {}};
  for (const PatchState& state : patch_states) {
    Points points;
    for (const int n : {1, 2, 4, 8})
      points.add(n, shell::patch_error(shell::refined(mesh, n), shell18, state.state, state.poisson,
                                       workers));
    const double order = std::log2(points.y[2] / points.y[3]);
    result.rows.push_back(
        {fmt::format("patch of five with curved sides refined, shell18: {}, order", state.name),
         order, 2, Relation::at_least, 0, "of the error in the cells' size"});
    plot.curves.push_back({state.name, points.x, points.y, {}});
  }
  result.pictures.push_back({"patch", plot});
}

}  // namespace

CaseResult solid_shell(const CaseContext& context) {
  CaseResult result;
  const Workers workers = context.workers;
  for (const CellType type : {hex8, shell18}) {
    add_patch("five", shell::five_cells(), type, Relation::at_most, workers, result);
    for (const double shift : {0.05, 0.2})
      add_patch(fmt::format("four, shift {}", shift).c_str(), shell::four_cells(shift), type,
                Relation::at_most, workers, result);
  }
  add_patch_convergence(workers, result);
  for (const Study& study :
       {cantilever(), roll_up(), pinched_cylinder(), scordelis_lo(), hemisphere_linear()})
    add_study(study, true, workers, result);
  add_study(hemisphere_finite({{hex8, 16, 16, {3.968, 7.818}}, {shell18, 8, 8, {4.023, 7.969}}}),
            false, workers, result);
  SlitPath path;
  add_study(slit_plate({{hex8, 30, 6, {13.168, 16.813}}, {shell18, 15, 3, {13.483, 17.121}}}, path),
            false, workers, result);
  return result;
}

CaseResult solid_shell_fine(const CaseContext& context) {
  CaseResult result;
  add_study(hemisphere_finite({{hex8, 8, 8, {}},
                               {hex8, 16, 16, {3.968, 7.818}},
                               {hex8, 32, 32, {4.067, 8.132}},
                               {shell18, 4, 4, {}},
                               {shell18, 8, 8, {4.023, 7.969}},
                               {shell18, 16, 16, {}}}),
            true, context.workers, result);
  SlitPath path;
  const Study slit = slit_plate({{hex8, 15, 3, {}},
                                 {hex8, 30, 6, {13.168, 16.813}},
                                 {hex8, 60, 10, {13.758, 17.396}},
                                 {shell18, 8, 2, {}},
                                 {shell18, 15, 3, {13.483, 17.121}},
                                 {shell18, 30, 5, {13.794, 17.431}}},
                                path);
  add_study(slit, true, context.workers, result);
  add_slit_picture(slit, path, result);
  return result;
}

}  // namespace osculate::verification

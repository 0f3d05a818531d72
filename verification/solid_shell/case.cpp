#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
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

constexpr const char* same_mesh = "same element and mesh, independent program";

/// One number of a study, and what shells theory or an accepted solution says.
struct Quantity {
  const char* label;
  double accepted;
  double half_digit = 0;  ///< half a unit of the last digit of the listed numbers
};

/// A mesh, and the numbers an independent program has on it, in the order of the quantities; none
/// if the mesh only adds a point to the plot.
struct ListedMesh {
  CellType type;
  Index cells, across;  ///< cells along the sides
  std::vector<double> listed;
};

struct Study {
  const char* name;
  const char* title;
  const char* source;  ///< of the accepted values
  const char* x_label;
  std::vector<Quantity> quantities;
  std::vector<ListedMesh> meshes;
  std::function<std::vector<double>(const ListedMesh&, int threads)> run;
};

const char* name_of(CellType type) { return type == CellType::hex8 ? "hex8" : "shell18"; }

/// Within 1 % of the listed number (or half a unit of its last digit), or nearer to the accepted
/// one than it.
void add_rows(const std::string& name, const Quantity& q, double computed, double listed,
              const char* source, CaseResult& result) {
  const double allowed = std::max(0.01 * std::abs(listed), q.half_digit);
  const double error = std::abs(computed - q.accepted), other = std::abs(listed - q.accepted);
  if (std::abs(computed - listed) <= allowed || error > other)
    result.rows.push_back(
        {name, computed, listed, Relation::equal, allowed / std::abs(listed), same_mesh});
  else
    result.rows.push_back(
        {name + ", error against that of the other", error, other, Relation::at_most, 0,
         fmt::format("listed {:g}, {}; accepted {:g}, {}", listed, same_mesh, q.accepted, source)});
  result.rows.push_back({name, computed, q.accepted, Relation::info, 0, source});
}

struct Points {
  std::vector<double> x, y;
  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
};

/// Computed over accepted, for all quantities whose accepted value is not zero.
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
      if (q.accepted == 0) continue;
      Points points;
      for (std::size_t m = 0; m < study.meshes.size(); ++m) {
        const ListedMesh& mesh = study.meshes[m];
        if (mesh.type != type) continue;
        ticks.insert(mesh.cells);
        points.add(mesh.cells, values[m][k] / q.accepted);
        if (!mesh.listed.empty()) listed.add(mesh.cells, mesh.listed[k] / q.accepted);
      }
      plot.curves.push_back(
          {fmt::format("{}, {}", name_of(type), q.label), points.x, points.y, {}});
    }
  plot.curves.push_back({"independent program", listed.x, listed.y, io::PlotStyle::marks});
  plot.x.ticks.assign(ticks.begin(), ticks.end());
  result.pictures.push_back({study.name, plot});
}

void add_study(const Study& study, bool picture, int threads, CaseResult& result) {
  std::vector<std::vector<double>> values;
  for (const ListedMesh& mesh : study.meshes) {
    values.push_back(study.run(mesh, threads));
    for (std::size_t k = 0; k < mesh.listed.size(); ++k)
      add_rows(fmt::format("{}, {} {}{}: {}", study.title, name_of(mesh.type), mesh.cells,
                           mesh.across > 1 ? fmt::format("x{}", mesh.across) : "",
                           study.quantities[k].label),
               study.quantities[k], values.back()[k], mesh.listed[k], study.source, result);
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
          [](const ListedMesh& m, int threads) {
            const ShellProblem p = shell::cantilever(m.type, m.cells);
            const Vec3 tip = tip_of(p, shell::solve(p, 10, threads).at(1));
            return std::vector<double>{-tip.x(), tip.z()};
          }};
}

Study roll_up() {
  return {"roll_up",
          "roll-up",
          "circle of radius EI/M",
          "cells along the strip",
          {{"U", -12}, {"W", 0, 0.0005}, {"half moment U", -12}, {"half moment W", 24 / M_PI}},
          {{hex8, 8, 1, {}},
           {hex8, 16, 1, {-11.66, 0.031}},
           {hex8, 32, 1, {-11.91, 0.002}},
           {shell18, 4, 1, {}},
           {shell18, 8, 1, {-11.974}},
           {shell18, 16, 1, {-11.983}}},
          [](const ListedMesh& m, int threads) {
            const ShellProblem p = shell::roll_up(m.type, m.cells);
            const ShellPath path = shell::solve(p, 40, threads);
            const Vec3 tip = tip_of(p, path.at(1)), half = tip_of(p, path.at(0.5));
            return std::vector<double>{tip.x(), tip.z(), half.x(), half.z()};
          }};
}

Study pinched_cylinder() {
  return {"pinched_cylinder",
          "pinched cylinder",
          "1.8248e-5, Belytschko et al. 1985",
          "cells a side of an eighth",
          {{"w/w_ref", 1}},
          {{hex8, 4, 4, {}},
           {hex8, 8, 8, {0.755}},
           {hex8, 16, 16, {0.930}},
           {hex8, 32, 32, {0.988}},
           {shell18, 2, 2, {}},
           {shell18, 4, 4, {}},
           {shell18, 8, 8, {0.9985}},
           {shell18, 16, 16, {1.008}}},
          [](const ListedMesh& m, int threads) {
            const ShellProblem p = shell::pinched_cylinder(m.type, m.cells);
            const Vec3 u = mid_displacement(p.mesh, shell::solve(p, 1, threads).at(1), 0, 0);
            return std::vector<double>{-u.x() / 1.8248e-5};
          }};
}

Study scordelis_lo() {
  return {"scordelis_lo",
          "Scordelis-Lo roof",
          "0.3024, Belytschko et al. 1985",
          "cells a side of a quarter",
          {{"w/w_ref", 1}},
          {{hex8, 4, 4, {}},
           {hex8, 8, 8, {1.0065}},
           {hex8, 16, 16, {0.9976}},
           {hex8, 32, 32, {}},
           {shell18, 2, 2, {}},
           {shell18, 4, 4, {}},
           {shell18, 8, 8, {0.995}},
           {shell18, 16, 16, {}}},
          [](const ListedMesh& m, int threads) {
            const ShellProblem p = shell::scordelis_lo(m.type, m.cells);
            return std::vector<double>{-tip_of(p, shell::solve(p, 1, threads).at(1)).z() / 0.3024};
          }};
}

Study hemisphere_linear() {
  return {"hemisphere_linear",
          "hemisphere, linear",
          "0.093 to 0.094, MacNeal & Harder 1985",
          "cells a side of a quarter",
          {{"u", 0.0935, 0}},
          {{hex8, 4, 4, {}},
           {hex8, 8, 8, {}},
           {hex8, 16, 16, {0.09329}},
           {hex8, 32, 32, {0.09343}},
           {shell18, 2, 2, {}},
           {shell18, 4, 4, {}},
           {shell18, 8, 8, {0.09305}},
           {shell18, 16, 16, {0.09347}}},
          [](const ListedMesh& m, int threads) {
            const ShellProblem p =
                shell::hemisphere(m.type, m.cells, shell::linear(6.825e7, 0.3), 2);
            const Eigen::VectorXd u = shell::solve(p, 1, threads).at(1);
            return std::vector<double>{mid_displacement(p.mesh, u, 0, 0).x()};
          }};
}

Study hemisphere_finite(std::vector<ListedMesh> meshes) {
  return {"hemisphere_finite",
          "hemisphere, P = 400",
          "Sze, Liu & Lo 2004",
          "cells a side of a quarter",
          {{"outwards", 4.067}, {"inwards", 8.178}},
          std::move(meshes),
          [](const ListedMesh& m, int threads) {
            const ShellProblem p =
                shell::hemisphere(m.type, m.cells, shell::finite(6.825e7, 0.3), 400);
            const Eigen::VectorXd u = shell::solve(p, 10, threads).at(1);
            return std::vector<double>{mid_displacement(p.mesh, u, 0, 0).x(),
                                       -mid_displacement(p.mesh, u, p.mesh.end_u(), 0).y()};
          }};
}

/// Deflections of the inner and the outer corner (A, B) of the loaded side.
std::vector<double> corners(const ShellProblem& p, const Eigen::VectorXd& u) {
  return {mid_displacement(p.mesh, u, 0, p.mesh.end_v()).z(),
          mid_displacement(p.mesh, u, p.mesh.end_u(), p.mesh.end_v()).z()};
}

Study slit_plate(std::vector<ListedMesh> meshes) {
  return {"slit_plate",
          "slit plate",
          "Sze, Liu & Lo 2004",
          "cells around",
          {{"A", 13.891}, {"B", 17.528}},
          std::move(meshes),
          [](const ListedMesh& m, int threads) {
            const ShellProblem p = shell::slit_plate(m.type, m.cells, m.across);
            return corners(p, shell::solve(p, 20, threads).at(1));
          }};
}

struct Limits {
  double membrane, bending, bending_flat;
};

void add_patches(const shell::PatchMesh& mesh, const char* name, CellType type,
                 const Limits& limits, Relation relation, int threads, CaseResult& result) {
  using shell::PlateState;
  const auto add = [&](const char* state, PlateState which, double nu, double limit) {
    result.rows.push_back(
        {fmt::format("patch of {}, {}: {}, nu {:g}", name, name_of(type), state, nu),
         shell::patch_error(mesh, type, which, nu, threads), limit, relation, 0,
         "exact; limit: independent program"});
  };
  add("membrane", PlateState::membrane, 0.3, limits.membrane);
  add("bending", PlateState::bending, 0.3, limits.bending);
  add("bending", PlateState::bending, 0, limits.bending_flat);
}

}  // namespace

CaseResult solid_shell(const CaseContext& context) {
  CaseResult result;
  const int threads = context.threads;
  constexpr Limits limits8{3e-9, 2.5e-8, 1.6e-8}, limits18{7e-5, 2e-6, 2e-7};
  add_patches(shell::five_cells(), "five", hex8, limits8, Relation::at_most, threads, result);
  add_patches(shell::five_cells(), "five", shell18, limits18, Relation::info, threads, result);
  for (const double shift : {0.01, 0.02, 0.05, 0.1, 0.2}) {
    const std::string name = fmt::format("four shifted {:g}", shift);
    add_patches(shell::four_cells(shift), name.c_str(), shell18, limits18, Relation::info, threads,
                result);
  }
  for (const Study& study :
       {cantilever(), roll_up(), pinched_cylinder(), scordelis_lo(), hemisphere_linear()})
    add_study(study, true, threads, result);
  add_study(hemisphere_finite({{hex8, 16, 16, {3.968, 7.818}}, {shell18, 8, 8, {4.023, 7.969}}}),
            false, threads, result);
  add_study(slit_plate({{hex8, 30, 6, {13.168, 16.813}}, {shell18, 15, 3, {13.483, 17.121}}}),
            false, threads, result);
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
            true, context.threads, result);
  add_study(slit_plate({{hex8, 15, 3, {}},
                        {hex8, 30, 6, {13.168, 16.813}},
                        {hex8, 60, 10, {13.758, 17.396}},
                        {shell18, 8, 2, {}},
                        {shell18, 15, 3, {13.483, 17.121}},
                        {shell18, 30, 5, {13.794, 17.431}}}),
            true, context.threads, result);
  return result;
}

}  // namespace osculate::verification

// Start of full sliding of an infinite layer, KS2D:90 and its confined counterpart.
#include <algorithm>
#include <cmath>
#include <limits>

#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr double mu = 0.3, nu = 0.3, v = 7e-3;

struct Onset {
  double u = std::numeric_limits<double>::quiet_NaN();  ///< first converged one with full sliding
  double before = 0;                                    ///< the increment before
  double coulomb = 0;  ///< largest ||T| / (mu N) - 1| from there on
};

Onset onset(const CaseContext& context, const std::string& model_file) {
  Onset found;
  const model::Model* model = nullptr;
  const auto look = [&](const Snapshot& now) {
    if (!now.record || now.progress.step == 0) return;
    const double u = now.state.u[2 * model->mesh.find_set("column.top_left")->nodes[0]];
    double normal = 0, shear = 0;
    bool slips = true;
    for (const pairing::PointResult<2>& p : now.system.contact()[0].points) {
      slips = slips && p.status == contact::Status::slip;
      normal += p.weight * p.normal_traction;
      shear += p.weight * p.shear_traction[0];
    }
    if (!slips) {
      found = {};
      found.before = u;
      return;
    }
    if (std::isnan(found.u)) found.u = u;
    found.coulomb = std::max(found.coulomb, std::abs(std::abs(shear / (mu * normal)) - 1));
  };
  (void)run_model(context.folder + "/" + model_file, look, [&](deck::Built& built) {
    built.options.threads = context.threads;
    model = &built.model;
  });
  return found;
}

}  // namespace

CaseResult critical_displacement(const CaseContext& context) {
  CaseResult out;
  const double free_sides = 2 * mu * v / (1 - nu);
  const double confined = 2 * mu * (1 - nu) * v / (1 - 2 * nu);
  const auto rows = [&](const std::string& name, const std::string& file, double reference,
                        const std::string& source) {
    const Onset start = onset(context, file);
    const double increment = start.u - start.before;
    out.rows.push_back({name + ": u at the start of full sliding", start.u, reference,
                        Relation::equal, increment / reference, source});
    out.rows.push_back({name + ": increment", increment, 1e-5, Relation::equal, 1e-6, "model"});
    out.rows.push_back({name + ": sliding, ||T| / (mu N) - 1|", start.coulomb, 0, Relation::equal,
                        1e-9, "Coulomb"});
  };
  rows("free sides, plane strain", "layer_free_sides_plane_strain.yaml", free_sides, "KS2D:90");
  rows("confined, plane stress", "layer_confined_plane_stress.yaml", free_sides, "KS2D:90");
  rows("confined, plane strain", "layer_confined_plane_strain.yaml", confined, "Hooke's law");
  return out;
}

}  // namespace osculate::verification

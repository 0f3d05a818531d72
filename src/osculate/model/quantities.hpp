#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// One column of history.csv.
struct HistoryRequest {
  enum class Kind { nodes, rigid, pair };
  std::string name;  ///< column name
  Kind kind = Kind::nodes;
  Index target = -1;         ///< rigid body or pair
  std::vector<Index> nodes;  ///< of a set
  std::string quantity;
};

/// What can be asked of node sets, rigid bodies and contact pairs. Displacements of a set are
/// averages, reactions (rf*) sums of the force the support exerts. Pair forces act on the slave;
/// `shear_force` is along the master's direction of travel.
inline constexpr std::array<std::string_view, 4> node_quantities{"ux", "uy", "rfx", "rfy"};
inline constexpr std::array<std::string_view, 6> rigid_quantities{"ux",  "uy",  "rz",
                                                                  "rfx", "rfy", "rmz"};
inline constexpr std::array<std::string_view, 10> pair_quantities{
    "force_x",         "force_y", "normal_force", "shear_force", "max_pressure",
    "max_penetration", "stick",   "slip",         "open",        "area"};

/// Value after the last evaluation of `system` at the committed `state`.
[[nodiscard]] double history_value(const System& system, const Model& model, const State& state,
                                   const HistoryRequest& request);

/// Contact results of one slave node under the names users know.
struct ContactFields {
  std::vector<Index> nodes;
  std::vector<double> copen, cpress, cshear, cslip, carea, cnforce, csforce;
  std::vector<double> cstatus, cfeature;
  std::vector<Vec2> normal;
};
[[nodiscard]] ContactFields contact_fields(const System& system, const Model& model,
                                           std::size_t pair);

/// Nodal reaction: internal + contact - external (zero at free nodes of a converged state).
[[nodiscard]] Eigen::VectorXd reactions(const System& system);

}  // namespace osculate::model

#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// One column of history.csv.
struct HistoryRequest {
  enum class Kind { nodes, rigid, pair, whole, remembered };
  std::string name;  ///< column name
  Kind kind = Kind::nodes;
  Index target = -1;         ///< rigid body or pair
  std::vector<Index> nodes;  ///< of a set
  std::string quantity;
  std::vector<Index> group{};  ///< further pairs: their sum, the largest of `max_*` and `slip`
  bool imaginary = false;      ///< part of what swings, in harmonic steps; 0 in others
};

/// Behind the name of a column, where steps are harmonic: the imaginary part.
inline constexpr std::string_view imaginary_suffix = ".imaginary";
/// Of models whose materials dissipate.
inline constexpr std::string_view plastic_quantity = "plastic";

/// What can be asked of node sets, rigid bodies and contact pairs. Displacements of a set are
/// averages, reactions (rf*) sums of the force the support exerts. Rotations of a rigid body in
/// space are the components of its rotation vector, reaction moments (rm*) act about axes through
/// its reference point that are fixed in space. Pair forces act on the slave; `shear_force` is
/// along the master's direction of travel (3D: the length of the resultant of all shear forces).
/// `friction_work` is what sliding has dissipated since the beginning; the elastic part of the
/// tangential penalty is not in it. `slip` is the largest distance, over the points in contact,
/// that a point has come along the master since it touched it: what CSLIP* have as a vector, zero
/// without friction. `stick` and `slipping` count points of pairs with friction (or tied), `closed`
/// all that are in contact. Velocities are zero in steps without inertia. Of the whole model: the
/// members of Energies, and the time since inertia began (`elapsed`). Of what materials remember
/// (material::Remembered, by its name): largest_remembered, over the nodes of a set.
inline constexpr std::array<std::string_view, 10> energy_quantities{
    "elapsed",  "kinetic", "strain",    "contact",  "external",
    "friction", "damping", "numerical", "residual", plastic_quantity};
/// Length of the last increment in time, where time steps are chosen by their errors.
inline constexpr std::string_view time_step_quantity = "time_step";
/// Of the running step that has passed, in models with inertia.
inline constexpr std::string_view fraction_quantity = "fraction";
inline constexpr std::array<std::string_view, 6> node_quantities{"ux",  "uy", "rfx",
                                                                 "rfy", "vx", "vy"};
inline constexpr std::array<std::string_view, 9> rigid_quantities{"ux",  "uy", "rz", "rfx", "rfy",
                                                                  "rmz", "vx", "vy", "wz"};
inline constexpr std::array<std::string_view, 13> pair_quantities{
    "force_x",      "force_y",  "normal_force", "shear_force", "max_pressure", "max_penetration",
    "stick",        "slipping", "closed",       "slip",        "open",         "area",
    "friction_work"};
inline constexpr std::array<std::string_view, 9> node_quantities3{"ux",  "uy", "uz", "rfx", "rfy",
                                                                  "rfz", "vx", "vy", "vz"};
inline constexpr std::array<std::string_view, 18> rigid_quantities3{
    "ux",  "uy",  "uz",  "rx", "ry", "rz", "rfx", "rfy", "rfz",
    "rmx", "rmy", "rmz", "vx", "vy", "vz", "wx",  "wy",  "wz"};
inline constexpr std::array<std::string_view, 14> pair_quantities3{"force_x",
                                                                   "force_y",
                                                                   "force_z",
                                                                   "normal_force",
                                                                   "shear_force",
                                                                   "max_pressure",
                                                                   "max_penetration",
                                                                   "stick",
                                                                   "slipping",
                                                                   "closed",
                                                                   "slip",
                                                                   "open",
                                                                   "area",
                                                                   "friction_work"};

/// Value after the last evaluation of `system` at the committed `state`.
template <int Dim>
[[nodiscard]] double history_value(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                                   const BasicState<Dim>& state, const HistoryRequest& request);

/// Place of an edge-edge contact on the slave's.
struct EdgeEdgeSite {
  Index edge = -1;  ///< number in pairing::EdgeContact::slave
  double xi = 0;
};

/// Contact results of one slave node under the names users know.
///
/// Frame      2D: shear and slip along the master's direction of travel. 3D: along two directions
///            of the contact plane: 1 is the x axis projected onto it (the z axis where the normal
///            is within 0.1 degree of x), 2 is normal x 1; `csforce` is the length of the shear
///            force
template <int Dim>
struct BasicContactFields {
  std::vector<Index> nodes;
  std::vector<double> copen, cpress, cshear, cslip, carea, cnforce, csforce;
  std::vector<double> cstatus, cfeature;
  std::vector<double> cshear2, cslip2;  ///< 3D only; `cshear` and `cslip` are along direction 1
  std::vector<Vec<Dim>> normal;
  std::vector<EdgeEdgeSite> edge_contacts;  ///< their values follow those of the nodes
};
template <int Dim>
[[nodiscard]] BasicContactFields<Dim> contact_fields(const BasicSystem<Dim>& system,
                                                     const BasicModel<Dim>& model,
                                                     std::size_t pair);

/// Forces that cells and contacts put on nodes: of nodes of no cell what equations pass on to them,
/// of those of shells and beams the sum over the nodes that they were expanded to.
template <int Dim>
[[nodiscard]] Eigen::VectorXd nodal_forces(const BasicSystem<Dim>& system);
/// Adds to nodes of no cell what equations pass on to them of the forces on others.
template <int Dim>
void pass_on(const BasicDofSpace<Dim>& dofs, Eigen::VectorXd& forces);

/// Nodal reaction: internal + contact - external, with inertia and damping (zero at free nodes of a
/// converged state; with inertia up to what the scheme leaves). Nodes of no cell, as those of
/// sections under pretension, have what the equations that name them pass on.
template <int Dim>
[[nodiscard]] Eigen::VectorXd reactions(const BasicSystem<Dim>& system);

/// Force and moment about the reference point that forces on nodes add up to on a rigid body; with
/// those of `reactions` what its supports exert.
template <int Dim>
[[nodiscard]] Vec<body::motions<Dim>> force_on_body(const BasicSystem<Dim>& system,
                                                    const BasicModel<Dim>& model,
                                                    const BasicState<Dim>& state, Index body,
                                                    const Eigen::VectorXd& forces);

using ContactFields = BasicContactFields<2>;
using ContactFields3 = BasicContactFields<3>;

}  // namespace osculate::model

#pragma once
// Cells of the plane, of space and of shells without their dimension, for what all of them must do.
// Coordinates and displacements are matrices with a row per node.
#include <variant>
#include <vector>

#include "section_cases.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {

enum class Kind { plane, space, shell };

std::string kind_name(const ::testing::TestParamInfo<Kind>& tested);

struct CellCase {
  Kind kind;
  std::variant<SectionCase, VolumeCase> of;

  [[nodiscard]] int dim() const { return kind == Kind::plane ? 2 : 3; }
  [[nodiscard]] cell::CellType type() const;
  [[nodiscard]] bool finite() const;
  [[nodiscard]] bool axisymmetric() const;
  [[nodiscard]] bool plane_stress() const;
  [[nodiscard]] bool full() const;  ///< plain displacement formulation
  [[nodiscard]] bool bbar() const;
  [[nodiscard]] bool reduced() const;

  [[nodiscard]] CellCase as_full() const;
  [[nodiscard]] CellCase as_small() const;  ///< and linear elastic
  [[nodiscard]] CellCase nearly_incompressible() const;
};

/// Visits all supported combinations of a kind.
void for_each_cell(Kind kind, const std::function<void(const CellCase&)>& visit);

/// Cells of size about 1 (shells: 0.2 thick): all nodes moved at random, only the corners, none.
Eigen::MatrixXd curved(const CellCase& c);
Eigen::MatrixXd straight(const CellCase& c);
Eigen::MatrixXd regular(const CellCase& c);

/// Random displacements: moderate ones, and ones of a given size.
Eigen::MatrixXd motion(const CellCase& c);
Eigen::MatrixXd motion(const CellCase& c, double size, int seed = 1);

struct CellResult {
  Status status;
  Eigen::VectorXd force;
  Eigen::MatrixXd tangent;
};
CellResult answer(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
                  bool with_tangent, const material::Memory& memory = {});
/// The answer with its tangent, which is expected to be ok.
CellResult evaluated(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u);

/// Size of the forces of a strain of one: what rounding is relative to.
double stiffness_scale(const CellCase& c, const Eigen::MatrixXd& x);

double energy(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
              const material::Memory& memory = {});

/// Stress and strain have the components of the cell; a node has no volume.
struct PointValues {
  Eigen::VectorXd xi, position, stress, strain;
  double volume = 0;
};
struct CellValues {
  Status status;
  std::vector<PointValues> at;
};
CellValues point_values(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
                        const material::Memory& memory = {});
CellValues nodal_values(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u);
Eigen::VectorXd weights(const CellCase& c, const Eigen::MatrixXd& x);

/// Of all places of the cell.
double least_jacobian(const CellCase& c, const Eigen::MatrixXd& x);

/// A side of a cell with the cell's section. Its nodes run so that the body lies behind it.
struct Side {
  CellCase as;  ///< of the type of the side
  std::vector<Eigen::Index> nodes;

  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& cell) const {
    return cell(nodes, Eigen::all);
  }
};
/// Those of shell18 are listed through their corners only: none are returned.
std::vector<Side> sides(const CellCase& c);

/// What loads of sides answer; `side` is of the type of a side.
CellResult pressure_on(const CellCase& side, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u,
                       double pressure);
Eigen::VectorXd side_weights(const CellCase& side, const Eigen::MatrixXd& x);

/// A vector or place of the plane or of space.
Vec3 in_space(const Eigen::VectorXd& v);

/// Sum of the forces, and of their moments about the origin.
std::pair<Vec3, Vec3> resultant(const Eigen::VectorXd& force, const Eigen::MatrixXd& places);

/// MacNeal and Harder's patches: five quadrilaterals in a rectangle, seven hexahedra in a unit
/// cube. The second half of the nodes lies inside.
struct CellPatch {
  cell::CellType type;
  Eigen::MatrixXd nodes;
  std::vector<std::vector<Eigen::Index>> cells;
};
CellPatch macneal_harder(Kind kind);

struct ShapeValues {
  Eigen::VectorXd n;
  Eigen::MatrixXd d;  ///< a row per node
};
ShapeValues shape(const CellCase& c, const Eigen::VectorXd& xi);

/// The part of four or six components in the directions of the coordinates.
Eigen::MatrixXd tensor(const CellCase& c, const Eigen::VectorXd& components);

Eigen::MatrixXd rotation(const CellCase& c, double angle);

}  // namespace osculate::solid::testing

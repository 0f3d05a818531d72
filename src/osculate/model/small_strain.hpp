#pragma once
#include <string>
#include <vector>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::model {

/// How far a section that is computed with small strains has left what they are for.
struct SmallStrain {
  std::string section;
  double strain = 0;           ///< largest of a cell: norm of the mean Green strain
  double rotation = 0;         ///< largest of a cell [radians]
  bool may_be_finite = false;  ///< its law may be used with finite strains, too
  [[nodiscard]] bool large() const { return strain > 0.1 || rotation > 0.1745; }  // 10 degrees
};

/// How far displacements may go from where they were measured before a section's strains or
/// rotations can be large.
///
/// Formula    |G(u)| <= |G(u0)| + k r ,  k^2 = N tr (sum a a^T)^-1 of N nodes at a from the middle
/// of
///            their cell, r half the diagonal of the box of u - u0 of all nodes (Frobenius norms);
///            |G| <= 0.09 is a strain below 0.0941 and a rotation below 8 degrees
template <int Dim>
struct SmallStrainBound {
  std::vector<Index> nodes;  ///< of the section, each once
  Eigen::VectorXd u;         ///< theirs, where it was measured
  double gradient = 0;       ///< largest |G| of a cell there
  double per_motion = 0;     ///< largest k
  [[nodiscard]] bool holds(const Eigen::VectorXd& displacements) const;
};

/// Takes a state into account: one entry per section with small strains, in the model's order.
/// Where `bounds` is given it gets an entry for each of them.
///
/// Formula    F = I + G, G the linear field nearest to the displacements of a cell's nodes;
///            strain |F^T F - I| / 2, rotation the angle of R in F = R U; of cells that have come
///            back new from where they did
/// Tested by  tests/unit/model/test_small_strain.cpp
template <int Dim>
void measure_small_strain(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                          std::vector<SmallStrain>& found,
                          std::vector<SmallStrainBound<Dim>>* bounds = nullptr);

/// What measures a run's states, but those in which nothing can be large.
///
/// Contract   `found` has the largest of all states in which a section is large, and 0 of others:
///            it does not depend on which states were measured
/// Tested by  tests/unit/model/test_small_strain.cpp
template <int Dim>
class SmallStrainWatch {
 public:
  /// `model`: as it is in step number `step`.
  void take(const BasicModel<Dim>& model, int step, const BasicState<Dim>& state,
            std::vector<SmallStrain>& found);
  /// How many states were measured.
  [[nodiscard]] int measured() const { return measured_; }

 private:
  std::vector<SmallStrainBound<Dim>> bounds_;
  int step_ = -1;  ///< that of the bounds
  int measured_ = 0;
};

/// A warning where it has, else empty.
[[nodiscard]] std::string left_small_strain(const SmallStrain& found);

}  // namespace osculate::model

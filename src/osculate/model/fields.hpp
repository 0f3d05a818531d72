#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::model {

/// Results at the nodes of the mesh (frame nodes left out), averaged over the cells that meet
/// there.
template <int Dim>
struct BasicNodalFields {
  using Tensor = std::array<double, solid::components<Dim>>;  ///< xx, yy, zz, xy (3D: yz, xz)
  std::vector<Vec<Dim>> displacement, reaction;
  std::vector<Tensor> stress;  ///< Cauchy
  std::vector<Tensor> strain;  ///< small or Green-Lagrange, half the shear angles
  std::vector<double> mises;
  /// What the materials remember, by name; zero where they have no such number.
  std::vector<std::pair<std::string_view, std::vector<double>>> memory;
};

template <int Dim>
[[nodiscard]] BasicNodalFields<Dim> nodal_fields(const BasicSystem<Dim>& system,
                                                 const BasicModel<Dim>& model,
                                                 const BasicState<Dim>& state);

/// Work per reference volume at the nodes, stored and dissipated in the material so far; averaged
/// as the fields are.
///
/// Tested by  tests/unit/api/test_answers.cpp
template <int Dim>
[[nodiscard]] std::vector<double> nodal_work(const BasicSystem<Dim>& system,
                                             const BasicModel<Dim>& model,
                                             const BasicState<Dim>& state);

/// A state that was reached, with its system, for all who write something of it: its results at
/// the nodes are computed when the first of them asks. For as long as system and state are as they
/// are.
template <int Dim>
class BasicReached {
 public:
  const BasicSystem<Dim>& system;
  const BasicModel<Dim>& model;
  const BasicState<Dim>& state;
  BasicReached(const BasicSystem<Dim>& of_system, const BasicModel<Dim>& of_model,
               const BasicState<Dim>& of_state)
      : system(of_system), model(of_model), state(of_state) {}
  [[nodiscard]] const BasicNodalFields<Dim>& fields() const {
    if (!fields_) fields_ = nodal_fields(system, model, state);
    return *fields_;
  }

 private:
  mutable std::optional<BasicNodalFields<Dim>> fields_;
};

/// The value of BasicNodalFields::memory with this name that is largest in size, over some nodes;
/// 0 if there are none.
///
/// Tested by  tests/unit/deck/test_plasticity.cpp
template <int Dim>
[[nodiscard]] double largest_remembered(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                                        std::span<const Index> nodes, std::string_view name);

using NodalFields = BasicNodalFields<2>;
using NodalFields3 = BasicNodalFields<3>;
using Reached = BasicReached<2>;
using Reached3 = BasicReached<3>;

}  // namespace osculate::model

#pragma once
#include <array>
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

/// The value of BasicNodalFields::memory with this name that is largest in size, over some nodes;
/// 0 if there are none.
///
/// Tested by  tests/unit/deck/test_plasticity.cpp
template <int Dim>
[[nodiscard]] double largest_remembered(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                                        std::span<const Index> nodes, std::string_view name);

using NodalFields = BasicNodalFields<2>;
using NodalFields3 = BasicNodalFields<3>;

}  // namespace osculate::model

#pragma once
#include <span>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"
#include "osculate/model/terms/assembly.hpp"

namespace osculate::model {

/// Whether small rotations of bodies are linear, as in the balance, or turn as they do: what is
/// about a loaded state, as vibrations and buckling, knows of the second order.
enum class SmallRotations { linear, turn };

/// What depends on the rotations of rigid bodies beyond the forces themselves: the work of moments
/// about fixed axes. `moved`: the tangent of it is wanted.
///
/// Tested by  tests/unit/model/test_system.cpp
template <int Dim>
void turn_moments(const BasicModel<Dim>& model, const BasicState<Dim>& trial, bool moved,
                  Assembly<Dim>& to, SmallRotations small = SmallRotations::linear);
/// The second-order part of the motion of their nodes, on which `force` acts (as in the balance).
template <int Dim>
void add_rigid_geometry(const BasicModel<Dim>& model, const BasicState<Dim>& trial,
                        std::span<const Vec<Dim>> x, const Eigen::VectorXd& force,
                        Assembly<Dim>& to, SmallRotations small = SmallRotations::linear);

}  // namespace osculate::model

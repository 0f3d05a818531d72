#pragma once
// What the solid elements of the plane and of space are called, so that the model is one template.
#include "osculate/solid/element.hpp"
#include "osculate/solid/volume.hpp"

namespace osculate::model {

template <int Dim>
struct BulkTraits;

template <>
struct BulkTraits<2> {
  using Section = solid::Section;
  using Coordinates = solid::Coordinates;
  using Result = solid::ElementResult;
  static constexpr int max_nodes = solid::max_nodes;
  static constexpr int tensor = 4;  ///< components of a stress: xx, yy, zz, xy
};

template <>
struct BulkTraits<3> {
  using Section = solid::VolumeSection;
  using Coordinates = solid::Coordinates3;
  using Result = solid::VolumeResult;
  static constexpr int max_nodes = solid::max_volume_nodes;
  static constexpr int tensor = 6;  ///< xx, yy, zz, xy, yz, xz
};

template <int Dim>
using SolidSection = typename BulkTraits<Dim>::Section;
template <int Dim>
using SolidCoordinates = typename BulkTraits<Dim>::Coordinates;

}  // namespace osculate::model

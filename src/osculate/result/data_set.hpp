#pragma once
#include <array>
#include <string>
#include <vector>

#include "osculate/io/vtk.hpp"
#include "osculate/model/system.hpp"
#include "osculate/result/rigid_pictures.hpp"

namespace osculate::result {

/// One part of a state as its file of results shows it: reference coordinates, cells and fields.
struct DataSet {
  std::string part;  ///< `bodies`, `rigid bodies`, or the name of a contact pair
  std::vector<Vec3> points;
  std::vector<mesh::Block> cells;
  std::vector<io::Field> point_fields, cell_fields{};
};

/// The slave of a pair with its contact fields (docs/results.md): its facets, or single points.
///
/// Tested by  tests/unit/result/test_field_files.cpp
template <int Dim>
[[nodiscard]] DataSet contact_set(const model::BasicSystem<Dim>& system,
                                  const model::BasicModel<Dim>& model,
                                  const model::BasicState<Dim>& state, std::size_t pair);

/// All rigid bodies with their displacement, numbered behind the deformable ones.
[[nodiscard]] DataSet rigid_set(const model::Model& model, const RigidLines& rigid,
                                const model::State& state, std::size_t deformable);
[[nodiscard]] DataSet rigid_set(const model::Model3& model, const RigidFaces& rigid,
                                const model::State3& state, std::size_t deformable);

// ---- fields as the files have them --------------------------------------------------------------

/// Three components, the last one 0 in the plane.
template <int Rows>
[[nodiscard]] io::Field vector_field(const std::string& name,
                                     const std::vector<Vec<Rows>>& values) {
  io::Field field{name, 3, {}, {}};
  for (const Vec<Rows>& value : values) {
    field.values.insert(field.values.end(), value.begin(), value.end());
    if (Rows == 2) field.values.push_back(0);
  }
  return field;
}

/// xx, yy, zz, xy, in space also yz, xz.
template <std::size_t N>
[[nodiscard]] io::Field tensor_field(const std::string& name,
                                     const std::vector<std::array<double, N>>& values) {
  io::Field field{name, static_cast<int>(N), {}, {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}};
  field.component_names.resize(N);
  for (const auto& v : values) field.values.insert(field.values.end(), v.begin(), v.end());
  return field;
}

/// What users call the nodes.
[[nodiscard]] io::Field numbers_field(const mesh::Mesh& mesh, const std::vector<Index>& nodes);

}  // namespace osculate::result

#pragma once
// What generators make and refuse; areas and volumes of sets.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <type_traits>

#include "facet_sample.hpp"
#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/volume_shape.hpp"

namespace osculate::mesh::testing {

template <class Spec>
using Append = void (*)(Mesh&, const Spec&, const core::SourceMark&);

template <class Spec>
Mesh generated(Append<Spec> append, const Spec& spec) {
  Mesh mesh;
  append(mesh, spec, {});
  return mesh;
}

/// A specification that was good is refused: the message names the place, the shape and what is
/// wrong; the mesh stays as it was.
template <class Spec>
void expect_refusal(Append<Spec> append, Spec spec,
                    const std::type_identity_t<std::function<void(Spec&)>>& spoil,
                    const std::string& shape, const std::string& message, const Mesh& before = {}) {
  spoil(spec);
  Mesh mesh = before;
  try {
    append(mesh, spec, {"model.yaml", 7, "mesh.generate"});
    ADD_FAILURE() << "accepted; expected: " << message;
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("model.yaml:7: mesh.generate: " + shape));
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
  EXPECT_EQ(mesh.nodes.size(), before.nodes.size());
  EXPECT_EQ(mesh.sets.size(), before.sets.size());
  EXPECT_EQ(mesh.blocks.size(), before.blocks.size());
}

inline std::span<const Index> corners_of(const Mesh& mesh, CellRef ref) {
  const Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  return {block.cell(ref.cell), static_cast<std::size_t>(cell::info(block.type).corners)};
}

/// Area vector of a facet: half the sum of the cross products of its corners (exact for plane
/// corners).
inline Vec3 area_vector(const Mesh& mesh, std::span<const Index> corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum += 0.5 * at(mesh, corners[k]).cross(at(mesh, corners[(k + 1) % corners.size()]));
  return sum;
}

inline Vec3 area_vector(const Mesh& mesh, CellRef ref) {
  return area_vector(mesh, corners_of(mesh, ref));
}

inline Vec3 area_of_set(const Mesh& mesh, const std::string& name) {
  Vec3 sum = Vec3::Zero();
  for (const CellRef ref : mesh.find_set(name)->cells) sum += area_vector(mesh, ref);
  return sum;
}

/// Volume of a cell by integrating its Jacobian with 3 x 3 x 3 Gauss points mapped to its shape
/// from the cube (collapsed for tetrahedra and wedges): exact up to degree four.
inline double volume_of(const Mesh& mesh, CellRef ref) {
  const Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const cell::CellInfo& info = cell::info(block.type);
  const double g = std::sqrt(0.6);
  constexpr std::array<double, 3> weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  const std::array<double, 3> place{0.5 * (1 - g), 0.5, 0.5 * (1 + g)};
  double volume = 0;
  for (std::size_t i = 0; i < 27; ++i) {
    const double a = place[i % 3], b = place[i / 3 % 3], c = place[i / 9];
    const double w = weight[i % 3] * weight[i / 3 % 3] * weight[i / 9];
    Vec3 xi(2 * a - 1, 2 * b - 1, 2 * c - 1);
    double scale = 8;
    if (info.corners == 6) {
      xi = {a, b * (1 - a), 2 * c - 1};
      scale = 2 * (1 - a);
    } else if (info.corners == 4) {
      xi = {a, b * (1 - a), c * (1 - a) * (1 - b)};
      scale = (1 - a) * (1 - a) * (1 - b);
    }
    const cell::VolumeShape shape = cell::volume_shape(block.type, xi);
    Mat<3, 3> jacobian = Mat<3, 3>::Zero();
    for (int k = 0; k < shape.count; ++k)
      jacobian += at(mesh, block.cell(ref.cell)[k]) * shape.d.row(k);
    volume += w * scale * jacobian.determinant();
  }
  return volume;
}

inline double volume_of_set(const Mesh& mesh, const std::string& name) {
  double total = 0;
  for (const CellRef ref : mesh.find_set(name)->cells) total += volume_of(mesh, ref);
  return total;
}

/// Area of a set of area cells, also curved ones.
inline double surface_of_set(const Mesh& mesh, const std::string& name) {
  double total = 0;
  for (const CellRef ref : mesh.find_set(name)->cells) {
    const Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    const cell::Quadrature2D rule =
        cell::is_triangle(block.type) ? cell::gauss_triangle(6) : cell::gauss_quad(4);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const cell::FacetShape shape = cell::facet_shape(block.type, rule.points[q], 1);
      Vec3 first = Vec3::Zero(), second = Vec3::Zero();
      for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k) {
        const Vec3& x = at(mesh, block.cell(ref.cell)[k]);
        first += shape.n[1][k] * x;
        second += shape.n[2][k] * x;
      }
      total += rule.weights[q] * first.cross(second).norm();
    }
  }
  return total;
}

}  // namespace osculate::mesh::testing

// Pipes and boxes of decks: sections of cells, and beams of them.
#include "osculate/io/inp/hollow_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/inp/deck_mesh.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::io::inp {
namespace {

using ::testing::HasSubstr;

constexpr double pi = std::numbers::pi;

ThinSection pipe(double radius, double wall) {
  ThinSection section;
  section.shape = ThinSection::Shape::pipe;
  section.thickness = {2 * radius, 2 * radius};
  section.wall[0] = wall;
  return section;
}
ThinSection box(double a, double b, const std::array<double, 4>& wall) {
  ThinSection section;
  section.shape = ThinSection::Shape::box;
  section.thickness = {a, b};
  section.wall = wall;
  return section;
}

/// sum share f of the points, times the halves of the sizes.
template <class F>
double mean(const ThinSection& of, const HollowSection& section, const std::vector<double>& share,
            const F& f) {
  double sum = 0;
  for (std::size_t p = 0; p < share.size(); ++p)
    sum += share[p] * f(of.thickness[0] / 2 * section.points[p].x(),
                        of.thickness[1] / 2 * section.points[p].y());
  return sum;
}

/// Of a ring: r^2 is (R^2 + r^2) / 2 in the mean.
TEST(HollowSection, PipeHasTheSecondMomentOfARing) {
  const ThinSection of = pipe(5, 0.5);
  const HollowSection section = hollow_section(of);
  EXPECT_EQ(section.cells.size(), 16U);
  EXPECT_EQ(section.points.size(), 80U);
  const double square = (25 + 4.5 * 4.5) / 2;
  const auto radius = [](double x, double y) { return x * x + y * y; };
  EXPECT_NEAR(mean(of, section, section.share, [](double, double) { return 1; }), 1, 1e-14);
  EXPECT_NEAR(mean(of, section, section.share, radius), square, 1e-4 * square);
  EXPECT_NEAR(mean(of, section, section.share, [](double x, double y) { return x * y; }), 0, 1e-13);
  EXPECT_NEAR(mean(of, section, section.axis_share, radius), square, 1e-4 * square);
}

TEST(HollowSection, BoxHasItsCentroidAndSecondMoments) {
  const ThinSection of = box(10, 16, {4, 3, 1, 2});
  const HollowSection section = hollow_section(of);
  EXPECT_EQ(section.cells.size(), 8U);
  // outer less inner: x from -4 to 1, y from -6 to 5
  const double area = 160 - 5 * 11;
  const double x = -55 * -1.5 / area, y = -55 * -0.5 / area;
  const double xx = (16 * 1000 / 12.0 - 11 * (1 + 64) / 3.0) / area;
  const double xy = -55 * 0.75 / area;
  const auto of_x = [](double a, double) { return a; };
  const auto of_y = [](double, double b) { return b; };
  EXPECT_NEAR(mean(of, section, section.share, of_x), x, 1e-12);
  EXPECT_NEAR(mean(of, section, section.share, of_y), y, 1e-12);
  EXPECT_NEAR(mean(of, section, section.share, [](double a, double) { return a * a; }), xx, 1e-11);
  EXPECT_NEAR(mean(of, section, section.share, [](double a, double b) { return a * b; }), xy,
              1e-11);
  for (const auto* const share : {&section.axis_share, &section.axis_corner_share}) {
    EXPECT_NEAR(mean(of, section, *share, [](double, double) { return 1; }), 1, 1e-13);
    EXPECT_NEAR(mean(of, section, *share, of_x), 0, 1e-13);
    EXPECT_NEAR(mean(of, section, *share, of_y), 0, 1e-13);
  }
}

DeckMesh beam(const std::string& section) {
  const std::string text =
      "*NODE, NSET=N\n1, 0, 0, 0\n2, 5, 0, 0\n3, 10, 0, 0\n4, 15, 0, 0\n5, 20, 0, 0\n"
      "*ELEMENT, TYPE=B32R, ELSET=E\n1, 1, 2, 3\n2, 3, 4, 5\n" +
      section + "*BOUNDARY\n1, 1, 6\n";
  return deck_mesh(read_cards(text, "a.inp"));
}

double volume_of(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const cell::Quadrature3D rule = cell::gauss_hex(4);
  double volume = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const cell::VolumeShape shape = cell::volume_shape(block.type, rule.points[q]);
    Mat<3, 3> jacobian = Mat<3, 3>::Zero();
    for (int k = 0; k < shape.count; ++k)
      jacobian += mesh.nodes[static_cast<std::size_t>(block.cell(ref.cell)[k])] * shape.d.row(k);
    EXPECT_GT(jacobian.determinant(), 0);
    volume += rule.weights[q] * jacobian.determinant();
  }
  return volume;
}

/// Its volume, and that all relations hold of what every solid does when it moves and stretches:
/// rotations of nodes are those of the field.
TEST(HollowSection, BeamsAreWholeAndMoveAsOne) {
  for (const auto& [text, area, within] :
       {std::tuple(std::string("PIPE\n5., 0.5\n0, 1, 0\n"), pi * (25 - 4.5 * 4.5), 1e-4),
        std::tuple(std::string("BOX\n10., 16., 4., 2., 1., 3.\n0, 1, 0\n"), 105.0, 1e-12)}) {
    const DeckMesh deck = beam("*BEAM GENERAL SECTION, ELSET=E, MATERIAL=M, SECTION=" + text);
    const mesh::Mesh& mesh = deck.mesh;
    for (const mesh::Finding& finding : mesh::check_mesh(mesh, {}, {}))
      EXPECT_FALSE(finding.is_error) << finding.message;
    double volume = 0;
    for (const mesh::CellRef& ref : mesh.find_set("E")->cells) volume += volume_of(mesh, ref);
    EXPECT_NEAR(volume, 20 * area, within * 20 * area);
    const Index turns = mesh.find_set("rotations of node 1")->nodes[0];
    Mat<3, 3> gradient;
    gradient << 0.1, 0.2, -0.3, -0.2, 0.5, 0.05, 0.3, -0.05, 0.5;
    const Vec3 turn(-0.05, -0.3, -0.2);
    double largest = 0;
    for (const mesh::Relation& relation : mesh.relations) {
      double sum = 0;
      for (const auto& term : relation.terms) {
        const Vec3 u = gradient * mesh.nodes[static_cast<std::size_t>(term.node)];
        sum += term.factor * (term.node == turns ? turn[term.direction] : u[term.direction]);
      }
      largest = std::max(largest, std::abs(sum));
    }
    EXPECT_LT(largest, 1e-11) << text;
  }
}

TEST(HollowSection, WhatIsWrongIsSaid) {
  const auto message = [](const std::string& section) {
    try {
      (void)beam("*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=" + section);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("PIPE\n5., 5.\n"), HasSubstr("a.inp:11: expected"));
  EXPECT_THAT(message("PIPE\n5., 5.\n"), HasSubstr("a wall thinner than the radius"));
  EXPECT_THAT(message("PIPE\n5.\n"), HasSubstr("a thickness above 0, found 0"));
  EXPECT_THAT(message("PIPE\n"), HasSubstr("a line with the thickness"));
  EXPECT_THAT(message("BOX\n10., 8., 1., 4., 1., 4.\n"), HasSubstr("walls that are thinner"));
  EXPECT_THAT(message("BOX\n10., 8., 1., 1., 1.\n"), HasSubstr("a thickness above 0, found 0"));
  EXPECT_THAT(message("PIPE\n5., 0.5\n*DLOAD\nE, P1, 2.\n"), HasSubstr("is a hollow beam"));
  EXPECT_THAT(message("PIPE\n5., 0.5\n*NODE\n6, 9, 9, 9\n*ELEMENT, TYPE=B31, ELSET=E\n3, 1, 6\n"),
              HasSubstr("of type B31; pipes and boxes are B32 or B32R"));
}

}  // namespace
}  // namespace osculate::io::inp

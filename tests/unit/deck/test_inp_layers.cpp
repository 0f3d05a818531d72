// Shells of layers in decks, against the classical theory of laminates.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "inp_run_test.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"

namespace osculate::deck {
namespace {

/// A strip of `count` S8R along x, 20 long and 1 wide, clamped at x = 0 (node 10 k + j + 1 is at x
/// = 10 k / count, y = j / 2).
std::string strip(int count, const std::string& section, const std::string& type = "S8R") {
  std::string text = "*NODE, NSET=NALL\n";
  for (int k = 0; k <= 2 * count; ++k)
    for (int j = 0; j < 3; ++j)
      if (k % 2 == 0 || j != 1)
        text += fmt::format("{}, {:.17g}, {}, 0\n", 10 * k + j + 1, 10.0 * k / count, 0.5 * j);
  text += "*ELEMENT, TYPE=" + type + ", ELSET=E\n";
  for (int e = 0; e < count; ++e) {
    const int a = 20 * e + 1;
    text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", e + 1, a, a + 20, a + 22, a + 2,
                        a + 10, a + 21, a + 12, a + 1);
  }
  const int end = 20 * count + 1;
  return text +
         fmt::format("*NSET, NSET=START\n1, 2, 3\n*NSET, NSET=TIP\n{}, {}, {}\n", end, end + 1,
                     end + 2) +
         "*MATERIAL, NAME=SOFT\n*ELASTIC\n1.E5, 0.\n*MATERIAL, NAME=HARD\n*ELASTIC\n4.E5, 0.\n"
         "*MATERIAL, NAME=PLY\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
         "2.E5, 1.E4, 1.E4, 0., 0., 0., 5.E3, 5.E3\n5.E3,\n"
         "*ORIENTATION, NAME=ALONG\n1., 0., 0., 0., 1., 0.\n"
         "*ORIENTATION, NAME=ACROSS\n0., 1., 0., -1., 0., 0.\n"
         "*ORIENTATION, NAME=UP\n1., 0., 0., 0., 0., 1.\n*SHELL SECTION, COMPOSITE, ELSET=E" +
         section + "*BOUNDARY\nSTART, 1, 6\n";
}
/// Forces on the three nodes of the end, together `force`, along x or z.
std::string pulled(int count, int direction, double force) {
  const int end = 20 * count + 1;
  std::string text = "*STEP\n*STATIC\n*CLOAD\n";
  for (int j = 0; j < 3; ++j)
    text += fmt::format("{}, {}, {:.17g}\n", end + j, direction, force * (j == 1 ? 4 : 1) / 6);
  return text + "*END STEP\n";
}

struct Laminate {
  double a = 0, b = 0, d = 0;  ///< N = a e + b k, M = b e + d k, of width 1
};
/// Of pairs of thickness and modulus, bottom first; no Poisson's ratio.
Laminate laminate(const std::vector<std::pair<double, double>>& layers) {
  double whole = 0;
  for (const auto& [h, e] : layers) whole += h;
  Laminate out;
  double z = -whole / 2;
  for (const auto& [h, e] : layers) {
    const double top = z + h;
    out.a += e * h;
    out.b += e * (top * top - z * z) / 2;
    out.d += e * (top * top * top - z * z * z) / 3;
    z = top;
  }
  return out;
}

/// Forces at the end act on a line of it: compared is one element before, where that has no say.
constexpr int strip_count = 8;
constexpr double strip_length = 20, strip_x = strip_length * (strip_count - 1) / strip_count;
constexpr int strip_node = 20 * (strip_count - 1) + 2;

/// Of a beam with the stiffness `d` under a force at its end.
double strip_bent(double force, double d) {
  return force / d * (strip_length * strip_x * strip_x / 2 - strip_x * strip_x * strip_x / 6);
}

/// What shear adds for each unit of length and force.
///
/// Formula    integral of (S / d)^2 / G , S(z) = integral of E z from z to the top
double shear_compliance(const std::array<double, 3>& moduli, double d, double shear_modulus) {
  constexpr int parts = 3000;
  constexpr double h = 0.3, step = h / parts;
  double s = 0, sum = 0;
  for (int i = 0; i < parts; ++i) {  // from the top
    const double z = h / 2 - (i + 0.5) * step;
    s += moduli[static_cast<std::size_t>(i / (parts / 3))] * z * step;
    sum += s * s * step;
  }
  return sum / (d * d * shear_modulus);
}

/// Two layers, one four times as stiff: what pulls them bends them, and the other way round.
TEST(InpLayers, ABimetalIsPulledAndBentAsALaminate) {
  const std::string section = "\n0.1, , SOFT\n0.2, , HARD\n";
  const Laminate l = laminate({{0.1, 1e5}, {0.2, 4e5}});
  const double det = l.a * l.d - l.b * l.b;
  const DeckRun drawn = run_deck(strip(strip_count, section) + pulled(strip_count, 1, 10));
  const Vec3 there = drawn.displacement(strip_node);
  EXPECT_NEAR(there.x(), 10 * l.d / det * strip_x, 2e-3 * 10 * l.d / det * strip_x);
  const double lifted = 10 * l.b / det * strip_x * strip_x / 2;
  EXPECT_NEAR(there.z(), lifted, 2e-3 * std::abs(lifted));
  const DeckRun bent = run_deck(strip(strip_count, section) + pulled(strip_count, 3, 0.1));
  const double sunk = strip_bent(0.1, det / l.a);
  EXPECT_NEAR(bent.displacement(strip_node).z(), sunk, 2e-3 * sunk);
}

/// Fibres along, across, along: stiff against bending, where they lie outside.
TEST(InpLayers, PliesHaveTheirAxes) {
  for (const auto& [outer, inner, moduli] : {std::tuple("ALONG", "ACROSS", std::array{2e5, 1e4}),
                                             std::tuple("ACROSS", "ALONG", std::array{1e4, 2e5})}) {
    const std::string section =
        fmt::format("\n0.1, , PLY, {0}\n0.1, 2, PLY, {1}\n0.1, , PLY, {0}\n", outer, inner);
    const Laminate l = laminate({{0.1, moduli[0]}, {0.1, moduli[1]}, {0.1, moduli[0]}});
    EXPECT_NEAR(l.b, 0, 1e-12 * l.a);
    const DeckRun bent = run_deck(strip(strip_count, section) + pulled(strip_count, 3, 0.1));
    const double sunk =
        strip_bent(0.1, l.d) +
        0.1 * strip_x * shear_compliance({moduli[0], moduli[1], moduli[0]}, l.d, 5e3);
    EXPECT_NEAR(bent.displacement(strip_node).z(), sunk, 2e-3 * sunk);
  }
}

/// A shell of one material as its single layer would be.
std::string alone(std::string deck, const std::string& axes) {
  const std::string composite = "*SHELL SECTION, COMPOSITE, ELSET=E";
  const std::string section = "*SHELL SECTION, MATERIAL=PLY, ELSET=E";
  deck.replace(deck.find(composite), composite.size(),
               section + (axes.empty() ? "" : ", ORIENTATION=" + axes));
  return deck;
}

TEST(InpLayers, WithoutLayersTheMaterialHasItsAxes) {
  for (const char* const axes : {"ALONG", "ACROSS"}) {
    const DeckRun bent =
        run_deck(alone(strip(strip_count, "\n0.3\n"), axes) + pulled(strip_count, 3, 0.1));
    const double modulus = axes == std::string("ALONG") ? 2e5 : 1e4;
    const Laminate l = laminate({{0.3, modulus}});
    const double sunk = strip_bent(0.1, l.d) +
                        0.1 * strip_x * shear_compliance({modulus, modulus, modulus}, l.d, 5e3);
    EXPECT_NEAR(bent.displacement(strip_node).z(), sunk, 2e-3 * sunk) << axes;
  }
}

TEST(InpLayers, AxesAreLaidOntoTheShell) {
  const auto sunk = [](const char* axes) {
    const DeckRun bent =
        run_deck(alone(strip(strip_count, "\n0.3\n"), axes) + pulled(strip_count, 3, 0.1));
    return bent.displacement(strip_node).z();
  };
  EXPECT_NEAR(sunk("UP"), sunk("ALONG"), 1e-11 * sunk("ALONG"));
  EXPECT_GT(sunk("ACROSS"), 10 * sunk("ALONG"));
}

/// A quarter of a tube of radius r = 10 about z, 2 long, t = 0.1 thick, of S8R, with a pressure of
/// 1 inside: what it widens by is p (r - t / 2) r / (E t), E the modulus around it.
double widened(const std::string& axes) {
  constexpr int count = 12;
  std::string text = "*NODE, NSET=NALL\n";
  for (int k = 0; k <= 2 * count; ++k)
    for (int j = 0; j < 3; ++j)
      if (k % 2 == 0 || j != 1) {
        const double angle = std::numbers::pi / 2 * k / (2 * count);
        text += fmt::format("{}, {:.17g}, {:.17g}, {}\n", 10 * k + j + 1, 10 * std::cos(angle),
                            10 * std::sin(angle), j);
      }
  text += "*ELEMENT, TYPE=S8R, ELSET=E\n";
  for (int e = 0; e < count; ++e) {
    const int a = 20 * e + 1;
    text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", e + 1, a, a + 20, a + 22, a + 2,
                        a + 10, a + 21, a + 12, a + 1);
  }
  const int end = 20 * count + 1;
  text += fmt::format(
      "*NSET, NSET=START\n1, 2, 3\n*NSET, NSET=TIP\n{}, {}, {}\n*MATERIAL, NAME=PLY\n*ELASTIC, "
      "TYPE=ENGINEERING CONSTANTS\n2.E5, 1.E4, 1.E4, 0., 0., 0., 5.E3, 5.E3\n5.E3,\n"
      "*ORIENTATION, NAME=A{}\n*SHELL SECTION, MATERIAL=PLY, ELSET=E, ORIENTATION=A\n0.1\n"
      "*BOUNDARY\nSTART, 2\nSTART, 6\nTIP, 1\nTIP, 6\n1, 3\n{}, 3\n"
      "*STEP\n*STATIC\n*DLOAD\nE, P, 1.\n*END STEP\n",
      end, end + 1, end + 2, axes, end);
  const DeckRun run = run_deck(text);
  const Vec3 moved = run.displacement(10 * count + 1);
  return moved.head<2>().norm();
}

TEST(InpLayers, AxesFollowACurvedShell) {
  const double soft = 9.95 * 10 / (1e4 * 0.1), stiff = soft / 20;
  EXPECT_NEAR(widened("\n0., 0., 1., 1., 0., 0."), soft, 1e-3 * soft);  // 1 along the tube
  EXPECT_NEAR(widened(", SYSTEM=CYLINDRICAL\n0., 0., 0., 0., 0., 1."), soft, 1e-3 * soft);
  EXPECT_NEAR(widened("\n-1., 1., 0., 0., 0., 1."), stiff, 1e-3 * stiff);  // 1 around it
}

TEST(InpLayers, EachHasItsSection) {
  const DeckRun run = run_deck(strip(2, ", OFFSET=0.5\n0.1, , SOFT\n0.3, , HARD\n") +
                               "*STEP\n*STATIC\n*DLOAD\nE, P, 1.\n*END STEP\n");
  ASSERT_EQ(run.built.model.sections.size(), 2U);
  const mesh::Mesh& mesh = run.built.model.mesh;
  const auto heights = [&](const std::string& set) {
    double low = 1e9, high = -1e9;
    for (const Index node : mesh.find_set(set)->nodes) {
      low = std::min(low, mesh.nodes[static_cast<std::size_t>(node)].z());
      high = std::max(high, mesh.nodes[static_cast<std::size_t>(node)].z());
    }
    return std::pair(low, high);
  };
  EXPECT_NEAR(heights("E layer 1").first, -0.4, 1e-12);
  EXPECT_NEAR(heights("E layer 1").second, -0.3, 1e-12);
  EXPECT_NEAR(heights("E layer 2").second, 0, 1e-12);
  EXPECT_EQ(mesh.find_set("P of E")->cells.size(), 2U);
}

TEST(InpLayers, WhatIsWrongIsSaid) {
  using ::testing::HasSubstr;
  const auto message = [](const std::string& section, const std::string& type = "S8R") {
    try {
      (void)run_deck(strip(1, section, type) + pulled(1, 1, 1));
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message("\n0.1, , SOFT\n0., , SOFT\n"), HasSubstr("a thickness above 0, found 0"));
  EXPECT_THAT(message("\n0.1\n"), HasSubstr("expected the material of the layer"));
  EXPECT_THAT(message("\n0.1, , PLY, NONE\n"), HasSubstr("ORIENTATION"));
  EXPECT_THAT(message("\n0.1, , GLUE\n"), HasSubstr("GLUE"));
  const auto refusal = [](const std::string& deck) {
    try {
      (void)translate_deck(deck, "a.inp");
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(refusal("*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*ELEMENT, TYPE=S4R, ELSET=E\n"
                      "1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
                      "2.E5, 1.E4, 1.E4, 0., 0., 0., 5.E3, 5.E3\n5.E3,\n*SHELL SECTION, ELSET=E, "
                      "MATERIAL=M\n0.1\n*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*END STEP\n"),
              HasSubstr("S4R of a material that is not isotropic is not supported"));
}

}  // namespace
}  // namespace osculate::deck

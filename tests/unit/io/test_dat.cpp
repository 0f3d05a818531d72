#include "osculate/io/dat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace osculate::io {
namespace {

// Copied from what ccx 2.20 writes of its deck beamb.
TEST(Dat, FactorsOfBucklingStandInTheirColumns) {
  const std::array<double, 2> factors{48.15456, 1063.175};
  EXPECT_EQ(dat_buckling(factors),
            "\n     B U C K L I N G   F A C T O R   O U T P U T\n\n"
            " MODE NO       BUCKLING\n"
            "                FACTOR\n\n"
            "      1   0.4815456E+02\n"
            "      2   0.1063175E+04\n");
}

TEST(Dat, RealsAsFortranWritesThem) {
  EXPECT_EQ(fortran_real(0.5, 14, 7), " 0.5000000E+00");
  EXPECT_EQ(fortran_real(1, 14, 6), "  0.100000E+01");
  EXPECT_EQ(fortran_real(-1234.5678, 14, 7), "-0.1234568E+04");
  EXPECT_EQ(fortran_real(0.00390625, 14, 6), "  0.390625E-02");
  EXPECT_EQ(fortran_real(99999999, 14, 7), " 0.1000000E+09");
  EXPECT_EQ(fortran_real(0, 12, 4), "  0.0000E+00");
  EXPECT_EQ(fortran_real(std::numeric_limits<double>::quiet_NaN(), 12, 4), "         NaN");
}

TEST(Dat, RowsStandInTheColumnsOfTheFormat) {
  const std::array u{1.975008e-4, -1.999906e-4, 0.0};
  std::string text;
  append_dat_row(text, 11, 0, u);
  append_dat_row(text, 5, 2, u);
  append_dat_total(text, u);
  EXPECT_EQ(text,
            "        11  1.975008E-04 -1.999906E-04  0.000000E+00\n"
            "         5   2  1.975008E-04 -1.999906E-04  0.000000E+00\n"
            "        1.975008E-04 -1.999906E-04  0.000000E+00\n");
  EXPECT_EQ(dat_title("forces (fx,fy,fz) for set FIX and", 0.5),
            "\n forces (fx,fy,fz) for set FIX and time  0.5000000E+00\n\n");
}

TEST(Dat, ForcesThroughASurfaceAsTheFormatHasThem) {
  const DatResultant of{
      {-2, 0, -10}, {-10, -7, 2}, {0.5, 1, 0}, {0, 0, -1}, {0, -12, 0}, 2, 10, 2, 0, 12};
  EXPECT_EQ(
      dat_resultant("surface set S", 1, of),
      "\n\n\n statistics for surface set S and time  0.1000000E+01\n\n"
      "   total surface force (fx,fy,fz) and moment about the origin(mx,my,mz)\n\n"
      "   -2.000000E+00  0.000000E+00 -1.000000E+01 -1.000000E+01 -7.000000E+00  2.000000E+00\n\n"
      "   center of gravity and mean normal\n\n"
      "    5.000000E-01  1.000000E+00  0.000000E+00  0.000000E+00  0.000000E+00 -1.000000E+00\n\n"
      "   moment about the center of gravity(mx,my,mz)\n\n"
      "    0.000000E+00 -1.200000E+01  0.000000E+00\n\n"
      "   area, normal force (+ = tension), shear force (size), torque and bending moment "
      "(size)\n\n"
      "    2.000000E+00  1.000000E+01  2.000000E+00  0.000000E+00  1.200000E+01\n");
}

TEST(Dat, VibrationsAsTheFormatHasThem) {
  const std::array found{0.6770787e10, -4.0};
  constexpr double all = std::numeric_limits<double>::infinity();
  const std::string text = dat_eigenvalues(found, {-all, all});
  EXPECT_THAT(dat_eigenvalues(found, {0.01, all}),
              ::testing::Not(::testing::HasSubstr("      2  ")));
  EXPECT_THAT(dat_eigenvalues(found, {0.01, 1e4}),
              ::testing::Not(::testing::HasSubstr("      1  ")));
  EXPECT_THAT(dat_eigenvalues(found, {-all, 1e4}), ::testing::HasSubstr("      2  -0.4"));
  EXPECT_TRUE(text.starts_with("\n     E I G E N V A L U E   O U T P U T\n\n MODE NO "));
  EXPECT_TRUE(
      text.ends_with("      1   0.6770787E+10   0.8228479E+05   0.1309603E+05   0.0000000E+00\n"
                     "      2  -0.4000000E+01   0.0000000E+00   0.0000000E+00   0.2000000E+01\n"))
      << text;
  const std::vector<std::array<double, 6>> rows{{0.5, -1, 0, 0, 0, 2}};
  const std::string table = dat_modal_table("M A S S", rows, "TOTAL", rows[0]);
  EXPECT_TRUE(table.starts_with("\n     M A S S\n\nMODE NO.   X-COMPONENT     Y-COMPONENT"));
  EXPECT_TRUE(
      table.ends_with("      1   0.5000000E+00  -0.1000000E+01   0.0000000E+00   "
                      "0.0000000E+00   0.0000000E+00   0.2000000E+01\n"
                      "TOTAL     0.5000000E+00  -0.1000000E+01   0.0000000E+00   "
                      "0.0000000E+00   0.0000000E+00   0.2000000E+01\n"))
      << table;
}

/// Lines of the file that CalculiX 2.20 writes of its deck beamdy8.
TEST(Dat, AmountsOfVibrationsAtAFrequency) {
  const std::array frequencies{13096.0311, 76839.71};
  const std::array<std::complex<double>, 2> amounts{
      {{0.5349862e-3, -0.1857317e-3}, {-0.274136e-5, 0}}};
  EXPECT_EQ(dat_factors(12000, frequencies, amounts),
            "\nP A R T I C I P A T I O N   F A C T O R S   F O R   F R E Q U E N C Y    "
            "0.1200000000000E+05 (CYCLES/TIME)\n\n MODE NO    FREQUENCY               FACTOR\n"
            "           (CYCLES/TIME)      REAL        IMAGINARY\n\n"
            "      1   0.1309603E+05   0.5349862E-03  -0.1857317E-03\n"
            "      2   0.7683971E+05  -0.2741360E-05   0.0000000E+00\n");
}

/// Lines of the file that CalculiX 2.20 writes of its deck segment.
TEST(Dat, VibrationsOfASector) {
  const std::array found{0.2797486e3, 0.6659588e4};
  const std::array diameters{1, 1};
  const std::string text = dat_eigenvalues(found, diameters);
  EXPECT_TRUE(text.starts_with(
      "\n     E I G E N V A L U E   O U T P U T\n\n  NODAL   MODE NO    EIGENVALUE  "));
  EXPECT_TRUE(text.ends_with(
      "\n    1          1   0.2797486E+03   0.1672569E+02   0.2661976E+01   0.0000000E+00\n"
      "    1          2   0.6659588E+04   0.8160630E+02   0.1298805E+02   0.0000000E+00\n"))
      << text;
}

TEST(Dat, RowsOfIncrementsAndIterations) {
  EXPECT_EQ(sta_row({2, 1, 1, 2, true, 2, 1, 1}),
            "     2          1     1     2  0.200000E+01  0.100000E+01  0.100000E+01\n");
  EXPECT_EQ(sta_row({1, 2, 3, 6, false, 0.00390625, 0.00390625, 0.5}),
            "     1          2     3U    6  0.390625E-02  0.390625E-02  0.500000E+00\n");
  EXPECT_EQ(cvg_row({2, 1, 1, 2}, 1, 28, 0.4778e-3, 1),
            "     2     1     1     1       28  0.4778E-01  0.1000E+03  0.0000E+00  0.0000E+00\n");
}

}  // namespace
}  // namespace osculate::io

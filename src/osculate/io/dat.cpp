#include "osculate/io/dat.hpp"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <iterator>
#include <numbers>

namespace osculate::io {
namespace {

/// 1.234567E-04 in so many columns; an exponent has two digits.
void append_real(std::string& out, double value, int columns, int digits) {
  constexpr double least = 1e-99;
  if (std::abs(value) < least) value = 0;
  fmt::format_to(std::back_inserter(out), "{:{}.{}E}", value, columns, digits);
}

}  // namespace

std::string fortran_real(double value, int columns, int digits) {
  if (!std::isfinite(value)) return fmt::format("{:>{}}", "NaN", columns);
  // 1.234E+05 is 0.1234E+06
  const std::string text = fmt::format("{:.{}E}", std::abs(value), digits - 1);
  const std::size_t e = text.find('E');
  const int exponent = value == 0 ? 0 : std::stoi(text.substr(e + 1)) + 1;
  const std::string mantissa = text.substr(0, 1) + text.substr(2, e - 2);
  return fmt::format("{:>{}}",
                     fmt::format("{}0.{}E{}{:02}", value < 0 ? "-" : "", mantissa,
                                 exponent < 0 ? '-' : '+', std::abs(exponent)),
                     columns);
}

std::string dat_title(std::string_view what, double time) {
  return fmt::format("\n {} time {}\n\n", what, fortran_real(time, 14, 7));
}

void append_dat_row(std::string& out, std::int64_t number, int point,
                    std::span<const double> values) {
  fmt::format_to(std::back_inserter(out), "{:10}", number);
  if (point > 0) fmt::format_to(std::back_inserter(out), "{:4}", point);
  for (const double value : values) {
    out += ' ';
    append_real(out, value, 13, 6);
  }
  out += '\n';
}

void append_dat_total(std::string& out, std::span<const double> values) {
  out += "      ";
  for (const double value : values) {
    out += ' ';
    append_real(out, value, 13, 6);
  }
  out += '\n';
}

std::string dat_resultant(std::string_view what, double time, const DatResultant& of) {
  std::string out = "\n\n" + dat_title(fmt::format("statistics for {} and", what), time);
  const auto add = [&out](std::string_view title, std::initializer_list<double> values) {
    out += fmt::format("   {}\n\n  ", title);
    for (const double value : values) {
      out += ' ';
      append_real(out, value, 13, 6);
    }
    out += "\n\n";
  };
  const auto& [f, m, c, n, mc, area, normal, shear, torque, bending] = of;
  add("total surface force (fx,fy,fz) and moment about the origin(mx,my,mz)",
      {f[0], f[1], f[2], m[0], m[1], m[2]});
  add("center of gravity and mean normal", {c[0], c[1], c[2], n[0], n[1], n[2]});
  add("moment about the center of gravity(mx,my,mz)", {mc[0], mc[1], mc[2]});
  add("area, normal force (+ = tension), shear force (size), torque and bending moment (size)",
      {area, normal, shear, torque, bending});
  out.pop_back();
  return out;
}

bool is_in_range(double omega_squared, const std::array<double, 2>& frequencies) {
  if (omega_squared < 0) return frequencies[0] < 0;
  const double frequency = std::sqrt(omega_squared) / (2 * std::numbers::pi);
  return frequency >= frequencies[0] && frequency <= frequencies[1];
}

std::string dat_eigenvalues(std::span<const double> omega_squared,
                            const std::array<double, 2>& frequencies) {
  std::string out =
      "\n     E I G E N V A L U E   O U T P U T\n\n"
      " MODE NO    EIGENVALUE                       FREQUENCY   \n"
      "                                     REAL PART            IMAGINARY PART\n"
      "                           (RAD/TIME)      (CYCLES/TIME     (RAD/TIME)\n\n";
  for (std::size_t i = 0; i < omega_squared.size(); ++i) {
    if (!is_in_range(omega_squared[i], frequencies)) continue;
    const double value = omega_squared[i], omega = std::sqrt(std::abs(value));
    const double real = value < 0 ? 0 : omega, imaginary = value < 0 ? omega : 0;
    out += fmt::format(
        "{:7}  {}  {}  {}  {}\n", i + 1, fortran_real(value, 14, 7), fortran_real(real, 14, 7),
        fortran_real(real / (2 * std::numbers::pi), 14, 7), fortran_real(imaginary, 14, 7));
  }
  return out;
}

std::string dat_buckling(std::span<const double> factors) {
  std::string out =
      "\n     B U C K L I N G   F A C T O R   O U T P U T\n\n"
      " MODE NO       BUCKLING\n"
      "                FACTOR\n\n";
  for (std::size_t i = 0; i < factors.size(); ++i)
    out += fmt::format("{:7}  {}\n", i + 1, fortran_real(factors[i], 14, 7));
  return out;
}

std::string dat_eigenvalues(std::span<const double> omega_squared, std::span<const int> diameters) {
  std::string out =
      "\n     E I G E N V A L U E   O U T P U T\n\n"
      "  NODAL   MODE NO    EIGENVALUE                      FREQUENCY   \n"
      " DIAMETER                                    REAL PART            IMAGINARY PART\n"
      "                                    (RAD/TIME)      (CYCLES/TIME)   (RAD/TIME)\n";
  int number = 0;
  for (std::size_t i = 0; i < omega_squared.size(); ++i) {
    const bool first = i == 0 || diameters[i] != diameters[i - 1];
    number = first ? 1 : number + 1;
    if (first) out += '\n';
    const double value = omega_squared[i], omega = std::sqrt(std::abs(value));
    const double real = value < 0 ? 0 : omega, imaginary = value < 0 ? omega : 0;
    out += fmt::format("{:5}    {:7}  {}  {}  {}  {}\n", diameters[i], number,
                       fortran_real(value, 14, 7), fortran_real(real, 14, 7),
                       fortran_real(real / (2 * std::numbers::pi), 14, 7),
                       fortran_real(imaginary, 14, 7));
  }
  return out;
}

std::string dat_modal_table(std::string_view title, std::span<const std::array<double, 6>> rows,
                            std::string_view last_head,
                            const std::optional<std::array<double, 6>>& last) {
  std::string out = fmt::format(
      "\n     {}\n\nMODE NO.   X-COMPONENT     Y-COMPONENT     Z-COMPONENT     X-ROTATION      "
      "Y-ROTATION      Z-ROTATION\n\n",
      title);
  const auto add = [&](std::string_view head, const std::array<double, 6>& values) {
    out += fmt::format("{:<7}", head);
    for (const double value : values) out += "  " + fortran_real(value, 14, 7);
    out += '\n';
  };
  for (std::size_t i = 0; i < rows.size(); ++i) add(fmt::format("{:7}", i + 1), rows[i]);
  if (last) add(last_head, *last);
  return out;
}

std::string dat_factors(double frequency, std::span<const double> frequencies,
                        std::span<const std::complex<double>> amounts) {
  std::string out = fmt::format(
      "\nP A R T I C I P A T I O N   F A C T O R S   F O R   F R E Q U E N C Y   {} "
      "(CYCLES/TIME)\n\n MODE NO    FREQUENCY               FACTOR\n"
      "           (CYCLES/TIME)      REAL        IMAGINARY\n\n",
      fortran_real(frequency, 20, 13));
  for (std::size_t i = 0; i < amounts.size(); ++i)
    out +=
        fmt::format("{:7}  {}  {}  {}\n", i + 1, fortran_real(frequencies[i], 14, 7),
                    fortran_real(amounts[i].real(), 14, 7), fortran_real(amounts[i].imag(), 14, 7));
  return out;
}

std::string sta_head() {
  return "SUMMARY OF JOB INFORMATION\n"
         "  STEP      INC     ATT  ITRS     TOT TIME     STEP TIME      INC TIME\n";
}

std::string sta_row(const Attempt& a) {
  return fmt::format("{:6}{:11}{:6}{}{:5}{}{}{}\n", a.step, a.increment, a.attempt,
                     a.converged ? ' ' : 'U', a.iterations, fortran_real(a.total_time, 14, 6),
                     fortran_real(a.step_time, 14, 6), fortran_real(a.increment_time, 14, 6));
}

std::string cvg_head() {
  return "SUMMARY OF C0NVERGENCE INFORMATION\n"
         "  STEP   INC  ATT   ITER     CONT.   RESID.        CORR.      RESID.      CORR.\n"
         "                              EL.    FORCE         DISP       FLUX        TEMP.\n"
         "                              (#)     (%)           (%)        (%)         (%)\n";
}

std::string cvg_row(const Attempt& a, int iteration, int contacts, double residual,
                    double correction) {
  return fmt::format("{:6}{:6}{:6}{:6}{:9}{}{}{}{}\n", a.step, a.increment, a.attempt, iteration,
                     contacts, fortran_real(100 * residual, 12, 4),
                     fortran_real(100 * correction, 12, 4), fortran_real(0, 12, 4),
                     fortran_real(0, 12, 4));
}

}  // namespace osculate::io

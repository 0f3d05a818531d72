#include "osculate/io/dat.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

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

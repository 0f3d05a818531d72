#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "osculate/api/domain.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {
namespace {

struct Flags {
  std::string surface, output, page;
  api::DomainOptions options;
  bool json = false;
};

int domain(const Flags& flags) {
  keep_inputs({flags.output, flags.page}, {flags.surface});
  deck::SurfaceInput input = deck::read_surface(flags.surface);
  result::DomainReport report = api::survey_domain(input.target, flags.surface, flags.options);
  report.warnings.insert(report.warnings.begin(), input.warnings.begin(), input.warnings.end());
  if (!flags.output.empty()) result::write_domain(flags.output, report.picture);
  if (!flags.page.empty()) io::write_file(flags.page, result::domain_html(report));
  std::FILE* const to = flags.json ? stderr : stdout;
  print(to, "{}", result::to_text(report));
  for (const std::string& file : {flags.output, flags.page})
    if (!file.empty()) print(to, "wrote {}\n", file);
  if (flags.json) print(stdout, "{}\n", result::to_json(report));
  return done;
}

}  // namespace

void add_domain(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "domain", "Projection domains, curvatures and point classes of a surface or curve");
  auto flags = std::make_shared<Flags>();
  command->add_option("surface", flags->surface, "Surface file (YAML), or MESH.msh:SET")
      ->required();
  command->add_option("-o,--output", flags->output,
                      "ParaView file: the surface with its curvatures, and the domain's borders");
  command->add_option("--page", flags->page, "Page that opens offline, with the surface in 3D");
  command
      ->add_option("--kink", flags->options.kink,
                   "Angle up to which neighbours count as smooth, degrees")
      ->check(finite() & CLI::Range(1e-9, 90.0))
      ->capture_default_str();
  command->add_option("--samples", flags->options.samples, "Places looked at, about")
      ->check(CLI::Range(10, 10000000))
      ->capture_default_str();
  command
      ->add_option("--tolerance", flags->options.tolerance,
                   "Between the proved and the found reach, as a part of it")
      ->check(finite() & CLI::Range(1e-6, 0.9))
      ->capture_default_str();
  command
      ->add_option("--length", flags->options.length,
                   "How far things without end are drawn (default: the size of the surface)")
      ->check(finite() & CLI::PositiveNumber);
  command->add_flag("--json", flags->json, "Print JSON on stdout");
  command->callback([flags, &exit_code] { exit_code = domain(*flags); });
}

}  // namespace osculate::app

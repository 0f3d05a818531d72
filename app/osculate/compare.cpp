#include <cmath>
#include <limits>
#include <memory>

#include "commands.hpp"
#include "osculate/api/compare.hpp"

namespace osculate::app {

void add_compare(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "compare", "Say how far two result folders, or .frd files, are apart, quantity by quantity");
  struct Flags {
    std::string a, b;
    double tolerance = std::numeric_limits<double>::infinity();
  };
  auto flags = std::make_shared<Flags>();
  command->add_option("a", flags->a, "Result folder, or .frd file")->required();
  command->add_option("b", flags->b, "The one beside it")->required();
  command
      ->add_option("--tolerance", flags->tolerance,
                   "Exit code 1 where a difference is larger, relative to the largest value of its "
                   "quantity, or one has what the other lacks")
      ->check(CLI::NonNegativeNumber & finite());
  command->callback([flags, &exit_code] {
    const api::Comparison found = api::compare(flags->a, flags->b);
    print(stdout, "{}", found.text());
    const bool asked = flags->tolerance < std::numeric_limits<double>::infinity();
    if (asked && (found.lacks || found.largest_relative() > flags->tolerance))
      exit_code = check_failed;
  });
}

}  // namespace osculate::app

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "osculate/api/run.hpp"
#include "osculate/deck/explain.hpp"
#include "osculate/deck/parse_surface.hpp"
#include "osculate/deck/schema.hpp"
#include "osculate/deck/search_doc.hpp"
#include "pages.hpp"

namespace osculate::app {

void add_schema(CLI::App& app, int&) {
  CLI::App* const command = app.add_subcommand("schema", "Print the JSON schema of the model file");
  auto surface = std::make_shared<bool>(false);
  command->add_flag("--surface", *surface, "Of the surface file of `osculate project`");
  command->callback([surface] {
    print(stdout, "{}\n", *surface ? deck::surface_schema() : deck::model_schema());
  });
}

namespace {

struct DocFlags {
  std::vector<std::string> key;
  std::string word;
  bool surface = false, manual = false, markdown = false;
};

std::string join(const std::vector<std::string>& words, char separator) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : std::string(1, separator)) + word;
  return text;
}

/// What is known of words that are no key; throws what was wrong with the key if nothing is.
std::string found_instead(const std::vector<std::string>& words, const core::InputError& error) {
  if (words.size() == 1)
    for (const deck::Page& page : pages())
      if (page.name == words[0]) return std::string(page.text);
  const std::string found = deck::search_model(pages(), join(words, ' '));
  if (found.empty()) throw core::InputError(error);
  return fmt::format("no key is called '{}'; this is what there is\n{}", join(words, ' '), found);
}

std::string documentation(const DocFlags& flags) {
  if (!flags.word.empty()) {
    const std::string found = deck::search_model(pages(), flags.word);
    if (found.empty())
      throw core::InputError({}, fmt::format("nothing is known of '{}'; `osculate doc` lists the "
                                             "keys, `osculate doc limits` what there is not",
                                             flags.word));
    return found;
  }
  if (flags.markdown) return flags.surface ? deck::surface_reference() : deck::model_reference();
  const std::string key = join(flags.key, '.');
  if (flags.surface) return deck::explain_surface_key(key);
  try {
    return deck::explain_model_key(key);
  } catch (const core::InputError& error) {
    if (key.find('.') != std::string::npos && flags.key.size() == 1) throw;
    return found_instead(flags.key, error);
  }
}

}  // namespace

void add_doc(CLI::App& app, int&) {
  CLI::App* const command =
      app.add_subcommand("doc", "Explain a key of the model file, print a page, search both");
  auto flags = std::make_shared<DocFlags>();
  command->add_option("key", flags->key,
                      "Path such as contact.friction.coulomb.mu, or its words; page such as limits "
                      "(default: the whole file)");
  command->add_option("--search", flags->word, "Find keys and pages that speak of a word");
  command->add_flag("--surface", flags->surface, "Of the surface file of `osculate project`");
  command->add_flag("--markdown", flags->markdown, "All keys as one page of Markdown");
  command->add_flag("--man", flags->manual, "The commands and their options as a page for man");
  command->callback([flags, &app] {
    if (flags->manual) return print(stdout, "{}", manual_page(app));
    print(stdout, "{}\n", documentation(*flags));
  });
}

void add_report(CLI::App& app, int&) {
  CLI::App* const command =
      app.add_subcommand("report", "Write report.html of a result folder again");
  auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "Result folder")->required();
  command->callback([folder] {
    api::rewrite_report(*folder);
    print(stdout, "{}/report.html\n", *folder);
  });
}

void add_check(CLI::App& app, int&) {
  CLI::App* const command = app.add_subcommand(
      "check", "Validate a model file and say what it consists of; solve nothing");
  struct Flags {
    std::string model;
    std::vector<std::string> settings;
    bool json = false;
  };
  auto flags = std::make_shared<Flags>();
  command->add_option("model", flags->model, "Model file (YAML)")->required();
  command->add_flag("--json", flags->json, "Print JSON on stdout");
  add_settings(*command, flags->settings);
  command->callback([flags] {
    const api::CheckReport report = api::check(flags->model, settings_of(flags->settings));
    print(flags->json ? stderr : stdout, "{}", report.text);
    if (flags->json) print(stdout, "{}\n", report.json);
  });
}

}  // namespace osculate::app

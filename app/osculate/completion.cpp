// Completion in shells and the manual page, written from the commands as they were added, so that
// they cannot say anything else.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "commands.hpp"
#include "osculate/core/version.hpp"

namespace osculate::app {
namespace {

using Options = std::vector<const CLI::Option*>;

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}
/// Those with a name that begins with -, or those without.
Options options_of(const CLI::App& command, bool positional) {
  return command.get_options(
      [&](const CLI::Option* option) { return option->nonpositional() != positional; });
}
bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// `-o`, `--output`
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string replaced(std::string text, std::string_view characters, const char* before) {
  for (std::size_t at = 0; (at = text.find_first_of(characters, at)) != std::string::npos; at += 2)
    text.insert(at, before);
  return text;
}
/// Between single quotes of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string bash_completion(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* const command : commands_of(app)) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    std::string words;
    for (const CLI::Option* const option : options_of(*command, false))
      for (const std::string& name : names_of(*option)) words += (words.empty() ? "" : " ") + name;
    cases += fmt::format("    {}) words='{}' ;;\n", command->get_name(), words);
  }
  return fmt::format(R"(# osculate completion bash
_osculate() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
  esac
}}
complete -o default -F _osculate osculate
)",
                     commands, cases);
}

/// An option as _arguments wants it.
std::string zsh_argument(const CLI::Option& option) {
  const std::vector<std::string> names = names_of(option);
  const std::string doc = replaced(option.get_description(), "[]:\\", "\\");
  const char* const value = takes_value(option) ? ":value:_files" : "";
  const auto one = [&](const std::string& name) {
    return quoted(fmt::format("({}){}[{}]{}", fmt::join(names, " "), name, doc, value));
  };
  std::string out;
  for (const std::string& name : names) out += " " + one(name);
  return out;
}

std::string zsh_completion(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* const command : commands_of(app)) {
    commands += fmt::format("    {}\n", quoted(command->get_name() + ":" +
                                               replaced(command->get_description(), ":\\", "\\")));
    cases += fmt::format("    {}) _arguments", command->get_name());
    for (const CLI::Option* const option : options_of(*command, false))
      cases += zsh_argument(*option);
    cases += " '*:file:_files' ;;\n";
  }
  return fmt::format(R"(#compdef osculate
_osculate() {{
  local -a commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
{}  esac
}}
if [ "$funcstack[1]" = _osculate ]; then _osculate "$@"; else compdef _osculate osculate; fi
)",
                     commands, cases);
}

std::string fish_completion(const CLI::App& app) {
  std::string out = "# osculate completion fish\n";
  const auto text = [](const std::string& doc) { return "'" + replaced(doc, "'\\", "\\") + "'"; };
  for (const CLI::App* const command : commands_of(app))
    out += fmt::format("complete -c osculate -f -n __fish_use_subcommand -a {} -d {}\n",
                       command->get_name(), text(command->get_description()));
  for (const CLI::App* const command : commands_of(app))
    for (const CLI::Option* const option : options_of(*command, false)) {
      out += fmt::format("complete -c osculate -n '__fish_seen_subcommand_from {}'",
                         command->get_name());
      for (const std::string& name : option->get_snames()) out += " -s " + name;
      for (const std::string& name : option->get_lnames()) out += " -l " + name;
      out += fmt::format("{} -d {}\n", takes_value(*option) ? " -r" : "",
                         text(option->get_description()));
    }
  return out;
}

/// Text of a manual page: hyphens that are minus signs, no line that is a request.
std::string troff(const std::string& text) {
  std::string out = replaced(text, "\\", "\\");
  for (std::size_t at = 0; (at = out.find('-', at)) != std::string::npos; at += 2)
    out.insert(at, "\\");
  return !out.empty() && (out.front() == '.' || out.front() == '\'') ? "\\&" + out : out;
}

std::string manual_of(const CLI::App& command) {
  std::string out = fmt::format(".SS osculate {}", command.get_name());
  for (const CLI::Option* const place : options_of(command, true)) {
    std::string name = place->get_name();
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
    out += place->get_required() ? " " + name : " [" + name + "]";
  }
  out += fmt::format("\n{}.\n", troff(command.get_description()));
  for (const bool positional : {true, false})
    for (const CLI::Option* const option : options_of(command, positional)) {
      const std::string name =
          positional ? option->get_name() : fmt::format("{}", fmt::join(names_of(*option), ", "));
      out += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", troff(name),
                         !positional && takes_value(*option) ? " \\fIVALUE\\fR" : "",
                         troff(option->get_description()));
    }
  return out;
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  std::string out = fmt::format(
      ".TH OSCULATE 1 \"\" \"Osculate {}\"\n.SH NAME\nosculate \\- contact mechanics with finite "
      "elements\n.SH SYNOPSIS\n.B osculate\n\\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n.SH DESCRIPTION\n"
      "{}.\n.SH COMMANDS\n",
      core::version, troff(app.get_description()));
  for (const CLI::App* const command : commands_of(app)) out += manual_of(*command);
  out += fmt::format(".SH EXIT STATUS\n.TP\n{}\nDone.\n", static_cast<int>(done));
  for (const auto& [code, meaning] :
       {std::pair(check_failed, "A check has failed."),
        {bad_input, "The input cannot be used; the message says why."},
        {analysis_stopped, "The analysis has stopped before its end."},
        {defect, "A defect of the program."}})
    out += fmt::format(".TP\n{}\n{}\n", static_cast<int>(code), meaning);
  return out + ".SH SEE ALSO\n\\fBosculate doc\\fR explains every key of model files.\n";
}

void add_completion(CLI::App& app, int&) {
  CLI::App* const command =
      app.add_subcommand("completion", "Print what completes commands and options in a shell");
  auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->callback([shell, &app] {
    print(stdout, "{}",
          *shell == "bash"  ? bash_completion(app)
          : *shell == "zsh" ? zsh_completion(app)
                            : fish_completion(app));
  });
}

}  // namespace osculate::app

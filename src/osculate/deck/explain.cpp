#include "osculate/deck/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "osculate/core/error.hpp"
#include "osculate/core/text.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/source_tree.hpp"

namespace osculate::deck {
namespace {

/// A key with its path; alternatives of one key share the path of the whole.
struct Found {
  std::string path;
  const Spec* spec = nullptr;
  bool required = false;
};

void collect(const Spec& spec, const Found& self, std::vector<Found>& out) {
  if (!self.path.empty()) out.push_back(self);
  const std::string dot = self.path.empty() ? "" : self.path + ".";
  for (const Key& key : spec.keys)
    collect(key.spec, {dot + key.name, &key.spec, key.required}, out);
  for (const Spec& part : spec.parts) {
    // Lists, names and alternatives have no key of their own: what is below them belongs to them.
    std::vector<Found> below;
    const std::string path = spec.type == Type::list    ? self.path + "[]"
                             : spec.type == Type::names ? dot + "NAME"
                                                        : self.path;
    collect(part, {path, &part, false}, below);
    for (Found& found : below)
      if (found.spec != &part) out.push_back(std::move(found));
  }
}

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> words;
  std::string word;
  bool in_brackets = false;
  for (const char c : path) {
    if (c == '[') in_brackets = true;
    if (c == '.' && !in_brackets) {
      words.push_back(std::exchange(word, {}));
    } else if (!in_brackets) {
      word += c;
    }
    if (c == ']') in_brackets = false;
  }
  words.push_back(word);
  return words;
}

/// Whether what the user typed names this path: NAME matches any word or none.
bool matches(const std::vector<std::string>& typed, std::size_t t,
             const std::vector<std::string>& path, std::size_t p) {
  if (p == path.size()) return t == typed.size();
  if (path[p] == "NAME" && matches(typed, t, path, p + 1)) return true;
  return t < typed.size() && (path[p] == "NAME" || path[p] == typed[t]) &&
         matches(typed, t + 1, path, p + 1);
}

std::string type_line(const Spec& spec, bool required) {
  std::string line = describe(spec);
  const std::string range = describe_range(spec);
  if (!range.empty()) line += " " + range;
  if (required) line += ", required";
  if (!spec.fallback.empty()) line += ", default " + spec.fallback;
  if (!spec.note.empty()) line += ", default: " + spec.note;
  if (!spec.available) line += "; not available yet";
  return line;
}

void append_words(const Spec& spec, std::string& out) {
  for (const Choice& c : spec.choices)
    out +=
        fmt::format("    {:<20} {}{}\n", c.name, c.doc, c.available ? "" : " (not available yet)");
  if (spec.type != Type::either) return;
  for (const Spec& part : spec.parts) append_words(part, out);
}

/// Keys directly below, looking through lists, names and alternatives.
void append_children(const Spec& spec, std::string& out) {
  for (const Key& key : spec.keys)
    out += fmt::format("    {:<20} {} ({})\n", key.name, key.spec.doc,
                       type_line(key.spec, key.required));
  for (const Group& group : spec.groups)
    out += fmt::format("    {} of: {}\n",
                       group.rule == Group::Rule::exactly_one ? "Exactly one" : "At least one",
                       core::join(group.keys));
  for (const Spec& part : spec.parts) append_children(part, out);
}

std::string entry_text(const Found& found) {
  const Spec& spec = *found.spec;
  std::string out = fmt::format("{}: {}\n  {}\n", found.path.empty() ? "model file" : found.path,
                                type_line(spec, found.required), spec.doc);
  if (!spec.unit.empty()) out += fmt::format("  Unit: {}\n", spec.unit);
  std::string words, children;
  append_words(spec, words);
  append_children(spec, children);
  if (!words.empty()) out += "  Words:\n" + words;
  if (!children.empty()) out += "  Keys:\n" + children;
  if (!spec.example.empty()) {
    const std::string key = split(found.path).back();
    out += fmt::format("  Example: {}: {}\n", key, spec.example);
  }
  return out;
}

/// Text as Markdown shows it, word for word; between backquotes it is code already.
std::string escaped(std::string_view text) {
  std::string out;
  bool code = false;
  for (const char c : text) {
    if (c == '`') code = !code;
    if (!code && std::string_view(R"(\*_$<>[]|#~)").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// The name by which a heading of that path is linked to: its letters, digits, _ and -.
std::string anchor(std::string_view path) {
  std::string out;
  for (const char c : path)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-')
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

void append_choices(const Spec& spec, std::string& out) {
  for (const Choice& c : spec.choices)
    out += fmt::format("  - `{}`: {}{}\n", c.name, escaped(c.doc),
                       c.available ? "" : " (not available yet)");
  if (spec.type != Type::either) return;
  for (const Spec& part : spec.parts) append_choices(part, out);
}

bool has_keys(const Spec& spec) {
  return !spec.keys.empty() || std::any_of(spec.parts.begin(), spec.parts.end(), has_keys);
}

/// A line for each key directly below, looking through lists, names and alternatives; those with
/// keys of their own lead to their heading.
void append_items(const Spec& spec, const std::string& path, std::string& out) {
  const std::string dot = path.empty() ? "" : path + ".";
  for (const Key& key : spec.keys) {
    const std::string link = has_keys(key.spec) ? "](#" + anchor(dot + key.name) + ")" : "";
    out += fmt::format("- {}**{}**{} ({}): {}{}\n", link.empty() ? "" : "[", key.name, link,
                       escaped(type_line(key.spec, key.required)), escaped(key.spec.doc),
                       key.spec.unit.empty() ? "" : " Unit: " + escaped(key.spec.unit) + ".");
    append_choices(key.spec, out);
  }
  for (const Spec& part : spec.parts)
    append_items(part,
                 spec.type == Type::list    ? path + "[]"
                 : spec.type == Type::names ? dot + "NAME"
                                            : path,
                 out);
}

std::string section_text(const Found& found) {
  const Spec& spec = *found.spec;
  const auto depth = std::count(found.path.begin(), found.path.end(), '.');
  std::string out =
      fmt::format("\n{} `{}`\n\n{} ({})\n\n", std::string(2 + std::min(depth, 3L), '#'), found.path,
                  escaped(spec.doc), escaped(type_line(spec, found.required)));
  append_items(spec, found.path, out);
  if (!spec.example.empty())
    out += fmt::format("\n```yaml\n{}: {}\n```\n", split(found.path).back(), spec.example);
  return out;
}

/// Keys of exactly that path, else keys whose path ends so.
std::vector<Found> find(const std::vector<Found>& all, std::string_view key) {
  const std::vector<std::string> typed = split(key);
  std::vector<Found> whole, ending;
  for (const Found& found : all) {
    std::vector<std::string> path = split(found.path);
    if (matches(typed, 0, path, 0)) whole.push_back(found);
    for (; !path.empty(); path.erase(path.begin()))
      if (path[0] == typed[0] && matches(typed, 0, path, 0)) {
        ending.push_back(found);
        break;
      }
  }
  return whole.empty() ? ending : whole;
}

/// The nearest path for a path, the nearest last part for a word.
[[noreturn]] void unknown_key(const std::vector<Found>& all, std::string_view key) {
  const bool whole_path = key.find('.') != std::string_view::npos;
  std::set<std::string> names;
  for (const Found& found : all) names.insert(whole_path ? found.path : split(found.path).back());
  const std::vector<std::string> candidates(names.begin(), names.end());
  const std::string near = core::nearest_name(key, candidates);
  throw core::InputError({}, fmt::format("unknown key '{}'; {}", printable(key),
                                         near.empty() ? std::string("without a key, all are listed")
                                                      : "did you mean '" + near + "'?"));
}

}  // namespace

std::string summary(const Spec& spec) {
  std::string text = spec.doc;
  if (!spec.unit.empty()) text += " Unit: " + spec.unit + ".";
  if (!spec.note.empty()) text += " Default: " + spec.note + ".";
  for (const Choice& c : spec.choices)
    text += fmt::format(" {}: {}{}.", c.name, c.doc, c.available ? "" : " (not available yet)");
  if (!spec.available) text += " Not available yet.";
  return text;
}

std::string explain(const Spec& spec, std::string_view key) {
  if (key.empty()) return entry_text({"", &spec, false});
  std::vector<Found> all;
  collect(spec, {"", &spec, false}, all);
  const std::vector<Found> found = find(all, key);
  if (found.empty()) unknown_key(all, key);
  std::string text;
  for (const Found& one : found) {
    if (!text.empty()) text += "\n";
    text += entry_text(one);
  }
  return text;
}

std::string reference(const Spec& spec, std::string_view title) {
  std::vector<Found> all;
  collect(spec, {"", &spec, false}, all);
  std::string text = fmt::format("# {}\n\n{}\n\n", title, escaped(spec.doc));
  append_items(spec, "", text);
  for (const Found& found : all)
    if (has_keys(*found.spec)) text += section_text(found);
  return text;
}

std::string explain_model_key(std::string_view key) {
  static const Spec spec = model_spec();
  return explain(spec, key);
}
std::string model_reference() { return reference(model_spec(), "Model file"); }

}  // namespace osculate::deck

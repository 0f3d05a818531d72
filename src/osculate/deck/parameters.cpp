#include "osculate/deck/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "osculate/core/text.hpp"

namespace osculate::deck {
namespace {

constexpr std::size_t longest_value = 1000;

bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool in_name(char c) { return starts_name(c) || (c >= '0' && c <= '9'); }

/// The whole text as a finite number.
std::optional<double> number_of(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = code == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Sums, products, brackets, numbers and names, read from left to right.
class Arithmetic {
 public:
  Arithmetic(std::string_view text, const std::vector<Setting>& known, const core::SourceMark& mark)
      : text_(text), known_(known), mark_(mark) {}

  /// The result as it is written in a model file.
  [[nodiscard]] std::string result() {
    skip();
    const std::size_t start = at_;
    if (at_ < text_.size() && starts_name(text_[at_])) {
      const std::string& value = lookup(name());
      skip();
      if (at_ == text_.size()) return value;  // also a text
      at_ = start;
    }
    const double value = sum();
    if (at_ < text_.size()) fail(fmt::format("'{}' is not expected", text_[at_]));
    if (!std::isfinite(value)) fail("the result is not finite");
    return fmt::format("{}", value);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw core::InputError(mark_, fmt::format("cannot compute '{}': {}", printable(text_), why));
  }
  void skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    skip();
    return true;
  }
  std::string name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && in_name(text_[at_])) ++at_;
    return std::string(text_.substr(start, at_ - start));
  }
  const std::string& lookup(const std::string& name) const {
    std::vector<std::string> names;
    for (const Setting& parameter : known_) {
      if (parameter.name == name) return parameter.value;
      names.push_back(parameter.name);
    }
    throw core::InputError(mark_, core::unknown_name_message("parameter", printable(name), names));
  }

  double sum() {
    double value = product();
    while (true) {
      if (take('+'))
        value += product();
      else if (take('-'))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = factor();
    while (true) {
      if (take('*'))
        value *= factor();
      else if (take('/'))
        value /= factor();
      else
        return value;
    }
  }
  double factor() {
    if (++depth_ > 100) fail("too many brackets or signs");
    double value = 0;
    if (take('-')) {
      value = -factor();
    } else if (take('+')) {
      value = factor();
    } else if (take('(')) {
      value = sum();
      if (!take(')')) fail("a bracket is not closed");
    } else {
      value = operand();
    }
    --depth_;
    return value;
  }
  double operand() {
    skip();
    if (at_ == text_.size()) fail("a number or name is missing at the end");
    if (starts_name(text_[at_])) {
      const std::string word = name();
      const std::optional<double> value = number_of(lookup(word));
      if (!value) fail(fmt::format("'{}' is a text", word));
      skip();
      return *value;
    }
    double value = 0;
    const auto [end, code] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (code != std::errc{}) fail(fmt::format("'{}' is not expected", text_[at_]));
    at_ = static_cast<std::size_t>(end - text_.data());
    skip();
    return value;
  }

  std::string_view text_;
  const std::vector<Setting>& known_;
  const core::SourceMark& mark_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// Replaces what a value says by what it means.
void resolve(SourceNode& node, const std::vector<Setting>& known, const core::SourceMark& mark) {
  if (!node.quoted && node.text.starts_with('=')) {
    node.text = Arithmetic(std::string_view(node.text).substr(1), known, mark).result();
    return;
  }
  if (node.text.find("${") == std::string::npos) return;
  std::string out;
  std::size_t at = 0;
  for (std::size_t open = 0; (open = node.text.find("${", at)) != std::string::npos;) {
    const std::size_t close = node.text.find('}', open);
    if (close == std::string::npos) throw core::InputError(mark, "'${' is not closed by '}'");
    const std::string value =
        Arithmetic(std::string_view(node.text).substr(open + 2, close - open - 2), known, mark)
            .result();
    out += node.text.substr(at, open - at) + value;
    if (open == 0 && close + 1 == node.text.size()) node.quoted = false;  // the value itself
    at = close + 1;
  }
  node.text = out + node.text.substr(at);
}

void resolve_all(SourceNode& node, const std::vector<Setting>& known,
                 const core::SourceMark& mark) {
  if (node.kind == SourceNode::Kind::scalar) resolve(node, known, {mark.file, node.line, mark.key});
  for (std::size_t i = 0; i < node.items.size(); ++i)
    resolve_all(node.items[i], known, {mark.file, 0, fmt::format("{}[{}]", mark.key, i)});
  for (SourceEntry& entry : node.entries)
    resolve_all(entry.value, known,
                {mark.file, 0, mark.key.empty() ? entry.key : mark.key + "." + entry.key});
}

void check_name(const SourceEntry& entry, const core::SourceMark& mark) {
  if (starts_name(entry.key.front()) && std::all_of(entry.key.begin(), entry.key.end(), in_name))
    return;
  throw core::InputError(mark, fmt::format("'{}' cannot be the name of a parameter; use letters, "
                                           "digits and _, a letter first",
                                           printable(entry.key)));
}

std::vector<Setting> read_parameters(SourceNode& parameters, const std::string& file,
                                     std::span<const Setting> settings) {
  std::vector<Setting> known;
  for (SourceEntry& entry : parameters.entries) {
    const core::SourceMark mark{file, entry.line, "parameters." + printable(entry.key)};
    check_name(entry, mark);
    SourceNode& node = entry.value;
    if (node.kind != SourceNode::Kind::scalar)
      throw core::InputError(mark, "expected a number or a text");
    for (const Setting& setting : settings)
      if (setting.name == entry.key) {
        node.text = setting.value;
        node.quoted = false;
      }
    resolve(node, known, mark);
    if (node.text.size() > longest_value)
      throw core::InputError(mark,
                             fmt::format("the value is longer than {} letters", longest_value));
    known.push_back({entry.key, node.text});
  }
  return known;
}

}  // namespace

std::vector<Setting> apply_parameters(SourceNode& root, const std::string& file,
                                      std::span<const Setting> settings) {
  std::vector<Setting> known;
  for (SourceEntry& entry : root.entries)
    if (entry.key == "parameters") known = read_parameters(entry.value, file, settings);
  std::vector<std::string> names;
  for (const Setting& parameter : known) names.push_back(parameter.name);
  for (const Setting& setting : settings)
    if (std::find(names.begin(), names.end(), setting.name) == names.end())
      throw core::InputError(
          {file, 0, ""},
          names.empty()
              ? fmt::format("--set {}: the file has no `parameters`", printable(setting.name))
              : "--set: " +
                    core::unknown_name_message("parameter", printable(setting.name), names));
  for (SourceEntry& entry : root.entries)
    if (entry.key != "parameters") resolve_all(entry.value, known, {file, 0, entry.key});
  return known;
}

}  // namespace osculate::deck

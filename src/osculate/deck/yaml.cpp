// The only translation unit that includes yaml-cpp (its headers are slow to compile). The parser's
// events are turned into our own tree, because yaml-cpp's accepts duplicate keys and cycles.
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/source_text.hpp"
#include "osculate/deck/source_tree.hpp"

namespace osculate::deck {
namespace {

using Kind = SourceNode::Kind;

/// Appended to the text as a comment. yaml-cpp lets a quote that is never closed end with the file;
/// then this turns up inside the quoted text. No model file can hold the character.
constexpr std::string_view end_mark = "#\x7F";

struct Size {
  std::size_t nodes = 0, bytes = 0;
};

Size size_of(const SourceNode& node) {
  Size size{1, node.text.size()};
  const auto add = [&](const SourceNode& child) {
    const Size part = size_of(child);
    size.nodes += part.nodes;
    size.bytes += part.bytes;
  };
  for (const SourceNode& item : node.items) add(item);
  for (const SourceEntry& entry : node.entries) {
    size.bytes += entry.key.size();
    add(entry.value);
  }
  return size;
}

SourceNode make_node(Kind kind, int line) {
  SourceNode node;
  node.kind = kind;
  node.line = line;
  return node;
}

class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(std::string file, const TextLimits& limits)
      : file_(std::move(file)), limits_(limits) {}

  [[nodiscard]] const SourceNode& root() const { return root_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(line_of(mark), "a second YAML document starts here; expected one");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    charge({1, 0}, line_of(mark));
    deliver(make_node(Kind::nothing, line_of(mark)), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    require_no_tag(mark, tag);
    charge({1, value.size()}, line_of(mark));
    if (value.find(end_mark) != std::string::npos)
      fail(line_of(mark), "the quote that begins here is never closed");
    SourceNode node = make_node(Kind::scalar, line_of(mark));
    node.quoted = tag == "!";
    node.text = value;
    deliver(std::move(node), anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Kind::list, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Kind::map, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override {
    require_unique_keys(stack_.back().node);
    close();
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      fail(line_of(mark), "this alias stands inside the list or map that it refers to");
    charge(size_of(found->second), line_of(mark));
    deliver(found->second, YAML::NullAnchor);
  }

 private:
  struct Frame {
    SourceNode node;
    YAML::anchor_t anchor = YAML::NullAnchor;
    bool has_key = false;
    std::string key;
    int key_line = 0;
  };

  static int line_of(const YAML::Mark& mark) { return mark.line + 1; }

  [[noreturn]] void fail(int line, const std::string& message) const {
    throw core::InputError({file_, line, path()}, message);
  }

  /// Path of the list or map that is being read.
  [[nodiscard]] std::string path() const {
    std::string text;
    for (std::size_t i = 0; i + 1 < stack_.size(); ++i) {
      const Frame& frame = stack_[i];
      if (frame.node.kind == Kind::list) {
        text += "[" + std::to_string(frame.node.items.size()) + "]";
      } else {
        if (!text.empty()) text += '.';
        text += printable(frame.key);
      }
    }
    return text;
  }

  void require_no_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!")
      fail(line_of(mark), "the YAML tag '" + printable(tag) + "' has no meaning here");
  }

  void charge(const Size& size, int line) {
    nodes_ += size.nodes;
    bytes_ += size.bytes;
    if (nodes_ > limits_.nodes || bytes_ > 2 * limits_.bytes)
      fail(line, "the file is too large: more than " + std::to_string(limits_.nodes) + " values");
  }

  [[nodiscard]] bool awaits_key() const {
    return !stack_.empty() && stack_.back().node.kind == Kind::map && !stack_.back().has_key;
  }

  void open(Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    const int line = line_of(mark);
    require_no_tag(mark, tag);
    if (awaits_key()) fail(line, "a key must be a word, not a list or map");
    charge({1, 0}, line);
    const bool under_key = !stack_.empty() && stack_.back().node.kind == Kind::map;
    const int shown = under_key ? stack_.back().key_line : line;
    Frame frame;
    frame.node = make_node(kind, shown);
    frame.anchor = anchor;
    stack_.push_back(std::move(frame));
    if (stack_.size() > limits_.depth)
      throw core::InputError({file_, line, ""}, "lists and maps are nested more than " +
                                                    std::to_string(limits_.depth) + " deep");
  }

  void close() {
    Frame done = std::move(stack_.back());
    stack_.pop_back();
    deliver(std::move(done.node), done.anchor);
  }

  void deliver(SourceNode node, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      charge(size_of(node), node.line);  // the copy kept for aliases
      anchors_[anchor] = node;
    }
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Frame& top = stack_.back();
    if (top.node.kind == Kind::list) {
      top.node.items.push_back(std::move(node));
    } else if (!top.has_key) {
      if (node.kind != Kind::scalar || node.text.empty()) fail(node.line, "a key must be a word");
      top.has_key = true;
      top.key = std::move(node.text);
      top.key_line = node.line;
    } else {
      if (node.kind == Kind::nothing) node.line = top.key_line;
      top.node.entries.push_back({std::move(top.key), top.key_line, std::move(node)});
      top.has_key = false;
    }
  }

  void require_unique_keys(const SourceNode& map) const {
    std::vector<const SourceEntry*> sorted;
    sorted.reserve(map.entries.size());
    for (const SourceEntry& entry : map.entries) sorted.push_back(&entry);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const SourceEntry* a, const SourceEntry* b) { return a->key < b->key; });
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i]->key == sorted[i - 1]->key)
        fail(sorted[i]->line, "key '" + printable(sorted[i]->key) +
                                  "' is given twice, first on line " +
                                  std::to_string(sorted[i - 1]->line));
  }

  std::string file_;
  TextLimits limits_;
  std::vector<Frame> stack_;
  std::map<YAML::anchor_t, SourceNode> anchors_;
  SourceNode root_;
  int documents_ = 0;
  std::size_t nodes_ = 0, bytes_ = 0;
};

/// What yaml-cpp's shortest messages mean in practice.
std::string hint(const std::string& message) {
  if (message == "illegal map value") return "; check the indentation and the space after each ':'";
  if (message == "end of map not found") return "; check the indentation and the quotes";
  if (message == "end of sequence flow not found") return "; a '[' is not closed";
  if (message == "end of map flow not found") return "; a '{' is not closed";
  return {};
}

int count_lines(std::string_view text) {
  const auto breaks = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  return text.empty() || text.ends_with('\n') ? std::max(breaks, 1) : breaks + 1;
}

}  // namespace

SourceNode read_yaml(std::string_view text, const std::string& file, const TextLimits& limits) {
  if (text.size() > limits.bytes)
    throw core::InputError({file, 0, ""}, "the file is too large: more than " +
                                              std::to_string(limits.bytes >> 20) + " MiB");
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  require_plain_text(text, file);
  TreeBuilder builder(file, limits);
  try {
    std::istringstream stream{std::string(text) + "\n" + std::string(end_mark) + "\n"};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 0 : std::min(error.mark.line + 1, count_lines(text));
    throw core::InputError({file, line, ""}, "not valid YAML: " + error.msg + hint(error.msg));
  }
  return builder.root();
}

namespace {

bool holds_no_list(const SourceNode& node) {
  const auto is_scalar = [](const SourceNode& child) { return child.kind == Kind::scalar; };
  return std::all_of(node.items.begin(), node.items.end(), is_scalar) &&
         std::all_of(node.entries.begin(), node.entries.end(),
                     [&](const SourceEntry& entry) { return is_scalar(entry.value); });
}

void emit(const SourceNode& node, YAML::Emitter& out) {
  if (node.kind == Kind::nothing) out << YAML::Null;
  if (node.kind == Kind::scalar) out << node.text;
  if (node.kind == Kind::list || node.kind == Kind::map)
    if (holds_no_list(node)) out << YAML::Flow;
  if (node.kind == Kind::list) {
    out << YAML::BeginSeq;
    for (const SourceNode& item : node.items) emit(item, out);
    out << YAML::EndSeq;
  }
  if (node.kind != Kind::map) return;
  out << YAML::BeginMap;
  for (const SourceEntry& entry : node.entries) {
    out << YAML::Key << entry.key << YAML::Value;
    emit(entry.value, out);
  }
  out << YAML::EndMap;
}

}  // namespace

std::string to_yaml(const SourceNode& root) {
  YAML::Emitter out;
  out.SetIndent(2);
  emit(root, out);
  return std::string(out.c_str()) + "\n";
}

}  // namespace osculate::deck

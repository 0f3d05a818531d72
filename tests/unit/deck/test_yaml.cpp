// What is wrong with a text before any key is looked at.
#include <filesystem>

#include "deck_test.hpp"
#include "osculate/deck/source_tree.hpp"

namespace osculate::deck {
namespace {

TEST(Yaml, DuplicateKeysNameBothLines) {
  EXPECT_EQ(refusal("osculate: 1\nmesh: a.msh\nmesh: b.msh\n"),
            "model.yaml:3: key 'mesh' is given twice, first on line 2");
  EXPECT_EQ(refusal("materials:\n  s:\n    linear_elastic: {E: 1,\n      nu: 0,\n      E: 2}\n"),
            "model.yaml:5: materials.s.linear_elastic: key 'E' is given twice, first on line 3");
  EXPECT_EQ(refusal("steps:\n  - {}\n  - {name: a, name: b}\n"),
            "model.yaml:3: steps[1]: key 'name' is given twice, first on line 3");
}

TEST(Yaml, AliasesAreCopiedAndCyclesRefused) {
  EXPECT_EQ(refusal("osculate: 1\nmesh: &m\n  generate: *m\n"),
            "model.yaml:3: mesh: this alias stands inside the list or map that it refers to");
  EXPECT_EQ(refusal("a: &x [*x]\n"),
            "model.yaml:1: a: this alias stands inside the list or map that it refers to");
  const SourceNode root = read_yaml("a: &x [1, {b: 2}]\nc: *x\n", "f");
  ASSERT_EQ(root.entries.size(), 2u);
  ASSERT_EQ(root.entries[1].value.items.size(), 2u);
  EXPECT_EQ(root.entries[1].value.items[1].entries[0].value.text, "2");
}

TEST(Yaml, AliasesCannotExhaustMemory) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int k = 1; k < 8; ++k) bomb += ", " + last;
    bomb += "]\n";
  }
  EXPECT_EQ(refusal(bomb), "model.yaml:6: the file is too large: more than 400000 values");
}

TEST(Yaml, LinesAndShapes) {
  const SourceNode root = read_yaml("# comment\nkey:\n  - 1\n  - \"1\"\nempty:\ntilde: ~\n", "f");
  using Kind = SourceNode::Kind;
  ASSERT_EQ(root.entries.size(), 3u);
  const SourceNode& list = root.entries[0].value;
  EXPECT_EQ(list.kind, Kind::list);
  EXPECT_EQ(list.line, 2);
  EXPECT_EQ(list.items[0].line, 3);
  EXPECT_FALSE(list.items[0].quoted);
  EXPECT_EQ(list.items[1].line, 4);
  EXPECT_TRUE(list.items[1].quoted);
  EXPECT_EQ(root.entries[1].value.kind, Kind::nothing);
  EXPECT_EQ(root.entries[1].value.line, 5);
  EXPECT_EQ(root.entries[2].value.kind, Kind::nothing);
}

TEST(Yaml, NotOneDocumentWithAMap) {
  EXPECT_EQ(refusal(""), "model.yaml: the file is empty; a model begins with `osculate: 1`");
  EXPECT_EQ(refusal("# nothing\n"),
            "model.yaml: the file is empty; a model begins with `osculate: 1`");
  EXPECT_EQ(refusal("[1, 2]\n"),
            "model.yaml:1: expected a map that begins with `osculate: 1`, got a list");
  EXPECT_EQ(refusal("$MeshFormat\n"),
            "model.yaml:1: expected a map that begins with `osculate: 1`, "
            "got the text '$MeshFormat'");
  EXPECT_EQ(refusal("osculate: 1\n---\nosculate: 1\n"),
            "model.yaml:2: a second YAML document starts here; expected one");
}

TEST(Yaml, SyntaxErrorsNameTheLine) {
  EXPECT_EQ(refusal("osculate: 1\nmesh: {generate: [\n"),
            "model.yaml:2: not valid YAML: end of sequence flow not found; a '[' is not closed");
  EXPECT_EQ(refusal("osculate: 1\n  mesh: a\n"),
            "model.yaml:2: not valid YAML: illegal map value; check the indentation and the space "
            "after each ':'");
  EXPECT_EQ(refusal("osculate: 1\nmesh: *nowhere\n"),
            "model.yaml:2: not valid YAML: the referenced anchor is not defined");
  EXPECT_EQ(refusal("osculate: 1\nmesh: \"open\n"),
            "model.yaml:2: the quote that begins here is never closed");
}

/// yaml-cpp lets such a quote swallow the rest of the file.
TEST(Yaml, QuotesMustBeClosed) {
  const std::string message = "model.yaml:2: the quote that begins here is never closed";
  for (const char* const rest : {"", "\n", " \nmesh: a.msh\n", "\n\n# 'it\n\n"}) {
    EXPECT_EQ(refusal("osculate: 1\ntitle: \"open" + std::string(rest)), message) << rest;
    if (std::string(rest).find('\'') != std::string::npos) continue;
    EXPECT_EQ(refusal("osculate: 1\ntitle: 'open" + std::string(rest)), message) << rest;
  }
  EXPECT_EQ(read_yaml("a: 'it''s'\n", "f").entries[0].value.text, "it's");
  EXPECT_EQ(read_yaml("a: |\n  two\n  lines\n", "f").entries[0].value.text, "two\nlines\n");
}

TEST(Yaml, TextThatNoModelHas) {
  EXPECT_EQ(refusal("osculate: 1\nmesh:\n\tgenerate: 1\n"),
            "model.yaml:3: indented with a tab; use spaces");
  EXPECT_EQ(refusal("osculate: 1\n \t mesh: 1"), "model.yaml:2: indented with a tab; use spaces");
  EXPECT_EQ(refusal("osculate: 1\ntitle: \xff\n"),
            "model.yaml:2: not a text file: byte 0xFF is not UTF-8 text");
  EXPECT_EQ(refusal(std::string("osculate: 1\n\0", 13)),
            "model.yaml:2: not a text file: byte 0x00 is not UTF-8 text");
  EXPECT_EQ(refusal("osculate: 1\n? [a]\n: 2\n"),
            "model.yaml:2: a key must be a word, not a list or map");
  EXPECT_EQ(refusal("osculate: 1\n: 2\n"), "model.yaml:2: a key must be a word");
  EXPECT_EQ(refusal("osculate: !!int 1\n"),
            "model.yaml:1: the YAML tag 'tag:yaml.org,2002:int' has no meaning here");
  EXPECT_EQ(refusal(std::string(60, '[') + std::string(60, ']')),
            "model.yaml:1: lists and maps are nested more than 48 deep");
  EXPECT_EQ(refusal(std::string((16u << 20) + 1, ' ')),
            "model.yaml: the file is too large: more than 16 MiB");
}

TEST(Yaml, DifferentLineEndsAndByteOrderMark) {
  const std::string block = test_file("block.yaml");
  EXPECT_EQ(refusal("\xEF\xBB\xBF" + block), "");
  std::string dos;
  for (const char c : block) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(refusal(dos), "");
  EXPECT_EQ(refusal(edited(dos, "mu: 0.3", "mu: x")),
            "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got the text 'x'");
}

TEST(Yaml, MessagesShowUsersTextSafely) {
  EXPECT_EQ(printable("a\nb\x1b[31m"), "a?b?[31m");
  const std::string shown(40, 'x');
  EXPECT_EQ(printable(std::string(41, 'x')), shown + "...");
  EXPECT_EQ(printable("\xC3\xA9\xC3"), "\xC3\xA9?");
}

TEST(Yaml, FilesThatCannotBeRead) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      (void)read_model(path);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(message("/nowhere/model.yaml"),
            "/nowhere/model.yaml: cannot be read: No such file or directory");
  EXPECT_EQ(message("/"), "/: cannot be read: it is a folder");
}

}  // namespace
}  // namespace osculate::deck

#!/usr/bin/env python3
"""The `///` comments of C++ declarations as a table, for docstrings of the Python package.

    tools/docstrings.py --of SOURCE... --in FOLDER... --to TABLE.hpp

SOURCE: C++ or Python, in which a text `"osculate::layer::Type::member"` (of `comment_of`) names a declaration by
its namespaces and classes. FOLDER: of headers. A name that no header declares, or without a comment, is an error.
Behind the comment of a public struct or enum stand those of its members, overloads have all of theirs. Whom a
declaration is tested by is left out, and C++ names are written as Python has them. TABLE.hpp.d: what it was made of.
"""
import argparse
import pathlib
import re
import sys
from dataclasses import dataclass, field

import cpp_text

NAMED = re.compile(r'"(osculate::[\w:]+)"')
ACCESS = re.compile(r"\s*(?:public|private|protected)\s*:(?!:)")
SCOPE = re.compile(r"\s*(?:template\s*)?(namespace|struct|class|enum)\b(?:\s+(?:class|struct)\b)?\s*((?:\w|::)*)")
IN_PYTHON = [(r"\bio::WriteError\b", "OSError"), (r"\b(?:[a-z]\w*::)+", ""), (r"\bResult::", "Evaluation."),
             (r"\b([A-Z]\w*)::(?=\w)", r"\1."), (r"\bDim\b", "dim")]


@dataclass
class Declaration:
    names: list   # in full; `double a, b;` declares two
    kind: str     # namespace, struct, class, enum, function, value
    first: int    # where its text begins and ends
    last: int
    comment: list = field(default_factory=list)  # lines


def flat(head):
    """Without template parameters, their arguments and attributes."""
    head, before = re.sub(r"\[\[.*?\]\]", "", head, flags=re.S), None
    while before != head:
        before, head = head, re.sub(r"<[^<>]*>", "", head)
    return head


def declared(head):
    """Kind and names of a declaration that is no scope."""
    plain = flat(head)
    if re.match(r"\s*(?:template\s*)?(?:extern|friend|static_assert)\b", plain) or "operator" in plain:
        return "function", []
    if alias := re.match(r"\s*(?:template\s*)?using\s+(\w+)", plain):
        return "value", [alias[1]]
    if "(" in re.split(r"[={]", plain)[0]:
        return "function", re.findall(r"(\w+)\s*$", plain.split("(")[0])
    parts = re.sub(r"\{[^{}]*\}|=[^,]*", "", plain).split(",")
    return "value", [name for part in parts for name in re.findall(r"(\w+)\s*$", part)]


def scan(code, first, last, scope, kind):
    """The declarations between two places of a scope, and those within them."""
    def declaration(end):
        of, names = declared(code[start:end])
        text = code[start:end]
        return Declaration(["::".join([*scope, name]) for name in names], of, end - len(text.lstrip()), end)

    start, at, brackets = first, first, 0
    while at < last:
        c = code[at]
        brackets += (c in "([") - (c in ")]")
        if brackets == 0 and c == "{":
            end, head = cpp_text.matching_brace(code, at), flat(code[start:at])
            inner = SCOPE.match(head)
            if inner and "(" not in head and "=" not in head:
                inside = [*scope, *filter(None, inner[2].split("::"))]
                yield Declaration(["::".join(inside)], inner[1], at - len(code[start:at].lstrip()), at)
                yield from scan(code, at + 1, end, inside, inner[1])
                start = end + 1
            elif "(" in head and code[end + 1:last].lstrip()[:1] not in (",", "{"):  # no value of a constructor's member
                found = declaration(at)
                found.last, start = end, end + 1
                yield found
            at = end
        elif brackets == 0 and (c == ";" or kind == "enum" and c == ","):
            yield declaration(at)
            start = at + 1
        elif c == ":" and ACCESS.fullmatch(code[start:at + 1]) and code[at + 1] != ":":
            start = at + 1
        at += 1
    if kind == "enum" and code[start:last].strip():
        yield declaration(last)


def commented(source):
    """The declarations of a header with their comments: those above them, and those behind them (`///<`)."""
    code = cpp_text.without_preprocessor(cpp_text.blanked(source))
    found = [d for d in scan(code, 0, len(code), [], "") if d.names]
    lines, position, of = source.split("\n"), 0, None
    for d in found:
        above = cpp_text.line_of(source, d.first) - 2
        first_of_line = not code[code.rfind("\n", 0, d.first) + 1:d.first].strip()
        while first_of_line and above >= 0 and (text := re.match(r"\s*///(?!<) ?(.*)", lines[above])):
            d.comment.insert(0, text[1].rstrip())
            above -= 1
    for line in lines:
        if match := re.search(r"///< ?(.*)", line):
            before = code[:position + match.start()].rstrip()
            if code[position:position + match.start()].strip():
                around = [d for d in found if d.first < len(before) <= d.last + 1]
                of = max(around, key=lambda d: d.first, default=None)
            if of is not None:
                of.comment.append(match[1].rstrip())
        position += len(line) + 1
    return found


def without_tests(lines):
    """Without the entry of whom it is tested by, and empty lines at the end."""
    kept, left_out = [], False
    for line in lines:
        left_out = line.startswith("Tested by") or left_out and line.startswith(" ")
        if not left_out:
            kept.append(line)
    return "\n".join(kept).strip()


def in_python(text):
    for pattern, ours in IN_PYTHON:
        text = re.sub(pattern, ours, text)
    return text


def text_of(name, declarations):
    """The comments of all that has this name; empty: there is none."""
    own = [d for d in declarations if name in d.names]
    parts = [without_tests(d.comment) for d in own]
    if name.count("::") == 1 and any(d.kind in ("struct", "enum") for d in own):  # of no layer
        values = [(", ".join(n.rpartition("::")[2] for n in d.names), d.comment) for d in declarations
                  if d.kind == "value" and d.comment and d.names[0].rpartition("::")[0] == name]
        width = max((len(word) for word, _ in values), default=0)
        parts.append("\n".join(f"{word if not i else '':{width}}  {line}" for word, lines in values
                               for i, line in enumerate(lines)))
    return in_python("\n\n".join(part for part in parts if part))


def table_of(names, texts):
    entries = "".join(f'    {{"{name}", R"comment({texts[name]})comment"}},\n' for name in names)
    return ("// Made by tools/docstrings.py of the comments in the headers.\n#pragma once\n#include <array>\n#include <utility>\n\n"
            f"namespace osculate::python {{\n\ninline constexpr std::array<std::pair<const char*, const char*>, {len(names)}>"
            f" comments{{{{\n{entries}}}}};\n\n}}  // namespace osculate::python\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--of", nargs="+", type=pathlib.Path, required=True)
    parser.add_argument("--in", nargs="+", type=pathlib.Path, required=True, dest="folders")
    parser.add_argument("--to", type=pathlib.Path, required=True)
    flags = parser.parse_args()
    asked = {}  # where each name is asked for first
    for source in flags.of:
        text = source.read_text()
        for match in NAMED.finditer(text):
            asked.setdefault(match[1], f"{source}:{cpp_text.line_of(text, match.start())}")
    last_words = re.compile(r"\b(?:" + "|".join({name.rpartition("::")[2] for name in asked}) + r")\b")
    declarations, used = [], set()
    for header in sorted(header for folder in flags.folders for header in folder.rglob("*.hpp")):
        source = header.read_text()
        if "///" in source and last_words.search(source):
            here = commented(source)
            declarations += here
            used |= {header} if any(name in asked for d in here for name in d.names) else set()
    texts, faults = {name: text_of(name, declarations) for name in asked}, []
    for name, where in asked.items():
        if not any(name in d.names for d in declarations):
            faults.append(f"{where}: error: no header declares {name}")
        elif not texts[name]:
            faults.append(f"{where}: error: the declaration of {name} has no comment (///)")
    if faults:
        sys.exit("\n".join(faults))
    flags.to.write_text(table_of(asked, texts))
    made_of = [str(path.resolve()).replace(" ", "\\ ") for path in [*flags.of, *sorted(used)]]
    pathlib.Path(f"{flags.to}.d").write_text(f"{flags.to}: {' '.join(made_of)}\n")


if __name__ == "__main__":
    main()

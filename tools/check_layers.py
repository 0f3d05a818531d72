#!/usr/bin/env python3
"""Does every file stand where it belongs, and is it small enough?

1. A file under src/osculate/LAYER includes only the layers that tools/layers.txt names for it, as
   "osculate/LAYER/file.hpp", and the CMake targets have the same edges. The public headers
   (include/osculate, included as "osculate/file.hpp") include each other alone, and of the layers
   only `embed` includes them.
2. No header includes itself through others.
3. Functions: 60 lines warn, 100 fail, unless a comment `long: reason` stands at or in it.
   Files: over 500 lines fail, unless a comment `size: reason` stands in it.

check_layers.py [--root DIR] [-q]
"""
import argparse
import pathlib
import re
import sys

from cpp_text import SOURCE_SUFFIXES, blanked, functions, line_of

FUNCTION_WARN, FUNCTION_FAIL, FILE_FAIL = 60, 100, 500
SIZED = ("src", "include", "app", "bindings", "verification", "tests", "benchmarks", "examples")
PUBLIC_LAYER = "embed"
INTERFACES = {"osculate/user_material.h": "material", "osculate/user_law.h": "contact"}  # what the program calls: of one layer
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)


def read_layers(path):
    layers = {}
    for line in path.read_text().splitlines():
        line = line.split("#")[0].strip()
        if line:
            name, _, allowed = line.partition(":")
            layers[name.strip()] = allowed.split()
    return layers


def closure(graph, start):
    seen, todo = set(), list(graph.get(start, ()))
    while todo:
        node = todo.pop()
        if node not in seen:
            seen.add(node)
            todo += graph.get(node, ())
    return seen


def find_cycle(graph):
    """One cycle as a list of nodes, or None. Iterative depth-first search with colours."""
    done = set()
    for root in sorted(graph):
        if root in done:
            continue
        path, trail = [root], [iter(sorted(graph[root]))]
        while path:
            for node in trail[-1]:
                if node in path:
                    return path[path.index(node):] + [node]
                if node not in done and node in graph:
                    path.append(node)
                    trail.append(iter(sorted(graph[node])))
                    break
            else:
                done.add(path.pop())
                trail.pop()
    return None


def sources(root, folders):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SOURCE_SUFFIXES and path.is_file() and "build" not in path.parts:
                yield path


def includes(text):
    """(line, bracket, target) of every include outside comments."""
    code = blanked(text, keep_strings=True)
    return [(line_of(code, m.start()), m.group(1), m.group(2)) for m in INCLUDE.finditer(code)]


def is_public(target):
    """osculate/file.hpp, in no layer."""
    return target.startswith("osculate/") and target.count("/") == 1


def check_includes(root, layers):
    problems, graph = [], {}
    base = root / "src" / "osculate"
    for path in sources(root, ["src/osculate"]):
        name = path.relative_to(root / "src").as_posix()
        layer = name.split("/")[1]
        graph[name] = set()
        if layer not in layers:
            problems.append(f"src/{name}: no layer '{layer}' in tools/layers.txt")
            continue
        for line, bracket, target in includes(path.read_text()):
            where = f"src/{name}:{line}"
            if is_public(target):
                if layer not in (PUBLIC_LAYER, INTERFACES.get(target)):
                    problems.append(f"{where}: the public headers are for other codes ({target})")
                elif not (root / "include" / target).is_file():
                    problems.append(f"{where}: {target} does not exist")
            elif target.startswith("osculate/"):
                if bracket == "<":
                    problems.append(f'{where}: write #include "{target}"')
                if not (root / "src" / target).is_file():
                    problems.append(f"{where}: {target} does not exist")
                graph[name].add(target)
                wanted = target.split("/")[1]
                if wanted != layer and wanted not in layers[layer]:
                    problems.append(f"{where}: {layer} must not include {wanted} ({target})")
            elif bracket == '"':
                problems.append(f'{where}: write "osculate/<layer>/{pathlib.Path(target).name}", '
                                f'not "{target}"')
    for path in sources(root, ["include"]):
        name = path.relative_to(root / "include").as_posix()
        graph[name] = set()
        for line, bracket, target in includes(path.read_text()):
            if is_public(target) and (root / "include" / target).is_file():
                graph[name].add(target)
            elif bracket == '"' or target.startswith("osculate/"):
                problems.append(f"include/{name}:{line}: {target} is no public header")
    cycle = find_cycle(graph)
    if cycle:
        problems.append("include cycle: " + " -> ".join(cycle))
    if not base.is_dir() or not graph:
        problems.append("no sources under src/osculate")
    return problems


def check_table(root, layers):
    """The table itself has no cycle, and the CMake targets have its edges."""
    problems = []
    cycle = find_cycle({name: set(allowed) for name, allowed in layers.items()})
    if cycle:
        problems.append("tools/layers.txt: cycle " + " -> ".join(cycle))
    cmake = root / "src" / "osculate" / "CMakeLists.txt"
    text = re.sub(r"#[^\n]*", "", cmake.read_text()) if cmake.is_file() else ""
    targets = {}
    for call in re.findall(r"osculate_layer\(([^)]*)\)", text):
        words = call.split()
        targets[words[0]] = []
        if "DEPS" in words:
            for word in words[words.index("DEPS") + 1:]:
                if word.isupper():
                    break
                targets[words[0]].append(word)
    for layer, allowed in layers.items():
        if layer not in targets:
            problems.append(f"src/osculate/CMakeLists.txt: no osculate_layer({layer} ...)")
        elif closure(targets, layer) != closure(layers, layer):
            problems.append(f"src/osculate/CMakeLists.txt: {layer} links {sorted(targets[layer])}, "
                            f"tools/layers.txt says {sorted(allowed)}")
    return problems


def excused(lines, first, last, word):
    """A comment `word: reason` in these lines (1-based, inclusive)."""
    pattern = re.compile(r"//.*\b" + word + r":\s*\S")
    return any(pattern.search(line) for line in lines[max(first, 1) - 1:last])


def check_sizes(root):
    problems, warnings = [], []
    for path in sources(root, SIZED):
        text = path.read_text()
        lines = text.splitlines()
        name = path.relative_to(root).as_posix()
        if len(lines) > FILE_FAIL and not excused(lines, 1, len(lines), "size"):
            problems.append(f"{name}: {len(lines)} lines, over {FILE_FAIL} without `size: reason`")
        for function in functions(text):
            first, last = line_of(text, function.first), line_of(text, function.last)
            length = last - first + 1
            if length < FUNCTION_WARN or excused(lines, first - 3, last, "long"):
                continue
            message = f"{name}:{first}: {function.name} has {length} lines"
            if length >= FUNCTION_FAIL:
                problems.append(f"{message}, {FUNCTION_FAIL} without `long: reason`")
            else:
                warnings.append(message)
    return problems, warnings


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("-q", "--quiet", action="store_true", help="no warnings")
    options = parser.parse_args()
    layers = read_layers(options.root / "tools" / "layers.txt")
    problems = check_table(options.root, layers) + check_includes(options.root, layers)
    sizes, warnings = check_sizes(options.root)
    problems += sizes
    if not options.quiet:
        for line in warnings:
            print(f"warning: {line} (aim below {FUNCTION_WARN})")
    for line in problems:
        print(f"error: {line}")
    count = sum(1 for _ in sources(options.root, SIZED))
    print(f"layers: {len(layers)} layers, {count} files, {len(warnings)} warnings, "
          f"{len(problems)} errors")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())

"""Where the equation tags stand: shared by check_equations.py and mutate."""
import pathlib
import re
from dataclasses import dataclass

from cpp_text import SOURCE_SUFFIXES, line_of

NAME = r"[A-Z][A-Za-z0-9]*:[A-Z]?\d+[a-z]?"
TAG = re.compile(r"@eq\s+(" + NAME + r"(?:\s*,\s*" + NAME + r")*)")
MENTION = re.compile(r"\beq:(" + NAME + r")")
TEST_SUFFIXES = SOURCE_SUFFIXES + (".py", ".yaml")


@dataclass
class Tag:
    name: str      # KEY:NUMBER
    path: str      # relative to the root
    line: int
    position: int  # of the comment that holds it, in the file's text


def files(root, folders, suffixes):
    for folder in folders:
        for path in sorted((pathlib.Path(root) / folder).rglob("*")):
            if path.suffix in suffixes and path.is_file():
                yield path, path.relative_to(root).as_posix()


def tags(root):
    found = []
    for path, name in files(root, ["src"], SOURCE_SUFFIXES):
        text = path.read_text()
        for match in TAG.finditer(text):
            for tag in re.split(r"\s*,\s*", match.group(1)):
                found.append(Tag(tag, name, line_of(text, match.start()), match.start()))
    return found


def mentions(root):
    """KEY:NUMBER -> [(path, line)] in tests and verification cases."""
    found = {}
    for path, name in files(root, ["tests", "verification"], TEST_SUFFIXES):
        if name.startswith("tests/tools/"):  # the tests of the tools themselves
            continue
        text = path.read_text()
        for match in MENTION.finditer(text):
            found.setdefault(match.group(1), []).append((name, line_of(text, match.start())))
    return found


def order(tag):
    """Sorting key: paper, then number, then letter."""
    key, _, number = tag.partition(":")
    digits = re.search(r"\d+", number)
    return key, number[:digits.start()], int(digits.group()), number[digits.end():]

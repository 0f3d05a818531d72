"""Just enough understanding of C++ text for the checks in this folder: comments and strings
blanked out with every position kept, and the functions of a file with their first and last line.
A heuristic by brace matching, not a parser; the code style of this project is what it knows."""
import re
from dataclasses import dataclass

SOURCE_SUFFIXES = (".cpp", ".hpp")

_TOKEN = re.compile(
    r"""//[^\n]*(?:\\\n[^\n]*)*"""
    r"""|/\*.*?\*/"""
    r"""|R"(?P<d>[^()\s\\]{0,16})\(.*?\)(?P=d)\""""
    r"""|"(?:\\.|[^"\\\n])*\""""
    r"""|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'""", re.S)


def _blank(text):
    return re.sub(r"[^\n]", " ", text)


def blanked(source, keep_strings=False):
    """The same text, same length, with comments (and the insides of strings) turned to spaces."""
    def replace(match):
        token = match.group(0)
        if token.startswith(("//", "/*")):
            return _blank(token)
        if keep_strings:
            return token
        return token[0] + _blank(token[1:-1]) + token[-1]
    return _TOKEN.sub(replace, source)


def without_preprocessor(code):
    return re.sub(r"^[ \t]*#[^\n]*(?:\\\n[^\n]*)*", lambda m: _blank(m.group(0)), code, flags=re.M)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


@dataclass
class Function:
    name: str
    first: int   # position of the first character of its signature
    body: int    # position of its opening brace
    last: int    # position of its closing brace


def matching_brace(code, position):
    depth = 0
    for i in range(position, len(code)):
        if code[i] == "{":
            depth += 1
        elif code[i] == "}":
            depth -= 1
            if depth == 0:
                return i
    return len(code) - 1


_SCOPE = re.compile(r"\b(namespace|class|struct|union)\b|^\s*extern\s*\"")
_MEMBER_INIT = re.compile(r"\)\s*(?:noexcept\s*)?:(?!:)")


def _kind(header):
    """What an opening brace after `header` (the text since the last ; { or }) opens."""
    if re.search(r"\b(?:enum|concept)\b", header):
        return "other"
    outside = re.sub(r"\([^()]*\)", "()", header)
    if _SCOPE.search(outside) and "(" not in re.sub(r"\b(?:alignas|decltype)\(\)", "", outside):
        return "scope"
    if _MEMBER_INIT.search(header) and re.search(r"[\w>]\s*$", header):
        return "member_init"
    if "(" in header and not re.search(r"(?<![=!<>+\-*/])=(?!=)\s*(?:\w|::|<|>|,|\s)*$", header):
        return "function"
    return "other"


def functions(source):
    """Every function defined in the file, lambdas inside functions not counted on their own."""
    code = without_preprocessor(blanked(source))
    found = []
    start = position = parentheses = 0
    while position < len(code):
        c = code[position]
        if c == "(":
            parentheses += 1
        elif c == ")":
            parentheses -= 1
        elif parentheses > 0:
            pass
        elif c in ";}":
            start = position + 1
        elif c == "{":
            header = code[start:position]
            kind = _kind(header)
            if kind == "scope":
                start = position + 1
            else:
                end = matching_brace(code, position)
                if kind == "function":
                    first = start + len(header) - len(header.lstrip())
                    found.append(Function(_name(header), first, position, end))
                    start = end + 1
                position = end
        position += 1
    return found


def _name(header):
    gtest = re.search(r"\b(?:TYPED_)?TEST(?:_[FP])?\s*\(\s*(\w+)\s*,\s*(\w+)\s*\)", header)
    if gtest:
        return f"{gtest.group(1)}.{gtest.group(2)}"
    name = re.search(r"(operator\s*(?:\(\)|[^\s(]+)|[~\w]+)\s*\(", header)
    return name.group(1) if name else "?"

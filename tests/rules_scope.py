"""Finds the place of a rule of tests/rules: a token that is unique in a function, regardless of the source layout."""

import bisect
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "style"))
sys.dont_write_bytecode = True
import source  # noqa: E402

LEXEME = re.compile(r'"(?:\\.|[^"\\\n])*"|\w+(?:\.\w+)*|::|->|<<|>>|<=|>=|==|!=|&&|\|\||\+\+|--|[-+*/|&]=|[^\s\w]')
NAME = re.compile(r"(operator\s*[^\s(]+|~?\w+)\s*\(")
NOT_NAMES = {"nodiscard", "noexcept", "requires", "decltype", "alignas", "explicit", "if", "for", "while", "switch",
             "return", "catch"}


def lexemes(text):
    """(text, begin, end) of each lexeme."""
    return [(m.group(), m.start(), m.end()) for m in LEXEME.finditer(text)]


def spans(text):
    """(name, begin, end) of each function and of each initialised variable outside of functions."""
    code = source.code_only(text)
    starts = [0] + [m.end() for m in re.finditer("\n", text)]
    found, outside, at = [], [], 0
    for first, last in source.functions(text):
        begin = starts[first - 1]
        end = starts[last] if last < len(starts) else len(text)
        names = [m.group(1) for m in NAME.finditer(code, begin, end) if m.group(1) not in NOT_NAMES]
        if names:
            found.append((names[0], begin, end))
        outside.append((at, begin))
        at = end
    outside.append((at, len(text)))
    for begin, end in outside:
        for m in re.finditer(r"(\w+)(?:\s*\[\w*\])?\s*(?:=(?!=)|\{(?=[^}]))", code[begin:end]):
            if m.group(1) in ("struct", "class", "namespace", "public", "private", "longreach", "enum"):
                continue
            found.append((m.group(1), begin + m.start(), statement_end(code, begin + m.start())))
    return found


def statement_end(code, at):
    depth = 0
    for i in range(at, len(code)):
        depth += {"{": 1, "(": 1, "}": -1, ")": -1}.get(code[i], 0)
        if depth < 0 or (depth == 0 and code[i] == ";"):
            return i + 1
    return len(code)


def places(text, function, token):
    """(begin, end) of each occurrence of the token in a function of this name. Comments are ignored."""
    needle = [l[0] for l in lexemes(token)]
    within = [(b, e) for name, b, e in spans(text) if name == function]
    words = lexemes(re.sub(r"//[^\n]*", lambda m: source.blank(m.group()), text))
    begins = [w[1] for w in words]
    found = set()
    for begin, end in within:
        i = bisect.bisect_left(begins, begin)
        while i + len(needle) <= len(words) and words[i + len(needle) - 1][2] <= end:
            if [w[0] for w in words[i:i + len(needle)]] == needle:
                found.add((words[i][1], words[i + len(needle) - 1][2]))
            i += 1
    return sorted(found)

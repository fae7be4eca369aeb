"""Analysis of C++ text for the style check: code without comments and strings, and the extent of its functions."""

import bisect
import re

TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/'                              # comments
    r'|\bu?8?[LU]?R"(?P<tag>[^()\\\s]{0,16})\(.*?\)(?P=tag)"'  # raw strings
    r'|"(?:\\.|[^"\\\n])*"'                            # strings
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'",           # characters, not digit separators
    re.DOTALL)
SCOPE = re.compile(r'(?:inline\s+)?(?:namespace|class|struct|union|enum|extern)\b')
INITIALIZER = re.compile(r'\)[^;]*:[^:]')              # in the initialiser list of a constructor


def blank(text):
    """Replaces all characters except line ends by spaces."""
    return re.sub(r'[^\n]', ' ', text)


def code_only(text):
    """The text with comments, strings and characters replaced by spaces. Line numbers do not change."""
    return TOKEN.sub(lambda match: blank(match.group()), text)


def closing(code, at):
    """Index of the brace that closes the one at `at`; the end of the text if there is none."""
    depth = 0
    for brace in re.compile(r'[{}]').finditer(code, at):
        depth += 1 if brace.group() == '{' else -1
        if depth == 0:
            return brace.start()
    return len(code) - 1


def without_template(head):
    """The declaration without its template parameters."""
    match = re.match(r'\s*template\s*<', head)
    if not match:
        return head.lstrip()
    depth = 1
    for i in range(match.end(), len(head)):
        depth += {'<': 1, '>': -1}.get(head[i], 0)
        if depth == 0:
            return without_template(head[i + 1:])
    return ''


def functions(text):
    """(first line, last line) of every function, counted from 1. Nested functions belong to the outer one."""
    code = code_only(text)
    code = re.sub(r'^[ \t]*#(?:\\\n|[^\n])*', lambda match: blank(match.group()), code, flags=re.MULTILINE)
    breaks = [match.start() for match in re.finditer('\n', code)]
    found = []
    at = head_start = 0
    while True:
        match = re.compile(r'[{};]').search(code, at)
        if not match:
            return found
        at = match.end()
        if match.group() != '{':
            head_start = at
            continue
        head = re.sub(r'^\s*(?:(?:public|private|protected)\s*:\s*)*', '', code[head_start:match.start()])
        if SCOPE.match(without_template(head)):
            head_start = at
            continue
        end = closing(code, match.start())
        at = end + 1
        # `member_{value}` in an initialiser list is not the body.
        if re.search(r'[\w>]$', head) and INITIALIZER.search(head):
            continue
        if '(' in head:
            begin = match.start() - len(head)
            found.append((bisect.bisect_left(breaks, begin) + 1, bisect.bisect_left(breaks, end) + 1))
        head_start = at


TYPE_HEAD = re.compile(r'\b(?:class|struct|union|enum(?:\s+class|\s+struct)?)\s+(\w+)(?:\s+final)?\s*(?::(?!:)[^;{}()=]*)?$')
NAMESPACE_HEAD = re.compile(r'namespace(?:\s+([\w:]+))?\s*$')


def types(code):
    """(namespace, name, line) of each type defined in a named namespace. `code` has no comments and strings."""
    found, scopes, since = [], [], 0
    for brace in re.compile(r'[{};]').finditer(code):
        at = brace.start()
        head = code[since:at].strip()
        since = at + 1
        if brace.group() == ';':
            continue
        if brace.group() == '}':
            if scopes:
                scopes.pop()
            continue
        space = NAMESPACE_HEAD.search(head)
        if space:
            scopes.append(space.group(1))
            continue
        kind = TYPE_HEAD.search(head)
        if kind and all(scopes):
            found.append(('::'.join(scopes), kind.group(1), code.count('\n', 0, at) + 1))
        scopes.append(None)   # nested types are not listed
    return found

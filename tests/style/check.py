#!/usr/bin/env python3
"""Checks rules that the compiler does not check: layers, purity of the stages, names, single definitions, sizes and layout.

Usage: check.py [--changed] [ROOT]. Prints PATH:LINE: MESSAGE for each finding; exit status 1 if one of them is an error.
--changed: checks the format only of files that differ from the last commit.
"""

import ast
import os
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True   # do not write into the source tree
import layers  # noqa: E402
import source  # noqa: E402
import words  # noqa: E402

TOP_FOLDERS = {'proto', 'common', 'master', 'slave', 'deploy', 'tests', '.ci'}
TOP_FILES = {'CMakeLists.txt', 'CMakePresets.json', 'README.md', 'ARCHITECTURE.md', 'CHANGELOG.md', 'CONTRIBUTING.md', 'LICENSE', 'NOTICE',
             '.clang-format', '.clang-tidy', '.gitignore', '.gitattributes'}
IGNORED = {'corpus', '.git', 'build', 'out', '__pycache__'}   # written by builds, runs and fuzzers
GENERATED = re.compile(r'proto/\w+(\.grpc)?\.pb\.h$|schema/\w+\.hpp$|commit\.hpp$')   # written by the build
CPP = ('.hpp', '.cpp')
FUNCTION_LINES, FILE_LINES, FILE_LINES_WISHED = 60, 400, 300
PLACES = {'ARCHITECTURE.md', 'deploy/guide/code.md', 'deploy/guide/link.md'}
PRODUCT = {'common', 'master', 'slave', 'deploy'}
FOLDER_FILES_USUAL = 40
FOLDER_FILES = {'common/config': 60, 'master': 10, 'slave': 10}

BANNED = {'manager', 'util', 'helper', 'handler', 'data', 'info', 'process'}
TYPE = re.compile(r'\b(?:class|struct|union|enum(?:\s+class|\s+struct)?|concept|message|service)\s+([A-Za-z_]\w*)'
                  r'|\busing\s+([A-Za-z_]\w*)\s*=|\btypedef\b[^;]*?\b(\w+)\s*;')
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

# Stages and nodes only compute. Clocks, threads, output and random numbers belong to higher layers.
IMPURE_HEADERS = re.compile(r'(?:thread|mutex|shared_mutex|atomic|condition_variable|future|stop_token|semaphore|latch|'
                            r'barrier|iostream|fstream|sstream|cstdio|stdio\.h|random|ctime|time\.h|filesystem|'
                            r'spdlog/.*|fmt/.*|google/protobuf/.*|grpc.*|asio.*|.*\.pb\.h)$')
IMPURE_CODE = [
    (re.compile(r'(?:::|\.)\s*now\s*\(\s*\)'), 'reads a clock'),
    (re.compile(r'\b(?:clock_gettime|gettimeofday|nanosleep|sleep_for|sleep_until)\b'), 'reads a clock or sleeps'),
    (re.compile(r'\bstd::(?:thread|jthread|mutex|atomic\w*)\b'), 'uses threads'),
    (re.compile(r'\b(?:printf|fprintf|puts|fputs)\s*\(|\bstd::(?:cout|cerr|clog)\b'), 'prints'),
    (re.compile(r'\bs?rand\s*\(|\bstd::(?:mt19937\w*|random_device|default_random_engine)\b'),
     'draws numbers outside of common/core/random'),
]
ALLOWED_IMPURE = {'common/core/check.hpp'}   # prints only before it ends the program

# Split, so that this file does not match its own patterns.
UNFINISHED = re.compile(r'\b(?:TO' r'DO|FIX' r'ME|X' r'XX)\b')
SWITCHED_OFF = re.compile(r'\bGTEST_' r'SKIP\b|\bDIS' r'ABLED_')
MACHINE_PATH = re.compile(r'(?<![\w.}/-])/(?:home|root|work|Users|mnt|tmp)' r'/')


class Findings:
    def __init__(self):
        self.errors = []
        self.warnings = []

    def error(self, path, line, message):
        self.errors.append(f'{path}:{line}: {message}')

    def warning(self, path, line, message):
        self.warnings.append(f'{path}:{line}: warning: {message}')


def tree(root):
    """Sorted paths of all files below the root, separated by '/'."""
    paths = []
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in IGNORED)
        paths += [os.path.relpath(os.path.join(folder, name), root).replace(os.sep, '/') for name in files
                  if name not in IGNORED]
    return sorted(paths)


def read(root, path):
    """The text of a file; None if it is not a text file."""
    with open(os.path.join(root, path), 'rb') as file:
        content = file.read()
    try:
        return None if b'\0' in content else content.decode('utf-8')
    except UnicodeDecodeError:
        return None


def banned_part(name):
    for part in re.findall(r'[A-Z]+(?![a-z])|[A-Z]?[a-z]+', name):
        part = part.lower()
        if part in BANNED or (part.endswith('s') and part[:-1] in BANNED):
            return part
    return None


def line_of(text, at):
    return text.count('\n', 0, at) + 1


def check_layout(root, found):
    for name in sorted(os.listdir(root)):
        if name in IGNORED:
            continue
        is_folder = os.path.isdir(os.path.join(root, name))
        if name not in (TOP_FOLDERS if is_folder else TOP_FILES):
            found.error(name, 1, 'does not belong at the top level')
    for name in sorted(TOP_FOLDERS):
        if not os.path.isdir(os.path.join(root, name)):
            found.error(name, 1, 'is missing at the top level')


def check_name(path, found):
    parts = path.split('/')
    for i, part in enumerate(parts):
        word = banned_part(part.split('.')[0])
        if word and parts[:2] != ['tests', 'process']:
            found.error('/'.join(parts[:i + 1]), 1, f'the name says nothing: "{word}"')
            return


def check_folders(paths, found):
    """Limits the number of files per folder of the product, because a large folder needs subfolders."""
    count = {}
    for path in paths:
        if path.split('/')[0] in PRODUCT:
            count[os.path.dirname(path)] = count.get(os.path.dirname(path), 0) + 1
    for folder, files in sorted(count.items()):
        most = FOLDER_FILES.get(folder, FOLDER_FILES_USUAL)
        if files > most:
            found.error(folder, 1, f'{files} files, over {most}')


def check_definitions(codes, found):
    """`codes`: path -> code without comments. A type must be defined once, because the linker detects no second definition."""
    first = {}
    for path in sorted(codes):
        for scope, name, line in source.types(codes[path]):
            if (scope, name) in first and first[scope, name] != path:
                found.error(path, line, f'{name} is defined in {first[scope, name]} as well')
            first.setdefault((scope, name), path)


def check_paths(path, text, paths, found):
    """Each path in a document must be a file, a pair of header and source, or a folder."""
    known = set(paths)
    for name in paths:
        known.add(name.rsplit('.', 1)[0])
        while '/' in name:
            name = os.path.dirname(name)
            known.add(name)
    for number, line in enumerate(text.split('\n'), 1):
        for name in re.findall(r'`([\w./-]+/[\w./-]+)`', line):
            if name.split('/')[0] in TOP_FOLDERS and name.rstrip('/') not in known:
                found.error(path, number, f'{name} does not exist')


def check_lines(path, text, found):
    for number, line in enumerate(text.split('\n'), 1):
        if '\t' in line:
            found.error(path, number, 'tab')
        if line != line.rstrip():
            found.error(path, number, 'trailing blank')
        if UNFINISHED.search(line):
            found.error(path, number, 'unfinished work is marked in the text')
        if SWITCHED_OFF.search(line):
            found.error(path, number, 'a test is switched off')
        if MACHINE_PATH.search(line):
            found.error(path, number, 'a path of one machine')
    if text and not text.endswith('\n'):
        found.error(path, line_of(text, len(text)), 'no newline at the end')


def check_length(path, text, found):
    lines = text.count('\n')
    if lines > FILE_LINES:
        found.error(path, 1, f'{lines} lines, over {FILE_LINES}')
    elif lines > FILE_LINES_WISHED:
        found.warning(path, 1, f'{lines} lines, over {FILE_LINES_WISHED}')


def check_types(path, code, found):
    for match in TYPE.finditer(code):
        name = next(group for group in match.groups() if group)
        word = banned_part(name)
        if word:
            found.error(path, line_of(code, match.start()), f'the name {name} says nothing: "{word}"')


def check_includes(root, path, text, found):
    pure = layers.is_pure(path) and path not in ALLOWED_IMPURE
    for number, line in enumerate(text.split('\n'), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        kind, included = match.groups()
        if pure and IMPURE_HEADERS.match(included):
            found.error(path, number, f'stages and nodes may not include {included}')
        if kind == '<':
            continue
        if '..' in included.split('/'):
            found.error(path, number, f'{included} is not a path from the root')
        elif GENERATED.match(included) or os.path.isfile(os.path.join(root, included)):
            reason = layers.refused(path, included)
            if reason:
                found.error(path, number, reason)
        else:
            found.error(path, number, f'{included} is not a file seen from the root')


def check_cpp(root, path, text, found):
    code = source.code_only(text)
    if path.endswith('.hpp') and not text.startswith('#pragma once\n'):
        found.error(path, 1, 'a header begins with #pragma once')
    for match in re.finditer(r'\busing\s+namespace\s+std\s*;', code):
        found.error(path, line_of(code, match.start()), 'using namespace std')
    check_includes(root, path, text, found)
    if layers.is_pure(path) and path not in ALLOWED_IMPURE:
        for pattern, what in IMPURE_CODE:
            for match in pattern.finditer(code):
                found.error(path, line_of(code, match.start()), f'{what}, which stages and nodes never do')
    for first, last in source.functions(text):
        if last - first + 1 > FUNCTION_LINES:
            found.error(path, first, f'a function of {last - first + 1} lines, over {FUNCTION_LINES}')


def check_python(path, text, found):
    for node in ast.walk(ast.parse(text, path)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            lines = node.end_lineno - node.lineno + 1
            if lines > FUNCTION_LINES:
                found.error(path, node.lineno, f'a function of {lines} lines, over {FUNCTION_LINES}')


def formatter():
    """The clang-format of Debian 12 if it is installed; other versions format differently."""
    for tool in ('clang-format-14', 'clang-format'):
        if shutil.which(tool):
            version = subprocess.run([tool, '--version'], capture_output=True, text=True, check=False).stdout
            if re.search(r'version 14\.', version):
                return tool
    return None


def check_format(root, paths, found):
    tool = formatter()
    if not tool or not paths:
        return
    together = os.cpu_count() or 1
    running = [subprocess.Popen([tool, '--dry-run', '--Werror', *paths[i::together]], cwd=root, stderr=subprocess.PIPE,
                                text=True) for i in range(min(together, len(paths)))]
    texts = [one.communicate()[1] for one in running]
    unformed = {}
    for path, line in re.findall(r'^(.+?):(\d+):\d+: (?:error|warning): ', '\n'.join(texts), re.MULTILINE):
        unformed.setdefault(path, int(line))
    for path, line in sorted(unformed.items()):
        found.error(path, line, f'not as clang-format has it: {tool} -i {path}')
    if any(one.returncode for one in running) and not unformed:
        found.error('.clang-format', 1, '\n'.join(texts).strip())


def changed(root):
    """The files that differ from the last commit."""
    told = subprocess.run(['git', 'status', '--porcelain', '--no-renames', '-uall'], cwd=root, capture_output=True, text=True,
                          check=True)
    return {line[3:] for line in told.stdout.splitlines()}


def check(root, form=None):
    """`form` selects the files whose format is checked, from the list of all; None: all."""
    found = Findings()
    check_layout(root, found)
    paths = tree(root)
    check_folders(paths, found)
    codes, texts = {}, {}
    for path in paths:
        check_name(path, found)
        text = read(root, path)
        if text is None:
            continue
        if path != 'CHANGELOG.md':   # it contains former names
            texts[path] = text
        check_lines(path, text, found)
        if path in PLACES:
            check_paths(path, text, paths, found)
        if path.endswith((*CPP, '.py')):
            check_length(path, text, found)
        if path.endswith((*CPP, '.py', '.proto')):
            check_types(path, source.code_only(text), found)
        if path.endswith(CPP):
            check_cpp(root, path, text, found)
            words.check_test_names(path, text, found)
            codes[path] = source.code_only(text)
        if path.endswith('.py'):
            check_python(path, text, found)
    check_definitions(codes, found)
    if words.LIST in texts:
        words.check_words(words.parse(texts[words.LIST]), texts, found)
    check_format(root, [path for path in paths if path.endswith(CPP) and (form is None or path in form)], found)
    return found


def main():
    options = [word for word in sys.argv[1:] if word != '--changed']
    root = options[0] if options else os.path.join(os.path.dirname(__file__), '..', '..')
    found = check(root, changed(root) if '--changed' in sys.argv else None)
    print('\n'.join(found.warnings + found.errors))
    print(f'style: {len(found.errors)} errors, {len(found.warnings)} warnings')
    return 1 if found.errors else 0


if __name__ == '__main__':
    sys.exit(main())

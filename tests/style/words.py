"""Checks banned words and phrases, and the length of test names.

Usage: words.py ROOT writes the current counts into the list, after a merge of branches that lowered them.
"""

import pathlib
import re
import subprocess
import sys

LIST = 'tests/style/words.txt'
TEST_NAME = 60
TEST = re.compile(r'^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\(\s*(\w+)\s*,\s*(\w+)\s*\)', re.MULTILINE)
EXEMPT = ('tests/style/', 'tests/fuzz/corpus/')


def parse(text):
    """(word, allowed, replacement) of each line `word | allowed | replacement`; `#` starts a comment."""
    rows = []
    for line in text.split('\n'):
        if line and not line.startswith('#'):
            word, allowed, instead = (part.strip() for part in line.split('|'))
            rows.append((word, int(allowed), instead))
    return rows


def pattern_of(word):
    """Pattern of a phrase, which may span several lines, even of a comment."""
    return re.compile(r'(?<!\w)' + r'\s+(?://+\s*)?'.join(map(re.escape, word.split())) + r'(?!\w)')


def check_words(rows, texts, found):
    """`texts`: path -> text. In all files together, a word may occur at most as often as its row allows."""
    texts = {path: text for path, text in texts.items() if not path.startswith(EXEMPT)}
    for word, allowed, instead in rows:
        pattern, rarest = pattern_of(word), max(word.split(), key=len)   # a plain search is much faster
        places = [(path, text.count('\n', 0, match.start()) + 1)
                  for path, text in sorted(texts.items()) if rarest in text for match in pattern.finditer(text)]
        if len(places) > allowed:
            path, line = places[-1] if allowed else places[0]
            found.error(path, line, f'"{word}" occurs {len(places)} times, over {allowed}: write {instead}')
        elif len(places) < allowed:
            found.warning(LIST, 1, f'"{word}" occurs {len(places)} times now: lower the number {allowed} to that')


def check_test_names(path, text, found):
    for match in TEST.finditer(text):
        if len(match.group(2)) > TEST_NAME:
            found.error(path, text.count('\n', 0, match.start()) + 1,
                        f'the name {match.group(1)}.{match.group(2)} has {len(match.group(2))} characters, over {TEST_NAME}')


def write(root):
    names = subprocess.run(['git', 'ls-files'], cwd=root, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
    texts = []
    for name in names:
        if not name.startswith(EXEMPT) and name != 'CHANGELOG.md':
            texts.append((root / name).read_bytes().decode('utf-8', 'replace'))
    rows = []
    for line in (root / LIST).read_text().splitlines():
        if line and not line.startswith('#'):
            word, _, instead = (part.strip() for part in line.split('|'))
            line = f'{word} | {sum(len(pattern_of(word).findall(text)) for text in texts)} | {instead}'
        rows.append(line)
    (root / LIST).write_text('\n'.join(rows) + '\n')


if __name__ == '__main__':
    write(pathlib.Path(sys.argv[1]))

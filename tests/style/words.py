"""Banned words and phrases, and the length of the names of tests."""

import re

LIST = 'tests/style/words.txt'
TEST_NAME = 60
TEST = re.compile(r'^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\(\s*(\w+)\s*,\s*(\w+)\s*\)', re.MULTILINE)
EXEMPT = ('tests/style/', 'tests/fuzz/corpus/')


def parse(text):
    """(word, allowed, replacement) of each line `word | allowed | replacement`; `#` begins a comment."""
    rows = []
    for line in text.split('\n'):
        if line and not line.startswith('#'):
            word, allowed, instead = (part.strip() for part in line.split('|'))
            rows.append((word, int(allowed), instead))
    return rows


def check_words(rows, texts, found):
    """`texts`: path -> text. A word may occur at most as often as its row allows, in all files together."""
    texts = {path: text for path, text in texts.items() if not path.startswith(EXEMPT)}
    for word, allowed, instead in rows:
        pattern = re.compile(r'(?<!\w)' + r'\s+(?://+\s*)?'.join(map(re.escape, word.split())) + r'(?!\w)')
        places = [(path, text.count('\n', 0, match.start()) + 1)
                  for path, text in sorted(texts.items()) for match in pattern.finditer(text)]
        if len(places) > allowed:
            path, line = places[-1] if allowed else places[0]
            found.error(path, line, f'"{word}" occurs {len(places)} times, over {allowed}: write {instead}')
        elif len(places) < allowed:
            found.error(LIST, 1, f'"{word}" occurs {len(places)} times now: lower the number {allowed} to that')


def check_test_names(path, text, found):
    for match in TEST.finditer(text):
        if len(match.group(2)) > TEST_NAME:
            found.error(path, text.count('\n', 0, match.start()) + 1,
                        f'the name {match.group(1)}.{match.group(2)} has {len(match.group(2))} characters, over {TEST_NAME}')

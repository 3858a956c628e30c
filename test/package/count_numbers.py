#!/usr/bin/python3
"""count_numbers.py [FOLDER...]: how many numbers the algorithms have that somebody chose, for each folder below src.

Named constants (kName = number), other literals but 0, 1 and 2, and defaults of settings in the folder's public headers. The
suite keeps the counts from growing (test_package.py)."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ['planes', 'rectangles', 'tracking', 'articulation', 'bend', 'kinds', 'structure', 'closing']
NUMBER = re.compile(r'(?<![\w.])(?:\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)[fFuUlL]*(?![\w.])')
CONSTANT = re.compile(r'\bk[A-Z]\w*(?:\[\])?\s*[={]\s*[^;,]*')
DEFAULT = re.compile(r'^  (?:double|int|float|bool|std::string) \w+ = ', re.MULTILINE)
SELF_EVIDENT = {0.0, 1.0, 2.0}


def without_comments(text):
    text = re.sub(r'//[^\n]*', '', re.sub(r'/\*.*?\*/', '', text, flags=re.DOTALL))
    return re.sub(r'"(?:\\.|[^"\\])*"|#include[^\n]*', '""', text)


def value(literal):
    return float(literal.rstrip('fFuUlL') or 0)


def count(folder):
    """{'lines', 'constants', 'literals', 'defaults'} of a folder below src."""
    total = {'lines': 0, 'constants': 0, 'literals': 0, 'defaults': 0}
    for file in sorted((ROOT / 'src' / folder).rglob('*')):
        if file.suffix not in ('.h', '.cpp'):
            continue
        text = file.read_text()
        code = without_comments(text)
        constants = [match for match in CONSTANT.findall(code) if NUMBER.search(match)]
        rest = CONSTANT.sub('', code)
        total['lines'] += text.count('\n')
        total['constants'] += len(constants)
        total['literals'] += sum(value(literal) not in SELF_EVIDENT for literal in NUMBER.findall(rest))
    for file in (ROOT / 'include/cabinet_articulation' / folder).glob('*.h'):
        code = without_comments(file.read_text())
        if 'static void fields(' in code:
            total['defaults'] += len(DEFAULT.findall(code))
    return total


if __name__ == '__main__':
    print('folder        lines  constants  a 1000 lines  literals  defaults')
    for name in sys.argv[1:] or FOLDERS:
        found = count(name)
        print('%-12s %6d %10d %13.1f %9d %9d' % (name, found['lines'], found['constants'],
                                                1000 * found['constants'] / found['lines'], found['literals'], found['defaults']))

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""doc/troubleshooting.md quotes what the stages and services really say."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / 'doc' / 'troubleshooting.md'


def literals():
    """All string literals of the sources, those in several parts joined."""
    text = '\n'.join(path.read_text() for path in sorted((ROOT / 'src').rglob('*')) if path.suffix in ('.cpp', '.h'))
    text = re.sub(r'"\s*\n\s*"', '', text)
    return re.findall(r'"((?:[^"\\\n]|\\.)*)"', text)


class Troubleshooting(unittest.TestCase):
    def test_quotes_what_is_said(self):
        page = PAGE.read_text().split('## What diagnostics say')[1]
        quotes = re.findall(r'^\| `([^`]+)` \|', page, re.M)
        self.assertGreater(len(quotes), 20)
        said = literals()
        for quote in quotes:
            for part in quote.split('...'):
                self.assertTrue(any(part.strip() in literal for literal in said), 'nothing says "%s"' % part.strip())


if __name__ == '__main__':
    unittest.main()

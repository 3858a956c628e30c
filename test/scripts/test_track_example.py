#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The example of doc/nodelets/tracking.md puts tracks together."""
import os
import re
import types
import unittest

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'doc', 'nodelets', 'tracking.md')


def array(*tracks):
    """Tracks of (id, revision, first, observations), whose poses are named as their stamps are but in capitals."""
    return types.SimpleNamespace(tracks=[
        types.SimpleNamespace(id=i, revision=revision, first=first, stamps=list(seen), poses=list(seen.upper()))
        for i, revision, first, seen in tracks])


class TrackExample(unittest.TestCase):
    def setUp(self):
        with open(PAGE, encoding='utf-8') as page:
            code = re.search(r'```python\n(.*?)```', page.read(), re.DOTALL).group(1)
        self.example = {}
        exec(compile(code, PAGE, 'exec'), self.example)

    def poses(self, track):
        return ''.join(self.example['tracks'][track][2])

    def add(self, *tracks):
        self.example['add'](array(*tracks))

    def test_is_short(self):
        with open(PAGE, encoding='utf-8') as page:
            code = re.search(r'def add.*?(?=```)', page.read(), re.DOTALL).group(0)
        self.assertLessEqual(len(code.splitlines()), 10)

    def test_appends_what_is_new(self):
        self.add((7, 0, 0, 'a'))
        self.add((7, 0, 0, 'ab'), (8, 0, 0, 'x'))
        self.add((7, 0, 1, 'b'), (8, 0, 0, 'xyz'))
        self.add((7, 0, 1, 'bc'), (8, 0, 2, 'z'))
        self.assertEqual(self.poses(7), 'ABC')
        self.assertEqual(self.poses(8), 'XYZ')

    def test_a_whole_one_replaces(self):
        self.add((7, 0, 0, 'ab'))
        self.add((7, 1, 0, 'abc'))
        self.add((7, 1, 2, 'cd'))
        self.assertEqual(self.poses(7), 'ABCD')

    def test_keeps_what_is_there_across_a_gap(self):
        self.add((7, 0, 0, 'ab'))
        self.add((7, 0, 2, 'cd'))
        self.assertEqual(self.poses(7), 'AB')
        self.add((7, 1, 1, 'bc'))
        self.assertEqual(self.poses(7), 'AB', 'another revision')
        self.add((7, 1, 0, 'abcde'))
        self.assertEqual(self.poses(7), 'ABCDE')

    def test_a_missed_thinning_is_a_gap(self):
        self.add((7, 0, 0, 'abcdef'))
        self.add((7, 0, 3, 'fg'))
        self.assertEqual(self.poses(7), 'ABCDEF')

    def test_forgets_what_ended(self):
        self.add((7, 0, 0, 'a'), (8, 0, 0, 'x'))
        self.add((8, 0, 0, 'xy'))
        self.assertNotIn(7, self.example['tracks'])

    def test_a_part_of_an_unknown_track_is_no_track(self):
        self.add((7, 0, 5, 'fg'))
        self.assertNotIn(7, self.example['tracks'])


if __name__ == '__main__':
    unittest.main()

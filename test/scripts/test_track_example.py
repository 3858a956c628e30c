#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The example of doc/nodelets/tracking.md puts tracks together."""
import os
import re
import types
import unittest

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'doc', 'nodelets', 'tracking.md')


def array(*tracks):
    return types.SimpleNamespace(tracks=[types.SimpleNamespace(id=i, revision=revision, first=first, poses=poses)
                                         for i, revision, first, poses in tracks])


class TrackExample(unittest.TestCase):
    def setUp(self):
        with open(PAGE, encoding='utf-8') as page:
            code = re.search(r'```python\n(.*?)```', page.read(), re.DOTALL).group(1)
        self.example = {}
        exec(compile(code, PAGE, 'exec'), self.example)

    def poses(self, track):
        return self.example['tracks'][track][1]

    def add(self, *tracks):
        self.example['add'](array(*tracks))

    def test_is_short(self):
        with open(PAGE, encoding='utf-8') as page:
            code = re.search(r'def add.*?```', page.read(), re.DOTALL).group(0)
        self.assertLessEqual(len(code.splitlines()), 10)

    def test_appends_what_is_new(self):
        self.add((7, 0, 0, ['a']))
        self.add((7, 0, 1, ['b']), (8, 0, 0, ['x']))
        self.add((7, 0, 1, ['b']), (8, 0, 1, ['y', 'z']))
        self.assertEqual(self.poses(7), ['a', 'b'])
        self.assertEqual(self.poses(8), ['x', 'y', 'z'])

    def test_a_whole_one_replaces(self):
        self.add((7, 0, 0, ['a', 'b']))
        self.add((7, 1, 0, ['A', 'B', 'C']))
        self.add((7, 1, 3, ['D']))
        self.assertEqual(self.poses(7), ['A', 'B', 'C', 'D'])

    def test_keeps_what_is_there_across_a_gap(self):
        self.add((7, 0, 0, ['a', 'b']))
        self.add((7, 0, 3, ['d']))
        self.assertEqual(self.poses(7), ['a', 'b'])
        self.add((7, 1, 2, ['c']))
        self.assertEqual(self.poses(7), ['a', 'b'], 'another revision')
        self.add((7, 1, 0, ['A', 'B', 'C', 'D']))
        self.assertEqual(self.poses(7), ['A', 'B', 'C', 'D'])

    def test_forgets_what_ended(self):
        self.add((7, 0, 0, ['a']), (8, 0, 0, ['x']))
        self.add((8, 0, 1, ['y']))
        self.assertNotIn(7, self.example['tracks'])

    def test_a_part_of_an_unknown_track_is_no_track(self):
        self.add((7, 0, 5, ['f']))
        self.assertNotIn(7, self.example['tracks'])


if __name__ == '__main__':
    unittest.main()

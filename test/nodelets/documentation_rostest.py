#!/usr/bin/python3
"""The pages in doc/nodelets name the topics and services that the running nodelets have, and no others."""
import re
import time
import unittest
from pathlib import Path

import rosgraph
import rostest

PAGES = Path(__file__).resolve().parents[2] / 'doc' / 'nodelets'
NAMESPACE = '/cabinet/'
# Every node has these.
COMMON = {'/rosout', '/clock'}
# Those that the default settings do not ask for: another input, tf between frames, another pace.
OPTIONAL = {'planes': {'depth/image', 'depth/camera_info'}, 'rectangles': {'depth/image', 'depth/camera_info', '/tf', '/tf_static'},
            'tracking': {'/tf', '/tf_static'}, 'overlay': {'depth/image', 'depth/camera_info', '/tf', '/tf_static'},
            'simulated_stereo_camera': {'/clock', 'models'}}


def documented(page, section):
    text = (PAGES / (page + '.md')).read_text()
    match = re.search(r'^## %s\n(.*?)(?=^## |\Z)' % section, text, re.M | re.S)
    return set(re.findall(r'^\| `([^`]+)` \|', match.group(1), re.M)) if match else set()


def running(state, page):
    """Names that a node has in one part of the master's state; without those of its own namespace."""
    node = NAMESPACE + page
    names = {name for name, nodes in state if node in nodes} - COMMON
    names = {name for name in names if not name.startswith(node + '/')}
    return {name[len(NAMESPACE):] if name.startswith(NAMESPACE) else name for name in names}


class Documentation(unittest.TestCase):
    def test_pages_name_what_there_is(self):
        pages = sorted(path.stem for path in PAGES.glob('*.md'))
        self.assertEqual(len(pages), 8)
        master = rosgraph.Master('/documentation_test')
        end = time.time() + 30
        while True:
            publishers, subscribers, services = master.getSystemState()
            wrong = []
            for page in pages:
                for section, state in (('Publishes', publishers), ('Subscribes', subscribers), ('Services', services)):
                    there, named = running(state, page), documented(page, section)
                    missing = there - named
                    surplus = named - there - OPTIONAL.get(page, set())
                    if missing or surplus:
                        wrong.append('%s, %s: not documented %s, not there %s' % (page, section, sorted(missing), sorted(surplus)))
            if not wrong or time.time() > end:
                break
            time.sleep(0.5)
        self.assertEqual(wrong, [])


if __name__ == '__main__':
    rostest.rosrun('cabinet_articulation', 'documentation_test', Documentation)

#!/usr/bin/python3
"""Another package builds against this one, in a workspace that overlays the devel space or the install space.

Both spaces are those of the build at hand: building this package again, beside the other one in a workspace of both, takes
longer than all tests together. scripts/check_workspace.sh does that.
"""
import re
import shutil
import unittest
from pathlib import Path

from spaces import DEVEL, INSTALL, PACKAGE, ROOT, SCRATCH, InstalledPackage, run

WATCHER = Path(__file__).resolve().parent / 'kitchen_watcher'


def build(space, name, *arguments):
    """The devel space of a new workspace with the other package."""
    workspace = SCRATCH / name
    shutil.rmtree(str(workspace), ignore_errors=True)
    shutil.copytree(str(WATCHER), str(workspace / 'src/kitchen_watcher'))
    run(space, 'catkin_make', '-DPYTHON_EXECUTABLE=/usr/bin/python3', *arguments, cwd=str(workspace))
    return workspace / 'devel'


class Downstream(InstalledPackage):
    def learns(self, devel, library_folder):
        program = devel / 'lib/kitchen_watcher/kitchen_watcher'
        libraries = re.findall(r'lib%s_pipeline\.so => (\S+)' % PACKAGE, run(devel, 'ldd', program))
        self.assertEqual([str(library_folder / ('lib%s_pipeline.so' % PACKAGE))], libraries)
        text = run(devel, 'rosrun', 'kitchen_watcher', 'kitchen_watcher')
        self.assertGreater(int(re.search(r'^(\d+) planes', text).group(1)), 1, text)
        joints = re.findall(r'^a joint of type (\d), its front (\S+) m', text, re.M)
        self.assertEqual(['1'], [kind for kind, _ in joints], text)
        self.assertLess(float(joints[0][1]), 0.01, text)
        self.assertEqual(1, len(re.findall('<joint [^>]*type="prismatic"', text)), text)

    def test_a_workspace_over_the_devel_space(self):
        self.learns(build(DEVEL, 'over_devel'), DEVEL / 'lib')

    def test_a_workspace_over_the_install_space_and_each_public_header_alone(self):
        self.learns(build(INSTALL, 'over_install', '-DEACH_HEADER_ALONE=ON'), INSTALL / 'lib')

    def test_the_public_headers_are_those_that_are_listed(self):
        listed = (WATCHER / 'public_headers.txt').read_text().split()
        for include in (ROOT / 'include' / PACKAGE, INSTALL / 'include' / PACKAGE):
            # Those of messages lie beside the folders.
            found = sorted(str(header.relative_to(include)) for header in include.glob('*/*'))
            self.assertEqual(listed, found, include)


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/python3
"""Rules about the tree itself: layers, lint, and files that must agree with one another."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from count_numbers import count  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = 'cabinet_articulation'

# Who may include whom. ROS headers lie in the system's include path on Debian, so the build alone does not keep them out.
LAYERS = {
    'config': set(),
    'geometry': set(),
    'stereo': {'config', 'geometry'},
    'planes': {'config', 'geometry', 'stereo'},
    'bend': {'geometry', 'stereo', 'planes'},
    'rectangles': {'config', 'geometry', 'stereo', 'planes'},
    'tracking': {'config', 'geometry', 'rectangles'},
    'articulation': {'config', 'geometry', 'rectangles', 'tracking'},
    'kinds': {'config', 'geometry', 'rectangles', 'tracking', 'articulation'},
    'joints': {'config', 'geometry', 'rectangles', 'tracking', 'articulation', 'kinds'},
    'closing': {'config', 'geometry', 'stereo', 'rectangles', 'tracking', 'articulation', 'joints'},
    'structure': {'config', 'geometry', 'stereo', 'rectangles', 'tracking', 'articulation', 'joints', 'closing'},
    'pipeline': {'config', 'geometry', 'stereo', 'planes', 'bend', 'rectangles', 'tracking', 'articulation', 'kinds', 'joints', 'closing',
                 'structure'},
    'simulation': {'config', 'geometry', 'stereo'},
}
# Numbers that somebody chose (count_numbers.py): constants, other literals, defaults of settings. Lower them with the code.
MOST_NUMBERS = {
    'planes': (34, 32, 24),
    'rectangles': (115, 85, 27),
    'tracking': (34, 19, 16),
    'articulation': (113, 316, 40),
    'bend': (18, 4, 0),
    'kinds': (14, 56, 6),
    'structure': (9, 2, 0),
    'closing': (30, 19, 0),
}
# Sub-folders of the folders of src/, in the order of the data: each may use those before it.
STEPS = {
    'articulation': ['paths', 'observations', 'fitting', 'models', 'decision', 'learner'],
    'rectangles': ['chart', 'search', 'refit', 'edges', 'acceptance', 'detector'],
    'tracking': ['size', 'motion', 'matching', 'tracker'],
    'nodelets': ['running', 'input', 'models', 'stages'],
    'ros': ['checks', 'settings', 'images', 'input', 'transforms', 'messages', 'answers', 'drawing'],
    'tools': ['terminal', 'input', 'settings', 'truth', 'results', 'report', 'programs'],
}
FOLDERS = [*LAYERS, 'ros', 'nodelets', 'rviz_plugin', 'tools', 'bridge']
ROS_HEADERS = re.compile(r'^(ros|rosbag|nodelet|pluginlib|tf|tf2|tf2_\w+|message_filters|image_transport|cv_bridge|'
                         r'image_geometry|diagnostic_updater|pcl_ros|pcl_conversions|xmlrpcpp|\w+_msgs)/|^XmlRpc')
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)


def sources(*folders):
    for folder in folders:
        yield from sorted(path for path in (ROOT / folder).rglob('*') if path.suffix in ('.h', '.cpp'))


class Layers(unittest.TestCase):
    def test_core_includes_no_ros_header_and_points_one_way(self):
        wrong = []
        for stage, allowed in LAYERS.items():
            files = list(sources('include/%s/%s' % (PACKAGE, stage), 'src/%s' % stage))
            self.assertTrue(files, 'no sources in stage %s' % stage)
            for path in files:
                for header in INCLUDE.findall(path.read_text()):
                    own = re.match('(?:%s/)?(%s)/' % (PACKAGE, '|'.join(FOLDERS)), header)
                    if own and own.group(1) not in allowed | {stage}:
                        wrong.append('%s: %s may not include %s' % (path.relative_to(ROOT), stage, header))
                    elif not own and (ROS_HEADERS.match(header) or header.startswith(PACKAGE + '/')):
                        wrong.append('%s: the core includes %s' % (path.relative_to(ROOT), header))
        self.assertEqual(wrong, [])

    def test_each_step_of_a_folder_uses_those_before_it(self):
        wrong = []
        for folder, steps in STEPS.items():
            self.assertEqual(sorted(steps), sorted(path.name for path in (ROOT / 'src' / folder).iterdir() if path.is_dir()))
            for i, step in enumerate(steps):
                for path in sources('src/%s/%s' % (folder, step)):
                    for header in re.findall(r'^#include "%s/(\w+)/' % folder, path.read_text(), re.M):
                        if header not in steps[:i + 1]:
                            wrong.append('%s includes %s/' % (path.relative_to(ROOT), header))
        self.assertEqual(wrong, [])

    def test_public_headers_include_public_ones_alone(self):
        for path in sources('include'):
            for header in re.findall(r'^#include "(.*)"', path.read_text(), re.M):
                self.assertTrue((ROOT / 'include' / header).is_file(), '%s includes %s' % (path.relative_to(ROOT), header))

    def test_a_header_beside_its_source_hides_no_other(self):
        """Both test/ and src/ are searched for "<folder>/x.h", and ROS's own headers are <ros/x.h>."""
        own = {str(path.relative_to(ROOT / 'src')) for path in sources('src') if path.suffix == '.h'}
        self.assertTrue(own)
        for folder in (ROOT / 'test', Path('/usr/include'), Path('/opt/ros/noetic/include')):
            self.assertEqual([name for name in sorted(own) if (folder / name).exists()], [], folder)

    def test_every_header_includes_once_and_every_source_has_a_licence(self):
        for path in sources('include', 'src', 'test', 'evaluation', 'benchmark'):
            text = path.read_text()
            self.assertTrue(text.startswith('// SPDX-License-Identifier: BSD-3-Clause'), path)
            if path.suffix == '.h':
                self.assertIn('#pragma once', text, path)


class Metadata(unittest.TestCase):
    def test_catkin_lint_has_nothing_to_say(self):
        self.assertTrue(shutil.which('catkin_lint'), 'catkin_lint is not installed')
        with tempfile.TemporaryDirectory() as folder:
            # The folder of a clone may have any name; lint wants the package's.
            link = Path(folder) / PACKAGE
            link.symlink_to(ROOT)
            # A workspace in the environment would name the clone's own folder.
            environment = {key: value for key, value in os.environ.items() if key != 'ROS_PACKAGE_PATH'}
            run = subprocess.run(['catkin_lint', '--offline', '--strict', '-W2', str(link) + '/'],
                                 env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn('checked 1 packages and found 0 problems', run.stdout)

    def test_a_bag_is_replayed_with_every_argument_of_the_pipeline(self):
        arguments = {name: dict(re.findall(r'<arg name="(\w+)" default="([^"]*)"', (ROOT / 'launch' / name).read_text()))
                     for name in ('pipeline.launch', 'replay.launch')}
        self.assertTrue(arguments['pipeline.launch'])
        self.assertEqual({}, {key: value for key, value in arguments['pipeline.launch'].items()
                              if arguments['replay.launch'].get(key) != value})

    def test_the_topics_of_each_camera_are_documented(self):
        def arguments(name):
            return dict(re.findall(r'<arg name="(\w+)" (?:default|value)="([^"]*)"', (ROOT / 'launch' / name).read_text()))

        rows = [line.split(' | ') for line in (ROOT / 'doc/inputs.md').read_text().splitlines() if 'launch/' in line and ' | ' in line]
        documented = set()
        for camera, start, topics, *_ in rows:
            launch = re.search(r'\(\.\./launch/(\w+\.launch)\)', start).group(1)
            values = {**arguments('pipeline.launch'), **arguments(launch), **dict(re.findall(r'(\w+):=(\S+?)`', start))}
            depth = values['input'] == 'depth'
            names = ('depth_image', 'depth_info') if depth else ('left_image', 'left_info', 'right_image', 'right_info')
            self.assertEqual([values[name] for name in names], re.findall(r'`([^`]+)`', topics), camera)
            documented.add(launch)
        self.assertEqual({'pipeline.launch', 'realsense.launch', 'kinect.launch', 'pr2.launch'}, documented)

    def test_every_message_and_source_is_built(self):
        cmake = (ROOT / 'CMakeLists.txt').read_text()
        for path in sorted([*(ROOT / 'msg').glob('*.msg'), *(ROOT / 'srv').glob('*.srv')]):
            self.assertIn(path.name, cmake)
        for path in sources('src', 'test', 'evaluation', 'benchmark'):
            if path.suffix == '.cpp':
                # The sanitizers' programs need other flags than all others: their script compiles them.
                lists = next(folder / 'CMakeLists.txt' for folder in path.parents if (folder / 'CMakeLists.txt').exists())
                builder = ROOT / 'scripts/check_sanitizers.sh' if path.parent.name == 'sanitizers' else lists
                lists = builder.read_text()
                stem = re.sub('_(ros)?test$', '', path.stem)
                self.assertTrue(path.name in lists or stem in lists, '%s is built by nobody' % path.relative_to(ROOT))

    def test_chosen_numbers_do_not_grow(self):
        for folder, most in MOST_NUMBERS.items():
            found = count(folder)
            self.assertGreater(found['lines'], 500, folder)
            for kind, limit in zip(('constants', 'literals', 'defaults'), most):
                self.assertLessEqual(found[kind], limit, '%s of %s: what evidence would make one needless?' % (kind, folder))


if __name__ == '__main__':
    unittest.main()

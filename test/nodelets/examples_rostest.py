#!/usr/bin/python3
"""The examples in Python: ask_kitchen.py watches a drawer that is played, asks about it, and saves it; check_accuracy.py compares
what was learned with what was seen."""
import copy
import math
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import rosbag
import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Point, PoseArray, Quaternion

from cabinet_articulation.msg import ArticulationModel, ArticulationModelArray, TrackArray

EXAMPLES = Path(__file__).resolve().parents[2] / 'doc' / 'examples'
POSES = 60
PATIENCE = 20


def write_drawer(path):
    """A front of 0.4 by 0.2 m that comes out along -z by 0.3 m. Logs have the corner of a rectangle."""
    with path.open('w') as log:
        for i in range(POSES):
            log.write('0.5 0.3 %.6f 1 0 0 0 0.4 0.2\n' % (1.5 - 0.3 * i / (POSES - 1)))


def door(hinge, turn=(0, 0, 0, 1)):
    """A front of 0.4 by 0.6 m at 1, 2, 3."""
    model = ArticulationModel(type=ArticulationModel.ROTATIONAL, width=0.4, height=0.6, axis_point=Point(*hinge))
    model.origin.position = Point(1, 2, 3)
    model.origin.orientation = Quaternion(*turn)
    return model


class Examples(unittest.TestCase):
    def test_the_hand_holds_the_edge_farthest_from_the_hinge(self):
        sys.path.insert(0, str(EXAMPLES))
        from ask_kitchen import far_edge
        quarter = (0, 0, math.sqrt(0.5), math.sqrt(0.5))  # its width along y
        for model, x, y in ((door((0.8, 2, 3)), 0.2, 0), (door((1.2, 2, 3.01)), -0.2, 0), (door((1, 2.3, 3)), 0, -0.3),
                            (door((1, 2.2, 3), quarter), -0.2, 0), (door((1.3, 2, 3), quarter), 0, 0.3)):
            edge = far_edge(model)
            self.assertEqual((edge.x, edge.y, edge.z), (x, y, 0))

    def test_ask_kitchen(self):
        with tempfile.TemporaryDirectory() as folder:
            self.ask(Path(folder))

    def wait_for_example(self):
        """A player starts at the first listener, as the test is, and nothing repeats what the example missed."""
        master = rosgraph.Master('/examples_test')
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            listeners = dict(master.getSystemState()[1]).get('/cabinet/models', [])
            if any(name.startswith('/ask_kitchen') for name in listeners):
                return
            time.sleep(0.1)
        self.fail('ask_kitchen.py does not listen to /cabinet/models after %d s' % PATIENCE)

    def output(self, folder, paths):
        """What the example says until it has saved, and its path has come."""
        with subprocess.Popen(['/usr/bin/python3', '-u', str(EXAMPLES / 'ask_kitchen.py'), str(folder / 'kitchen.yaml')],
                              stdout=subprocess.PIPE, universal_newlines=True) as example:
            lines = []
            player = None
            try:
                self.wait_for_example()
                player = subprocess.Popen(['rosrun', 'cabinet_articulation', 'track_publisher', str(folder / 'drawer.log'),
                                           '_rate:=30', '_frame_id:=map', 'tracks:=/cabinet/tracks'])
                for line in example.stdout:
                    lines.append(line)
                    if line.startswith('saved: '):
                        break
                end = time.monotonic() + PATIENCE
                while not paths and time.monotonic() < end:
                    time.sleep(0.05)
            finally:
                example.send_signal(signal.SIGINT)
                if player:
                    player.send_signal(signal.SIGINT)
                    player.wait()
        return ''.join(lines)

    def ask(self, folder):
        write_drawer(folder / 'drawer.log')
        paths, tracks, models = [], [], []
        rospy.Subscriber('/cabinet/tracks', TrackArray, tracks.append)
        rospy.Subscriber('/cabinet/models', ArticulationModelArray, models.append)
        rospy.Subscriber('/gripper_path', PoseArray, paths.append)
        text = self.output(folder, paths)
        self.assertRegex(text, r'front 1 is a drawer, at 0\.\d+ m')
        self.assertRegex(text, r'half way at q = 0\.\d+ m, known to \d+\.\d mm')
        # The hand holds the right edge, 0.2 m beside the centre, and goes where the drawer goes.
        way = [tuple(map(float, words)) for words in re.findall(r'q = (\S+): hand at (\S+) (\S+) (\S+)', text)]
        self.assertEqual(len(way), 20, text)
        for q, x, y, z in way:
            self.assertAlmostEqual(x, 0.9, delta=0.003)
            self.assertAlmostEqual(y, 0.2, delta=0.003)
            self.assertAlmostEqual(z, 1.5 - q, delta=0.003)
        self.assertEqual([path.header.frame_id for path in paths], ['map'])
        self.assertIn('prismatic', (folder / 'kitchen.yaml').read_text())
        self.check(folder, tracks[-1], models[-1])

    def check(self, folder, tracks, models):
        """The same drawer, seen 1 cm lower: y points down in the log."""
        for pose in tracks.tracks[0].poses:
            pose.position.y += 0.01
        hanging = copy.deepcopy(models.models[0])
        hanging.id, hanging.parent = 9, hanging.id
        models.models.append(hanging)
        for name, topic, message in (('learned', '/cabinet/models', models), ('seen', '/cabinet/tracks', tracks)):
            with rosbag.Bag(str(folder / (name + '.bag')), 'w') as bag:
                bag.write(topic, message, message.header.stamp)
        text = subprocess.run(['/usr/bin/python3', str(EXAMPLES / 'check_accuracy.py'), str(folder / 'learned.bag'),
                               str(folder / 'seen.bag')], stdout=subprocess.PIPE, check=True, universal_newlines=True).stdout
        error, degrees, way = re.match(r'front 1: (\S+) mm and (\S+) degrees from its path in the mean, over (\S+) of', text).groups()
        self.assertAlmostEqual(float(error), 10, delta=0.5)
        self.assertAlmostEqual(float(degrees), 0, delta=0.1)
        self.assertGreater(float(way), 0.05)
        self.assertIn('front 9: left out', text)


if __name__ == '__main__':
    rospy.init_node('examples_test')
    rostest.rosrun('cabinet_articulation', 'examples_test', Examples)

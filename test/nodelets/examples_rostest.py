#!/usr/bin/python3
"""The examples in Python: ask_kitchen.py watches a drawer that is played, asks about it, and saves it; check_accuracy.py compares
what was learned with what was seen."""
import re
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import rosbag
import rospy
import rostest
from geometry_msgs.msg import PoseArray

from cabinet_articulation.msg import ArticulationModelArray, TrackArray

EXAMPLES = Path(__file__).resolve().parents[2] / 'doc' / 'examples'
POSES = 60
PATIENCE = 20


def write_drawer(path):
    """A front of 0.4 by 0.2 m that comes out along -z by 0.3 m. Logs have the corner of a rectangle."""
    with path.open('w') as log:
        for i in range(POSES):
            log.write('0.5 0.3 %.6f 1 0 0 0 0.4 0.2\n' % (1.5 - 0.3 * i / (POSES - 1)))


class Examples(unittest.TestCase):
    def test_ask_kitchen(self):
        with tempfile.TemporaryDirectory() as folder:
            self.ask(Path(folder))

    def output(self, file, paths):
        """What the example says until it has saved, and its path has come."""
        with subprocess.Popen(['/usr/bin/python3', '-u', str(EXAMPLES / 'ask_kitchen.py'), str(file)], stdout=subprocess.PIPE,
                              universal_newlines=True) as example:
            lines = []
            for line in example.stdout:
                lines.append(line)
                if line.startswith('saved: '):
                    break
            end = time.monotonic() + PATIENCE
            while not paths and time.monotonic() < end:
                time.sleep(0.05)
            example.send_signal(signal.SIGINT)
        return ''.join(lines)

    def ask(self, folder):
        write_drawer(folder / 'drawer.log')
        paths, tracks, models = [], [], []
        rospy.Subscriber('/cabinet/tracks', TrackArray, tracks.append)
        rospy.Subscriber('/cabinet/models', ArticulationModelArray, models.append)
        rospy.Subscriber('/gripper_path', PoseArray, paths.append)
        player = subprocess.Popen(['rosrun', 'cabinet_articulation', 'track_publisher', str(folder / 'drawer.log'), '_rate:=30',
                                   '_frame_id:=map', 'tracks:=/cabinet/tracks'])
        try:
            text = self.output(folder / 'kitchen.yaml', paths)
        finally:
            player.send_signal(signal.SIGINT)
            player.wait()
        self.assertRegex(text, r'front 1 is a drawer, at 0\.\d+ m')
        self.assertRegex(text, r'half open at q = 0\.\d+ m, known to \d+\.\d mm')
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
        for name, topic, message in (('learned', '/cabinet/models', models), ('seen', '/cabinet/tracks', tracks)):
            with rosbag.Bag(str(folder / (name + '.bag')), 'w') as bag:
                bag.write(topic, message, message.header.stamp)
        text = subprocess.run(['/usr/bin/python3', str(EXAMPLES / 'check_accuracy.py'), str(folder / 'learned.bag'),
                               str(folder / 'seen.bag')], stdout=subprocess.PIPE, check=True, universal_newlines=True).stdout
        error, degrees, way = re.match(r'front 1: (\S+) mm and (\S+) degrees from its path in the mean, over (\S+) of', text).groups()
        self.assertAlmostEqual(float(error), 10, delta=0.5)
        self.assertAlmostEqual(float(degrees), 0, delta=0.1)
        self.assertGreater(float(way), 0.05)


if __name__ == '__main__':
    rospy.init_node('examples_test')
    rostest.rosrun('cabinet_articulation', 'examples_test', Examples)

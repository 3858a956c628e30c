#!/usr/bin/python3
"""Logs in the original release's format are played by track_publisher, learned from, recorded, and written again by
track_writer as they were."""
import math
import random
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import rosbag
import rospy
import rostest

from cabinet_articulation.msg import ArticulationModel, ArticulationModelArray, TrackArray

POSES = 60
PATIENCE = 60
WIDTH, HEIGHT = 0.4, 0.6


def door(i):
    """A corner at the hinge side's end of a front that turns about y; its x axis points away from the hinge."""
    q = 1.4 * i / (POSES - 1)
    return [0.1 + 0.02 * math.cos(q), 0.2, 1.5 - 0.02 * math.sin(q), 0, math.sin(q / 2), 0, math.cos(q / 2)]


def drawer(i):
    return [0.5, 0.3, 1.5 - 0.3 * i / (POSES - 1), 0, 1, 0, 0]


def write_log(path, pose, extra):
    noise = random.Random(1)
    with open(path, 'w') as log:
        for i in range(POSES):
            row = pose(i)
            row[:3] = [value + noise.gauss(0, 1e-3) for value in row[:3]]
            log.write(' '.join('%.9f' % value for value in row + extra) + '\n')


def read_log(path):
    return [[float(word) for word in line.split()] for line in path.read_text().splitlines() if not line.startswith('#')]


class OriginalLogs(unittest.TestCase):
    def test_are_learned_from_and_written_as_they_were(self):
        with tempfile.TemporaryDirectory() as folder:
            self.round_trip(Path(folder))

    def round_trip(self, folder):
        logs = [folder / 'door.log', folder / 'drawer.log']
        write_log(logs[0], door, [WIDTH, HEIGHT])
        write_log(logs[1], drawer, [])
        tracks, models = self.play(logs)

        door_model, drawer_model = models.models
        self.assertEqual(door_model.type, ArticulationModel.ROTATIONAL)
        self.assertEqual(drawer_model.type, ArticulationModel.PRISMATIC)
        self.assertAlmostEqual(door_model.q_max - door_model.q_min, 1.4, delta=0.03)
        self.assertAlmostEqual(drawer_model.q_max - drawer_model.q_min, 0.3, delta=0.01)
        self.assertEqual(models.header.frame_id, 'kitchen')

        with rosbag.Bag(str(folder / 'recorded.bag'), 'w') as bag:
            bag.write('/cabinet/tracks', tracks, tracks.header.stamp)
        subprocess.run(['rosrun', 'cabinet_articulation', 'track_writer', str(folder / 'recorded.bag'), str(folder / 'out')],
                       check=True, stdout=subprocess.DEVNULL)
        for log, track in zip(logs, tracks.tracks):
            given, written = read_log(log), read_log(folder / 'out' / ('track_%d.log' % track.id))
            self.assertEqual(len(written), POSES)
            for a, b in zip(given, written):
                self.assertEqual(len(b), 9)
                # The same orientation may be written as q or as -q.
                sign = math.copysign(1, sum(x * y for x, y in zip(a[3:7], b[3:7])))
                for x, y in zip(a, b[:3] + [sign * value for value in b[3:7]] + b[7:]):
                    self.assertAlmostEqual(x, y, places=6)

    def play(self, logs):
        """The tracks of whole logs, and the models learned from them. A busy machine may need a second round for that."""
        tracks, models = {}, {}
        subscribers = [rospy.Subscriber('/cabinet/tracks', TrackArray, lambda m: tracks.update({m.header.stamp: m})),
                       rospy.Subscriber('/cabinet/models', ArticulationModelArray, lambda m: models.update({m.header.stamp: m}))]
        player = subprocess.Popen(['rosrun', 'cabinet_articulation', 'track_publisher', *map(str, logs), '_rate:=30',
                                   '_frame_id:=kitchen', '_loop:=true', 'tracks:=/cabinet/tracks'])
        try:
            end = time.monotonic() + PATIENCE
            while time.monotonic() < end:
                for stamp in sorted(set(tracks) & set(models)):
                    if len(tracks[stamp].tracks[0].poses) == POSES:
                        return tracks[stamp], models[stamp]
                time.sleep(0.05)
        finally:
            player.send_signal(signal.SIGINT)
            player.wait()
            for subscriber in subscribers:
                subscriber.unregister()
        raise AssertionError('%d tracks were played and %d models learned' % (len(tracks), len(models)))


if __name__ == '__main__':
    rospy.init_node('original_logs_test')
    rostest.rosrun('cabinet_articulation', 'original_logs_test', OriginalLogs)

#!/usr/bin/python3
"""A kitchen that is used again and again stays known: scripts/soak.sh in short."""
import subprocess
import tempfile
import unittest

import rostest

MINUTES = 1.5


class Soak(unittest.TestCase):
    def test_door_and_drawer_are_known_all_the_time_and_saved(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(['rosrun', 'cabinet_articulation', 'soak_report', '_minutes:=%s' % MINUTES,
                                  '_file:=%s/soak.yaml' % folder, 'truth:=/stereo/truth', 'models:=/cabinet/models',
                                  'timing:=/cabinet/timing', 'predict:=/cabinet/predict',
                                  'save_models:=/cabinet/save_models'],
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        print(run.stdout)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn('drawer known in', run.stdout)
        self.assertIn('door known in', run.stdout)
        self.assertTrue(run.stdout.endswith('everything held\n'), run.stdout)


if __name__ == '__main__':
    rostest.rosrun('cabinet_articulation', 'soak_test', Soak)

#!/usr/bin/python3
"""The robot runs what was measured: nodelets that get every frame of a bag say the same as process_bag, field by field."""
import subprocess
import tempfile
import unittest

import rospy
import rostest

WHOLE = 0, 75  # first frame and number of frames; 5 s: the front opens and stays for a moment
# From half open to open and back: wherever time jumps back there are tracks, and a joint was learned.
ROUND = 34, 40


def run(*arguments):
    """Exit status and both streams."""
    result = subprocess.run(['rosrun', 'cabinet_articulation', *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            universal_newlines=True)
    print(result.stdout)
    return result.returncode, result.stdout


class Parity(unittest.TestCase):
    def test_nodelets_and_process_bag_say_the_same(self):
        scene, source, motion, rounds = (rospy.get_param('~' + name) for name in ('scene', 'input', 'camera_motion', 'rounds'))
        first, frames = WHOLE if rounds == 1 else ROUND
        with tempfile.TemporaryDirectory() as folder:
            bag = folder + '/scene.bag'
            status, text = run('simulated_bag', scene, bag, '--input', source, '--camera-motion', str(motion), '--first',
                               str(first), '--frames', str(frames), '--rounds', str(rounds))
            self.assertEqual(status, 0, text)
            status, text = run('compare_live.sh', bag, 'out:=' + folder, 'rate:=0.3', 'input:=' + source,
                               'fixed_frame:=' + ('world' if motion else ''))
        self.assertEqual(status, 0, text)
        self.assertIn('all %d frames are there and equal' % (rounds * frames), text)
        self.assertNotIn('nothing moved', text)
        self.assertEqual(text.count('process_bag: time jumped back'), rounds - 1)


if __name__ == '__main__':
    rospy.init_node('parity_test')
    rostest.rosrun('cabinet_articulation', 'parity_test', Parity)

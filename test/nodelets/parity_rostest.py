#!/usr/bin/python3
"""The robot runs what was measured: nodelets that get every frame of a bag say the same as process_bag, field by field."""
import io
import subprocess
import tempfile
import unittest

import rosbag
import rospy
import rostest
from PIL import Image
from sensor_msgs.msg import CompressedImage

WHOLE = 0, 75  # first frame and number of frames; 5 s: the front opens and stays for a moment
# From half open to open and back: wherever time jumps back there are tracks, and a joint was learned. It is also enough for a
# camera at rest with another input than `stereo`: what it enters through differs, and nothing behind.
PART = 34, 40


# What is recorded, and how the pipeline is started on it.
INPUTS = {
    'stereo': ('stereo', ['input:=stereo']),
    'rectified': ('stereo', ['input:=stereo', 'rectified:=true']),
    'compressed': ('stereo', ['input:=stereo', 'image_transport:=compressed']),
    'jpeg': ('stereo', ['input:=stereo', 'image_transport:=compressed']),
    'disparity': ('disparity', ['input:=disparity']),
    'depth': ('depth', ['input:=depth']),
    'millimetres': ('stereo', ['input:=depth', 'camera:=camera', 'depth_image:=depth/image_raw']),
    'compressedDepth': ('stereo', ['input:=depth', 'camera:=camera', 'depth_image:=depth/image_raw',
                                   'image_transport:=compressedDepth']),
}
COMPRESSED = {'compressed': 'png', 'jpeg': 'jpeg', 'compressedDepth': 'png'}  # format of the files


def run(*arguments):
    """Exit status and both streams."""
    result = subprocess.run(['rosrun', 'cabinet_articulation', *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            universal_newlines=True)
    print(result.stdout)
    return result.returncode, result.stdout


def encode(image, file_format):
    """An image of one channel as a file."""
    mode = 'L' if image.encoding == 'mono8' else 'I;16'
    picture = Image.frombytes(mode, (image.width, image.height), bytes(image.data), 'raw', mode, image.step, 1)
    file = io.BytesIO()
    picture.save(file, file_format, compress_level=1)
    return file.getvalue()


def compress(source, target, file_format):
    """The same bag with all images as image_transport's plugin sends them."""
    with rosbag.Bag(source) as read, rosbag.Bag(target, 'w') as written:
        for topic, message, time in read.read_messages():
            if message._type == 'sensor_msgs/Image':
                if message.encoding == '16UC1':
                    topic += '/compressedDepth'
                    # Before the file: the plugin's header, which is for floating point depth only.
                    message = CompressedImage(message.header, '16UC1; compressedDepth', bytes(12) + encode(message, file_format))
                else:
                    topic += '/compressed'
                    description = '%s; %s compressed ' % (message.encoding, file_format)
                    message = CompressedImage(message.header, description, encode(message, file_format))
            written.write(topic, message, time)


class Parity(unittest.TestCase):
    def test_nodelets_and_process_bag_say_the_same(self):
        scene, source, motion, rounds = (rospy.get_param('~' + name) for name in ('scene', 'input', 'camera_motion', 'rounds'))
        first, frames = WHOLE if rounds == 1 and (source == 'stereo' or motion) else PART
        with tempfile.TemporaryDirectory() as folder:
            bag = folder + '/scene.bag'
            recorded, launch = INPUTS[source]
            status, text = run('simulated_bag', scene, bag, '--input', recorded, '--camera-motion', str(motion), '--first',
                               str(first), '--frames', str(frames), '--rounds', str(rounds))
            self.assertEqual(status, 0, text)
            if source in ('millimetres', 'compressedDepth'):
                status, text = run('depth_bag', bag, folder + '/depth.bag')
                self.assertEqual(status, 0, text)
                bag = folder + '/depth.bag'
            if source in COMPRESSED:
                compress(bag, folder + '/compressed.bag', COMPRESSED[source])
                bag = folder + '/compressed.bag'
            status, text = run('compare_live.sh', bag, 'out:=' + folder, 'rate:=0.3', *launch,
                               'fixed_frame:=' + ('world' if motion else ''))
        self.assertEqual(status, 0, text)
        self.assertIn('all %d frames are there and equal' % (rounds * frames), text)
        self.assertNotIn('nothing moved', text)
        self.assertEqual(text.count('process_bag: time jumped back'), rounds - 1)


if __name__ == '__main__':
    rospy.init_node('parity_test')
    rostest.rosrun('cabinet_articulation', 'parity_test', Parity)

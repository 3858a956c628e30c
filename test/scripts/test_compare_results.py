#!/usr/bin/python3
"""What compare_results.py finds equal, and what it names where it does not."""
import copy
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import genpy
import rosbag
from geometry_msgs.msg import Pose, Quaternion
from std_msgs.msg import Header

from cabinet_articulation.msg import ArticulationModel, ArticulationModelArray, Rectangle, RectangleArray
from cabinet_articulation.msg import Timing, Track, TrackArray

SCRIPT = Path(__file__).resolve().parents[2] / 'scripts' / 'compare_results.py'
sys.path.insert(0, str(SCRIPT.parent))
import compare_results  # noqa: E402


def header(second, nanoseconds=0):
    return Header(stamp=genpy.Time(second, nanoseconds), frame_id='world')


def rectangles(second, x=0.25):
    rectangle = Rectangle(width=0.4, height=0.6)
    rectangle.pose.pose.position.x = x
    rectangle.pose.pose.orientation = Quaternion(0.5, -0.5, 0.5, -0.5)
    rectangle.pose.covariance = [1e-6] * 36
    return RectangleArray(header=header(second), rectangles=[rectangle])


def models(second):
    model = ArticulationModel(header=header(second), id=2, probabilities=[0.1, 0.2, 0.7], q=float('nan'), q_max=0.3)
    return ArticulationModelArray(header=header(second), models=[model])


def part(last, observations, first=0, revision=1):
    """A track whose newest observation is `last`, with these of them."""
    return Track(header=header(last), id=3, first=first, revision=revision, stamps=[genpy.Time(i) for i in observations],
                 poses=[Pose(orientation=Quaternion(w=1)) for _ in observations], widths=[0.1 * i for i in observations],
                 covariances=[1e-6 * i for i in observations for _ in range(36)],
                 measured_widths=[0.2 * i for i in observations])


def tracks(second, *parts):
    return TrackArray(header=header(second), tracks=parts)


def whole(count, revision=1):
    """A frame with one track of so many observations."""
    return tracks(count, part(count, range(1, count + 1), 0, revision))


def newest(count, revision=1):
    """The same, with the last observation only."""
    return tracks(count, part(count, [count], count - 1, revision))


def found(live, offline, topic='models'):
    return compare_results.Comparison(topic, live, offline)


class Messages(unittest.TestCase):
    def expect_difference(self, message, change, paths, tolerance=compare_results.TOLERANCE):
        other = copy.deepcopy(message)
        change(other)
        self.assertEqual([entry[0] for entry in compare_results.differences(message, other, tolerance)], paths)

    def test_equal_ones_have_no_difference(self):
        for message in rectangles(1), models(1), whole(3):
            self.expect_difference(message, lambda other: None, [])

    def test_how_often_a_message_was_sent_does_not_matter(self):
        def change(other):
            other.header.seq = 7
            other.models[0].header.seq = 8
        self.expect_difference(models(1), change, [])

    def test_names_a_value_that_is_off_by_little(self):
        def change(other):
            other.rectangles[0].pose.pose.position.x *= 1 + 1e-8
            other.rectangles[0].pose.covariance[7] *= 1 + 1e-8
        names = ['rectangles[0].pose.pose.position.x', 'rectangles[0].pose.covariance[7]']
        self.expect_difference(rectangles(1), change, names)
        self.expect_difference(rectangles(1), change, [], 1e-7)

    def test_allows_rounding(self):
        def change(other):
            other.rectangles[0].pose.pose.position.x *= 1 + 1e-10
            other.rectangles[0].pose.pose.position.y = 1e-13
        self.expect_difference(rectangles(1), change, [])

    def test_small_numbers_count(self):
        def change(other):
            other.rectangles[0].pose.pose.position.y = 1e-11
            other.rectangles[0].pose.covariance[3] += 1e-13
        self.expect_difference(rectangles(1), change, ['rectangles[0].pose.pose.position.y', 'rectangles[0].pose.covariance[3]'])

    def test_nan_equals_nan_only(self):
        def change(other):
            other.models[0].q = 0.0
        self.expect_difference(models(1), change, ['models[0].q'])

    def test_infinity_is_far_from_everything(self):
        self.expect_difference(models(1), lambda other: setattr(other.models[0], 'q_max', float('inf')), ['models[0].q_max'])

    def test_quaternions_have_either_sign(self):
        def turn(sign, error=0):
            def change(other):
                q = other.rectangles[0].pose.pose.orientation
                q.x, q.y, q.z, q.w = (sign * value for value in (q.x, q.y, q.z, q.w))
                q.y += error
            return change
        self.expect_difference(rectangles(1), turn(-1), [])
        self.expect_difference(rectangles(1), turn(-1, 1e-8), ['rectangles[0].pose.pose.orientation.y'])

    def test_lengths_strings_and_whole_numbers_are_exact(self):
        self.expect_difference(models(1), lambda other: other.models[0].probabilities.append(0.0),
                               ['models[0].probabilities (length)'])
        self.expect_difference(models(1), lambda other: other.models.clear(), ['models (length)'])
        self.expect_difference(models(1), lambda other: setattr(other.header, 'frame_id', 'camera'), ['header.frame_id'])
        self.expect_difference(models(1), lambda other: setattr(other.models[0], 'id', 3), ['models[0].id'])
        self.expect_difference(models(1), lambda other: setattr(other.models[0].header, 'stamp', genpy.Time(1, 1)),
                               ['models[0].header.stamp'])


class Frames(unittest.TestCase):
    def test_belong_together_by_their_stamps(self):
        result = found([models(1), models(2), models(4)], [models(2), models(3), models(4)])
        self.assertEqual(result.common, 2)
        self.assertEqual(result.only_live, [(0, 1 * 10**9)])
        self.assertEqual(result.only_offline, [(0, 3 * 10**9)])
        self.assertIsNone(result.first)
        self.assertIn('only offline: 3.000000000', result.text())

    def test_of_a_bag_in_a_loop_are_told_apart(self):
        self.assertEqual(found([models(1), models(2), models(1), models(2)], [models(1), models(2)]).only_live,
                         [(1, 1 * 10**9), (1, 2 * 10**9)])

    def test_the_first_that_differs_is_named(self):
        other = [models(i) for i in range(1, 5)]
        other[1].models[0].q_max = 0.4
        other[3].models[0].q_max = 0.4
        result = found([models(i) for i in range(1, 5)], other)
        self.assertEqual(result.first, ((0, 2 * 10**9), 'models[0].q_max', 0.3, 0.4))
        self.assertEqual((result.fields, len(result.frames)), (2, 2))
        status, text = compare_results.verdict([result], 1e-9, False)
        self.assertEqual(status, 1)
        self.assertEqual(text, 'different: 2 fields in 2 frames; first at 2.000000000 in models: models[0].q_max')

    def test_that_are_missing_are_a_failure_unless_allowed(self):
        result = [found([models(1)], [models(1), models(2)])]
        self.assertEqual(compare_results.verdict(result, 1e-9, False)[0], 1)
        self.assertEqual(compare_results.verdict(result, 1e-9, True)[0], 0)
        self.assertEqual(compare_results.verdict([found([models(1)], [models(2)])], 1e-9, True)[0], 1)


class Tracks(unittest.TestCase):
    def expect(self, live, offline, path=None, gaps=0):
        result = found(live, offline, 'tracks')
        self.assertEqual(result.first and result.first[1], path)
        self.assertEqual(result.gaps, gaps)
        return result

    def test_are_put_together(self):
        self.expect([whole(1), newest(2), newest(3), newest(4)], [whole(1), whole(2), whole(3), whole(4)])

    def test_what_comes_twice_replaces_what_was_there(self):
        again = tracks(3, part(3, [2, 3], 1))
        self.expect([whole(1), newest(2), again], [whole(1), whole(2), whole(3)])

    def test_a_message_may_bring_nothing(self):
        self.expect([whole(2), tracks(3, part(2, [], 2))], [whole(2), tracks(3, part(2, [1, 2]))])

    def test_a_history_that_differs_is_found_when_it_comes(self):
        other = [whole(1), newest(2), newest(3)]
        other[1].tracks[0].covariances[5] = 1.0
        result = self.expect([whole(1), whole(2), whole(3)], other, 'tracks[0].covariances[41]')
        self.assertEqual(len(result.frames), 2, 'it stays in the history')

    def test_a_lost_observation_is_found(self):
        self.expect([whole(1), whole(2)], [whole(1), tracks(2, part(2, [], 1))], 'tracks[0].stamps (length)')

    def test_after_a_gap_the_next_whole_one_counts(self):
        live = [whole(1), newest(3), newest(4), whole(5), newest(6)]
        offline = [whole(1), newest(2), newest(3), newest(4), newest(5), newest(6)]
        result = self.expect(live, offline, gaps=2)
        self.assertEqual(result.only_offline, [(0, 2 * 10**9)])
        self.assertIn('2 times the history of a track was not compared', result.text())

    def test_a_gap_where_nothing_is_missing_is_a_failure(self):
        late = tracks(2, part(2, [2], 2))
        result = self.expect([whole(1), late], [whole(1), newest(2)], gaps=1)
        self.assertEqual(compare_results.verdict([result], 1e-9, False)[0], 1)

    def test_another_revision_needs_a_whole_one(self):
        self.expect([whole(1), newest(2, 2), whole(3, 2)], [whole(1), whole(2, 2), whole(3, 2)], gaps=1)
        self.expect([whole(1), whole(2, 2)], [whole(1), whole(2)], 'tracks[0].revision')

    def test_ends_when_it_is_not_there_any_more(self):
        self.expect([whole(1), tracks(2), newest(3)], [whole(1), tracks(2), whole(3)], gaps=1)


class Bags(unittest.TestCase):
    def run_on(self, live, offline, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            paths = [str(Path(folder) / name) for name in ('live.bag', 'offline.bag')]
            for path, content in zip(paths, (live, offline)):
                with rosbag.Bag(path, 'w') as bag:
                    for topic, message in content:
                        bag.write(topic, message, message.header.stamp)
            run = subprocess.run([sys.executable, str(SCRIPT), *paths, *arguments], stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, universal_newlines=True)
        return run.returncode, run.stdout

    @staticmethod
    def frame(second, ns='cabinet'):
        track = Track(header=header(second), id=1, stamps=[genpy.Time(second)], poses=[Pose()], widths=[0.4], heights=[0.6])
        return [('/%s/rectangles' % ns, rectangles(second)), ('/%s/tracks' % ns, tracks(second, track)),
                ('/%s/models' % ns, models(second))]

    def test_equal(self):
        timing = [('/cabinet/timing', Timing(header=header(1), stage='planes', milliseconds=value)) for value in (3, 5, 40)]
        status, text = self.run_on(self.frame(1) + self.frame(2) + timing, self.frame(1) + self.frame(2))
        self.assertEqual(status, 0, text)
        self.assertTrue(text.startswith('milliseconds live (median): planes 5.0\n'), text)
        self.assertTrue(text.endswith('all 2 frames are there and equal to 1e-09 relative\n'), text)

    def test_a_missing_frame(self):
        status, text = self.run_on(self.frame(1), self.frame(1) + self.frame(2))
        self.assertEqual(status, 1)
        self.assertIn('models: 1 frames in both, 0 only live, 1 only offline; 0 frames differ, in 0 fields', text)
        self.assertEqual(self.run_on(self.frame(1), self.frame(1) + self.frame(2), '--allow-missing')[0], 0)

    def test_another_tolerance_and_namespace(self):
        live = self.frame(1, 'kitchen')
        live[0][1].rectangles[0].width += 1e-8
        status, text = self.run_on(live, self.frame(1), '--ns', 'kitchen')
        self.assertEqual(status, 1)
        self.assertIn('first: at 1.000000000 rectangles[0].width is 0.40000001 live and 0.4 offline', text)
        self.assertEqual(self.run_on(live, self.frame(1), '--ns', 'kitchen', '--tolerance', '1e-6')[0], 0)

    def test_what_is_no_result(self):
        status, text = self.run_on([('/cabinet/models', models(1))], self.frame(1))
        self.assertEqual(status, 2)
        self.assertIn('live.bag has no message on /cabinet/rectangles, /cabinet/tracks', text)


if __name__ == '__main__':
    unittest.main()

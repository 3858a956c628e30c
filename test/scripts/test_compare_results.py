#!/usr/bin/python3
"""What compare_results.py finds equal, and what it names where it does not."""
import copy
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import genpy
import genpy.dynamic
import rosbag
from geometry_msgs.msg import Point, Pose, Quaternion
from std_msgs.msg import Header

from cabinet_articulation.msg import ArticulationModel, ArticulationModelArray, Rectangle, RectangleArray
from cabinet_articulation.msg import Timing, Track, TrackArray

SCRIPT = Path(__file__).resolve().parents[2] / 'scripts' / 'compare_results.py'
sys.path.insert(0, str(SCRIPT.parent))
import compare_results  # noqa: E402


def header(second, nanoseconds=0):
    return Header(stamp=genpy.Time(second, nanoseconds), frame_id='world')


def rectangles(second, x=0.25, y=0.0, quaternion=(0.5, -0.5, 0.5, -0.5), covariance=1e-6):
    rectangle = Rectangle(width=0.4, height=0.6)
    rectangle.pose.pose = Pose(Point(x, y, 0), Quaternion(*quaternion))
    rectangle.pose.covariance = [1e-6] * 7 + [covariance] + [1e-6] * 28
    return RectangleArray(header=header(second), rectangles=[rectangle])


def models(second, **fields):
    """One model, with these fields."""
    usual = dict(header=header(second), id=2, probabilities=[0.1, 0.2, 0.7], q=float('nan'), q_max=0.3)
    return ArticulationModelArray(header=header(second), models=[ArticulationModel(**{**usual, **fields})])


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
    """The same, with the last observation and the one before."""
    return tracks(count, part(count, [count - 1, count], count - 2, revision))


def found(live, offline, topic='models'):
    return compare_results.Comparison(topic, live, offline)


class Messages(unittest.TestCase):
    def expect(self, a, b, *paths, tolerance=compare_results.TOLERANCE):
        self.assertEqual([entry[0] for entry in compare_results.differences(a, b, tolerance)], list(paths))

    def test_equal_ones_have_no_difference(self):
        for message in rectangles(1), models(1), whole(3):
            self.expect(message, copy.deepcopy(message))

    def test_how_often_a_message_was_sent_does_not_matter(self):
        other = models(1)
        other.header.seq, other.models[0].header.seq = 7, 8
        self.expect(models(1), other)

    def test_names_a_value_that_is_off_by_little(self):
        other = rectangles(1, x=0.25 * (1 + 1e-8), covariance=1e-6 * (1 + 1e-8))
        self.expect(rectangles(1), other, 'rectangles[0].pose.pose.position.x', 'rectangles[0].pose.covariance[7]')
        self.expect(rectangles(1), other, tolerance=1e-7)

    def test_allows_rounding(self):
        self.expect(rectangles(1), rectangles(1, x=0.25 * (1 + 1e-10), y=1e-13))

    def test_small_numbers_count(self):
        self.expect(rectangles(1), rectangles(1, y=1e-11, covariance=1e-6 + 1e-13), 'rectangles[0].pose.pose.position.y',
                    'rectangles[0].pose.covariance[7]')

    def test_nan_equals_nan_only(self):
        self.expect(models(1), models(1, q=0.0), 'models[0].q')

    def test_infinity_is_far_from_everything(self):
        self.expect(models(1), models(1, q_max=float('inf')), 'models[0].q_max')

    def test_quaternions_have_either_sign(self):
        self.expect(rectangles(1), rectangles(1, quaternion=(-0.5, 0.5, -0.5, 0.5)))
        self.expect(rectangles(1), rectangles(1, quaternion=(-0.5, 0.5 + 1e-8, -0.5, 0.5)),
                    'rectangles[0].pose.pose.orientation.y')

    def test_lengths_strings_and_whole_numbers_are_exact(self):
        self.expect(models(1), models(1, probabilities=[0.1, 0.2, 0.7, 0.0]), 'models[0].probabilities (length)')
        self.expect(models(1), ArticulationModelArray(header=header(1)), 'models (length)')
        self.expect(models(1), models(1, id=3), 'models[0].id')
        self.expect(models(1), models(1, header=header(1, 1)), 'models[0].header.stamp')
        self.expect(models(1), models(1, header=Header(stamp=genpy.Time(1), frame_id='camera')), 'models[0].header.frame_id')


class Frames(unittest.TestCase):
    def test_belong_together_by_their_stamps(self):
        result = found([models(1), models(2), models(4)], [models(2), models(3), models(4)])
        self.assertEqual(result.common, 2)
        self.assertEqual(result.only_live, [(0, 1 * 10**9)])
        self.assertEqual(result.only_offline, [(0, 3 * 10**9)])
        self.assertIsNone(result.first)
        self.assertIn('only offline: 3.000000000', result.text())

    def test_of_a_bag_in_a_loop_are_told_apart(self):
        self.assertEqual(found([models(1), models(3), models(1), models(3)], [models(1), models(3)]).only_live,
                         [(1, 1 * 10**9), (1, 3 * 10**9)])

    def test_merely_out_of_order_are_of_one_round(self):
        result = found([models(i) for i in (1, 3, 2, 4)], [models(i) for i in range(1, 5)])
        self.assertEqual((result.common, result.only_live, result.only_offline), (4, [], []))
        late = models(1)
        late.header = header(1, 999999999)
        self.assertEqual(list(compare_results.by_frame([models(3), late])), [(0, 3 * 10**9), (1, 1999999999)])

    def test_the_first_that_differs_is_named(self):
        result = found([models(i) for i in range(1, 5)], [models(1), models(2, q_max=0.4), models(3), models(4, q_max=0.4)])
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
        self.expect([whole(2), newest(3), newest(4), newest(5)], [whole(2), whole(3), whole(4), whole(5)])

    def test_what_comes_twice_replaces_what_was_there(self):
        self.expect([whole(2), newest(3), tracks(4, part(4, [2, 3, 4], 1))], [whole(2), whole(3), whole(4)])

    def test_a_message_may_bring_nothing_new(self):
        self.expect([whole(2), tracks(3, part(2, [2], 1))], [whole(2), tracks(3, part(2, [1, 2]))])

    def test_a_history_that_differs_is_found_when_it_comes(self):
        other = [whole(2), whole(3), newest(4)]
        other[1].tracks[0].covariances[41] = 1.0
        result = self.expect([whole(2), newest(3), newest(4)], other, 'tracks[0].covariances[41]')
        self.assertEqual(len(result.frames), 2, 'it stays in the history')

    def test_a_lost_observation_is_found(self):
        self.expect([whole(2), whole(3)], [whole(2), tracks(3, part(3, [2], 1))], 'tracks[0].stamps (length)')

    def test_after_a_gap_the_next_whole_one_counts(self):
        live = [whole(2), newest(4), newest(5), whole(6), newest(7)]
        result = self.expect(live, [whole(2)] + [newest(i) for i in range(3, 8)], gaps=2)
        self.assertEqual(result.only_offline, [(0, 3 * 10**9)])
        self.assertIn('2 times the history of a track was not compared', result.text())

    def test_a_gap_where_nothing_is_missing_is_a_failure(self):
        for late in part(3, [3], 2), part(3, [], 1):
            result = self.expect([whole(2), tracks(3, late)], [whole(2), newest(3)], gaps=1)
            self.assertEqual(compare_results.verdict([result], 1e-9, False)[0], 1)

    def test_a_missed_thinning_is_a_gap(self):
        after = tracks(8, part(8, [7, 8], 4))
        self.expect([whole(6), after], [whole(6), tracks(7, part(7, [1, 3, 5, 6, 7])), after], gaps=1)

    def test_another_revision_needs_a_whole_one(self):
        self.expect([whole(2), newest(3, 2), whole(4, 2)], [whole(2), whole(3, 2), whole(4, 2)], gaps=1)
        self.expect([whole(1), whole(2, 2)], [whole(1), whole(2)], 'tracks[0].revision')

    def test_ends_when_it_is_not_there_any_more(self):
        self.expect([whole(2), tracks(3), newest(4)], [whole(2), tracks(3), whole(4)], gaps=1)


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
        messages = zip(compare_results.TOPICS, (rectangles(second), whole(second), models(second)))
        return [('/%s/%s' % (ns, name), message) for name, message in messages]

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

    def test_a_bag_of_an_older_version(self):
        definition = '\n'.join(line for line in TrackArray._full_text.splitlines() if not line.startswith('uint32 first'))
        old = genpy.dynamic.generate_dynamic(TrackArray._type, definition)
        content = old[TrackArray._type](header=header(1), tracks=[old[Track._type]()])
        status, text = self.run_on([('/cabinet/tracks', content)], self.frame(1))
        self.assertEqual(status, 2)
        self.assertIn('live.bag is of an older version: its tracks have no first', text)


if __name__ == '__main__':
    unittest.main()

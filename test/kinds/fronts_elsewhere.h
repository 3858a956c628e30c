// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core::test {

/// The i-th of some places in a house, none like another.
inline Eigen::Isometry3d place(int i) {
  return Eigen::Translation3d(i, -0.5 * i, 0.2 * i) * Eigen::AngleAxisd(0.7 * i, Eigen::Vector3d(0.1 * i, 0.2, 1).normalized());
}

/// The same, all upright in a room, whose z points up.
inline Eigen::Isometry3d standing(int i) {
  return Eigen::Translation3d(i, -0.5 * i, 0.2 * i) * Eigen::AngleAxisd(0.7 * i, Eigen::Vector3d::UnitZ()) *
         Eigen::Isometry3d(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()));
}

using Place = Eigen::Isometry3d (*)(int);

inline Track moved(Track track, const Eigen::Isometry3d& by) {
  for (TrackedObservation& observation : track.observations) observation.rectangle.pose = by * observation.rectangle.pose;
  return track;
}

/// The front at place(i), opened from 0 to `q_end`.
inline Track trackAt(SyntheticFront front, int i, double q_end, const Place& at = place) {
  front.q_end = q_end;
  front.poses = 60;
  front.seed = static_cast<unsigned>(i + 1);
  return moved(syntheticTrack(front), at(i));
}

inline SyntheticFront doorOf(double width) {
  SyntheticFront front = door();
  front.width = width;
  return front;
}

/// [m] How far the prediction is from the front at `q`, at the nearest of its own openings.
inline double errorAt(const LearnedModel& model, const SyntheticFront& front, int i, double q, const Place& at = place) {
  const Eigen::Isometry3d truth = at(i) * truePose(front, q);
  return (model.predict(model.configuration(truth)).translation() - truth.translation()).norm();
}

}  // namespace cabinet_articulation::core::test

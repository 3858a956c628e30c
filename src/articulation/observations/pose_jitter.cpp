// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/observations/pose_jitter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "articulation/paths/arc.h"
#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kLeastPoses = 10;  ///< for each pose of a step: their median step back tells the noise

/// Over steps of so many poses.
PoseJitter jitterOver(std::size_t lag, std::size_t count, const std::function<Eigen::Isometry3d(std::size_t)>& pose_at) {
  std::vector<double> back, back_turns;
  const std::size_t stride = std::max<std::size_t>(1, count / kJitterTriples);
  for (std::size_t i = lag; i + lag < count; i += stride) {
    const Eigen::Isometry3d before = pose_at(i - lag), here = pose_at(i), after = pose_at(i + lag);
    const Eigen::Vector3d step = here.translation() - before.translation(), next = after.translation() - here.translation();
    const Eigen::Vector3d turn = rotationVector(Eigen::Quaterniond(here.linear() * before.linear().transpose()));
    const Eigen::Vector3d next_turn = rotationVector(Eigen::Quaterniond(after.linear() * here.linear().transpose()));
    back.push_back(stepBack(step, next));
    back_turns.push_back(stepBack(turn, next_turn));
  }
  return {sigmaOfStepsBack(std::move(back)), sigmaOfStepsBack(std::move(back_turns))};
}

}  // namespace

double stepBack(const Eigen::Vector3d& step, const Eigen::Vector3d& next) { return std::sqrt(std::max(0.0, -step.dot(next))); }

double sigmaOfStepsBack(std::vector<double> steps_back) {
  constexpr double kMedian = 1.475;  // measured on Gaussian noise of unit variance in each of three directions
  return 1 / kMedian * median(std::move(steps_back));
}

PoseJitter jitterOf(std::size_t count, const std::function<Eigen::Isometry3d(std::size_t)>& pose_at) {
  PoseJitter jitter;
  for (const std::size_t lag : {1, 2, 4, 8}) {
    if (count < kLeastPoses * lag) break;
    const PoseJitter over = jitterOver(lag, count, pose_at);
    jitter = {std::max(jitter.position, over.position), std::max(jitter.orientation, over.orientation)};
  }
  return jitter;
}

}  // namespace cabinet_articulation::core

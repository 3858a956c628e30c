// SPDX-License-Identifier: BSD-3-Clause
// The intervals that the learner states, on random fronts of any frame rate that rest before, between and after.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "articulation/synthetic_tracks.h"
#include "scores/interval_coverage.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr int kFronts = 200;
constexpr double kStated = 0.95;
constexpr double kRare = 1e-3;  // of correct intervals, this many tests would fail on either side

/// Probability that of n events, each of probability p, at most k happen.
double binomial(int k, int n, double p) {
  double sum = 0;
  for (int i = 0; i <= k; ++i)
    sum +=
        std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * std::log(p) + (n - i) * std::log1p(-p));
  return sum;
}

struct Count {
  int inside = 0, all = 0;

  void add(double of_limit) {
    inside += of_limit <= 1;
    ++all;
  }
  /// Not too few for intervals that hold the truth in `kStated` of the cases, nor, with `no_more`, too many.
  void expectAsStated(const std::string& what, bool no_more) const {
    EXPECT_GT(binomial(inside, all, kStated), kRare) << what << ": only " << inside << " of " << all;
    if (!no_more) return;
    EXPECT_GT(1 - binomial(inside - 1, all, kStated), kRare) << what << ": " << inside << " of " << all;
  }
};

AxisEstimate truthOf(const SyntheticFront& front) {
  AxisEstimate truth;
  truth.type = front.type;
  truth.axis = trueAxis(front);
  truth.axis_point = trueAxisPoint(front);
  truth.center = closedPose().translation();
  truth.radius = front.width / 2;
  return truth;
}

class StatedIntervals : public ::testing::TestWithParam<bool> {};

TEST_P(StatedIntervals, HoldTheTruthAsOftenAsTheySay) {
  std::mt19937 random(17);
  const auto between = [&random](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  Count axes, radii, types;
  for (unsigned seed = 1; seed <= kFronts; ++seed) {
    SyntheticFront front = randomFront(seed);
    const double faster = std::exp2(between(-2, 2));
    front.period /= faster;
    front.poses = static_cast<int>(front.poses * faster);
    // Real noise is slow in part. At 15 Hz it keeps so much of itself from pose to pose.
    front.drift = between(0.001, 0.004);
    front.drift_memory = std::pow(between(0.7, 0.95), 1 / faster);
    const Rests rests{between(0, 10), between(0, 10), between(0, 10)};
    const Track track = syntheticTrack(front, rests);
    const LearnedModel model = learn(GetParam() ? reported(track, front.noise, front.turn_noise) : track);
    if (!model.moved || probability(model, model.type) <= kStated) continue;
    types.add(model.type == front.type ? 0 : 2);
    if (model.type != front.type) continue;
    const IntervalCheck check = checkIntervals(AxisEstimate::of(model), truthOf(front));
    axes.add(check.axis);
    if (check.radius) radii.add(*check.radius);
  }
  EXPECT_GE(types.all, kFronts * 9 / 10);
  EXPECT_GT(binomial(types.inside, types.all, kStated), kRare) << "only " << types.inside << " types of " << types.all;
  // Fronts of a detector may err together by more than these do (ArticulationConfig::sigma_edge).
  axes.expectAsStated("axes", !GetParam());
  radii.expectAsStated("radii", !GetParam());
}

std::string nameOf(const ::testing::TestParamInfo<bool>& info) { return info.param ? "OfADetector" : "OfATracker"; }
INSTANTIATE_TEST_SUITE_P(Poses, StatedIntervals, ::testing::Bool(), nameOf);

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

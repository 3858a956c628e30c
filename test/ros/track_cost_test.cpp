// SPDX-License-Identifier: BSD-3-Clause
// What a frame costs, from the tracker to the models' message, does not grow with the length of its tracks.
#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <algorithm>
#include <chrono>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/known_fronts.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation {
namespace {

constexpr double kFrame = 1.0 / 15;

struct Cost {
  std::uint32_t bytes = 0;
  double milliseconds = 0;
  std::size_t length = 0;  ///< observations of the track
};

/// A door that is opened and closed again and again, seen in every frame by tracker and learner as in the nodelets.
std::vector<Cost> watch(int frames, int max_observations) {
  core::TrackingConfig config;
  config.max_observations = max_observations;
  core::RectangleTracker tracker(config);
  core::TrackUpdates updates;
  core::KnownFronts known;
  core::ArticulationLearner learner{core::ArticulationConfig{}};
  core::NoisyDetector detect(1);
  const std_msgs::Header header;
  std::vector<Cost> costs;
  for (int i = 0; i < frames; ++i) {
    const double stamp = 1000 + i * kFrame, q = 0.6 * (1 - std::cos(0.8 * i * kFrame));
    const std::vector<core::DetectedRectangle> rectangles{detect(core::swung(core::closedFront(), q))};
    const auto start = std::chrono::steady_clock::now();
    const TrackArray message = toMessage(updates.of(tracker.process(stamp, rectangles), stamp), header);
    known.follow(fromMessage(message));
    const std::vector<core::LearnedModel> models = learner.process(known.tracks());
    known.update(models);
    const ArticulationModelArray published = toMessage(models, header);
    const auto end = std::chrono::steady_clock::now();
    costs.push_back({ros::serialization::serializationLength(message),
                     std::chrono::duration<double, std::milli>(end - start).count(),
                     known.tracks().empty() ? 0 : known.tracks()[0].observations.size()});
  }
  return costs;
}

/// Of the frames of three periods of whole tracks from `begin` on.
template <class Value>
Value quantile(const std::vector<Cost>& costs, int begin, double share, Value Cost::*value) {
  std::vector<Value> values;
  for (int i = begin; i < begin + 225; ++i) values.push_back(costs[i].*value);
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double meanBytes(const std::vector<Cost>& costs, int begin) {
  double sum = 0;
  for (int i = begin; i < begin + 225; ++i) sum += costs[i].bytes;
  return sum / 225;
}

TEST(TrackCost, DoesNotGrowWithTheTrack) {
  const std::vector<Cost> costs = watch(3300, 5000);
  EXPECT_EQ(costs[3299].length, 3300u);
  EXPECT_LE(quantile(costs, 3000, 0.97, &Cost::bytes), quantile(costs, 100, 0.5, &Cost::bytes));
  EXPECT_LT(quantile(costs, 3000, 0.5, &Cost::bytes), 2000u);
  // Lower quartiles, for whatever else the machine does; a copy of the track in every frame takes 3 ms.
  EXPECT_LT(quantile(costs, 3000, 0.25, &Cost::milliseconds), 1.5 * quantile(costs, 100, 0.25, &Cost::milliseconds) + 0.2);
  // Whole ones come three times among 225 frames, with 744 bytes for an observation.
  EXPECT_LT(meanBytes(costs, 3000), 2000 + 744.0 * 3300 * 3 / 225);
}

TEST(TrackCost, IsBoundedAsTheHistoryIs) {
  const std::vector<Cost> costs = watch(3300, core::TrackingConfig().max_observations);
  EXPECT_LE(costs[3299].length, 1000u);
  EXPECT_LE(quantile(costs, 3000, 0.97, &Cost::bytes), quantile(costs, 100, 0.5, &Cost::bytes));
  EXPECT_LT(meanBytes(costs, 3000), 2000 + 744.0 * 1000 * 4 / 225) << "one more for the thinned history";
}

}  // namespace
}  // namespace cabinet_articulation

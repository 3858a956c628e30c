// SPDX-License-Identifier: BSD-3-Clause
// What is learned of a front does not depend on how it was recorded.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "articulation/decision/model_selection.h"
#include "articulation/fitting/residual_correlation.h"
#include "articulation/models/model_registry.h"
#include "articulation/observations/observation_history.h"
#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kFronts = 12;
constexpr double kSure = 0.95;

/// Stands for `seconds` at the share `where` of its way.
Track withRest(const SyntheticFront& front, double where, double seconds) {
  SyntheticFront before = front, pause = front, after = front;
  const double q = front.q_start + where * (front.q_end - front.q_start);
  before.q_end = pause.q_start = pause.q_end = after.q_start = q;
  before.poses = static_cast<int>(where * front.poses);
  pause.poses = static_cast<int>(seconds / front.period);
  after.poses = front.poses - before.poses;
  pause.seed += 1000;
  after.seed += 2000;
  Track track = syntheticTrack(before);
  for (const SyntheticFront& part : {pause, after})
    for (TrackedObservation observation : syntheticTrack(part).observations) {
      observation.stamp = track.observations.empty() ? 10 : track.observations.back().stamp + front.period;
      track.observations.push_back(observation);
    }
  return track;
}

class Invariance : public ::testing::TestWithParam<bool> {
 protected:
  /// From a detector that says how certain it is, or from a tracker that does not.
  static Track recorded(const Track& track, const SyntheticFront& front) {
    return GetParam() ? reported(track, front.noise, front.turn_noise) : track;
  }
  static Track recorded(const SyntheticFront& front) { return recorded(syntheticTrack(front), front); }

  /// Where both are sure, they say the same, and hardly less often than the first alone.
  void expectSame(const std::string& what, const std::function<LearnedModel(const SyntheticFront&)>& other) const {
    int sure = 0, also_sure = 0;
    for (unsigned seed = 1; seed <= kFronts; ++seed) {
      const SyntheticFront front = randomFront(seed);
      const LearnedModel a = learn(recorded(front)), b = other(front);
      if (!isSure(a)) continue;
      ++sure;
      EXPECT_EQ(a.type, front.type) << what << ", front " << seed;
      if (!isSure(b)) continue;
      ++also_sure;
      EXPECT_EQ(b.type, front.type) << what << ", front " << seed;
    }
    EXPECT_GE(sure, kFronts - 1);
    EXPECT_GE(also_sure, sure - 1) << what;
  }

  static bool isSure(const LearnedModel& model) {
    return model.moved && model.explained && probability(model, model.type) > kSure;
  }
};

TEST_P(Invariance, OfTheFrameRate) {
  for (const double factor : {0.25, 0.5, 2.0, 4.0})
    expectSame("frame rate times " + std::to_string(factor), [&](SyntheticFront front) {
      front.poses = static_cast<int>(front.poses * factor);
      front.period /= factor;
      return learn(recorded(front));
    });
}

TEST_P(Invariance, OfTheLengthOfARest) {
  for (const double seconds : {5.0, 300.0})
    for (const double where : {0.0, 0.5, 1.0})
      expectSame("rest of " + std::to_string(seconds) + " s at " + std::to_string(where),
                 [&](const SyntheticFront& front) { return learn(recorded(withRest(front, where, seconds), front)); });
}

/// [nats] Odds that a front slides rather than stands still, by all poses of its track.
double oddsOfSliding(const Track& track) {
  const ArticulationConfig config;
  ObservationHistory history(config);
  history.update(track);
  const PoseSequence poses = history.evenlySpaced({}, track.observations.size());
  std::vector<std::unique_ptr<ArticulationModel>> models;
  std::vector<Candidate> candidates;
  for (const ModelEntry& entry : modelRegistry()) {
    if (entry.type != JointType::kRigid && entry.type != JointType::kPrismatic) continue;
    models.push_back(entry.create(config));
    models.back()->fit(poses, WorkBudget::unlimited());
    candidates.push_back(evaluateCandidate(models.back().get(), poses, config));
  }
  return selectModel(&candidates, poses, nullptr, 0, config).log_odds;
}

TEST_P(Invariance, OfTheOddsOfAMotionThatEndsInARest) {
  SyntheticFront front = drawer();
  front.q_end = 0.06;
  front.poses = 30;
  std::vector<double> odds;
  for (const double seconds : {2.0, 4.0, 8.0, 16.0, 32.0})
    odds.push_back(oddsOfSliding(recorded(withRest(front, 1, seconds), front)));
  // Sixteen times the rest tells nothing more of the motion, and little against it.
  EXPECT_GT(odds.front(), std::log(ArticulationConfig().prior.rest_odds));
  for (const double later : odds) EXPECT_GT(later, 0.9 * odds.front());
}

TEST(InformativePoses, AreThoseOfAnEvenMotionAndNotThoseOfARest) {
  std::vector<double> q;
  for (int i = 0; i < 50; ++i) q.push_back(i / 49.0);
  const double moving = informativePoses(q, 0, 1);
  EXPECT_NEAR(moving, 50, 0.05 * 50);
  q.insert(q.end(), 10000, 1.0);
  const double rested = informativePoses(q, 0, 1);
  q.insert(q.end(), 90000, 1.0);
  EXPECT_NEAR(informativePoses(q, 0, 1), rested, 0.01 * rested);
  EXPECT_LT(rested, 4.1 * moving);
  EXPECT_EQ(informativePoses({1, 1, 1}, 1, 1), 1);
}

TEST_P(Invariance, OfTheNumberOfPosesThatAreKept) {
  for (const int poses : {100, 1000})
    expectSame(std::to_string(poses) + " kept poses", [&](SyntheticFront front) {
      front.poses = 400;
      ArticulationConfig config;
      config.poses_max = poses;
      return learn(recorded(front), config);
    });
}

TEST_P(Invariance, OfARigidMotionOfEverything) {
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(3, -5, 1) * Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.8, 0.5).normalized());
  expectSame("moved", [&](const SyntheticFront& front) {
    Track track = syntheticTrack(front);
    for (TrackedObservation& observation : track.observations) observation.rectangle.pose = motion * observation.rectangle.pose;
    return learn(recorded(track, front));
  });
}

TEST_P(Invariance, OfTheDescriptionOfTheRectangle) {
  for (int quarters = 0; quarters < 4; ++quarters)
    for (const bool back : {false, true})
      expectSame(std::to_string(quarters) + " quarters" + (back ? ", from the back" : ""), [&](const SyntheticFront& front) {
        Track track = recorded(front);
        for (TrackedObservation& observation : track.observations) {
          Rectangle& rectangle = observation.rectangle;
          rectangle.pose.rotate(Eigen::AngleAxisd(quarters * M_PI / 2, Eigen::Vector3d::UnitZ()));
          if (back) rectangle.pose.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
          if (quarters % 2) std::swap(rectangle.width, rectangle.height);
        }
        if (quarters % 2) std::swap(track.width, track.height);
        return learn(track);
      });
}

TEST_P(Invariance, OfTheOrderInWhichJointsAreNamed) {
  expectSame("named from the last", [&](const SyntheticFront& front) {
    ArticulationConfig config;
    config.joint_types.clear();
    for (auto entry = modelRegistry().rbegin(); entry != modelRegistry().rend(); ++entry)
      config.joint_types += std::string(config.joint_types.empty() ? "" : " ") + modelName(entry->type);
    return learn(recorded(front), config);
  });
}

std::string nameOf(const ::testing::TestParamInfo<bool>& info) { return info.param ? "OfADetector" : "OfATracker"; }
INSTANTIATE_TEST_SUITE_P(Poses, Invariance, ::testing::Bool(), nameOf);

}  // namespace
}  // namespace cabinet_articulation::core

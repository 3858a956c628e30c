// SPDX-License-Identifier: BSD-3-Clause
// A drawer and a door that are used for a long time stay known, from detections to joints.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/tracking/rectangle_tracker.h"

namespace cabinet_articulation::core {
namespace {

/// How the fronts are used and watched.
struct Use {
  const char* name;
  double minutes, rate;  ///< [min, Hz]
  double period, rest;   ///< [s] an opening and closing takes, and between two
  int poses_max = 200;
};

void PrintTo(const Use& use, std::ostream* out) { *out << use.name; }

Eigen::Isometry3d facing(double x, double y, double z, double turn) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
}

/// A drawer that comes out 28 cm and a door that turns by 1.2 rad about its left edge, with a millimetre of noise.
class Kitchen {
 public:
  explicit Kitchen(const Use& use) : use_(use) {}

  std::vector<DetectedRectangle> at(double t) {
    const double phase = std::fmod(t, use_.period + use_.rest) - use_.rest;
    const double opening = phase < 0 ? 0 : 0.5 - 0.5 * std::cos(2 * M_PI * phase / use_.period);
    const double turn = 1.2 * opening;
    return {seen({facing(0.5, 0.3, 1.5 - 0.28 * opening, 0), 0.4, 0.2}),
            seen({facing(-0.3 + 0.2 * std::cos(turn), 0.1, 1.5 - 0.2 * std::sin(turn), turn), 0.4, 0.6})};
  }

 private:
  DetectedRectangle seen(Rectangle front) {
    DetectedRectangle detection;
    front.pose.pretranslate(Eigen::Vector3d(noise(), noise(), noise()));
    front.width += noise();
    front.height += noise();
    detection.rectangle = front;
    detection.covariance.setZero();
    detection.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    detection.edge_support = {1, 1, 1, 1};
    return detection;
  }

  double noise() { return 1e-3 * normal_(random_); }

  const Use use_;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

class LongUse : public testing::TestWithParam<Use> {};

TEST_P(LongUse, LosesNoJoint) {
  const Use& use = GetParam();
  ArticulationConfig config;
  config.poses_max = use.poses_max;
  RectangleTracker tracker({});
  ArticulationLearner learner(config);
  Kitchen kitchen(use);
  struct Counts {
    int known = 0, since_known = 0, other = 0;
  };
  std::map<std::uint32_t, Counts> counts;
  const int frames = static_cast<int>(use.minutes * 60 * use.rate);
  for (int i = 0; i < frames; ++i) {
    const double t = i / use.rate;
    const std::vector<Track>& tracks = tracker.process(t, kitchen.at(t));
    ASSERT_EQ(tracks.size(), 2u) << t;
    for (const LearnedModel& model : learner.process(tracks)) {
      const bool is_joint = model.moved && model.explained && model.type != JointType::kRigid;
      const JointType truth = model.width * model.height < 0.12 ? JointType::kPrismatic : JointType::kRotational;
      Counts& count = counts[model.id];
      if (is_joint || count.since_known > 0) ++count.since_known;
      count.known += is_joint;
      count.other += is_joint && model.type != truth;
    }
  }
  ASSERT_EQ(counts.size(), 2u);
  for (const auto& [id, count] : counts) {
    EXPECT_GT(count.since_known, 0.7 * frames) << "front " << id << " is known since its first opening";
    EXPECT_GE(count.known, 0.99 * count.since_known) << "front " << id;
    EXPECT_EQ(count.other, 0) << "front " << id << " has another type";
  }
}

// Histories are thinned from 1000 observations on, and fits take fewer poses from 800 on.
INSTANTIATE_TEST_SUITE_P(, LongUse,
                         testing::Values(Use{"Usual", 6, 15, 6, 10}, Use{"WithoutRest", 3, 15, 4, 0},
                                         Use{"LongRests", 6, 15, 8, 60}, Use{"SlowCamera", 6, 5, 6, 10},
                                         Use{"FewPoses", 4, 15, 6, 10, 100}, Use{"FastCamera", 2, 30, 6, 10}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/articulation_learner.h"

#include <gtest/gtest.h>

#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kDegree = M_PI / 180;

TEST(ArticulationLearner, LearnsADoor) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SyntheticFront front = door();
    front.seed = seed;
    const LearnedModel model = learn(syntheticTrack(front));
    EXPECT_TRUE(model.moved);
    EXPECT_TRUE(model.explained);
    EXPECT_GT(probability(model, JointType::kRotational), 0.95) << seed;
    // 100 positions with 3 mm noise leave the bend's depth uncertain by 0.3 mm. Over 69 degrees it is 3.5 cm deep, so that the
    // radius is uncertain by 2 %. Without orientations, the tilt about the chord would be uncertain by 1.6 degrees.
    EXPECT_NEAR(model.radius, 0.2, 0.012) << seed;
    EXPECT_LT(angleBetweenLines(model.axis, trueAxis(front)), 2 * kDegree) << seed;
    EXPECT_GT(model.axis.dot(trueAxis(front)), 0) << "q must grow with the opening";
    EXPECT_LT((model.axis_point - trueAxisPoint(front)).norm(), 0.015) << seed;
    // The noise of the first and the farthest pose, 3 mm at 20 cm, is in the range.
    EXPECT_NEAR(model.q_max, 1.2, 0.08) << seed;
    EXPECT_LT(predictionError(front, model, 0, 1.2), 0.01) << seed;
  }
}

TEST(ArticulationLearner, SaysWhichFrontsWereSeenToBeHollow) {
  Track track = syntheticTrack(door());
  EXPECT_FALSE(learn(track).hollow);
  track.hollow = true;
  EXPECT_TRUE(learn(track).hollow);
}

TEST(ArticulationLearner, LearnsADrawer) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SyntheticFront front = drawer();
    front.seed = seed;
    const LearnedModel model = learn(syntheticTrack(front));
    EXPECT_TRUE(model.moved);
    EXPECT_GT(probability(model, JointType::kPrismatic), 0.95) << seed;
    EXPECT_GT(model.axis.dot(trueAxis(front)), std::cos(0.8 * kDegree)) << seed;
    EXPECT_NEAR(model.q_max, 0.3, 0.01) << seed;
    // q = 0 is where the first pose was seen, which has 3 mm noise.
    EXPECT_LT(predictionError(front, model, 0, 0.3), 0.01) << seed;
    EXPECT_EQ(model.radius, 0);
  }
}

TEST(ArticulationLearner, NothingThatStandsStillMoves) {
  for (const double drift : {0.0, 0.004, 0.007}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      SyntheticFront front = still();
      front.seed = seed;
      front.drift = drift;
      const LearnedModel model = learn(syntheticTrack(front));
      EXPECT_FALSE(model.moved) << drift << " " << seed;
      EXPECT_EQ(model.type, JointType::kRigid) << drift << " " << seed;
    }
  }
}

TEST(ArticulationLearner, PlanesThatTouchABottleHereAndThereDoNotMove) {
  Track track = syntheticTrack(still());
  const Eigen::Vector3d behind = closedPose() * Eigen::Vector3d(0, 0, -0.08);
  const Eigen::Vector3d upright = closedPose().linear().col(1);
  for (size_t i = 0; i < track.observations.size(); ++i) {
    Eigen::Isometry3d& pose = track.observations[i].rectangle.pose;
    const double angle = 0.6 * std::sin(0.1 * static_cast<double>(i));
    pose = Eigen::Translation3d(behind) * Eigen::AngleAxisd(angle, upright) * Eigen::Translation3d(-behind) * pose;
  }
  EXPECT_FALSE(learn(track).moved);
}

TEST(ArticulationLearner, ProbabilitiesSumToOne) {
  for (const SyntheticFront& front : {door(), drawer(), still()}) {
    const LearnedModel model = learn(syntheticTrack(front));
    double sum = 0;
    for (const double p : model.probabilities) sum += p;
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_EQ(model.type, front.type);
  }
}

TEST(ArticulationLearner, SurvivesOutliers) {
  for (SyntheticFront front : {door(), drawer()}) {
    front.outliers = 0.15;
    for (front.seed = 1; front.seed <= 5; ++front.seed) {
      const LearnedModel model = learn(syntheticTrack(front));
      EXPECT_EQ(model.type, front.type) << front.seed;
      EXPECT_TRUE(model.explained);
      EXPECT_LT(angleBetweenLines(model.axis, trueAxis(front)), 4 * kDegree) << front.seed;
    }
  }
}

/// As poses of small markers are: centimetres and ten degrees of noise, and many that are altogether wrong.
TEST(ArticulationLearner, NoiseBelongsToThePosesNotToTheMotion) {
  for (const JointType type : {JointType::kPrismatic, JointType::kRotational})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      SyntheticFront front = type == JointType::kPrismatic ? drawer() : door();
      front.seed = seed;
      front.poses = 300;
      front.noise = 0.02;
      front.turn_noise = 0.15;
      front.outliers = 0.1;
      const LearnedModel model = learn(syntheticTrack(front));
      EXPECT_TRUE(model.moved && model.explained) << seed;
      EXPECT_EQ(model.type, type) << seed;
    }
}

/// A marker's orientation errs by more the farther it is turned from the camera, which looks like a wide door.
TEST(ArticulationLearner, OrientationsThatDriftAlongTheWayMakeNoSureDoor) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SyntheticFront front = drawer();
    front.seed = seed;
    front.poses = 300;
    const Track track = syntheticTrack(
        front, [&](double q) { return truePose(front, q) * Eigen::AngleAxisd(0.2 * q / front.q_end, Eigen::Vector3d::UnitY()); });
    EXPECT_LT(probability(learn(track), JointType::kRotational), 0.95) << seed;
  }
}

TEST(ArticulationLearner, ReportsTheCentreOfTheFrontWhateverItsDescription) {
  const Track track = syntheticTrack(door());
  const LearnedModel reference = learn(track);
  for (int k = 1; k < kDescriptions; ++k) {
    Track other = track;
    for (TrackedObservation& observation : other.observations) observation.rectangle = describe(observation.rectangle, k);
    if (k % 2 == 1) std::swap(other.width, other.height);
    const LearnedModel model = learn(other);
    EXPECT_EQ(model.type, JointType::kRotational);
    EXPECT_NEAR(model.radius, reference.radius, 0.003) << k;
    EXPECT_LT((model.axis_point - reference.axis_point).norm(), 0.005) << k;
    EXPECT_GT(model.axis.dot(reference.axis), std::cos(0.3 * kDegree)) << k;
  }
}

TEST(ArticulationLearner, ClosingAgainChangesNothing) {
  SyntheticFront front = door();
  Track track = syntheticTrack(front);
  const LearnedModel opened = learn(track);
  std::swap(front.q_start, front.q_end);
  front.seed = 2;
  for (TrackedObservation observation : syntheticTrack(front).observations) {
    observation.stamp += 100;
    track.observations.push_back(observation);
  }
  const LearnedModel model = learn(track);
  EXPECT_EQ(model.type, JointType::kRotational);
  EXPECT_NEAR(model.q, 0, 0.05);
  EXPECT_NEAR(model.q_max, opened.q_max, 0.05);
  EXPECT_NEAR(model.radius, opened.radius, 0.004);
}

TEST(ArticulationLearner, AnUpdateAgreesWithAFreshFit) {
  const Track whole = syntheticTrack(door());
  ArticulationLearner learner({});
  Track grown = whole;
  LearnedModel model;
  for (std::size_t n = 1; n <= whole.observations.size(); ++n) {
    grown.observations.assign(whole.observations.begin(), whole.observations.begin() + static_cast<std::ptrdiff_t>(n));
    model = learner.process({grown}).at(0);
  }
  const LearnedModel fresh = learn(whole);
  EXPECT_EQ(model.type, fresh.type);
  EXPECT_NEAR(model.radius, fresh.radius, 0.003);
  EXPECT_LT((model.axis_point - fresh.axis_point).norm(), 0.004);
}

TEST(ArticulationLearner, TheSameInputGivesTheSameOutput) {
  const Track track = syntheticTrack(door());
  const LearnedModel a = learn(track), b = learn(track);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.probabilities, b.probabilities);
}

TEST(ArticulationLearner, ForgetsTracksThatAreGone) {
  Track first = syntheticTrack(door()), second = syntheticTrack(drawer());
  first.id = 9;
  second.id = 3;
  ArticulationLearner learner({});
  const std::vector<LearnedModel> both = learner.process({first, second});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].id, 3u);
  EXPECT_EQ(both[1].id, 9u);
  EXPECT_EQ(learner.process({first}).size(), 1u);
  EXPECT_TRUE(learner.process({}).empty());
}

TEST(ArticulationLearner, DoorsThatTurnALittleAreTold) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SyntheticFront front = door();
    front.q_end = 0.6;
    front.drift = 0.003;
    front.seed = seed;
    EXPECT_GT(probability(learn(syntheticTrack(front)), JointType::kRotational), 0.95) << seed;
  }
}

TEST(ArticulationLearner, DoorsTurnAlthoughTheyHardlyGoAnywhere) {
  SyntheticFront front = door();
  front.width = 0.3;
  front.q_end = 0.35;
  front.noise = 0.004;
  front.drift = 0.004;
  front.turn_noise = 0.005;  // far less than fits believe
  for (front.seed = 1; front.seed <= 20; ++front.seed)
    EXPECT_GT(probability(learn(syntheticTrack(front)), JointType::kRotational), 0.95) << front.seed;
}

TEST(ArticulationLearner, DoorsThatSlideWithinTheirPlaneAreTold) {
  SyntheticFront front = still();
  front.noise = 0.002;
  for (const double length : {0.2, 0.6})
    for (front.seed = 1; front.seed <= 10; ++front.seed) {
      Track track = syntheticTrack(front);
      for (std::size_t i = 0; i < track.observations.size(); ++i)
        track.observations[i].rectangle.pose.pretranslate(length * i / 99 * closedPose().linear().col(0));
      EXPECT_GT(probability(learn(reported(track, 0.002, 0.01)), JointType::kPrismatic), 0.95) << length << " " << front.seed;
    }
}

TEST(ArticulationLearner, IntervalsHoldTheTruth) {
  constexpr int kFronts = 100;
  int axes = 0, radii = 0;
  for (int seed = 1; seed <= kFronts; ++seed) {
    SyntheticFront front = door();
    front.drift = 0.003;
    front.drift_memory = 0.9;
    front.noise = 0.002;
    front.seed = static_cast<unsigned>(seed);
    const LearnedModel model = learn(syntheticTrack(front));
    Eigen::Matrix<double, 3, 2> across;
    across.col(0) = model.axis.unitOrthogonal();
    across.col(1) = model.axis.cross(across.col(0));
    const Eigen::Vector2d tilt = across.transpose() * model.axis.cross(trueAxis(front));
    const Eigen::Matrix2d variance = across.transpose() * model.covariance.bottomRightCorner<3, 3>() * across;
    axes += tilt.dot(variance.inverse() * tilt) <= 5.99;
    const Eigen::Vector3d outward = (model.origin.translation() - model.axis_point).normalized();
    const double sigma = std::sqrt(outward.dot(model.covariance.topLeftCorner<3, 3>() * outward));
    radii += std::abs(model.radius - front.width / 2) <= 1.96 * sigma;
  }
  // 90 to 98 % are meant; a hundred fronts tell a share to 3 %.
  EXPECT_GE(axes, 87);
  EXPECT_GE(radii, 87);
  EXPECT_LE(axes + radii, 199) << "intervals so wide say nothing";
}

TEST(FitAllModels, BestFirst) {
  const std::vector<LearnedModel> models = fitAllModels(syntheticTrack(drawer()), {});
  ASSERT_EQ(models.size(), 3u) << "a drawer does not turn: no screw";
  EXPECT_EQ(models[0].type, JointType::kPrismatic);
  EXPECT_GE(probability(models[1], models[1].type), probability(models[2], models[2].type));
  EXPECT_TRUE(fitAllModels(Track{}, {}).empty());
}

}  // namespace
}  // namespace cabinet_articulation::core

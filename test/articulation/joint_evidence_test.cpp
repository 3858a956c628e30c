// SPDX-License-Identifier: BSD-3-Clause
// What keeps a joint that is established, and what makes it given up.
#include "articulation/decision/joint_evidence.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <random>

#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

/// A front that is watched frame by frame.
class Watched {
 public:
  explicit Watched(const SyntheticFront& front, double rate = 15, const ArticulationConfig& config = {})
      : learner(config), front_(front), period_(1 / rate) {
    track_.id = 7;
    track_.width = front.width;
    track_.height = front.height;
  }

  /// Shows it where `pose` says, with a millimetre of noise.
  LearnedModel see(const Eigen::Isometry3d& pose, double after = 0) {
    TrackedObservation observation;
    observation.stamp = stamp_ += after > 0 ? after : period_;
    observation.rectangle = {pose, front_.width, front_.height};
    observation.rectangle.pose.pretranslate(1e-3 * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_)));
    observation.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    track_.observations.push_back(observation);
    return model_ = learner.process({track_}).at(0);
  }

  LearnedModel rest(double q, int frames) {
    for (int i = 0; i < frames; ++i) see(truePose(front_, q));
    return model_;
  }

  LearnedModel move(double from, double to, int frames) {
    for (int i = 1; i <= frames; ++i) see(truePose(front_, from + (to - from) * i / frames));
    return model_;
  }

  const LearnedModel& model() const { return model_; }
  Track& track() { return track_; }

  ArticulationLearner learner;

 private:
  SyntheticFront front_;
  const double period_;  ///< [s]
  Track track_;
  LearnedModel model_;
  double stamp_ = 10;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

bool isA(JointType type, const LearnedModel& model) { return model.moved && model.explained && model.type == type; }

TEST(JointEvidence, IsThereOnceAFrontOpenedAndStaysAtRest) {
  for (const SyntheticFront& front : {door(), drawer()}) {
    Watched watched(front);
    watched.rest(0, 15);
    const LearnedModel opened = watched.move(0, front.q_end, 30);
    ASSERT_TRUE(isA(front.type, opened));
    EXPECT_GE(opened.support, 10);
    EXPECT_EQ(opened.doubt, 0);
    const LearnedModel rested = watched.rest(front.q_end, 300);
    EXPECT_TRUE(isA(front.type, rested));
    EXPECT_LE(rested.support, opened.support + 2) << "rest supports nothing";
    EXPECT_EQ(rested.doubt, 0);
  }
}

TEST(JointEvidence, OfOneOpeningIsFoundAfterAnyRest) {
  for (const SyntheticFront& front : {door(), drawer()}) {
    Watched watched(front);
    watched.rest(0, 900);
    watched.move(0, front.q_end / 2, 60);
    const LearnedModel opened = watched.move(front.q_end / 2, front.q_end, 30);
    EXPECT_TRUE(isA(front.type, opened)) << int(front.type);
    EXPECT_GT(opened.support, 10);
  }
}

TEST(JointEvidence, DoesNotFallWithAFewFalseDetections) {
  Watched watched(drawer());
  watched.rest(0, 15);
  watched.move(0, 0.3, 30);
  const Eigen::Isometry3d elsewhere = Eigen::Translation3d(0.2, 0.1, 0) * truePose(drawer(), 0.3);
  double most = 0;
  for (int i = 0; i < 60; ++i) {
    const LearnedModel model = watched.see(i % 10 < 3 ? elsewhere : truePose(drawer(), 0.3));
    ASSERT_TRUE(isA(JointType::kPrismatic, model)) << i;
    most = std::max(most, model.doubt);
  }
  EXPECT_GT(most, 0) << "it is doubted meanwhile";
  EXPECT_EQ(watched.model().doubt, 0) << "and believed again";
}

TEST(JointEvidence, IsOutweighedByAsManyContraryPoses) {
  // A chair that was pushed once, stood for a minute, and is pushed another way.
  SyntheticFront chair = drawer();
  chair.height = 0.4;
  Watched watched(chair);
  watched.rest(0, 15);
  const LearnedModel pushed = watched.move(0, 0.3, 20);
  ASSERT_TRUE(isA(JointType::kPrismatic, pushed));
  watched.rest(0.3, 900);
  ASSERT_TRUE(isA(JointType::kPrismatic, watched.model()));
  const Eigen::Isometry3d there = truePose(chair, 0.3);
  int contrary = 0;
  while (isA(JointType::kPrismatic, watched.model()) && watched.model().doubt < 1 && contrary < 100) {
    const double way = 0.05 + 0.02 * ++contrary;
    watched.see(Eigen::Translation3d(way, 0, 0) * there * Eigen::AngleAxisd(0.8 * way, Eigen::Vector3d::UnitX()));
  }
  EXPECT_GT(contrary, 5);
  EXPECT_LE(contrary, 20) << "frames in which it was pushed first";
  EXPECT_EQ(watched.model().doubt, 1);
}

TEST(JointEvidence, OfAnArmIsOutweighedToo) {
  // A forearm that reaches forward is a plane that slides; then it turns away.
  SyntheticFront arm = drawer();
  arm.width = 0.35;
  arm.height = 0.1;
  Watched watched(arm);
  watched.move(0, 0.2, 25);
  ASSERT_TRUE(isA(JointType::kPrismatic, watched.model()));
  const Eigen::Isometry3d there = truePose(arm, 0.2);
  for (int i = 1; i <= 25; ++i)
    watched.see(Eigen::Translation3d(0.012 * i, 0.008 * i, 0) * there *
                Eigen::AngleAxisd(0.03 * i, Eigen::Vector3d(1, 1, 0.5).normalized()));
  EXPECT_FALSE(isA(JointType::kPrismatic, watched.model()) && watched.model().doubt < 1);
}

TEST(JointEvidence, GrowsWithTheWayAndNotWithUseOrFrames) {
  double support[2] = {};
  for (const int rate : {5, 30}) {
    Watched watched(drawer(), rate);
    watched.rest(0, 2 * rate);
    for (int use = 0; use < 10; ++use) {
      watched.move(0, 0.3, 2 * rate);
      watched.move(0.3, 0, 2 * rate);
      if (use == 0) support[0] = watched.model().support;
    }
    support[1] = watched.model().support;
    EXPECT_GE(support[1], 10) << rate;
    EXPECT_LE(support[1], 36) << rate << ": centimetres of the way, and some";
    EXPECT_LE(support[1], 1.6 * support[0]) << rate;
  }
}

TEST(JointEvidence, IsNotOutweighedByAFalsePlaceHoweverLongItIsSeen) {
  for (const int rate : {5, 30}) {
    Watched watched(drawer(), rate);
    watched.rest(0, 2 * rate);
    watched.move(0, 0.12, 2 * rate);
    const Eigen::Isometry3d beside = Eigen::Translation3d(0.15, 0, 0) * truePose(drawer(), 0.12);
    for (int i = 0; i < rate; ++i) ASSERT_TRUE(isA(JointType::kPrismatic, watched.see(beside))) << rate << " Hz, frame " << i;
    EXPECT_GT(watched.model().doubt, 0);
    EXPECT_EQ(watched.rest(0.12, 5).doubt, 0);
  }
}

TEST(JointEvidence, OfTheFirstCentimetresOfADoorIsCorrected) {
  SyntheticFront front = door();
  front.width = 0.6;
  Watched watched(front);
  watched.rest(0, 60);
  watched.move(0, 0.16, 40);
  const LearnedModel first = watched.rest(0.16, 60);
  ASSERT_TRUE(first.moved);
  // As if the line had been believed.
  LearnedModel line = first;
  line.type = JointType::kPrismatic;
  line.axis = truePose(front, 0.08).linear().col(2);
  line.support = 16;
  watched.learner.remember({line});
  ASSERT_TRUE(isA(JointType::kPrismatic, watched.see(truePose(front, 0.16))) || isA(JointType::kRotational, watched.model()));
  const LearnedModel opened = watched.move(0.16, 1.2, 60);
  EXPECT_TRUE(isA(JointType::kRotational, opened));
  EXPECT_LT(angleBetweenLines(opened.axis, trueAxis(front)), 0.02);
}

TEST(JointEvidence, OutlivesItsTrack) {
  Watched watched(door());
  watched.rest(0, 15);
  watched.move(0, 1.2, 40);
  ASSERT_TRUE(isA(JointType::kRotational, watched.model()));
  const LearnedModel known = watched.model();
  watched.learner.process({});
  // The front comes back with two poses of its history left.
  watched.track().observations = {watched.track().observations.front(), watched.track().observations.back()};
  const LearnedModel back = watched.see(truePose(door(), 0.6), 100);
  EXPECT_TRUE(isA(JointType::kRotational, back));
  EXPECT_NEAR(back.q, 0.6, 0.05);
  EXPECT_LT(angleBetweenLines(back.axis, known.axis), 0.02);
  EXPECT_GE(back.support, known.support);
}

TEST(JointEvidence, IsRememberedAndForgotten) {
  Watched earlier(door());
  earlier.rest(0, 15);
  const LearnedModel known = earlier.move(0, 1.2, 40);
  for (const bool forgotten : {false, true}) {
    Watched later(door());
    later.learner.remember({known});
    if (forgotten) later.learner.forget(known.id);
    EXPECT_EQ(isA(JointType::kRotational, later.see(truePose(door(), 0.6), 1e5)), !forgotten);
  }
  Watched doubting(door());
  LearnedModel given_up = known;
  given_up.doubt = 1;
  doubting.learner.remember({given_up});
  const LearnedModel seen = doubting.see(truePose(door(), 0.6), 1e5);
  EXPECT_FALSE(seen.moved);
  EXPECT_EQ(seen.doubt, 1) << "until something else is found";
}

TEST(JointEvidence, ThatIsDoubtedIsRememberedSoAndThenGivenUp) {
  Watched earlier(drawer());
  earlier.rest(0, 15);
  LearnedModel known = earlier.move(0, 0.3, 40);
  known.doubt = 0.5;
  Watched later(drawer());
  later.learner.remember({known});
  const Eigen::Isometry3d there = truePose(drawer(), 0.3);
  EXPECT_NEAR(later.see(there).doubt, 0.5, 0.1);
  int contrary = 0;
  while (later.model().doubt < 1 && contrary < 100)
    later.see(Eigen::Translation3d(0.02 * ++contrary, 0, 0) * there * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
  EXPECT_LE(contrary, 12) << "half of what it takes";
  EXPECT_EQ(later.model().observations, contrary) << "learned anew from what contradicts";
}

/// A door that is opened and then lifted off its hinges: no joint does both.
TEST(JointEvidence, OfHalfOfAMotionIsNotSure) {
  const SyntheticFront opened = door();
  Watched watched(opened);
  watched.move(0, opened.q_end, 25);
  ASSERT_TRUE(isA(JointType::kRotational, watched.model()));
  const Eigen::Isometry3d there = truePose(opened, opened.q_end);
  LearnedModel model;
  for (int i = 1; i <= 30; ++i) model = watched.see(Eigen::Translation3d(0.012 * i * there.linear().col(1)) * there);
  for (const JointType type : {JointType::kPrismatic, JointType::kRotational})
    EXPECT_LT(probability(model, type), 0.5) << static_cast<int>(type);
  EXPECT_GT(probability(model, JointType::kNonparametric), 0.5);
  double sum = 0;
  for (const double p : model.probabilities) sum += p;
  EXPECT_NEAR(sum, 1, 1e-9);
  // The tracker knows the size better and places the history anew.
  ++watched.track().revision;
  const LearnedModel placed_anew = watched.see(Eigen::Translation3d(0.36 * there.linear().col(1)) * there);
  EXPECT_GT(probability(placed_anew, JointType::kNonparametric), 0.5);
  // What is seen of the other half alone outweighs that in the end.
  for (int use = 0; use < 4; ++use)
    for (int i = 30; i >= 1; --i) model = watched.see(Eigen::Translation3d(0.012 * i * there.linear().col(1)) * there);
  EXPECT_TRUE(isA(JointType::kPrismatic, model));
  EXPECT_GT(probability(model, JointType::kPrismatic), 0.95);
}

/// Probabilities are those of the types that were asked for.
TEST(JointEvidence, OfHalfOfAMotionGivesNothingToACurveThatIsNotAskedFor) {
  const SyntheticFront opened = door();
  ArticulationConfig config;
  config.joint_types = "rigid prismatic rotational";
  Watched watched(opened, 15, config);
  watched.move(0, opened.q_end, 25);
  const Eigen::Isometry3d there = truePose(opened, opened.q_end);
  LearnedModel model;
  for (int i = 1; i <= 30; ++i) model = watched.see(Eigen::Translation3d(0.012 * i * there.linear().col(1)) * there);
  EXPECT_FALSE(model.explained);
  EXPECT_EQ(probability(model, JointType::kNonparametric), 0);
  EXPECT_NEAR(std::accumulate(model.probabilities.begin(), model.probabilities.end(), 0.0), 1, 1e-9);
}

/// Nor does a rest on the way of the second half make it sure, however long it is and however often the front is seen.
TEST(JointEvidence, OfHalfOfAMotionIsNotSureAfterALongRest) {
  const SyntheticFront opened = door();
  for (const int rate : {5, 60}) {
    Watched watched(opened, rate);
    watched.move(0, opened.q_end, 2 * rate);
    ASSERT_TRUE(isA(JointType::kRotational, watched.model()));
    const Eigen::Isometry3d there = truePose(opened, opened.q_end);
    const auto lifted = [&](double way) { return Eigen::Translation3d(way * there.linear().col(1)) * there; };
    for (int i = 1; i <= 2 * rate; ++i) watched.see(lifted(0.36 * i / (2 * rate)));
    for (int i = 0; i < 60 * rate; ++i) watched.see(lifted(0.36));
    EXPECT_LT(probability(watched.model(), JointType::kPrismatic), 0.5) << rate << " Hz";
  }
}

TEST(JointEvidence, NeedsNoModelThatStandsStill) {
  ArticulationConfig config;
  config.joint_types = "prismatic rotational nonparametric";
  SyntheticFront front = drawer();
  front.noise = 0.001;
  EXPECT_GT(learn(reported(syntheticTrack(front), 0.001, 0.01), config).support, 0);
}

TEST(JointEvidence, DoesNotChangeWhenTheHistoryIsThinned) {
  Watched watched(drawer());
  watched.rest(0, 30);
  watched.move(0, 0.3, 40);
  watched.rest(0.3, 30);
  const LearnedModel before = watched.model();
  std::vector<TrackedObservation>& all = watched.track().observations;
  std::vector<TrackedObservation> kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i == 0 || i + 10 > all.size() || i % 4 == 0) kept.push_back(all[i]);
  all = kept;
  const LearnedModel after = watched.see(truePose(drawer(), 0.3));
  EXPECT_TRUE(isA(JointType::kPrismatic, after));
  EXPECT_EQ(after.observations, static_cast<int>(kept.size()) + 1);
  EXPECT_NEAR(after.support, before.support, 1);
  EXPECT_LT(angleBetweenLines(after.axis, before.axis), 0.01);
}

}  // namespace
}  // namespace cabinet_articulation::core

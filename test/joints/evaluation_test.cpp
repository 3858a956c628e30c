// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/evaluation.h"

#include <gmock/gmock.h>

#include <cmath>

#include "articulation/synthetic_tracks.h"
#include "support/models.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::ThrowsSaying;
using testing::HasSubstr;

constexpr int kPoses = 60;

/// Observations of a joint from q = 0 to q_max, `off` away in the front's frame, with noise of `noise` [m].
Track trackOf(const LearnedModel& truth, double noise = 0, const Eigen::Vector3d& off = Eigen::Vector3d::Zero()) {
  SyntheticFront front;
  front.poses = kPoses;
  front.noise = noise;
  front.turn_noise = 3 * noise;
  front.q_end = truth.q_max;
  front.width = truth.width;
  front.height = truth.height;
  return syntheticTrack(front, [&](double q) { return truth.predict(q) * Eigen::Translation3d(off); });
}

double logLikelihood(const LearnedModel& model, const Track& track) { return evaluateOnTrack(model, track, {}).log_likelihood; }

TEST(EvaluateOnTrack, TheTruthHasNoResidualsAndTheTrueOpenings) {
  for (const LearnedModel& truth : {test::doorModel(), test::drawerModel(), test::garageModel()}) {
    const Track track = trackOf(truth);
    const TrackEvaluation evaluation = evaluateOnTrack(truth, track, {});
    ASSERT_EQ(evaluation.nearest.size(), track.observations.size());
    ASSERT_EQ(evaluation.projected.size(), track.observations.size());
    for (std::size_t i = 0; i < evaluation.nearest.size(); ++i) {
      EXPECT_NEAR(evaluation.nearest[i].q, truth.q_max * static_cast<double>(i) / (kPoses - 1), 1e-6);
      EXPECT_NEAR(evaluation.nearest[i].position_residual, 0, 1e-6);
      EXPECT_NEAR(evaluation.nearest[i].orientation_residual, 0, 1e-6);
      EXPECT_TRUE(evaluation.projected[i].isApprox(track.observations[i].rectangle.pose, 1e-6));
    }
    EXPECT_NEAR(evaluation.position_error, 0, 1e-6);
    EXPECT_EQ(evaluation.outlier_ratio, 0);
  }
}

TEST(EvaluateOnTrack, ResidualsAreTheDistanceFromThePath) {
  // Along the height, which is the door's axis, so that q stays as it is. 5 cm are 5 sigma_position.
  const TrackEvaluation evaluation = evaluateOnTrack(test::doorModel(), trackOf(test::doorModel(), 0, {0, 0.05, 0}), {});
  for (const NearestConfiguration& nearest : evaluation.nearest) EXPECT_NEAR(nearest.position_residual, 0.05, 1e-9);
  EXPECT_NEAR(evaluation.position_error, 0.05, 1e-9);
  EXPECT_NEAR(evaluation.outlier_ratio, 1, 1e-9);
}

TEST(EvaluateOnTrack, ASigmaAcrossCostsHalfANatEachPose) {
  const double at_truth = logLikelihood(test::doorModel(), trackOf(test::doorModel()));
  const double off = logLikelihood(test::doorModel(), trackOf(test::doorModel(), 0, {0, ArticulationConfig().sigma_position, 0}));
  EXPECT_NEAR(at_truth - off, kPoses / 2.0, 0.5);
}

TEST(EvaluateOnTrack, TheTrueJointIsFarMoreLikelyThanOthers) {
  const Track door = trackOf(test::doorModel(), 0.003), drawer = trackOf(test::drawerModel(), 0.003);
  LearnedModel rigid = test::restingModel();
  rigid.origin = test::doorModel().origin;
  LearnedModel slides = test::drawerModel();
  slides.origin = test::doorModel().origin;
  EXPECT_GT(logLikelihood(test::doorModel(), door), logLikelihood(rigid, door) + 100);
  EXPECT_GT(logLikelihood(test::doorModel(), door), logLikelihood(slides, door) + 100);
  EXPECT_GT(logLikelihood(test::drawerModel(), drawer), logLikelihood(test::doorModel(), drawer) + 100);
}

TEST(EvaluateOnTrack, AgreesWithWhatTheLearnerSaysOfItsOwnModels) {
  // A marker is fitted at its own place, as evaluated here, and 60 poses are all used.
  LearnedModel marker = test::doorModel();
  marker.width = marker.height = 0;
  const Track track = trackOf(marker, 0.003);
  const std::vector<LearnedModel> models = fitAllModels(track, {});
  ASSERT_GE(models.size(), 3U);
  for (const LearnedModel& model : models) {
    const TrackEvaluation evaluation = evaluateOnTrack(model, track, {});
    for (const ModelParam& param : model.params) {
      // A learned joint weighs place and turn alike wherever it is asked, a fit as its own noise says; and the way of a free
      // curve is kept as some of its poses.
      const double tolerance = model.type == JointType::kNonparametric ? 1 : 0.1;
      if (param.name == "loglikelihood") {
        EXPECT_NEAR(evaluation.log_likelihood, param.value, tolerance);
      }
    }
    EXPECT_NEAR(evaluation.position_error, model.position_error, 1e-3 * model.position_error + 1e-5);
  }
}

TEST(EvaluateOnTrack, RefusesWhatHasNoShape) {
  const Track track = trackOf(test::doorModel());
  LearnedModel no_axis = test::doorModel();
  no_axis.axis.setZero();
  EXPECT_THAT([&] { evaluateOnTrack(no_axis, track, {}); },
              ThrowsSaying<ModelError>(HasSubstr("the model is rotational, and its axis has the length 0.000000, expected 1")));
  LearnedModel no_curve = test::garageModel();
  no_curve.curve.resize(1);
  EXPECT_THAT([&] { evaluateOnTrack(no_curve, track, {}); }, ThrowsSaying<ModelError>(HasSubstr("expected 4 poses or more")));
  LearnedModel long_curve = test::garageModel();
  long_curve.curve.resize(kMostCurvePoses + 1, long_curve.origin);
  EXPECT_THAT([&] { evaluateOnTrack(long_curve, track, {}); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("there are 101 poses in curve, expected 100 at most")));
  EXPECT_THAT([&] { evaluateOnTrack(test::doorModel(), {}, {}); }, ThrowsSaying<ModelError>(HasSubstr("no pose of the track")));
}

TEST(TakenAsJoint, AnswersWhateverItSaysOfItsObservations) {
  LearnedModel door = test::doorModel();
  door.moved = false;
  door.explained = false;
  door.doubt = 1;
  EXPECT_TRUE(predictWithCovariance(takenAsJoint(door), 0.5).pose.isApprox(door.predict(0.5)));
  EXPECT_THAT([] { takenAsJoint(test::restingModel()); }, ThrowsSaying<ModelError>(HasSubstr("the model is rigid")));
}

}  // namespace
}  // namespace cabinet_articulation::core

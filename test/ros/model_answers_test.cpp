// SPDX-License-Identifier: BSD-3-Clause
#include "ros/answers/model_answers.h"

#include <gmock/gmock.h>

#include <cmath>

#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "joints/learned_fronts.h"
#include "support/throws_saying.h"

namespace cabinet_articulation {
namespace {

using test::ThrowsSaying;
using testing::Each;
using testing::HasSubstr;

EvaluateModel::Request evaluationOf(const core::LearnedModel& model) {
  const core::KnownFront front = test::learned(model);
  EvaluateModel::Request request;
  request.model = toMessage(front.model, "map");
  request.track = toMessage(front.track, "map");
  return request;
}

ProjectPoses::Request posesOf(const core::LearnedModel& model, const std::vector<double>& q) {
  ProjectPoses::Request request;
  request.model = toMessage(model, "map");
  for (const double at : q) request.poses.push_back(toMessage(model.predict(at)));
  return request;
}

TEST(EvaluateModelAnswer, HasAnEntryForEachPoseOfTheTrack) {
  const EvaluateModel::Request request = evaluationOf(test::doorModel());
  const EvaluateModel::Response answer = evaluateModel(request, {});
  ASSERT_EQ(answer.q.size(), 20U);
  for (std::size_t i = 0; i < answer.q.size(); ++i) {
    EXPECT_NEAR(answer.q[i], 1.2 * static_cast<double>(i) / 19, 1e-9);
    EXPECT_TRUE(fromMessage(answer.projected[i]).isApprox(fromMessage(request.track.poses[i]), 1e-9));
  }
  EXPECT_THAT(answer.position_residuals, Each(testing::Lt(1e-9)));
  EXPECT_THAT(answer.orientation_residuals, Each(testing::Lt(1e-6)));
  EXPECT_TRUE(std::isfinite(answer.log_likelihood));
}

TEST(EvaluateModelAnswer, ARigidOneIsEvaluatedToo) {
  EvaluateModel::Request request = evaluationOf(test::drawerModel());
  const double drawer = evaluateModel(request, {}).log_likelihood;
  request.model.type = ArticulationModel::RIGID;
  const EvaluateModel::Response answer = evaluateModel(request, {});
  EXPECT_THAT(answer.q, Each(0));
  EXPECT_NEAR(answer.position_residuals.back(), 0.3, 1e-9) << "how far the drawer came out";
  EXPECT_LT(answer.log_likelihood, drawer - 20);
}

TEST(EvaluateModelAnswer, RefusalsNameThePart) {
  EvaluateModel::Request request = evaluationOf(test::doorModel());
  request.track.poses[2].position.x = std::nan("");
  EXPECT_THAT([&] { evaluateModel(request, {}); }, ThrowsSaying<std::invalid_argument>(HasSubstr("track: poses[2]: position")));
  request = evaluationOf(test::doorModel());
  request.track.first = 3;
  EXPECT_THAT([&] { evaluateModel(request, {}); }, ThrowsSaying<std::invalid_argument>(HasSubstr("a whole track")));
  request.model.type = 77;
  EXPECT_THAT([&] { evaluateModel(request, {}); }, ThrowsSaying<std::invalid_argument>(HasSubstr("model: type is 77")));
  request.model.header.frame_id = "odom";
  EXPECT_THAT([&] { evaluateModel(request, {}); },
              ThrowsSaying<std::invalid_argument>("the model is in the frame 'odom' and the track in 'map'"));
}

TEST(AnswersAboutAModel, RefuseOneThatHangsOnAFrontNobodyPlaces) {
  const auto refused = ThrowsSaying<std::invalid_argument>(HasSubstr("model: parent is 7, expected 0"));
  EvaluateModel::Request evaluation = evaluationOf(test::doorModel());
  evaluation.model.parent = 7;
  EXPECT_THAT([&] { evaluateModel(evaluation, {}); }, refused);
  ProjectPoses::Request poses = posesOf(test::doorModel(), {0});
  poses.model.parent = 7;
  EXPECT_THAT([&] { projectPoses(poses); }, refused);
  ProjectConfigurations::Request configurations;
  configurations.model = evaluation.model;
  configurations.q = {0};
  EXPECT_THAT([&] { projectConfigurations(configurations); }, refused);
}

TEST(ProjectPosesAnswer, InvertsPrediction) {
  for (const core::LearnedModel& model : {test::doorModel(), test::drawerModel(), test::garageModel()}) {
    const std::vector<double> q{0, 0.1, 0.25};
    const ProjectPoses::Response answer = projectPoses(posesOf(model, q));
    for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(answer.q.at(i), q[i], 1e-6);
    EXPECT_EQ(answer.message, "");
    EXPECT_TRUE(std::isnan(answer.openings.at(0))) << "it was not seen closed";
  }
}

TEST(ProjectPosesAnswer, CountsOpeningsFromTheClosedPositionAndWarnsBeyondTheRange) {
  core::LearnedModel drawer = test::drawerModel();
  drawer.closed_known = true;
  drawer.q_closed = 0;
  const ProjectPoses::Response answer = projectPoses(posesOf(drawer, {0.15, 0.4}));
  EXPECT_NEAR(answer.openings.at(0), 0.5, 1e-9);
  EXPECT_THAT(answer.message, HasSubstr("beyond that this is a guess"));
}

TEST(ProjectPosesAnswer, RefusesWhatItCannotAnswer) {
  ProjectPoses::Request request = posesOf(test::doorModel(), {});
  EXPECT_THAT([&] { projectPoses(request); }, ThrowsSaying<std::invalid_argument>(HasSubstr("poses is empty")));
  request.poses.resize(10001);
  EXPECT_THAT([&] { projectPoses(request); }, ThrowsSaying<std::invalid_argument>(HasSubstr("there are 10001 poses")));
  EXPECT_THAT([&] { projectPoses(posesOf(test::restingModel(), {0})); },
              ThrowsSaying<core::ModelError>(HasSubstr("the model is rigid: it has no openings")));
}

TEST(ProjectConfigurationsAnswer, SaysWhereTheFrontIsAndHowSurely) {
  ProjectConfigurations::Request request;
  request.model = toMessage(test::learned(test::doorModel()).model, "map");
  request.q = {0, 0.6};
  ProjectConfigurations::Response answer = projectConfigurations(request);
  EXPECT_EQ(answer.header, request.model.header);
  EXPECT_TRUE(fromMessage(answer.poses.at(1).pose).isApprox(test::doorModel().predict(0.6), 1e-9));
  EXPECT_GT(answer.poses.at(1).covariance[0], 0);
  request.as_opening = true;
  EXPECT_THAT([&] { projectConfigurations(request); }, ThrowsSaying<core::ModelError>(HasSubstr("it is not known where")));
  request.model.closed_known = true;
  request.model.q_closed = 0;
  request.q = {0.5};
  answer = projectConfigurations(request);
  EXPECT_TRUE(fromMessage(answer.poses.at(0).pose).isApprox(test::doorModel().predict(0.6), 1e-9));
  request.q.clear();
  EXPECT_THAT([&] { projectConfigurations(request); }, ThrowsSaying<std::invalid_argument>(HasSubstr("q is empty")));
  request.q = {1e9};
  request.as_opening = false;
  EXPECT_THAT([&] { projectConfigurations(request); }, ThrowsSaying<std::invalid_argument>(HasSubstr("expected -100 to 100")));
}

}  // namespace
}  // namespace cabinet_articulation

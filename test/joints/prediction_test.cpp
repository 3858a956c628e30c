// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/prediction.h"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "support/models.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::ThrowsSaying;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// With an axis that is known to 3 mm and 0.01 rad, and residuals of 2 mm and 0.02 rad.
LearnedModel uncertain(LearnedModel model) {
  model.covariance.diagonal() << 9e-6, 9e-6, 9e-6, 1e-4, 1e-4, 1e-4;
  model.position_error = 0.002;
  model.orientation_error = 0.02;
  return model;
}

/// The covariance that differences of predict() give when the axis is varied about the middle of the range.
Matrix6d numericCovariance(const LearnedModel& model, double q) {
  const double middle = model.type == JointType::kRotational ? (model.q_min + model.q_max) / 2 : 0;
  const Eigen::Isometry3d anchor = model.predict(middle);
  constexpr double kStep = 1e-6;
  Matrix6d J;
  for (int i = 0; i < 6; ++i) {
    LearnedModel varied = model;
    varied.origin = anchor;
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(i % 3);
    if (i < 3 && model.type == JointType::kPrismatic) varied.origin.pretranslate(kStep * unit);
    if (i < 3) varied.axis_point += kStep * unit;
    if (i >= 3) varied.axis = Eigen::AngleAxisd(kStep, unit) * model.axis;
    const Eigen::Isometry3d pose = varied.predict(q - middle), expected = model.predict(q);
    const Eigen::AngleAxisd turn(pose.linear() * expected.linear().transpose());
    J.col(i) << (pose.translation() - expected.translation()) / kStep, turn.angle() * turn.axis() / kStep;
  }
  return J * model.covariance * J.transpose();
}

TEST(Prediction, CovarianceFollowsFromTheAxis) {
  for (const LearnedModel& model : {uncertain(test::doorModel()), uncertain(test::drawerModel())}) {
    LearnedModel exact = model;
    exact.position_error = exact.orientation_error = 0;
    for (const double q : {-0.1, 0.0, 0.6, 2.0}) {
      const UncertainPose predicted = predictWithCovariance(exact, q);
      EXPECT_TRUE(predicted.pose.isApprox(model.predict(q), 1e-12));
      EXPECT_LT((predicted.covariance - numericCovariance(model, q)).norm(), 1e-8) << model.id << " at " << q;
    }
  }
}

TEST(Prediction, IsLeastUncertainInTheMiddleOfWhatWasSeenAndNeverCertain) {
  const LearnedModel door = uncertain(test::doorModel());
  const auto spread = [&](double q) { return predictWithCovariance(door, q).covariance.topLeftCorner<3, 3>().trace(); };
  EXPECT_GT(spread(0.6), 0);
  EXPECT_GT(spread(0.0), spread(0.6));
  EXPECT_GT(spread(2.4), spread(1.2));
  const Matrix6d covariance = predictWithCovariance(door, 2.4).covariance;
  EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-12));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(covariance).eigenvalues().minCoeff(), 0);
}

TEST(Prediction, RefusesWhatHasNoAnswer) {
  EXPECT_THAT([] { predictWithCovariance(test::doorModel(), kNan); }, ThrowsSaying<std::invalid_argument>(HasSubstr("q is nan")));
  EXPECT_THAT([] { predictWithCovariance(test::restingModel(), 0); }, ThrowsSaying<ModelError>(HasSubstr("not moved")));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = kNan;
  EXPECT_THAT([&] { findConfiguration(test::doorModel(), pose); }, ThrowsSaying<std::invalid_argument>(HasSubstr("nan")));
  pose.translation().x() = 1e300;
  EXPECT_THAT([&] { findConfiguration(test::doorModel(), pose); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("position is (1e+300, ")));
}

TEST(Configuration, InvertsThePrediction) {
  for (const LearnedModel& model : {test::doorModel(), test::drawerModel()}) {
    for (const double q : {-0.2, 0.0, 0.3, 1.1, 3.5}) {
      const NearestConfiguration nearest = findConfiguration(model, model.predict(q));
      EXPECT_NEAR(nearest.q, q, 1e-9);
      EXPECT_NEAR(nearest.position_residual, 0, 1e-9);
      EXPECT_NEAR(nearest.orientation_residual, 0, 1e-6);
    }
  }
}

TEST(Configuration, ResidualIsTheDistanceFromThePath) {
  const LearnedModel drawer = test::drawerModel();
  Eigen::Isometry3d pose = drawer.predict(0.1);
  pose.pretranslate(Eigen::Vector3d(0.03, 0.04, 0));
  pose.rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()));
  const NearestConfiguration nearest = findConfiguration(drawer, pose);
  EXPECT_NEAR(nearest.q, 0.1, 1e-9);
  EXPECT_NEAR(nearest.position_residual, 0.05, 1e-9);
  EXPECT_NEAR(nearest.orientation_residual, 0.2, 1e-9);
}

TEST(Configuration, OfAFrontThatTurnsOnTheSpotComesFromItsOrientation) {
  LearnedModel model = test::doorModel();
  model.axis_point = model.origin.translation();
  EXPECT_NEAR(findConfiguration(model, model.predict(0.7)).q, 0.7, 1e-9);
}

TEST(HandlePath, HandStaysFixedToTheFront) {
  const LearnedModel door = uncertain(test::doorModel());
  Eigen::Isometry3d T_front_grasp(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  T_front_grasp.translation() = Eigen::Vector3d(0.15, 0, 0.04);
  const std::vector<UncertainPose> path = handlePath(door, T_front_grasp, 0.2, 1.4, 13);
  ASSERT_EQ(path.size(), 13u);
  for (int i = 0; i < 13; ++i) EXPECT_TRUE(path[i].pose.isApprox(door.predict(0.2 + 0.1 * i) * T_front_grasp, 1e-9)) << i;
  // All at one distance from the hinge, in a plane across it.
  for (const UncertainPose& step : path) EXPECT_NEAR(step.pose.translation().y(), path[0].pose.translation().y(), 1e-9);
}

TEST(HandlePath, CovarianceOfAHandFarFromTheCentreIncludesTheFrontsTurn) {
  LearnedModel drawer = test::drawerModel();
  drawer.orientation_error = 0.1;
  Eigen::Isometry3d T_front_grasp = Eigen::Isometry3d::Identity();
  T_front_grasp.translation().x() = 0.2;
  const UncertainPose hand = handlePath(drawer, T_front_grasp, 0, 0.3, 2).back();
  // A turn about y or z moves the hand by 0.2 m times the angle.
  const double expected = 0.2 * 0.2 * 0.1 * 0.1 * M_PI / 8;
  EXPECT_NEAR(hand.covariance(1, 1), expected, 1e-9);
  EXPECT_NEAR(hand.covariance(2, 2), expected, 1e-9);
  EXPECT_NEAR(hand.covariance(0, 0), 0, 1e-9);
}

TEST(HandlePath, RefusesWhatHasNoAnswer) {
  const Eigen::Isometry3d grasp = Eigen::Isometry3d::Identity();
  EXPECT_THAT([&] { handlePath(test::doorModel(), grasp, 0, 1, 1); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("steps is 1, expected 2 to 10000")));
  EXPECT_THAT([&] { handlePath(test::doorModel(), grasp, 0, kNan, 5); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("q_to is nan")));
  Eigen::Isometry3d nowhere = grasp;
  nowhere.translation().x() = kNan;
  EXPECT_THAT([&] { handlePath(test::doorModel(), nowhere, 0, 1, 5); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("grasp_point is ")));
  nowhere.translation().x() = 1e300;
  EXPECT_THAT([&] { handlePath(test::doorModel(), nowhere, 0, 1, 5); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("expected -100 to 100 m")));
  EXPECT_THAT([&] { handlePath(test::doorModel(), grasp, 1e300, -1e300, 5); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("q_from is 1e+300")));
}

}  // namespace
}  // namespace cabinet_articulation::core

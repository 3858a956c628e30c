// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <set>

#include "articulation/models/model_registry.h"
#include "articulation/observations/observation_history.h"
#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

/// What every registered model must keep, on a track of its own kind.
class ModelContract : public ::testing::TestWithParam<ModelEntry> {
 protected:
  std::unique_ptr<ArticulationModel> make() const { return GetParam().create(config_); }
  PoseSequence track(double noise) const {
    const LearnedModel truth = GetParam().example();
    SyntheticFront front;
    front.noise = noise;
    front.turn_noise = 3 * noise;
    front.q_end = truth.q_max;
    ObservationHistory poses(config_);
    poses.update(syntheticTrack(front, [&](double q) { return truth.predict(q); }));
    return poses.evenlySpaced({1, 0}, 1000);
  }

  ArticulationConfig config_;
};

TEST_P(ModelContract, TypeIsTheIndexInTheRegistry) {
  EXPECT_EQ(make()->type(), GetParam().type);
  EXPECT_EQ(modelRegistry().at(static_cast<std::size_t>(GetParam().type)).type, GetParam().type);
  const auto chosen = chosenModels(config_);
  EXPECT_TRUE(std::any_of(chosen.begin(), chosen.end(), [](const ModelEntry* entry) { return entry->type == GetParam().type; }));
}

TEST_P(ModelContract, PredictsTheTrackItWasFittedTo) {
  const auto model = make();
  const PoseSequence clean = track(0);
  ASSERT_TRUE(model->fit(clean));
  for (const Eigen::Isometry3d& pose : clean.poses) {
    const Eigen::Isometry3d predicted = model->predict(model->configuration(pose));
    // A fit stops when the likelihood gains nothing: far below the millimetre that the noise's floor stands for.
    EXPECT_LT((predicted.translation() - pose.translation()).norm(), 1e-4);
    EXPECT_LT(angleBetween(predicted, pose), 1e-3);
  }
}

TEST_P(ModelContract, ConfigurationInvertsPrediction) {
  const auto model = make();
  const PoseSequence noisy = track(0.005);
  ASSERT_TRUE(model->fit(noisy));
  const ModelResiduals residuals = model->residuals(noisy);
  if (!model->moves()) {
    EXPECT_EQ(model->configuration(model->predict(0)), 0);
    return;
  }
  for (int i = -5; i <= 15; ++i) {
    const double q = residuals.q_min + (residuals.q_max - residuals.q_min) * i / 10;
    EXPECT_NEAR(model->configuration(model->predict(q)), q, 1e-9);
  }
}

TEST_P(ModelContract, ConfigurationStartsAtZeroAndGrowsWithTheOpening) {
  const auto model = make();
  const PoseSequence noisy = track(0.001);
  ASSERT_TRUE(model->fit(noisy));
  EXPECT_NEAR(model->configuration(noisy.poses.front()), 0, 1e-9);
  const ModelResiduals residuals = model->residuals(noisy);
  EXPECT_GE(residuals.q_max, -residuals.q_min);
  if (model->moves()) {
    EXPECT_GT(residuals.q_max, 0);
  }
}

TEST_P(ModelContract, LikelihoodFallsWithDistance) {
  const auto model = make();
  PoseSequence noisy = track(0.003);
  ASSERT_TRUE(model->fit(noisy));
  const double likelihood = model->logLikelihood(noisy, model->residuals(noisy));
  EXPECT_TRUE(std::isfinite(likelihood));
  const Eigen::Vector3d across = model->predict(0).linear().col(1);
  for (Eigen::Isometry3d& pose : noisy.poses) pose.pretranslate(config_.sigma_position * across);
  // 1 sigma for each of 100 poses: half a nat each.
  EXPECT_NEAR(model->logLikelihood(noisy, model->residuals(noisy)), likelihood - 50, 10);
}

TEST_P(ModelContract, ASecondFitChangesNothing) {
  const auto model = make();
  const PoseSequence noisy = track(0.003);
  ASSERT_TRUE(model->fit(noisy));
  const Eigen::Isometry3d before = model->predict(0.1);
  ASSERT_TRUE(model->fit(noisy));
  EXPECT_LT((model->predict(0.1).translation() - before.translation()).norm(), 2e-4);
}

TEST_P(ModelContract, TooShortATrackLeavesItUnchanged) {
  const auto model = make();
  EXPECT_FALSE(model->fit(PoseSequence{}));
  ASSERT_TRUE(model->fit(track(0.001)));
  const Eigen::Isometry3d before = model->predict(0.1);
  EXPECT_FALSE(model->fit(PoseSequence{}));
  EXPECT_TRUE(model->predict(0.1).isApprox(before, 0));
}

TEST_P(ModelContract, IdenticalPosesGiveFiniteNumbers) {
  PoseSequence same;
  for (int i = 0; i < 10; ++i) {
    same.stamps.push_back(i);
    same.poses.push_back(closedPose());
  }
  const auto model = make();
  ASSERT_TRUE(model->fit(same));
  EXPECT_LT((model->predict(0).translation() - closedPose().translation()).norm(), 1e-4);
  EXPECT_TRUE(std::isfinite(model->logLikelihood(same, model->residuals(same))));
  EXPECT_TRUE(model->covariance(same, closedPose().translation(), 0).allFinite());
  if (model->moves()) {
    EXPECT_TRUE(std::isfinite(model->sequenceLogLikelihood(same, WorkBudget::unlimited(), std::nullopt).log_likelihood));
  }
}

TEST_P(ModelContract, CovarianceIsSymmetricAndNotNegative) {
  const auto model = make();
  const PoseSequence noisy = track(0.005);
  ASSERT_TRUE(model->fit(noisy));
  const Matrix6d covariance = model->covariance(noisy, closedPose().translation(), 0.3);
  EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-9));
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(covariance);
  EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-12);
  EXPECT_GT(covariance.trace(), 0);
  // Correlated residuals say less.
  EXPECT_GT(model->covariance(noisy, closedPose().translation(), 0.8).trace(), 2 * covariance.trace());
}

TEST_P(ModelContract, ParametersHaveNames) {
  const auto model = make();
  ASSERT_TRUE(model->fit(track(0.001)));
  std::set<std::string> names;
  for (const ModelParam& param : model->parameters()) {
    EXPECT_TRUE(names.insert(param.name).second) << param.name;
    EXPECT_TRUE(std::isfinite(param.value)) << param.name;
  }
  EXPECT_FALSE(names.empty());
}

INSTANTIATE_TEST_SUITE_P(AllModels, ModelContract, ::testing::ValuesIn(modelRegistry()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace cabinet_articulation::core

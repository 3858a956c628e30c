// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/pipeline/pipeline.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "geometry/degrees.h"
#include "pipeline/same_bits.h"

namespace cabinet_articulation::core {
namespace {

SimulationConfig doorAt(double rate) {
  SimulationConfig config;
  config.scene = "door";
  config.rate = rate;
  return config;
}

/// Takes every frame of the simulation through the pipeline, in the camera's or in the world frame.
PipelineResult runAll(Pipeline& pipeline, SimulatedStereoCamera& simulation, double rate, bool in_world) {
  PipelineResult result;
  for (int i = 0; i < simulation.frameCount(); ++i) {
    const StereoFrame frame = simulation.frame(i);
    const Eigen::Isometry3d T_fixed_camera = in_world ? frame.truth.T_world_camera : Eigen::Isometry3d::Identity();
    result = pipeline.process(100 + i / rate, frame.left, frame.right, simulation.camera(), T_fixed_camera);
  }
  return result;
}

/// The models of what moved must be the one door of the scene, with its axis in the fixed frame.
void expectDoor(const PipelineResult& result, const GroundTruth& truth, const Eigen::Isometry3d& T_fixed_camera) {
  std::vector<LearnedModel> movers;
  std::copy_if(result.models.begin(), result.models.end(), std::back_inserter(movers),
               [](const LearnedModel& model) { return model.moved; });
  ASSERT_EQ(movers.size(), 1u);
  ASSERT_EQ(movers[0].type, JointType::kRotational);
  EXPECT_GT(movers[0].probabilities[2], 0.95);
  const Eigen::Vector3d axis = T_fixed_camera.linear() * truth.joints[0].axis;
  const Eigen::Vector3d point = T_fixed_camera * truth.joints[0].axis_point;
  EXPECT_GT(std::abs(movers[0].axis.dot(axis)), std::cos(3 * kDegree)) << "a dozen observations";
  EXPECT_LT((movers[0].axis_point - point).cross(axis).norm(), 0.02) << "block matching and a few edges: 2 cm";
}

TEST(Pipeline, LearnsADoor) {
  constexpr double kRate = 3;
  SimulatedStereoCamera simulation(doorAt(kRate));
  Pipeline pipeline({});
  const PipelineResult result = runAll(pipeline, simulation, kRate, false);
  expectDoor(result, simulation.truth(0), Eigen::Isometry3d::Identity());
  for (double milliseconds : {result.milliseconds.stereo, result.milliseconds.planes, result.milliseconds.rectangles,
                              result.milliseconds.tracking, result.milliseconds.articulation})
    EXPECT_GT(milliseconds, 0);
  EXPECT_EQ(result.tracks, &pipeline.tracks());
}

TEST(Pipeline, LearnsADoorInTheFixedFrameWhileTheCameraMoves) {
  constexpr double kRate = 3;
  SimulationConfig config = doorAt(kRate);
  config.camera_motion = 0.1;
  SimulatedStereoCamera simulation(config);
  Pipeline pipeline({});
  const PipelineResult result = runAll(pipeline, simulation, kRate, true);
  expectDoor(result, simulation.truth(0), simulation.truth(0).T_world_camera);
}

TEST(Pipeline, JointsStayKnownWhenTimeIsSetBack) {
  constexpr double kRate = 5;
  SimulatedStereoCamera simulation(doorAt(kRate));
  Pipeline pipeline({});
  const PipelineResult before = runAll(pipeline, simulation, kRate, false);
  expectDoor(before, simulation.truth(0), Eigen::Isometry3d::Identity());
  const auto moved = [](const LearnedModel& model) { return model.moved; };
  const std::uint32_t door = std::find_if(before.models.begin(), before.models.end(), moved)->id;
  pipeline.startAfresh();
  EXPECT_TRUE(pipeline.tracks().empty());
  // A glimpse of the open door, earlier than all that was seen.
  int told = 0;
  for (int i = simulation.frameCount() / 2; i < simulation.frameCount() / 2 + 4; ++i) {
    const StereoFrame frame = simulation.frame(i);
    const PipelineResult result = pipeline.process(i / kRate, frame.left, frame.right, simulation.camera());
    for (const LearnedModel& model : result.models) told += model.moved && model.id == door;
  }
  EXPECT_GE(told, 3);
}

TEST(Pipeline, TheSameFramesGiveTheSameBits) {
  SimulatedStereoCamera simulation(doorAt(5));
  Pipeline first({}), second({});
  second.process(1, cv::Mat1b::zeros(480, 640), cv::Mat1b::zeros(480, 640), simulation.camera());
  second.reset();
  for (int i = 5; i < 12; ++i) {
    const StereoFrame frame = simulation.frame(i);
    const auto a = first.process(i, frame.left, frame.right, simulation.camera());
    const auto b = second.process(i, frame.left, frame.right, simulation.camera());
    expectSameBits(a, b);
  }
}

/// The paper's own recipe finds large fronts that stand well off their surroundings.
TEST(Pipeline, ThePapersVariantDetectsADoor) {
  SimulatedStereoCamera simulation(doorAt(3));
  Pipeline pipeline(PipelineConfig::paper());
  int open = 0, found = 0;
  for (int i = 0; i < simulation.frameCount(); ++i) {
    const FrontTruth door = simulation.truth(i).joints[0];
    if (door.q < 0.5) continue;
    const StereoFrame frame = simulation.frame(i);
    const PipelineResult result = pipeline.process(i / 3.0, frame.left, frame.right, simulation.camera());
    ++open;
    found += std::any_of(result.rectangles.begin(), result.rectangles.end(), [&](const DetectedRectangle& detection) {
      return intersectionOverUnion(door.rectangle, detection.rectangle) > 0.7;
    });
  }
  ASSERT_GT(open, 5);
  EXPECT_GT(found, open / 2);
}

TEST(Pipeline, NothingSeenIsNothingLearned) {
  SimulatedStereoCamera simulation(doorAt(5));
  Pipeline pipeline({});
  const cv::Mat1b black = cv::Mat1b::zeros(480, 640);
  const PipelineResult result = pipeline.process(1, black, black, simulation.camera());
  EXPECT_TRUE(result.rectangles.empty());
  EXPECT_TRUE(result.tracks->empty());
  EXPECT_TRUE(result.models.empty());
}

TEST(Pipeline, RefusesImagesOfDifferentSize) {
  SimulatedStereoCamera simulation(doorAt(5));
  Pipeline pipeline({});
  EXPECT_THROW(pipeline.process(1, cv::Mat1b::zeros(480, 640), cv::Mat1b::zeros(240, 320), simulation.camera()),
               std::invalid_argument);
}

TEST(Transformed, TurnsPoseAndCovariance) {
  DetectedRectangle detection;
  detection.rectangle.pose.translation() = Eigen::Vector3d(1, 0, 0);
  detection.covariance = (Eigen::Matrix<double, 6, 1>() << 1, 2, 3, 4, 5, 6).finished().asDiagonal();
  detection.covariance(0, 3) = detection.covariance(3, 0) = 0.5;
  Eigen::Isometry3d T_fixed_camera = Eigen::Isometry3d::Identity();
  T_fixed_camera.translate(Eigen::Vector3d(0, 0, 2)).rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  const DetectedRectangle result = transformed({detection}, T_fixed_camera)[0];
  EXPECT_TRUE(result.rectangle.center().isApprox(Eigen::Vector3d(0, 1, 2), 1e-12));
  Matrix6d expected = (Eigen::Matrix<double, 6, 1>() << 2, 1, 3, 5, 4, 6).finished().asDiagonal();
  expected(1, 4) = expected(4, 1) = 0.5;
  EXPECT_TRUE(result.covariance.isApprox(expected, 1e-12));
}

class PipelineConfigFiles : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / ("pipeline_test_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path directory_;
};

TEST_F(PipelineConfigFiles, AreReadWhereTheyExist) {
  std::ofstream(directory_ / "tracking.yaml") << "timeout: 7.5\ntimeot: 3\n";
  std::vector<std::string> warnings;
  const PipelineConfig config = PipelineConfig::load(directory_.string(), &warnings);
  EXPECT_EQ(config.tracking.timeout, 7.5);
  EXPECT_EQ(config.stereo.disparity_range, StereoConfig().disparity_range);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("tracking.yaml"), std::string::npos);
  EXPECT_NE(warnings[0].find("timeot"), std::string::npos);
}

TEST_F(PipelineConfigFiles, BadValuesAndAMissingDirectoryAreErrors) {
  std::vector<std::string> warnings;
  std::ofstream(directory_ / "tracking.yaml") << "timeout: -1\n";
  EXPECT_THROW(PipelineConfig::load(directory_.string(), &warnings), ConfigError);
  EXPECT_THROW(PipelineConfig::load((directory_ / "none").string(), &warnings), ConfigError);
}

}  // namespace
}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
// Tracker and learner together. What was learned outlives a clock that is set back, a file, a forgotten neighbour, and a tracker
// that is started anew.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/Forget.h>
#include <cabinet_articulation/LoadModels.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/SaveModels.h>
#include <cabinet_articulation/SetName.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "cabinet_articulation/joints/model_file.h"
#include "cabinet_articulation/ros/conversions.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

namespace fs = std::filesystem;
using test::Recorder;
using test::spinUntil;

constexpr double kRate = 15;             // [Hz]
constexpr int kRest = 15, kFrames = 75;  // of one opening and closing

class KnownFrontsChain : public testing::Test {
 protected:
  KnownFrontsChain() : folder_(fs::temp_directory_path() / ("known_fronts_rostest." + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    path_ = (folder_ / "kitchen.yaml").string();
    nh_.setParam("articulation/models_file", path_);
    nh_.setParam("articulation/diagnostic_period", 0.1);
    load("articulation");
    load("tracking");
  }

  ~KnownFrontsChain() override {
    unload("tracking");
    unload("articulation");
    fs::remove_all(folder_);
  }

  void SetUp() override { waitForBoth(); }

  void load(const std::string& stage) {
    nodelet::NodeletLoad load;
    load.request.name = "/cabinet/" + stage;
    load.request.type = "cabinet_articulation/" + stage;
    EXPECT_TRUE(ros::service::waitForService("/cabinet/manager/load_nodelet", ros::Duration(test::kGenerous)));
    EXPECT_TRUE(ros::service::call("/cabinet/manager/load_nodelet", load));
  }

  void unload(const std::string& stage) {
    nodelet::NodeletUnload unload;
    unload.request.name = "/cabinet/" + stage;
    ros::service::call("/cabinet/manager/unload_nodelet", unload);
  }

  void waitForBoth() {
    ASSERT_TRUE(spinUntil([&] { return models_.connected() && tracks_.connected() && rectangles_.getNumSubscribers() > 0; }));
  }

  void restart(const std::string& stage) {
    unload(stage);
    load(stage);
    waitForBoth();
  }

  core::DetectedRectangle drawer(double x, double q) {
    core::DetectedRectangle seen;
    seen.rectangle.pose = Eigen::Translation3d(x, 0.2, 1.5 - q) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
    seen.rectangle.pose.translation() += 1e-3 * Eigen::Vector3d(noise_(random_), noise_(random_), noise_(random_));
    seen.rectangle.width = 0.4;
    seen.rectangle.height = 0.2;
    seen.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    seen.precision = seen.recall = 0.95;
    seen.edge_support = {1, 1, 1, 1};
    return seen;
  }

  /// Drawers at -0.5 and 0.5 that open and close; whether every frame but the first few gave models.
  bool play(double start, int frames = kFrames) {
    int missed = 0;
    for (int i = 0; i < frames; ++i) {
      std_msgs::Header header;
      header.frame_id = "map";
      header.stamp = ros::Time(start + i / kRate);
      const double q = 0.15 * (1 - std::cos(2 * M_PI * std::max(0, i - kRest) / (kFrames - kRest)));
      const auto has = [&](const auto& recorder) {
        return !recorder.messages.empty() && recorder.messages.back()->header.stamp == header.stamp;
      };
      const auto answered = [&] { return has(models_) && has(tracks_); };
      rectangles_.publish(toMessage({drawer(-0.5, q), drawer(0.5, q)}, header));
      if (!spinUntil(answered, 1)) ++missed;
    }
    return missed <= 3;
  }

  /// The id of the front at x in the newest tracks; 0 if there is none.
  std::uint32_t idAt(double x) const {
    for (const Track& track : tracks_.messages.back()->tracks)
      if (std::abs(track.poses.back().position.x - x) < 0.1 && track.stamps.back() == tracks_.messages.back()->header.stamp)
        return track.id;
    return 0;
  }

  size_t observationsAt(double x) const {
    for (const Track& track : tracks_.messages.back()->tracks)
      if (track.id == idAt(x)) return track.first + track.poses.size();
    return 0;
  }

  static bool predicts(std::uint32_t id) {
    Predict call;
    call.request.id = id;
    call.request.q = {0.1};
    return ros::service::call("/cabinet/predict", call) && call.response.success;
  }

  std::string save() {
    SaveModels call;
    EXPECT_TRUE(ros::service::call("/cabinet/save_models", call) && call.response.success) << call.response.message;
    return call.response.message;
  }

  static Forget::Response forget(std::uint32_t id) {
    Forget call;
    call.request.id = id;
    EXPECT_TRUE(ros::service::call("/cabinet/forget", call));
    return call.response;
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> noise_;
  const fs::path folder_;
  std::string path_;
  ros::NodeHandle nh_{"/cabinet"};
  ros::Publisher rectangles_ = nh_.advertise<RectangleArray>("rectangles", 10);
  Recorder<TrackArray> tracks_{"/cabinet/tracks"};
  Recorder<ArticulationModelArray> models_{"/cabinet/models"};
};

TEST_F(KnownFrontsChain, ForgetsOneFrontWhileTheOthersGoOn) {
  ASSERT_TRUE(play(1000));
  const std::uint32_t left = idAt(-0.5), right = idAt(0.5);
  EXPECT_EQ(std::min(left, right), 1u) << "0 is nobody";
  ASSERT_TRUE(predicts(left) && predicts(right));
  save();
  const size_t before = observationsAt(0.5);
  const Forget::Response answer = forget(left);
  EXPECT_TRUE(answer.success);
  EXPECT_NE(answer.message.find("is forgotten and taken from '" + path_), std::string::npos) << answer.message;
  EXPECT_EQ(core::readModelFile(path_).fronts.size(), 1u);
  EXPECT_FALSE(predicts(left));
  EXPECT_FALSE(forget(left).success);
  EXPECT_NE(forget(left).message.find("there is no front " + std::to_string(left) + "; the fronts known are"), std::string::npos);
  const size_t models = models_.messages.size();
  ASSERT_TRUE(play(1010, kRest));
  EXPECT_EQ(idAt(0.5), right);
  EXPECT_EQ(observationsAt(0.5), before + kRest) << "without interruption";
  EXPECT_EQ(idAt(-0.5), 3u) << "seen again, it is another";
  for (size_t i = models; i < models_.messages.size(); ++i)
    for (const ArticulationModel& model : models_.messages[i]->models) EXPECT_NE(model.id, left);
  EXPECT_NE(save().find("1 fronts saved"), std::string::npos) << "it does not come back";
  restart("articulation");
  ASSERT_TRUE(play(1020, kRest));
  EXPECT_TRUE(predicts(right));
  EXPECT_FALSE(predicts(left));
}

TEST_F(KnownFrontsChain, KeepIdsAndHistoriesWhateverTheClockSays) {
  ASSERT_TRUE(play(1795000000));
  const std::uint32_t left = idAt(-0.5), right = idAt(0.5);
  SetName name;
  name.request.id = left;
  name.request.name = "cutlery";
  ASSERT_TRUE(ros::service::call("/cabinet/set_name", name) && name.response.success) << name.response.message;
  // Set back, to near 0, to 0, and hours on; with and without a file between.
  for (const double start : {30.0, 2.0, 0.0, 50000.0, 5.0}) {
    if (start == 5) {
      save();
      unload("tracking");
      unload("articulation");
      load("articulation");
      load("tracking");
      waitForBoth();
    }
    ASSERT_TRUE(play(start)) << "from " << start;
    EXPECT_EQ(idAt(-0.5), left) << "from " << start;
    EXPECT_EQ(idAt(0.5), right) << "from " << start;
    for (const ArticulationModel& model : models_.messages.back()->models)
      EXPECT_EQ(model.name, model.id == left ? "cutlery" : "") << "from " << start;
    EXPECT_TRUE(predicts(left) && predicts(right)) << "from " << start;
    EXPECT_GT(observationsAt(0.5), static_cast<size_t>(kFrames)) << "its history is back, too";
  }
  EXPECT_NE(save().find("2 fronts saved"), std::string::npos);
}

TEST_F(KnownFrontsChain, ARefusedFileChangesNothing) {
  ASSERT_TRUE(play(1000));
  const std::uint32_t left = idAt(-0.5);
  save();
  core::ModelFile models = core::readModelFile(path_);
  const std::string other = (folder_ / "other.yaml").string();
  models.frame = "odom";
  core::saveModelFile(other, models);
  LoadModels call;
  call.request.file = other;
  ASSERT_TRUE(ros::service::call("/cabinet/load_models", call));
  EXPECT_FALSE(call.response.success);
  const size_t before = observationsAt(-0.5);
  ASSERT_TRUE(play(1010, 5));
  EXPECT_EQ(idAt(-0.5), left);
  EXPECT_EQ(observationsAt(-0.5), before + 5);
  EXPECT_TRUE(predicts(left));
}

TEST_F(KnownFrontsChain, ATrackerThatIsStartedAnewHearsWhatWasLearnedAndUsesNoIdTwice) {
  ASSERT_TRUE(play(1000));
  const std::uint32_t left = idAt(-0.5), right = idAt(0.5);
  EXPECT_TRUE(forget(right).success);
  restart("tracking");
  ASSERT_TRUE(play(1010));
  EXPECT_EQ(idAt(-0.5), left);
  EXPECT_GT(idAt(0.5), std::max(left, right)) << "a number nobody had";
  EXPECT_TRUE(predicts(left) && predicts(idAt(0.5)));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "known_fronts_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}

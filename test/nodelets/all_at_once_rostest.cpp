// SPDX-License-Identifier: BSD-3-Clause
// Everything that others may do to the pipeline, from several threads at the same time, while it works: nothing dies, nothing
// waits for ever, and all works afterwards. Under ThreadSanitizer (scripts/check_sanitizers.sh) it also tells of races.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/Configuration.h>
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/FitTrack.h>
#include <cabinet_articulation/Forget.h>
#include <cabinet_articulation/HandlePath.h>
#include <cabinet_articulation/LoadModels.h>
#include <cabinet_articulation/PlaneArray.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SaveModels.h>
#include <cabinet_articulation/TrackArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>
#include <unistd.h>
#include <visualization_msgs/MarkerArray.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <thread>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/moving_fronts.h"
#include "support/pipeline_nodelets.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::kNodelets;
using test::loadNodelet;
using test::Recorder;
using test::spinUntil;
using test::unloadNodelet;

constexpr int kReloads = 3;     // of every nodelet
constexpr double kPause = 0.1;  // [s] between two rounds of requests

/// Calls a service that may be gone at the moment. What it answers does not matter here.
template <class Service>
void ask(const std::string& name, const Service& request = {}) {
  Service call = request;
  if (ros::service::exists(name, false)) ros::service::call(name, call);
}

/// Every stage is built anew, with the settings it has.
void reconfigure() {
  for (const char* stage : {"stereo", "planes", "rectangles", "tracking", "articulation"})
    ask<dynamic_reconfigure::Reconfigure>(std::string("/cabinet/") + stage + "/set_parameters");
}

void useWhatIsKnown(std::uint32_t id) {
  Predict predict;
  predict.request.id = id;
  predict.request.q = {0, 0.1};
  ask("/cabinet/predict", predict);
  Configuration configuration;
  configuration.request.id = id;
  configuration.request.pose.orientation.w = 1;
  ask("/cabinet/configuration", configuration);
  HandlePath path;
  path.request.id = id;
  path.request.q_to = 0.2;
  path.request.steps = 10;
  ask("/cabinet/handle_path", path);
  FitTrack fit;
  for (int i = 0; i < 10; ++i) {
    fit.request.track.stamps.push_back(ros::Time(1 + i));
    fit.request.track.poses.push_back(toMessage(test::doorPose(0.1 * i)));
    fit.request.track.widths.push_back(0.4);
    fit.request.track.heights.push_back(0.6);
  }
  ask("/cabinet/fit_track", fit);
  ask<ExportUrdf>("/cabinet/export_urdf");
}

void changeWhatIsKnown(const std::string& file, std::uint32_t id) {
  SaveModels save;
  save.request.file = file;
  ask("/cabinet/save_models", save);
  LoadModels load;
  load.request.file = file;
  ask("/cabinet/load_models", load);
  Forget forget;
  forget.request.id = id;
  ask("/cabinet/forget", forget);
  if (id % 5 == 0) ask<std_srvs::Trigger>("/cabinet/reset");
}

/// Results that somebody listens to only now and then, so that stages begin and end their work.
void listenForAWhile() {
  const Recorder<PlaneArray> planes("/cabinet/planes");
  const Recorder<TrackArray> tracks("/cabinet/tracks");
  const Recorder<visualization_msgs::MarkerArray> markers("/cabinet/markers");
  ros::WallDuration(kPause).sleep();
}

/// Does each of these again and again in a thread of its own, until it is destroyed.
class Crowd {
 public:
  ~Crowd() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

  /// `work` is told how often it was called before.
  void add(const std::function<void(std::uint32_t)>& work) {
    threads_.emplace_back([this, work] {
      for (std::uint32_t round = 0; !over_; ++round) {
        work(round);
        ros::WallDuration(kPause).sleep();
      }
    });
  }

 private:
  std::atomic<bool> over_{false};
  std::vector<std::thread> threads_;
};

TEST(AllAtOnce, NothingDiesOrWaitsForEver) {
  ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", ros::Duration(test::kGenerous)));
  for (const std::string& name : kNodelets) ASSERT_TRUE(loadNodelet(name)) << name;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("all_at_once_" + std::to_string(::getpid()) + ".yaml");
  {
    Recorder<ArticulationModelArray> models("/cabinet/models");
    Recorder<sensor_msgs::Image> overlays("/cabinet/overlay");
    const auto works = [&] {
      models.messages.clear();
      overlays.messages.clear();
      return spinUntil([&] { return models.messages.size() > 2 && overlays.messages.size() > 2; });
    };
    ASSERT_TRUE(works());
    {
      Crowd crowd;
      crowd.add([](std::uint32_t) { reconfigure(); });
      crowd.add([](std::uint32_t round) { useWhatIsKnown(1 + round % 8); });
      crowd.add([&](std::uint32_t round) { changeWhatIsKnown(file.string(), 1 + round % 8); });
      crowd.add([](std::uint32_t) { listenForAWhile(); });
      for (int i = 0; i < kReloads; ++i)
        for (const std::string& name : kNodelets) {
          test::spinFor(3 * kPause);
          EXPECT_TRUE(unloadNodelet(name)) << name;
          EXPECT_TRUE(loadNodelet(name)) << name;
        }
    }
    EXPECT_TRUE(works()) << "when all is quiet again";
  }
  std::filesystem::remove(file);
  nodelet::NodeletList loaded;
  ASSERT_TRUE(ros::service::call("/manager/list", loaded)) << "the manager lives";
  EXPECT_EQ(loaded.response.nodelets.size(), kNodelets.size());
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "all_at_once_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
// Names that people give to fronts: where they are seen, and what they outlive.
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/Forget.h>
#include <cabinet_articulation/SaveModels.h>
#include <cabinet_articulation/SetName.h>
#include <sensor_msgs/JointState.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>
#include <unistd.h>
#include <urdf_parser/urdf_parser.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <filesystem>

#include "support/moving_fronts.h"

namespace cabinet_articulation {
namespace {

namespace fs = std::filesystem;
using test::Recorder;
using test::spinUntil;

const std::string kNodelet = "/cabinet/articulation";

class Names : public test::MovingFronts {
 protected:
  Names()
      : MovingFronts("cabinet"), path_(fs::temp_directory_path() / ("names_rostest." + std::to_string(::getpid()) + ".yaml")) {
    nh_.setParam(kNodelet + "/models_file", path_.string());
    loadNodelet();
  }

  ~Names() override {
    unloadNodelet();
    fs::remove(path_);
  }

  template <class Service>
  static typename Service::Response call(const std::string& name, typename Service::Request request) {
    typename Service::Response response;
    EXPECT_TRUE(ros::service::waitForService("/cabinet/" + name, ros::Duration(test::kGenerous)));
    EXPECT_TRUE(ros::service::call("/cabinet/" + name, request, response)) << name;
    return response;
  }

  static SetName::Response setName(std::uint32_t id, const std::string& name) {
    SetName::Request request;
    request.id = id;
    request.name = name;
    return call<SetName>("set_name", request);
  }

  std::uint32_t id(int i) const { return tracks_[static_cast<size_t>(i)].id; }
  std::string defaultOf(int i) const { return "front_" + std::to_string(id(i)); }

  /// One frame in which everything rests; the names in its models.
  std::vector<std::string> namesAt(double stamp) {
    const Eigen::Isometry3d poses[] = {test::doorPose(1.4), test::drawerPose(0.3), test::wallPose(0)};
    for (size_t i = 0; i < tracks_.size(); ++i) observe(&tracks_[i], poses[i], stamp);
    const ArticulationModelArrayConstPtr models = publish(stamp);
    std::vector<std::string> names;
    if (models)
      for (const ArticulationModel& model : models->models) names.push_back(model.name);
    return names;
  }

  static urdf::ModelInterfaceSharedPtr description() {
    const ExportUrdf::Response exported = call<ExportUrdf>("export_urdf", {});
    EXPECT_TRUE(exported.success) << exported.message;
    return urdf::parseURDF(exported.urdf);
  }

  const fs::path path_;
  const Recorder<sensor_msgs::JointState> joint_states_{"/cabinet/joint_states"};
  const Recorder<visualization_msgs::MarkerArray> markers_{"/cabinet/markers"};
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_, ros::NodeHandle(), false};
};

TEST_F(Names, AreInEverythingThatIsSaidOfAFront) {
  ASSERT_TRUE(play(100));
  ASSERT_TRUE(spinUntil([&] { return joint_states_.connected() && markers_.connected(); }));
  EXPECT_EQ(namesAt(105), (std::vector<std::string>(3, "")));
  const SetName::Response named = setName(id(0), "fridge");
  EXPECT_TRUE(named.success);
  EXPECT_EQ(named.message, "front " + std::to_string(id(0)) + " is called 'fridge' now");
  const SetName::Response wall = setName(id(2), "tray");
  EXPECT_TRUE(wall.success);
  EXPECT_NE(wall.message.find("no joint yet, and only joints are saved"), std::string::npos) << wall.message;
  EXPECT_EQ(namesAt(106), (std::vector<std::string>{"fridge", "", "tray"}));

  const auto states = [&] {
    return joint_states_.messages.empty() ? std::vector<std::string>() : joint_states_.messages.back()->name;
  };
  EXPECT_TRUE(spinUntil([&] { return states() == std::vector<std::string>{"fridge", defaultOf(1)}; }));
  ASSERT_TRUE(spinUntil([&] { return buffer_.canTransform("map", "cabinet_fridge", ros::Time(106)); }));
  const std::string front = "cabinet_" + std::to_string(id(0)) + "_front";
  EXPECT_TRUE(tf2::transformToEigen(buffer_.lookupTransform("map", "cabinet_fridge", ros::Time(106)))
                  .isApprox(tf2::transformToEigen(buffer_.lookupTransform("map", front, ros::Time(106)))));
  const auto is_labelled = [&] {
    const auto& markers = markers_.messages.back()->markers;
    return std::any_of(markers.begin(), markers.end(), [&](const visualization_msgs::Marker& marker) {
      return marker.text.find(std::to_string(id(0)) + " fridge rotational") == 0;
    });
  };
  EXPECT_TRUE(spinUntil([&] { return !markers_.messages.empty() && is_labelled(); }));

  const auto urdf = description();
  ASSERT_TRUE(urdf);
  EXPECT_TRUE(urdf->getJoint("fridge") && urdf->getJoint(defaultOf(1)) && urdf->getLink("cabinet_fridge") &&
              urdf->getLink(front));
  const auto body = urdf->getLink("cabinet_" + std::to_string(id(0)) + "_body");
  ASSERT_TRUE(body) << "door and drawer lie in one surface, 0.2 m apart";
  EXPECT_EQ(body->child_links.size(), 2u);
}

TEST_F(Names, ThatCannotBeGivenAreRefusedWithOneThatCan) {
  ASSERT_TRUE(play(200));
  ASSERT_TRUE(setName(id(0), "fridge").success);
  const auto expectRefused = [&](const std::string& name, const std::string& why, const std::string& proposal) {
    const SetName::Response answer = setName(id(1), name);
    EXPECT_FALSE(answer.success);
    EXPECT_NE(answer.message.find(why), std::string::npos) << answer.message;
    EXPECT_NE(answer.message.find("'" + proposal + "' would do"), std::string::npos) << answer.message;
    EXPECT_EQ(answer.proposal, proposal);
  };
  expectRefused("fridge", "'fridge' is the name of front " + std::to_string(id(0)), "fridge_2");
  expectRefused("", "is empty", defaultOf(1));
  expectRefused("top drawer", "at position 4 of the name", "top_drawer");
  expectRefused(defaultOf(0), "without a name", defaultOf(0) + "_2");
  expectRefused(std::string(100000, 'x'), "has 100000 characters, expected 64 at most", std::string(64, 'x'));
  EXPECT_EQ(namesAt(205), (std::vector<std::string>{"fridge", "", ""}));
  const SetName::Response nobody = setName(99999, "fridge");
  EXPECT_FALSE(nobody.success);
  EXPECT_NE(nobody.message.find("there is no front 99999"), std::string::npos) << nobody.message;
  EXPECT_EQ(nobody.proposal, "");
  EXPECT_TRUE(setName(id(1), setName(id(1), "fridge").proposal).success);
  EXPECT_EQ(namesAt(206), (std::vector<std::string>{"fridge", "fridge_2", ""}));
  frame_id_ = "cabinet_room";
  for (core::Track& track : tracks_) {
    track.id = nextId();
    track.observations.clear();
  }
  ASSERT_TRUE(play(210));
  expectRefused("room", "would be the name of the frame that all models are in", "room_2");
}

TEST_F(Names, OutliveARestartAndAClockThatIsSetBack) {
  ASSERT_TRUE(play(300));
  ASSERT_TRUE(setName(id(0), "fridge").success && setName(id(1), "cutlery").success);
  ASSERT_TRUE(call<SaveModels>("save_models", {}).success);
  restart();
  const auto urdf = description();
  EXPECT_TRUE(urdf && urdf->getJoint("fridge") && urdf->getJoint("cutlery")) << "before anything is seen";
  EXPECT_EQ(namesAt(400), (std::vector<std::string>{"fridge", "cutlery", ""}));
  EXPECT_EQ(setName(id(2), "cutlery").proposal, "cutlery_2") << "taken";
  for (core::Track& track : tracks_) track.observations.clear();
  EXPECT_EQ(namesAt(50), (std::vector<std::string>{"fridge", "cutlery", ""})) << "time was set back";

  Forget::Request door;
  door.id = id(0);
  ASSERT_TRUE(call<Forget>("forget", door).success);
  EXPECT_TRUE(setName(id(2), "fridge").success) << "free again";
  restart();
  const auto without = description();
  EXPECT_TRUE(without && !without->getJoint("fridge") && without->getJoint("cutlery"));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "names_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}

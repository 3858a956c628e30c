// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/Configuration.h>
#include <cabinet_articulation/EvaluateModel.h>
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/FitTrack.h>
#include <cabinet_articulation/HandlePath.h>
#include <cabinet_articulation/KnownFrontArray.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/ProjectConfigurations.h>
#include <cabinet_articulation/ProjectPoses.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <limits>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/moving_fronts.h"

namespace cabinet_articulation {
namespace {

using test::doorPose;
using test::drawerPose;
using test::Recorder;
using test::spinUntil;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Services : public test::MovingFronts {
 protected:
  Services() : MovingFronts("cabinet") {}

  template <class Service>
  typename Service::Response call(const std::string& name, const typename Service::Request& request) {
    typename Service::Response response;
    EXPECT_TRUE(ros::service::waitForService("/cabinet/" + name, ros::Duration(test::kGenerous)));
    typename Service::Request copy = request;
    EXPECT_TRUE(ros::service::call("/cabinet/" + name, copy, response)) << name;
    return response;
  }

  Predict::Response predict(std::uint32_t id, const std::vector<double>& q) {
    Predict::Request request;
    request.id = id;
    request.q = q;
    return call<Predict>("predict", request);
  }

  HandlePath::Request pathRequest() const {
    HandlePath::Request request;
    request.id = tracks_[0].id;
    request.grasp_point.x = 0.15;
    request.grasp_point.z = 0.03;
    request.q_to = 1.2;
    request.steps = 7;
    return request;
  }
};

TEST_F(Services, PredictGivesPosesWithCovarianceAlsoWhereNobodyLooked) {
  const ArticulationModelArrayConstPtr models = play(100);
  ASSERT_TRUE(models);
  const Predict::Response answer = predict(tracks_[0].id, {0, 0.7, 1.4, 1.7});
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_EQ(answer.header.frame_id, "map");
  EXPECT_NEAR((answer.header.stamp - models->header.stamp).toSec(), 0, 1e-6);
  ASSERT_EQ(answer.poses.size(), 4u);
  EXPECT_NE(answer.message.find("beyond that this is a guess"), std::string::npos) << answer.message;
  const double qs[] = {0, 0.7, 1.4, 1.7};
  for (int i = 0; i < 4; ++i) {
    // Noise of 1 mm over 60 poses: a radius is known to about 2 mm, an opening to about 0.01 rad.
    const Eigen::Isometry3d error = doorPose(qs[i]).inverse() * fromMessage(answer.poses[i].pose);
    EXPECT_LT(error.translation().norm(), 0.008) << i;
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.03) << i;
    for (int axis = 0; axis < 6; ++axis) EXPECT_GT(answer.poses[i].covariance[7 * axis], 0) << i << " " << axis;
  }
  EXPECT_EQ(predict(tracks_[1].id, {0.1}).message, "");
}

TEST_F(Services, ConfigurationInvertsPredict) {
  play(200);
  Configuration::Request request;
  request.id = tracks_[1].id;
  request.pose = toMessage(drawerPose(0.12));
  request.pose.position.x += 0.05;
  const auto answer = call<Configuration>("configuration", request);
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_NEAR(answer.q, 0.12, 0.003);
  EXPECT_NEAR(answer.residual, 0.05, 0.003);
  EXPECT_NEAR(answer.orientation_residual, 0, 0.01);
}

TEST_F(Services, HandlePathFollowsTheHandle) {
  play(300);
  const HandlePath::Response answer = call<HandlePath>("handle_path", pathRequest());
  ASSERT_TRUE(answer.success) << answer.message;
  ASSERT_EQ(answer.poses.size(), 7u);
  ASSERT_EQ(answer.q.size(), 7u);
  EXPECT_EQ(answer.q.back(), 1.2);
  for (int i = 0; i < 7; ++i) {
    const Eigen::Isometry3d hand = fromMessage(answer.poses[i].pose);
    const Eigen::Vector3d expected = doorPose(0.2 * i) * Eigen::Vector3d(0.15, 0, 0.03);
    EXPECT_LT((hand.translation() - expected).norm(), 0.008) << i;
    EXPECT_GT(answer.poses[i].covariance[0], 0);
  }
}

TEST_F(Services, FitTrackRemembersNothing) {
  play(400);
  FitTrack::Request request;
  request.track = toMessage(tracks_[0], "somewhere");
  request.track.id = 4711;
  const FitTrack::Response answer = call<FitTrack>("fit_track", request);
  ASSERT_TRUE(answer.success) << answer.message;
  ASSERT_GE(answer.models.size(), 3u) << "all candidates";
  EXPECT_EQ(answer.models[0].type, ArticulationModel::ROTATIONAL);
  EXPECT_EQ(answer.models[0].header.frame_id, "somewhere");
  EXPECT_FALSE(predict(4711, {0}).success);
}

TEST_F(Services, AModelThatIsSentInIsEvaluatedAndProjectedTo) {
  const ArticulationModelArrayConstPtr models = play(420);
  ASSERT_TRUE(models);
  EvaluateModel::Request evaluate;
  evaluate.track = toMessage(tracks_[1], "map");
  std::vector<double> likelihoods;
  for (const ArticulationModel& model : models->models) {
    evaluate.model = model;
    evaluate.model.id = 4712;
    const auto answer = call<EvaluateModel>("evaluate_model", evaluate);
    ASSERT_TRUE(answer.success) << answer.message;
    ASSERT_EQ(answer.q.size(), tracks_[1].observations.size());
    likelihoods.push_back(answer.log_likelihood);
  }
  ASSERT_EQ(likelihoods.size(), 3u);
  EXPECT_GT(likelihoods[1], std::max(likelihoods[0], likelihoods[2]) + 100) << "the drawer's track is the drawer's";

  ProjectPoses::Request poses;
  poses.model = models->models[1];
  poses.model.id = 4712;
  poses.poses = {toMessage(drawerPose(0.05)), toMessage(drawerPose(0.2))};
  const auto q = call<ProjectPoses>("project_poses", poses);
  ASSERT_TRUE(q.success) << q.message;
  EXPECT_NEAR(q.q.at(1) - q.q.at(0), 0.15, 0.003);
  ProjectConfigurations::Request configurations;
  configurations.model = poses.model;
  configurations.q = q.q;
  const auto back = call<ProjectConfigurations>("project_configurations", configurations);
  ASSERT_TRUE(back.success) << back.message;
  ASSERT_EQ(back.poses.size(), 2u);
  EXPECT_EQ(back.header.frame_id, "map");
  EXPECT_LT((fromMessage(back.poses[1].pose).translation() - drawerPose(0.2).translation()).norm(), 0.005);
  EXPECT_GT(back.poses[1].covariance[0], 0);
  EXPECT_FALSE(predict(4712, {0}).success) << "nothing is remembered";

  evaluate.track.header.frame_id = "odom";
  const auto frames = call<EvaluateModel>("evaluate_model", evaluate);
  EXPECT_FALSE(frames.success);
  EXPECT_EQ(frames.message, "the model is in the frame 'map' and the track in 'odom'");
  EXPECT_TRUE(frames.q.empty());
}

TEST_F(Services, RefusalsSayWhy) {
  play(500);
  const auto refuses = [this](const std::string& words, bool success, const std::string& message) {
    EXPECT_FALSE(success);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  const auto expectPredict = [&](const std::string& words, std::uint32_t id, const std::vector<double>& q) {
    const Predict::Response answer = predict(id, q);
    refuses(words, answer.success, answer.message);
    EXPECT_TRUE(answer.poses.empty());
  };
  expectPredict("there is no front 99999; the fronts known are", 99999, {0});
  expectPredict("has not moved enough yet", tracks_[2].id, {0});
  expectPredict("q is nan, expected -100 to 100", tracks_[0].id, {0, kNan});
  expectPredict("q is empty", tracks_[0].id, {});
  Predict::Request half_open;
  half_open.id = tracks_[0].id;
  half_open.q = {0.5};
  half_open.as_opening = true;
  const auto not_seen_closed = call<Predict>("predict", half_open);
  refuses("it is not known where front", not_seen_closed.success, not_seen_closed.message);
  Configuration::Request pose;
  pose.id = tracks_[0].id;
  const auto no_pose = call<Configuration>("configuration", pose);
  refuses("expected a unit quaternion", no_pose.success, no_pose.message);
  HandlePath::Request path = pathRequest();
  path.steps = 4000000000U;
  const auto too_long = call<HandlePath>("handle_path", path);
  refuses("expected 2 to 10000", too_long.success, too_long.message);
  const auto no_track = call<FitTrack>("fit_track", {});
  refuses("the track has no poses", no_track.success, no_track.message);
  FitTrack::Request track;
  track.track = toMessage(tracks_[0], "map");
  track.track.poses[1].position.x = kNan;
  const auto bad_track = call<FitTrack>("fit_track", track);
  refuses(", expected -1e+08 to 1e+08 m", bad_track.success, bad_track.message);
}

TEST_F(Services, RefuseWhatWouldHoldUpTheOtherStages) {
  play(550);
  const auto expectRefused = [](const auto& answer, const std::string& words) {
    EXPECT_FALSE(answer.success);
    EXPECT_NE(answer.message.find(words), std::string::npos) << answer.message;
  };
  const std::uint32_t door = tracks_[0].id;
  expectRefused(predict(door, std::vector<double>(10001, 0.5)), "there are 10001 openings in q, expected 10000 at most");
  expectRefused(predict(door, {1e300}), "q is 1e+300, expected -100 to 100 m or rad");
  EXPECT_TRUE(predict(door, std::vector<double>(10000, 0.5)).success);
  ExportUrdf::Request ids;
  ids.ids.assign(10001, door);
  expectRefused(call<ExportUrdf>("export_urdf", ids), "there are 10001 ids");
  ids.ids.assign(3, door);
  const auto urdf = call<ExportUrdf>("export_urdf", ids);
  EXPECT_TRUE(urdf.success) << "each counts once: " << urdf.message;
  FitTrack::Request track;
  track.track = toMessage(tracks_[0], "map");
  track.track.poses[3].position.y = 1e155;
  expectRefused(call<FitTrack>("fit_track", track), "poses[3]: position is (");
  track.track.poses.resize(10001);
  expectRefused(call<FitTrack>("fit_track", track), "there are 10001 poses");
  EXPECT_TRUE(predict(door, {0.5}).success) << "what was known stays known";
}

TEST_F(Services, KnowJointsAlsoAfterTheClockWasSetBack) {
  play(2000);
  const Recorder<KnownFrontArray> known("/cabinet/known_fronts");
  ASSERT_TRUE(spinUntil([&] { return !known.messages.empty(); })) << "a tracker that comes hears of what is known";
  generation_ = known.messages.back()->generation;
  send(1000);
  ASSERT_TRUE(spinUntil([&] { return known.messages.back()->generation != generation_; }))
      << "the tracker hears of the joints, as after a restart";
  const auto& fronts = known.messages.back()->tracks;
  const auto is_known = [&](int i) {
    return std::any_of(fronts.begin(), fronts.end(), [&](const Track& front) { return front.id == tracks_[i].id; });
  };
  EXPECT_TRUE(is_known(0) && is_known(1) && !is_known(2)) << "door and drawer, and not the wall";
  EXPECT_TRUE(predict(tracks_[0].id, {0.5}).success);
}

TEST_F(Services, ForgetWhatIsInAnotherFrameThanTheTracksNow) {
  play(3000);
  ASSERT_TRUE(predict(tracks_[0].id, {0.5}).success);
  const std::uint32_t door = tracks_[0].id;
  frame_id_ = "odom";
  for (core::Track& track : tracks_) {
    track.id = nextId();
    track.observations.clear();
  }
  test::Reports reports;
  ASSERT_TRUE(spinUntil([&] { return reports.hears(2); }));
  ASSERT_TRUE(play(3100));
  EXPECT_EQ(predict(tracks_[0].id, {0.5}).header.frame_id, "odom");
  EXPECT_FALSE(predict(door, {0.5}).success);
  EXPECT_TRUE(spinUntil(
      [&] { return reports.logged(rosgraph_msgs::Log::WARN, "what was known is in the frame 'map' and tracks are in 'odom'"); }));
}

TEST_F(Services, ResetForgetsEverythingAndTellsTheTracker) {
  play(600);
  ASSERT_TRUE(predict(tracks_[0].id, {0}).success);
  const Recorder<KnownFrontArray> known("/cabinet/known_fronts");
  ASSERT_TRUE(spinUntil([&] { return !known.messages.empty(); }));
  generation_ = known.messages.back()->generation;
  const auto answer = call<std_srvs::Trigger>("reset", {});
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_FALSE(predict(tracks_[0].id, {0}).success);
  ASSERT_TRUE(spinUntil([&] { return known.messages.back()->generation != generation_; }));
  EXPECT_TRUE(known.messages.back()->tracks.empty());
  // What the tracker published before it heard of the reset is not learned from; what it publishes then is.
  const size_t before = models_.messages.size();
  send(700);
  test::spinFor(0.3);
  EXPECT_EQ(models_.messages.size(), before);
  generation_ = known.messages.back()->generation;
  for (core::Track& track : tracks_) track.observations.clear();
  EXPECT_TRUE(play(800));
  EXPECT_TRUE(predict(tracks_[0].id, {0}).success);
}

TEST_F(Services, RemindATrackerThatDoesNotFollowAndDoNotWaitForEver) {
  play(900);
  const Recorder<KnownFrontArray> known("/cabinet/known_fronts");
  ASSERT_TRUE(spinUntil([&] { return !known.messages.empty(); }));
  generation_ = known.messages.back()->generation;
  ASSERT_TRUE(call<std_srvs::Trigger>("reset", {}).success);
  const size_t models = models_.messages.size();
  test::Reports reports;
  bool told = false;
  double stamp = 910;
  EXPECT_TRUE(spinUntil([&] {
    send(stamp += 0.1);
    test::spinFor(0.1);
    told = told || reports.statusHas("articulation", "waits for the tracker to take over what is known");
    return models_.messages.size() > models;
  }));
  EXPECT_TRUE(told);
  EXPECT_GT(known.messages.size(), 2u) << "the greeting, the reset, and it again";
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "services_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}

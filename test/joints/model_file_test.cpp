// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/model_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "cabinet_articulation/joints/prediction.h"
#include "joints/learned_fronts.h"
#include "joints/model_folder.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;
using test::learned;
using test::ThrowsSaying;
using testing::AllOf;
using testing::HasSubstr;

class ModelFiles : public test::ModelFolder {
 protected:
  void expectRefused(const std::string& words) const {
    EXPECT_THAT([&] { readModelFile(path_); }, ThrowsSaying<ModelFileError>(AllOf(HasSubstr(path_), HasSubstr(words))));
  }
};

TEST_F(ModelFiles, BringBackWhatWasKnown) {
  ModelFile saved{"odom", {learned(test::doorModel()), learned(test::drawerModel()), learned(test::garageModel())}};
  saved.fronts[1].model.doubt = 0.25;
  saved.fronts[0].model.hollow = true;
  saveModelFile(path_, saved);
  const ModelFile loaded = readModelFile(path_);
  EXPECT_EQ(loaded.frame, "odom");
  ASSERT_EQ(loaded.fronts.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const LearnedModel& before = saved.fronts[i].model;
    const LearnedModel& after = loaded.fronts[i].model;
    EXPECT_EQ(after.id, before.id);
    EXPECT_EQ(after.type, before.type);
    EXPECT_TRUE(isJoint(after));
    EXPECT_EQ(after.doubt, before.doubt);
    EXPECT_NEAR(after.stamp, before.stamp, 1e-5);
    EXPECT_EQ(after.observations, 20);
    EXPECT_TRUE(after.q_min_is_end);
    EXPECT_FALSE(after.q_max_is_end);
    EXPECT_EQ(after.probabilities, before.probabilities);
    EXPECT_TRUE(after.origin.isApprox(before.origin, 1e-10));
    EXPECT_TRUE(after.axis.isApprox(before.axis, 1e-10));
    EXPECT_TRUE(after.axis_point.isApprox(before.axis_point, 1e-10));
    EXPECT_TRUE(after.covariance.isApprox(before.covariance, 1e-9));
    EXPECT_EQ(after.curve.size(), before.curve.size());
    EXPECT_EQ(after.hollow, before.hollow);
    EXPECT_EQ(loaded.fronts[i].track.hollow, before.hollow);
    for (const auto& field :
         {&LearnedModel::radius, &LearnedModel::pitch, &LearnedModel::q, &LearnedModel::q_min, &LearnedModel::q_max,
          &LearnedModel::width, &LearnedModel::height, &LearnedModel::position_error, &LearnedModel::orientation_error})
      EXPECT_NEAR(after.*field, before.*field, 1e-10);
    EXPECT_EQ(after.params.size(), 2u);
    EXPECT_EQ(after.params[1].name, "q_min[0]");
    EXPECT_EQ(after.params[1].kind, ModelParam::kEval);
    for (const double q : {-0.1, 0.0, 0.2, 0.9}) {
      const UncertainPose a = predictWithCovariance(before, q), b = predictWithCovariance(after, q);
      EXPECT_TRUE(a.pose.isApprox(b.pose, 1e-10)) << i << " at " << q;
      EXPECT_TRUE(a.covariance.isApprox(b.covariance, 1e-9)) << i << " at " << q;
    }
    const Track& track = loaded.fronts[i].track;
    ASSERT_EQ(track.observations.size(), 20u);
    const TrackedObservation &first = saved.fronts[i].track.observations[3], &again = track.observations[3];
    EXPECT_NEAR(again.stamp, first.stamp, 1e-5);
    EXPECT_TRUE(again.rectangle.pose.isApprox(first.rectangle.pose, 1e-10));
    EXPECT_NEAR(again.rectangle.height, first.rectangle.height, 1e-10);
    EXPECT_EQ(again.edge_support, first.edge_support);
    EXPECT_TRUE(again.covariance.isApprox(first.covariance, 1e-9));
    EXPECT_TRUE(again.measured.pose.isApprox(again.rectangle.pose));
  }
}

TEST_F(ModelFiles, KeepNames) {
  for (const char* const name : {"fridge", "null", "true", "No", "NaN", "e5", "front_3"}) {
    KnownFront door = learned(test::doorModel());
    door.model.name = name;
    saveModelFile(path_, {"map", {door}});
    EXPECT_EQ(readModelFile(path_).fronts.at(0).model.name, name);
  }
}

TEST_F(ModelFiles, KeepWhatAFrontHangsOn) {
  KnownFront door = learned(test::doorModel()), drawer = learned(test::drawerModel());
  saveModelFile(path_, {"map", {door, drawer}});
  EXPECT_EQ(text().find("parent"), std::string::npos);
  EXPECT_NE(text().find("version: 1"), std::string::npos) << "older programs read what hangs on the world";
  drawer.model.parent = 3;
  drawer.model.parent_probability = 0.875;  // the same drawer, better known
  saveModelFile(path_, {"map", {door, drawer}});
  EXPECT_NE(text().find("version: 2"), std::string::npos) << "and not what they would place wrongly";
  const ModelFile loaded = readModelFile(path_);
  ASSERT_EQ(loaded.fronts.size(), 2U);
  EXPECT_EQ(loaded.fronts[0].model.parent, 0U);
  EXPECT_EQ(loaded.fronts[0].model.parent_probability, 1);
  EXPECT_EQ(loaded.fronts[1].model.parent, 3U);
  EXPECT_EQ(loaded.fronts[1].model.parent_probability, 0.875);
}

TEST_F(ModelFiles, WithACycleOfParentsAreRefused) {
  KnownFront door = learned(test::doorModel()), drawer = learned(test::drawerModel());
  drawer.model.parent = 3;
  saveModelFile(path_, {"map", {door, drawer}});
  damage("id: 3\n", "id: 3\n    parent: 4\n");
  expectRefused("front 3 hangs on front 4, which hangs on front 3, in a cycle");
  damage("parent: 4", "parent: 3");
  expectRefused("front 3 hangs on front 3, in a cycle");
  damage("parent: 3", "parent: x");
  expectRefused("'parent'");
}

TEST_F(ModelFiles, OlderThanNamesHaveNone) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  EXPECT_EQ(text().find("name:"), std::string::npos);
  EXPECT_EQ(readModelFile(path_).fronts.at(0).model.name, "");
}

TEST_F(ModelFiles, WithBadNamesAreRefused) {
  KnownFront door = learned(test::doorModel()), drawer = learned(test::drawerModel());
  door.model.name = "fridge";
  drawer.model.name = "drawer";
  saveModelFile(path_, {"map", {door, drawer}});
  damage("name: drawer", "name: [drawer]");
  expectRefused("front 2: 'name' is no name");
  damage("name: [drawer]", "name: top drawer");
  expectRefused("front 2: 'name': the character at position 4");
  damage("name: top drawer", "name: front_9");
  expectRefused("front 2: 'name' is that of another front, front_9");
  damage("name: front_9", "name: fridge");
  expectRefused("front 2: its name is there twice");
}

std::vector<JointShape> twoKinds() {
  JointShape door;
  door.type = JointType::kRotational;
  door.frame = Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  door.radius = 0.1234567;
  door.width = 0.25;
  door.height = 0.6;
  door.range = 1.5;
  JointShape drawer;
  drawer.width = drawer.height = 0.3;
  return {door, drawer};
}

TEST_F(ModelFiles, KeepKindsOfFrontsThatAreForgotten) {
  ModelFile models{"map", {learned(test::doorModel())}};
  models.kinds = twoKinds();
  EXPECT_THAT(saveModelFile(path_, models).inWords(path_), HasSubstr("the joints of 2 fronts that are not known any more"));
  const std::vector<JointShape> kinds = readModelFile(path_).kinds;
  ASSERT_EQ(kinds.size(), 2u);
  EXPECT_EQ(kinds[0].type, JointType::kRotational);
  EXPECT_TRUE(kinds[0].frame.isApprox(models.kinds[0].frame, 1e-10));
  for (const auto& field : {&JointShape::radius, &JointShape::width, &JointShape::height, &JointShape::range})
    EXPECT_NEAR(kinds[0].*field, models.kinds[0].*field, 1e-10);
  EXPECT_EQ(kinds[1].type, JointType::kPrismatic);
  EXPECT_EQ(saveModelFile(path_, models).kinds, 2u) << "the same ones";
  models.kinds[1].height = 0.4;
  EXPECT_EQ(saveModelFile(path_, models).kinds, 3u) << "of both";
  EXPECT_EQ(removeFromModelFile(path_, "map", {test::doorModel()}), 1u);
  EXPECT_EQ(readModelFile(path_).kinds.size(), 3u) << "the kind of a front that is gone exists all the same";
  models.replaces_kinds = true;
  models.kinds.clear();
  EXPECT_EQ(saveModelFile(path_, models).kinds, 0u);
}

TEST_F(ModelFiles, OfAnotherFrameGiveTheirKinds) {
  ModelFile models{"odom", {learned(test::doorModel())}};
  models.kinds = twoKinds();
  saveModelFile(path_, models);
  const SavedModels saved = saveModelFile(path_, {"map", {learned(test::drawerModel())}});
  EXPECT_NE(saved.kept, "");
  EXPECT_EQ(readModelFile(path_).kinds.size(), 2u) << "kinds are in no frame";
}

TEST_F(ModelFiles, OlderThanKindsHaveNone) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  EXPECT_EQ(text().find("kinds"), std::string::npos);
  EXPECT_TRUE(readModelFile(path_).kinds.empty());
}

TEST_F(ModelFiles, WithBadKindsAreRefused) {
  ModelFile models{"map", {}};
  models.kinds = twoKinds();
  saveModelFile(path_, models);
  damage("radius: 0.1234567", "radius: 0");
  expectRefused("joint 1 of 'kinds': 'radius' is 0");
  damage("radius: 0", "radius: .inf");
  expectRefused("joint 1 of 'kinds': 'radius' is missing or no finite number");
  damage("radius: .inf", "radius: 0.2");
  damage("type: prismatic", "type: screw");
  expectRefused("joint 2 of 'kinds': 'type' is screw, expected prismatic or rotational");
  damage("type: screw", "type: prismatic");
  damage("frame: [0, 0, 0, 1]", "frame: [0, 0, 1, 1]");
  expectRefused("joint 2 of 'kinds': 'frame' has no unit quaternion");
  damage("frame: [0, 0, 1, 1]", "frame: [0, 0, 1]");
  expectRefused("joint 2 of 'kinds': 'frame' is not a list of 4 numbers");
}

TEST_F(ModelFiles, OlderThanTheEndsOfARangeKnowOfNone) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  damage("    q_min_is_end: true\n", "");
  EXPECT_FALSE(readModelFile(path_).fronts.at(0).model.q_min_is_end);
}

TEST_F(ModelFiles, KeepWhereAFrontIsClosed) {
  KnownFront door = learned(test::doorModel());
  door.model.closed_known = true;
  door.model.q_closed = -0.3;
  saveModelFile(path_, {"map", {door, learned(test::drawerModel())}});
  const ModelFile loaded = readModelFile(path_);
  EXPECT_TRUE(loaded.fronts.at(0).model.closed_known);
  EXPECT_NEAR(loaded.fronts[0].model.q_closed, -0.3, 1e-10);
  EXPECT_NEAR(loaded.fronts[0].model.opening, 0.8 / 1.5, 1e-10);
  EXPECT_FALSE(loaded.fronts.at(1).model.closed_known) << "as in a file that is older than the field";
  EXPECT_TRUE(std::isnan(loaded.fronts[1].model.q_closed) && std::isnan(loaded.fronts[1].model.opening));
}

TEST_F(ModelFiles, OlderThanAJointTypeGiveItNoProbability) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  damage("probabilities: [0.01, 0.02, 0.94, 0.03, 0]", "probabilities: [0.01, 0.02, 0.97]");
  damage("    pitch: 0.0125\n", "");
  const LearnedModel loaded = readModelFile(path_).fronts.at(0).model;
  EXPECT_EQ(loaded.probabilities, (std::vector<double>{0.01, 0.02, 0.97, 0, 0}));
  EXPECT_EQ(loaded.pitch, 0);
}

TEST_F(ModelFiles, OlderThanDoubtKnowOfNone) {
  KnownFront door = learned(test::doorModel());
  door.model.doubt = 0.5;
  saveModelFile(path_, {"map", {door}});
  damage("    doubt: 0.5\n", "");
  EXPECT_EQ(readModelFile(path_).fronts.at(0).model.doubt, 0);
}

TEST_F(ModelFiles, OlderThanTheFieldsForSupportAndDoubtHaveThemAmongTheParams) {
  KnownFront door = learned(test::doorModel());
  door.model.support = 40;
  door.model.params.push_back({"support", 17, ModelParam::kEval});
  door.model.params.push_back({"doubt", 0.25, ModelParam::kEval});
  saveModelFile(path_, {"map", {door}});
  ASSERT_NE(text().find("doubt: [0.25, 2]"), std::string::npos);
  const LearnedModel loaded = readModelFile(path_).fronts.at(0).model;
  EXPECT_EQ(loaded.support, 40);
  EXPECT_EQ(loaded.doubt, 0);
  ASSERT_EQ(loaded.params.size(), 2u) << "nobody keeps them up to date there";
  EXPECT_EQ(loaded.params[1].name, "q_min[0]");
}

TEST_F(ModelFiles, OfTheTimeWhenIdsBeganAtZeroGiveThatFrontAnother) {
  saveModelFile(path_, {"map", {learned(test::doorModel()), learned(test::drawerModel())}});
  damage("id: 3", "id: 0");
  const ModelFile loaded = readModelFile(path_);
  EXPECT_EQ(loaded.fronts.at(0).model.id, 5u);
  EXPECT_EQ(loaded.fronts.at(0).track.id, 5u);
  EXPECT_EQ(inWords(loaded.changes), "front 0 of the file is front 5 now");
}

TEST_F(ModelFiles, HoldTimesFromTheFirstToTheLastThatAMessageHolds) {
  for (const double stamp : {0.0, 0.02, 4290000000.0}) {
    saveModelFile(path_, {"map", {learned(test::doorModel(), 20, stamp)}});
    const KnownFront loaded = readModelFile(path_).fronts.at(0);
    EXPECT_NEAR(loaded.model.stamp, stamp, 0.01);
    EXPECT_GE(loaded.track.observations.front().stamp, 0);
    EXPECT_TRUE(std::is_sorted(loaded.track.observations.begin(), loaded.track.observations.end(),
                               [](const auto& a, const auto& b) { return a.stamp < b.stamp; }));
    fs::remove(path_);
  }
}

TEST_F(ModelFiles, OfNothingAreReadToo) {
  saveModelFile(path_, {"map", {}});
  EXPECT_TRUE(readModelFile(path_).fronts.empty());
}

TEST_F(ModelFiles, HoldMarkersThatHaveNoSizeAndObservationsWithoutCertainty) {
  LearnedModel marker = test::drawerModel();
  marker.width = marker.height = 0;
  ModelFile saved{"map", {learned(marker)}};
  for (TrackedObservation& observation : saved.fronts[0].track.observations) observation.rectangle.height = 0;
  saved.fronts[0].track.observations[1].covariance(5, 5) = std::numeric_limits<double>::infinity();
  saved.fronts[0].track.observations[2].rectangle.pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  saveModelFile(path_, saved);
  const KnownFront loaded = readModelFile(path_).fronts.at(0);
  EXPECT_EQ(loaded.model.width, 0);
  ASSERT_EQ(loaded.track.observations.size(), 19u) << "but for the one without a place";
  EXPECT_TRUE(loaded.track.observations[1].covariance.isZero(0)) << "unknown";
}

TEST_F(ModelFiles, StaySmallWhenMuchWasSeen) {
  saveModelFile(path_, {"map", {learned(test::doorModel(), 5000)}});
  EXPECT_LE(readModelFile(path_).fronts.at(0).track.observations.size(), 200u);
  EXPECT_LT(fs::file_size(path_), 200000u);
}

TEST_F(ModelFiles, OfAnotherVersionAreRefused) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  damage("version: 1", "version: 3");
  expectRefused("its version is 3, this program reads the versions 1 and 2");
}

TEST_F(ModelFiles, ThatAreCutOffAreRefused) {
  saveModelFile(path_, {"map", {learned(test::doorModel()), learned(test::drawerModel())}});
  const std::string whole = text();
  // Wherever the file ends: in the middle of a number, of a list, or after a whole line. The last byte alone is a newline.
  for (size_t size = 1; size < whole.size() - 8; size += 97) {
    write(whole.substr(0, size));
    EXPECT_THROW(readModelFile(path_), ModelFileError) << size;
  }
  write("");
  expectRefused("holds no models");
}

TEST_F(ModelFiles, ThatAreDamagedAreRefused) {
  const std::pair<std::pair<const char*, const char*>, const char*> damages[] = {
      {{"type: rotational", "type: wobbly"}, "front 1: 'type' is no kind of joint"},
      {{"id: 3", "id: -3"}, "'id' is not a whole number"},
      {{"id: 3", "id: 4294967295"}, "'id' is not a whole number from 0 to 4000000000"},
      {{"number_of_observations: 20", "number_of_observations: 4294967295"}, "'number_of_observations' is not a whole number"},
      {{"doubt: 0", "doubt: 1.5"}, "doubt is 1.5, expected 0 to 1"},
      {{"stamp: 1", "stamp: -1"}, "'stamp' has the time -1795323255.250000, expected seconds from 0 to 4290000000"},
      {{"stamp: 1", "stamp: 9"}, "'stamp' has the time 9795323255.250000"},
      {{"stamp: 1795323255.25", "stamp: .inf"}, "'stamp' is missing or no finite number"},
      {{"- [1795323253.350000", "- [-1.5"}, "'observations' has the time -1.5"},
      {{"- [1795323253.350000", "- [1e12"}, "'observations' has the time 1000000000000"},
      {{"- [1795323253.350000", "- [1795323254"}, "'observations' are not in the order of their times"},
      {{", 1, 0.5, 0.25, 0, ", ", 1e154, 0.5, 0.25, 0, "}, "an observation's share of an edge is 1e+154, expected 0 to 1"},
      {{"sigma_position: [0.01, 0]", "sigma_position: [0.01, 1e300]"}, "a param's kind is 1e+300, expected 0 to 2"},
      {{"width: 0.4", "width: -0.4"}, "width is -0.4, expected 0.001 to 10 m, or 0"},
      {{"q_max: 1.2", "q_max: .nan"}, "'q_max' is missing or no finite number"},
      {{"q_max: 1.2", "q_max: -1"}, "'q_min' is more than 'q_max'"},
      {{"q_min_is_end: true", "q_min_is_end: 3"}, "'q_min_is_end' is neither true nor false"},
      {{"q_min_is_end: true", "q_closed: 1000"}, "q_closed"},
      {{"axis: [0, 1, 0]", "axis: [0, 2, 0]"}, "'axis' is not of unit length"},
      {{"axis: [0, 1, 0]", "axis: [0, 1]"}, "'axis' is not a list of 3 numbers"},
      {{"probabilities: [0.01, 0.02, 0.94, 0.03, 0]", "probabilities: [0.01, 0.99]"},
       "'probabilities' is not a list of 3 numbers"},
      {{"probabilities: [0.01, 0.02, 0.94, 0.03, 0]", "probabilities: 1"}, "'probabilities' is not a list of 5 numbers"},
      {{"probabilities:", "others:"}, "'probabilities' is not a list of 5 numbers"},
      {{"origin: [", "origin: [1, "}, "'origin' is not a list of 7 numbers"},
      {{"frame: map", "fram: map"}, "'frame' or 'fronts' is missing"},
      {{"observations:\n", "remarks:\n"}, "'observations' is missing or empty"},
  };
  for (const auto& [change, words] : damages) {
    fs::remove(path_);
    saveModelFile(path_, {"map", {learned(test::doorModel())}});
    damage(change.first, change.second);
    expectRefused(words);
  }
  fs::remove(path_);
  saveModelFile(path_, {"map", {learned(test::doorModel()), learned(test::drawerModel())}});
  damage("id: 4", "id: 3");
  expectRefused("front 2: its id is there twice");
  write("just some text");
  expectRefused("holds no models of this program");
  write("a: [1, 2");
  expectRefused("line");
}

TEST_F(ModelFiles, WhereNobodyCanWriteAreAnError) {
  EXPECT_THAT(
      [&] {
        saveModelFile((folder_ / "missing" / "kitchen.yaml").string(), {"map", {}});
      },
      ThrowsSaying<ModelFileError>(HasSubstr("cannot be written: No such file or directory")));
  EXPECT_THAT([&] { readModelFile((folder_ / "missing.yaml").string()); },
              ThrowsSaying<ModelFileError>(HasSubstr("cannot be opened")));
}

TEST_F(ModelFiles, AreOrdinaryFilesAndNothingElseIsOpened) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  expectRefused("is a pipe, expected an ordinary file");  // and does not wait for somebody to write
  EXPECT_THAT([&] { saveModelFile(path_, {"map", {}}); }, ThrowsSaying<ModelFileError>(HasSubstr("is left as it is")));
  EXPECT_TRUE(fs::is_fifo(path_));
  EXPECT_THAT([&] { readModelFile(folder_.string()); }, ThrowsSaying<ModelFileError>(HasSubstr("is a folder")));
  EXPECT_THAT([&] { saveModelFile("/dev/null", {"map", {}}); }, ThrowsSaying<ModelFileError>(HasSubstr("is a device")));
}

}  // namespace
}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <vector>

#include "cabinet_articulation/joints/model_file.h"
#include "joints/learned_fronts.h"
#include "joints/model_folder.h"

namespace cabinet_articulation::core {
namespace {

using test::learned;
using testing::HasSubstr;

class NamesParentsAndKindsInModelFiles : public test::ModelFolder {};

TEST_F(NamesParentsAndKindsInModelFiles, KeepNames) {
  for (const char* const name : {"fridge", "null", "true", "No", "NaN", "e5", "front_3"}) {
    KnownFront door = learned(test::doorModel());
    door.model.name = name;
    saveModelFile(path_, {"map", {door}});
    EXPECT_EQ(readModelFile(path_).fronts.at(0).model.name, name);
  }
}

TEST_F(NamesParentsAndKindsInModelFiles, KeepWhatAFrontHangsOn) {
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

TEST_F(NamesParentsAndKindsInModelFiles, WithACycleOfParentsAreRefused) {
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

TEST_F(NamesParentsAndKindsInModelFiles, OlderThanNamesHaveNone) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  EXPECT_EQ(text().find("name:"), std::string::npos);
  EXPECT_EQ(readModelFile(path_).fronts.at(0).model.name, "");
}

TEST_F(NamesParentsAndKindsInModelFiles, WithBadNamesAreRefused) {
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

TEST_F(NamesParentsAndKindsInModelFiles, KeepKindsOfFrontsThatAreForgotten) {
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

TEST_F(NamesParentsAndKindsInModelFiles, OfAnotherFrameGiveTheirKinds) {
  ModelFile models{"odom", {learned(test::doorModel())}};
  models.kinds = twoKinds();
  saveModelFile(path_, models);
  const SavedModels saved = saveModelFile(path_, {"map", {learned(test::drawerModel())}});
  EXPECT_NE(saved.kept, "");
  EXPECT_EQ(readModelFile(path_).kinds.size(), 2u) << "kinds are in no frame";
}

TEST_F(NamesParentsAndKindsInModelFiles, OlderThanKindsHaveNone) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  EXPECT_EQ(text().find("kinds"), std::string::npos);
  EXPECT_TRUE(readModelFile(path_).kinds.empty());
}

TEST_F(NamesParentsAndKindsInModelFiles, WithBadKindsAreRefused) {
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

}  // namespace
}  // namespace cabinet_articulation::core

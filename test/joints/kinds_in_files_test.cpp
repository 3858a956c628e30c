// SPDX-License-Identifier: BSD-3-Clause
// How the kinds of joints in files come and go.
#include "joints/cleared_kinds.h"
#include "joints/kind_fields.h"
#include "joints/learned_fronts.h"
#include "joints/model_folder.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::learned;

class KindsInFiles : public test::ModelFolder {};

/// Drawers of different fronts.
std::vector<JointShape> drawers(std::size_t count, double narrowest) {
  std::vector<JointShape> shapes(count);
  for (std::size_t i = 0; i < count; ++i) {
    shapes[i].width = narrowest + 1e-3 * static_cast<double>(i);
    shapes[i].height = 0.2;
  }
  return shapes;
}

TEST_F(KindsInFiles, AreAtMostAsManyAsInMemory) {
  ModelFile models{"map", {learned(test::doorModel())}};
  models.kinds = drawers(kMostShapes - 6, 0.2);
  EXPECT_EQ(saveModelFile(path_, models).kinds, kMostShapes - 6);
  models.kinds = drawers(10, 0.7);
  EXPECT_EQ(saveModelFile(path_, models).kinds, kMostShapes);
  const std::vector<JointShape> kinds = readModelFile(path_).kinds;
  ASSERT_EQ(kinds.size(), kMostShapes);
  EXPECT_TRUE(isSame(kinds[9], models.kinds[9])) << "those of the run that saves come first";
}

TEST_F(KindsInFiles, OfMoreJointsThanThatAreRefusedInWords) {
  ModelFile models{"map", {learned(test::doorModel())}};
  models.kinds = drawers(kMostShapes, 0.2);
  saveModelFile(path_, models);
  std::string changed = text();
  const std::size_t first = changed.find("kinds:\n") + 7, second = changed.find("  - type", first + 1);
  write(changed.insert(first, changed.substr(first, second - first)));
  EXPECT_THAT([&] { readModelFile(path_); }, test::ThrowsSaying<ModelFileError>(testing::HasSubstr("257 joints in 'kinds'")));
}

TEST_F(KindsInFiles, OutliveTheFrontThatTaughtThem) {
  saveModelFile(path_, {"map", {learned(test::doorModel()), learned(test::drawerModel())}});
  ASSERT_TRUE(readModelFile(path_).kinds.empty());
  const std::vector<JointShape> votes = drawers(1, 0.4);
  EXPECT_EQ(removeFromModelFile(path_, "map", {test::drawerModel()}, votes), 1u);
  const std::vector<JointShape> kinds = readModelFile(path_).kinds;
  ASSERT_EQ(kinds.size(), 1u);
  EXPECT_TRUE(isSame(kinds[0], votes[0]));
  EXPECT_EQ(removeFromModelFile(path_, "map", {test::doorModel()}, votes), 1u);
  EXPECT_EQ(readModelFile(path_).kinds.size(), 1u) << "one joint is there once";
}

TEST_F(KindsInFiles, AreClearedOnceFromEachFile) {
  const std::string other = folder_ / "backup.yaml", link = folder_ / "link.yaml";
  ClearedKinds cleared;
  EXPECT_FALSE(cleared.in(path_));
  cleared.clear();
  cleared.replaced(other);
  EXPECT_TRUE(cleared.in(path_)) << "a backup is another file";
  EXPECT_FALSE(cleared.in(other));
  write("");
  std::filesystem::create_symlink(path_, link);
  cleared.replaced(path_);
  EXPECT_FALSE(cleared.in(path_));
  EXPECT_FALSE(cleared.in(link)) << "it is the same file";
  cleared.clear();
  EXPECT_TRUE(cleared.in(path_));
  EXPECT_TRUE(cleared.in(other));
}

}  // namespace
}  // namespace cabinet_articulation::core

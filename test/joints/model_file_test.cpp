// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/model_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "cabinet_articulation/joints/prediction.h"
#include "support/models.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A front with a history from q_min to q_max and a covariance without zeros.
KnownFront known(LearnedModel model, int observations = 20) {
  model.stamp = 1795323255.25;
  model.position_error = 0.0012345;
  model.orientation_error = 0.02;
  model.observations = observations;
  model.q_min_is_end = true;
  model.q_max_is_end = false;
  model.probabilities = {0.01, 0.02, 0.94, 0.03};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) model.covariance(i, j) = 1e-5 / (1 + i + j);
  model.params = {{"sigma_position", 0.01, ModelParam::kPrior}, {"q_min[0]", model.q_min, ModelParam::kEval}};
  KnownFront front{model, {}};
  front.track.id = model.id;
  front.track.width = model.width;
  front.track.height = model.height;
  for (int i = 0; i < observations; ++i) {
    TrackedObservation observation;
    observation.stamp = model.stamp - 0.1 * (observations - 1 - i);
    observation.rectangle = {model.predict(model.q_max * i / (observations - 1)), model.width, model.height + 0.001 * i};
    observation.covariance = model.covariance;
    observation.edge_support = {1, 0.5F, 0.25F, 0};
    front.track.observations.push_back(observation);
  }
  return front;
}

class ModelFiles : public testing::Test {
 protected:
  ModelFiles() : folder_(fs::temp_directory_path() / ("model_file_test." + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    path_ = folder_ / "kitchen.yaml";
  }
  ~ModelFiles() override { fs::remove_all(folder_); }

  std::string text() const {
    std::ifstream in(path_);
    std::stringstream stream;
    stream << in.rdbuf();
    return stream.str();
  }

  void write(const std::string& text) const { std::ofstream(path_) << text; }

  /// Replaces the first `from` in the file.
  void damage(const std::string& from, const std::string& to) const {
    std::string content = text();
    const size_t at = content.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(content.replace(at, from.size(), to));
  }

  void expectRefused(const std::string& words) const {
    const std::string before = text();
    EXPECT_THAT([&] { readModelFile(path_); }, ThrowsMessage<ModelFileError>(AllOf(HasSubstr(path_), HasSubstr(words))));
    EXPECT_THAT([&] { writeModelFile(path_, {"map", {}}); }, ThrowsMessage<ModelFileError>(HasSubstr("left as it is")));
    EXPECT_EQ(text(), before) << "left untouched";
  }

  const fs::path folder_;
  std::string path_;
};

TEST_F(ModelFiles, BringBackWhatWasKnown) {
  const ModelFile saved{"odom", {known(test::doorModel()), known(test::drawerModel()), known(test::garageModel())}};
  writeModelFile(path_, saved);
  const ModelFile loaded = readModelFile(path_);
  EXPECT_EQ(loaded.frame, "odom");
  ASSERT_EQ(loaded.fronts.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const LearnedModel& before = saved.fronts[i].model;
    const LearnedModel& after = loaded.fronts[i].model;
    EXPECT_EQ(after.id, before.id);
    EXPECT_EQ(after.type, before.type);
    EXPECT_TRUE(isJoint(after));
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
    for (const auto& field :
         {&LearnedModel::radius, &LearnedModel::q, &LearnedModel::q_min, &LearnedModel::q_max, &LearnedModel::width,
          &LearnedModel::height, &LearnedModel::position_error, &LearnedModel::orientation_error})
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

TEST_F(ModelFiles, OlderThanTheEndsOfARangeKnowOfNone) {
  writeModelFile(path_, {"map", {known(test::doorModel())}});
  damage("    q_min_is_end: true\n", "");
  EXPECT_FALSE(readModelFile(path_).fronts.at(0).model.q_min_is_end);
}

TEST_F(ModelFiles, OfNothingAreReadToo) {
  writeModelFile(path_, {"map", {}});
  EXPECT_TRUE(readModelFile(path_).fronts.empty());
}

TEST_F(ModelFiles, HoldMarkersThatHaveNoSizeAndObservationsWithoutCertainty) {
  LearnedModel marker = test::drawerModel();
  marker.width = marker.height = 0;
  ModelFile saved{"map", {known(marker)}};
  for (TrackedObservation& observation : saved.fronts[0].track.observations) observation.rectangle.height = 0;
  saved.fronts[0].track.observations[1].covariance(5, 5) = std::numeric_limits<double>::infinity();
  saved.fronts[0].track.observations[2].rectangle.pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  writeModelFile(path_, saved);
  const KnownFront loaded = readModelFile(path_).fronts.at(0);
  EXPECT_EQ(loaded.model.width, 0);
  ASSERT_EQ(loaded.track.observations.size(), 19u) << "but for the one without a place";
  EXPECT_TRUE(loaded.track.observations[1].covariance.isZero(0)) << "unknown";
}

TEST_F(ModelFiles, StaySmallWhenMuchWasSeen) {
  writeModelFile(path_, {"map", {known(test::doorModel(), 5000)}});
  EXPECT_LE(readModelFile(path_).fronts.at(0).track.observations.size(), 200u);
  EXPECT_LT(fs::file_size(path_), 200000u);
}

TEST_F(ModelFiles, ReplaceAnOlderOneAndLeaveNothingBehind) {
  writeModelFile(path_, {"map", {known(test::doorModel())}});
  writeModelFile(path_, {"map", {known(test::drawerModel())}});
  EXPECT_EQ(readModelFile(path_).fronts.at(0).model.id, 4u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(ModelFiles, InAnotherFrameAreNotOverwritten) {
  writeModelFile(path_, {"map", {known(test::doorModel())}});
  EXPECT_THAT(
      [&] {
        writeModelFile(path_, {"odom", {known(test::drawerModel())}});
      },
      ThrowsMessage<ModelFileError>(HasSubstr("in the frame 'map', and the new ones in 'odom'; it is left as it is")));
  EXPECT_EQ(readModelFile(path_).fronts.at(0).model.id, 3u);
}

TEST_F(ModelFiles, OfAnotherVersionAreRefused) {
  writeModelFile(path_, {"map", {known(test::doorModel())}});
  damage("version: 1", "version: 2");
  expectRefused("its version is 2, this program reads version 1");
}

TEST_F(ModelFiles, ThatAreCutOffAreRefused) {
  writeModelFile(path_, {"map", {known(test::doorModel()), known(test::drawerModel())}});
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
      {{"width: 0.4", "width: -0.4"}, "'width' is -0.4, expected a length"},
      {{"q_max: 1.2", "q_max: .nan"}, "'q_max' is missing or no finite number"},
      {{"q_max: 1.2", "q_max: -1"}, "'q_min' is more than 'q_max'"},
      {{"q_min_is_end: true", "q_min_is_end: 3"}, "'q_min_is_end' is neither true nor false"},
      {{"axis: [0, 1, 0]", "axis: [0, 2, 0]"}, "'axis' is not of unit length"},
      {{"axis: [0, 1, 0]", "axis: [0, 1]"}, "'axis' is not a list of 3 numbers"},
      {{"origin: [", "origin: [1, "}, "'origin' is not a list of 7 numbers"},
      {{"frame: map", "fram: map"}, "'frame' or 'fronts' is missing"},
      {{"observations:\n", "remarks:\n"}, "'observations' is missing or empty"},
  };
  for (const auto& [change, words] : damages) {
    fs::remove(path_);
    writeModelFile(path_, {"map", {known(test::doorModel())}});
    damage(change.first, change.second);
    expectRefused(words);
  }
  fs::remove(path_);
  writeModelFile(path_, {"map", {known(test::doorModel()), known(test::doorModel())}});
  expectRefused("front 2: its id is there twice");
  write("just some text");
  expectRefused("holds no models of this program");
  write("a: [1, 2");
  expectRefused("line");
}

TEST_F(ModelFiles, WhereNobodyCanWriteAreAnError) {
  EXPECT_THAT(
      [&] {
        writeModelFile((folder_ / "missing" / "kitchen.yaml").string(), {"map", {}});
      },
      ThrowsMessage<ModelFileError>(HasSubstr("cannot be written: No such file or directory")));
  EXPECT_THAT([&] { readModelFile((folder_ / "missing.yaml").string()); },
              ThrowsMessage<ModelFileError>(HasSubstr("cannot be opened")));
}

}  // namespace
}  // namespace cabinet_articulation::core

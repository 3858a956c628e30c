// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <utility>

#include "cabinet_articulation/joints/model_file.h"
#include "joints/learned_fronts.h"
#include "joints/model_folder.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;
using test::learned;
using test::ThrowsSaying;
using testing::HasSubstr;

class BadModelFiles : public test::ModelFolder {};

TEST_F(BadModelFiles, OfAnotherVersionAreRefused) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  damage("version: 1", "version: 3");
  expectRefused("its version is 3, this program reads the versions 1 and 2");
}

TEST_F(BadModelFiles, ThatAreCutOffAreRefused) {
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

TEST_F(BadModelFiles, ThatAreDamagedAreRefused) {
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

TEST_F(BadModelFiles, WhereNobodyCanWriteAreAnError) {
  EXPECT_THAT(
      [&] {
        saveModelFile((folder_ / "missing" / "kitchen.yaml").string(), {"map", {}});
      },
      ThrowsSaying<ModelFileError>(HasSubstr("cannot be written: No such file or directory")));
  EXPECT_THAT([&] { readModelFile((folder_ / "missing.yaml").string()); },
              ThrowsSaying<ModelFileError>(HasSubstr("cannot be opened")));
}

TEST_F(BadModelFiles, AreOrdinaryFilesAndNothingElseIsOpened) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  expectRefused("is a pipe, expected an ordinary file");  // and does not wait for somebody to write
  EXPECT_THAT([&] { saveModelFile(path_, {"map", {}}); }, ThrowsSaying<ModelFileError>(HasSubstr("is left as it is")));
  EXPECT_TRUE(fs::is_fifo(path_));
  EXPECT_THAT([&] { readModelFile(folder_.string()); }, ThrowsSaying<ModelFileError>(HasSubstr("is a folder")));
  EXPECT_THAT([&] { saveModelFile("/dev/null", {"map", {}}); }, ThrowsSaying<ModelFileError>(HasSubstr("is a device")));
}

}  // namespace
}  // namespace cabinet_articulation::core

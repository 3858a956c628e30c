// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/bend_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "pipeline/kept_bends.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;

class BendFile : public testing::Test {
 protected:
  BendFile() { fs::create_directories(folder_); }
  ~BendFile() override { fs::remove_all(folder_); }

  static KnownBend example(double scale) {
    KnownBend known;
    known.camera = {640, 480, 525.123456789, 525, 319.5, 239.5, 0.075, 0};
    known.bend = BendVector::LinSpaced(-0.1, 0.2) * scale;
    known.views = 81;
    known.remaining = 0.125;
    return known;
  }

  void write(const std::string& text) const { std::ofstream(file_) << text; }

  std::string text() const {
    std::ostringstream all;
    all << std::ifstream(file_).rdbuf();
    return all.str();
  }

  const fs::path folder_ = fs::temp_directory_path() / ("bend_file_test_" + std::to_string(getpid()));
  const std::string file_ = (folder_ / "bends.yaml").string();
};

TEST_F(BendFile, WhatWasSavedComesBack) {
  EXPECT_TRUE(readBendFile(file_).empty()) << "a file that is not there yet";
  saveBends(file_, {{"kinect", example(1)}});
  const KnownBend back = readBendFile(file_).at("kinect");
  EXPECT_TRUE(back.bend.isApprox(example(1).bend, 1e-11));
  EXPECT_EQ(back.views, 81U);
  EXPECT_EQ(back.remaining, 0.125);
  EXPECT_EQ(back.camera.width, 640);
  EXPECT_NEAR(back.camera.fx, 525.123456789, 1e-9);
  EXPECT_EQ(back.camera.baseline, 0.075);
}

TEST_F(BendFile, EachCameraBeginsWithWhatIsKnownOfIt) {
  saveBends(file_, {{"kinect", example(1)}});
  KeptBends kept;
  kept.read(file_);
  EXPECT_EQ(kept.size(), 1U);
  SensorBend bend;
  kept.follow("other", &bend);
  EXPECT_FALSE(bend.isKnown());
  kept.follow("kinect", &bend);
  EXPECT_TRUE(bend.isKnown());
  EXPECT_EQ(bend.remaining(), 0.125);
  EXPECT_EQ(kept.save(bend), 0U) << "nothing was learned since";
}

TEST_F(BendFile, OtherCamerasStay) {
  saveBends(file_, {{"left: one", example(1)}, {"right", example(2)}});
  saveBends(file_, {{"right", example(3)}});
  const BendsOfCameras bends = readBendFile(file_);
  ASSERT_EQ(bends.size(), 2U);
  EXPECT_TRUE(bends.at("left: one").bend.isApprox(example(1).bend, 1e-11));
  EXPECT_TRUE(bends.at("right").bend.isApprox(example(3).bend, 1e-11));
}

TEST_F(BendFile, ABadFileIsSaidInWordsAndStays) {
  for (const std::string bad :
       {"models: []\n", "bends: 3\n", "bends: [{width: 3}]\n", "bends: [{camera: a, width: 640}]\n", "{", "- 1\n"}) {
    write(bad);
    EXPECT_THROW(readBendFile(file_), std::runtime_error) << bad;
    EXPECT_THROW(saveBends(file_, {{"kinect", example(1)}}), std::runtime_error) << bad;
    EXPECT_EQ(text(), bad);
  }
}

TEST_F(BendFile, NumbersThatNoCameraHasAreRefused) {
  saveBends(file_, {{"kinect", example(1)}});
  std::string changed = text();
  changed.replace(changed.find("-0.1"), 4, "1e30");
  write(changed);
  try {
    readBendFile(file_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("camera 'kinect': bend is 1e+30, expected -20 to 20 px"), std::string::npos)
        << error.what();
  }
}

/// Of each camera that the file has, a picture of that size is drawn.
TEST_F(BendFile, ImagesThatNoCameraHasAreRefused) {
  saveBends(file_, {{"kinect", example(1)}});
  std::string changed = text();
  changed.replace(changed.find("width: 640"), 10, "width: 16384");
  changed.replace(changed.find("height: 480"), 11, "height: 16384");
  write(changed);
  EXPECT_THROW(readBendFile(file_), std::runtime_error);
}

}  // namespace
}  // namespace cabinet_articulation::core

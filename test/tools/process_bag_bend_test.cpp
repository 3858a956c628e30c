// SPDX-License-Identifier: BSD-3-Clause
// What process_bag learns of a depth camera's bend, in a file.
#include "bend/bend_basis.h"
#include "pipeline/bend_file.h"
#include "support/bent_kitchen.h"
#include "tools/stereo_bag_fixture.h"

namespace cabinet_articulation {
namespace {

using core::BendsOfCameras;

class ProcessBagBend : public StereoBagFixture {
 protected:
  ProcessBagBend() { kitchen_.bend(test::dome()); }

  /// Depth of a camera that looks around and bends what is flat by up to a pixel.
  void writeTour(const std::string& name, int frames) {
    constexpr int kStep = 4;  // [tenths of a second]
    rosbag::Bag bag(path(name), rosbag::bagmode::Write);
    for (int i = 0; i < frames; ++i) {
      const core::DepthFrame frame = kitchen_.onTour(kStep * i);
      const ros::Time stamp(100 + i);
      cv::Mat1f depth(frame.disparity.size(), 0.0F);
      for (int v = 0; v < depth.rows; ++v)
        for (int u = 0; u < depth.cols; ++u)
          if (frame.disparity(v, u) > 0) depth(v, u) = static_cast<float>(frame.camera.depth(frame.disparity(v, u)));
      bag.write("/camera/depth/image", stamp, imageOf(depth, stamp, "32FC1"));
      bag.write("/camera/depth/camera_info", stamp, infoOf(frame.camera, false, stamp));
    }
  }

  /// Of one of the runs of a tour too short to learn from.
  std::string outputOf(const std::string& options) const {
    const Outcome outcome = run("short.bag out.bag --input depth " + options);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    return outcome.output;
  }

  test::BentKitchen kitchen_;
};

TEST_F(ProcessBagBend, IsSavedAndHoldsFromTheFirstFrameOfTheNextRun) {
  constexpr int kLong = 60, kShort = 3;
  writeTour("long.bag", kLong);
  const Outcome outcome = run("long.bag out.bag --input depth --bend-file bends.yaml");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const BendsOfCameras bends = core::readBendFile(path("bends.yaml"));
  ASSERT_EQ(bends.count(kOpticalFrame), 1U) << outcome.output;
  cv::Mat1f found;
  core::BendBasis({test::kKinect.width, test::kKinect.height}).draw(bends.at(kOpticalFrame).bend, &found);
  EXPECT_LT(cv::norm(found - test::dome(), cv::NORM_L2), 0.5 * cv::norm(test::dome(), cv::NORM_L2)) << "most of it";

  writeTour("short.bag", kShort);
  EXPECT_NE(outputOf("").find("no bend of the depth is known"), std::string::npos) << "or what follows shows nothing";
  const std::string saved = bytes(path("bends.yaml")), unknown = bytes(path("out.bag"));
  const std::string known = outputOf("--bend-file bends.yaml");
  EXPECT_NE(known.find("the depth is corrected by up to "), std::string::npos) << known;
  EXPECT_NE(bytes(path("out.bag")), unknown);
  EXPECT_EQ(bytes(path("bends.yaml")), saved) << "nothing new was learned";
}

TEST_F(ProcessBagBend, OfAFileThatIsDamagedIsSaidAndTheFileStays) {
  writeTour("short.bag", 1);
  std::ofstream(path("bends.yaml")) << "bends: 3\n";
  expectFailure("short.bag out.bag --input depth --bend-file bends.yaml", "bend file 'bends.yaml'");
  EXPECT_EQ(bytes(path("bends.yaml")), "bends: 3\n");
  EXPECT_FALSE(std::filesystem::exists(path("out.bag")));
}

TEST_F(ProcessBagBend, ThatTheSettingsSwitchOffIsNotReadInSilence) {
  writeTour("short.bag", 1);
  std::filesystem::create_directory(path("config"));
  std::ofstream(path("config/planes.yaml")) << "bend: false\n";
  const std::string output = outputOf("--config config --bend-file bends.yaml");
  EXPECT_NE(output.find("'bends.yaml' is neither used nor written"), std::string::npos) << output;
  EXPECT_FALSE(std::filesystem::exists(path("bends.yaml")));
}

}  // namespace
}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include "tools/input/scene_bag.h"
#include "tools/stereo_bag_fixture.h"

namespace cabinet_articulation {
namespace {

class ProcessBagReport : public StereoBagFixture {
 protected:
  void writeDoor(const std::string& name, int frames) const {
    SceneBagConfig config;
    config.simulation.scene = "door";
    config.simulation.rate = 3;
    config.frames = frames;
    config.start = ros::Time(100);
    writeSceneBag(path(name), config);
  }
};

TEST_F(ProcessBagReport, ShowsTheJointAndLeavesTheResultAsItIs) {
  writeDoor("door.bag", 0);
  ASSERT_EQ(run("door.bag plain.bag").status, 0);
  const Outcome outcome = run("door.bag shown.bag --report new/folder");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("report: new/folder/index.html"), std::string::npos) << outcome.output;
  EXPECT_TRUE(bytes(path("plain.bag")) == bytes(path("shown.bag")));

  std::ifstream file(path("new/folder/index.html"));
  boost::property_tree::ptree page;
  ASSERT_NO_THROW(read_xml(file, page));
  const std::string text = bytes(path("new/folder/index.html"));
  EXPECT_NE(text.find("1 front moved"), std::string::npos);
  EXPECT_NE(text.find("rotational, 100.0 %"), std::string::npos);
  EXPECT_NE(text.find("process_bag door.bag shown.bag --report new/folder"), std::string::npos);
  EXPECT_NE(text.find("data:image/jpeg;base64,/9j/"), std::string::npos) << "frames are within the page";
  EXPECT_EQ(text.find("http"), std::string::npos) << "nothing is fetched";
}

TEST_F(ProcessBagReport, ReplacesAReportButNothingElse) {
  writeDoor("door.bag", 3);
  ASSERT_EQ(run("door.bag out.bag --report report").status, 0);
  EXPECT_EQ(run("door.bag out.bag --report report/").status, 0) << "a second time";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("report")), {}), 1);
  std::ofstream(path("report/notes.txt")) << "mine\n";
  expectFailure("door.bag out.bag --report report", "--report report: holds other things, such as 'notes.txt'; name a folder");
  EXPECT_EQ(bytes(path("report/notes.txt")), "mine\n");
}

TEST_F(ProcessBagReport, SaysBeforeTheRunThatAFolderCannotBeWritten) {
  writeDoor("door.bag", 3);
  std::ofstream(path("file.txt")) << "no folder\n";
  expectFailure("door.bag out.bag --report file.txt", "file.txt' is no folder");
  expectFailure("door.bag out.bag --report file.txt/report", "file.txt' is no folder");
  expectFailure("door.bag out.bag --report /proc/report", "--report /proc/report: cannot be written");
  EXPECT_EQ(run("door.bag other.bag --report file.txt").output.find("frames of"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("other.bag")));
}

TEST_F(ProcessBagReport, ShowsWhatWasReadOfABagThatEndsEarly) {
  writeDoor("door.bag", 3);
  rosbag::Bag bag(path("door.bag"), rosbag::bagmode::Append);
  bag.write("/stereo/left/image_raw", ros::Time(200), imageOf(cv::Mat1b(480, 640, std::uint8_t{0}), ros::Time(200)));
  bag.close();
  ASSERT_EQ(run("door.bag out.bag --report report").status, 0);
  EXPECT_NE(bytes(path("report/index.html")).find("skipped 1 frames: left image without a right image"), std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation

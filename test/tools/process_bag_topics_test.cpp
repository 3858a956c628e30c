// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/RectangleArray.h>
#include <rosbag/view.h>
#include <sensor_msgs/CompressedImage.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "tools/input/bag_input.h"
#include "tools/stereo_bag_fixture.h"

namespace cabinet_articulation {
namespace {

/// What process_bag finds in a bag, and what it says where it finds nothing. Its depth images show a wall at 1.5 m and a front.
class ProcessBagTopics : public StereoBagFixture {
 protected:
  ProcessBagTopics() : simulation_(door()), frame_(simulation_.frame(12)) {}

  void SetUp() override {
    StereoBagFixture::SetUp();
    bag_.open(path("in.bag"), rosbag::bagmode::Write);
  }

  static core::SimulationConfig door() {
    core::SimulationConfig config;
    config.scene = "door";
    config.rate = 3;
    return config;
  }

  /// What a lens with the distortion of `info` makes of an ideal image.
  static cv::Mat throughLens(const cv::Mat& ideal, const sensor_msgs::CameraInfo& info) {
    std::vector<cv::Point2f> pixels, sources;
    for (int v = 0; v < ideal.rows; ++v)
      for (int u = 0; u < ideal.cols; ++u) pixels.emplace_back(u, v);
    const cv::Matx33d K(info.K.data());
    cv::undistortPoints(pixels, sources, K, info.D, cv::noArray(), K);
    cv::Mat raw;
    cv::remap(ideal, raw, cv::Mat(sources).reshape(2, ideal.rows), cv::noArray(), cv::INTER_LINEAR);
    return raw;
  }

  static cv::Mat1w millimetres() {
    cv::Mat1w depth(480, 640, 1500);
    depth(cv::Rect(200, 180, 200, 100)) = 1000;
    return depth;
  }

  template <class Message>
  void add(const std::string& topic, const Message& message) {
    bag_.write(topic, kStamp, message);
  }

  void addInfo(const std::string& topic, bool right = false) { add(topic, infoOf(simulation_.camera(), right, kStamp)); }

  void addImage(const std::string& topic, const cv::Mat& image, const char* encoding) {
    add(topic, imageOf(image, kStamp, encoding));
  }

  /// As image_transport's plugins do, `header` before the file.
  void addCompressed(const std::string& topic, const cv::Mat& image, const std::string& format, const char* extension,
                     const std::vector<std::uint8_t>& header = {}) {
    sensor_msgs::CompressedImage message;
    message.header.stamp = kStamp;
    message.header.frame_id = kOpticalFrame;
    message.format = format;
    cv::imencode(extension, image, message.data);
    message.data.insert(message.data.begin(), header.begin(), header.end());
    add(topic, message);
  }

  void addPair(const std::string& left, const std::string& right, const std::string& image) {
    addImage(left + image, frame_.left, "mono8");
    addImage(right + image, frame_.right, "mono8");
    addInfo(left + "camera_info");
    addInfo(right + "camera_info", true);
  }

  void addDepth(const std::string& camera) {
    addImage(camera + "image_raw", millimetres(), "16UC1");
    addInfo(camera + "camera_info");
  }

  static InputOptions rectifiedOptions(bool rectified) {
    InputOptions options;
    options.rectified = rectified;
    return options;
  }

  /// All that process_bag says about the input.
  Outcome process(const std::string& options) {
    bag_.close();
    return run("in.bag out.bag " + options);
  }

  void expectFrame(const std::string& options) {
    const Outcome outcome = process(options);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("1 frames of"), std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find("skipped"), std::string::npos) << outcome.output;
  }

  /// Of the last frame.
  std::vector<Rectangle> rectangles() {
    std::vector<Rectangle> found;
    rosbag::Bag out(path("out.bag"));
    for (const rosbag::MessageInstance& instance : rosbag::View(out, rosbag::TopicQuery("/cabinet/rectangles")))
      found = instance.instantiate<RectangleArray>()->rectangles;
    return found;
  }

  /// The front of millimetres() is found where it is.
  void expectFront(const std::string& options) { expectFront(options, 200 * 100, 1 / simulation_.camera().fx); }

  /// The same for a front of `area` pixels, each `pixel` metres wide at 1 m.
  void expectFront(const std::string& options, double area, double pixel) {
    expectFrame(options);
    const std::vector<Rectangle> found = rectangles();
    const auto matches = [area, pixel](const Rectangle& rectangle) {
      return std::abs(rectangle.width * rectangle.height - area * pixel * pixel) < 0.003 &&
             std::abs(rectangle.pose.pose.position.z - 1) < 0.002;
    };
    EXPECT_EQ(std::count_if(found.begin(), found.end(), matches), 1) << found.size() << " rectangles";
  }

  /// The simulated door has 0.4 m by 0.58 m; which of the two is the width depends on the corner that is named first.
  static bool isDoor(const Rectangle& rectangle) {
    const auto [less, more] = std::minmax({rectangle.width, rectangle.height});
    return std::abs(less - 0.4) < 0.02 && std::abs(more - 0.58) < 0.02;
  }

  void expectWords(const std::string& options, int status, const std::string& words) {
    const Outcome outcome = process(options);
    EXPECT_EQ(outcome.status, status) << outcome.output;
    EXPECT_NE(outcome.output.find(words), std::string::npos) << "expected '" << words << "' in:\n" << outcome.output;
  }

  const ros::Time kStamp{100};
  core::SimulatedStereoCamera simulation_;
  core::StereoFrame frame_;
  rosbag::Bag bag_;
};

TEST_F(ProcessBagTopics, TheOnlyInputIsFoundWithoutOptions) {
  addDepth("/camera/depth/");
  addImage("/camera/rgb/image_raw", cv::Mat3b(480, 640, cv::Vec3b(1, 2, 3)), "bgr8");
  addInfo("/camera/rgb/camera_info");
  expectFront("");
}

TEST_F(ProcessBagTopics, APairUnderOtherNames) {
  addPair("/camera/infra1/", "/camera/infra2/", "image_rect_raw");
  expectFrame("");
}

TEST_F(ProcessBagTopics, NamedTopics) {
  addPair("/a/", "/b/", "grey");
  addDepth("/camera/depth/");
  expectFrame("--left-image a/grey --right-image /b/grey");
}

TEST_F(ProcessBagTopics, RectifiedImagesAreTakenAsTheyAre) {
  addImage("/a/left", frame_.left, "mono8");
  addImage("/a/right", frame_.right, "mono8");
  sensor_msgs::CameraInfo left = infoOf(simulation_.camera(), false, kStamp), right = infoOf(simulation_.camera(), true, kStamp);
  left.distortion_model = right.distortion_model = "unknown to OpenCV";
  left.D = right.D = {0.1};
  add("/a/left_info", left);
  add("/a/right_info", right);
  const std::string topics = "--left-image a/left --left-info a/left_info --right-image a/right --right-info a/right_info";
  expectWords(topics, 1, "distortion_model is 'unknown to OpenCV', expected plumb_bob");
  expectFrame(topics + " --rectified");
}

TEST_F(ProcessBagTopics, RectifiedNamesComeFirstWhereTheImagesAreRectified) {
  for (const char* image : {"image_raw", "image_rect"}) addPair("/stereo/left/", "/stereo/right/", image);
  bag_.close();
  BagInput input = chooseInput(rosbag::Bag(path("in.bag")), rectifiedOptions(true));
  EXPECT_EQ(input.topics.left, "/stereo/left/image_rect");
  input = chooseInput(rosbag::Bag(path("in.bag")), rectifiedOptions(false));
  EXPECT_EQ(input.topics.left, "/stereo/left/image_raw");
}

TEST_F(ProcessBagTopics, TheRightImageAloneMayBeNamed) {
  addPair("/stereo/left/", "/stereo/right/", "image_raw");
  addImage("/stereo/right/other", frame_.right, "mono8");
  bag_.close();
  InputOptions options;
  options.right_image = "/stereo/right/other";
  EXPECT_EQ(chooseInput(rosbag::Bag(path("in.bag")), options).topics.right, "/stereo/right/other");
}

TEST_F(ProcessBagTopics, ALeftImageWhoseNameTellsNoRightOneNeedsOne) {
  addPair("/stereo/left/", "/stereo/right/", "image_raw");
  addImage("/grey", frame_.left, "mono8");
  expectWords("--left-image /grey --left-info /stereo/left/camera_info", 1, "--right-image is missing: the name /grey");
}

TEST_F(ProcessBagTopics, ACompressedImageIsReadIfItIsNamed) {
  addPair("/stereo/left/", "/stereo/right/", "image_raw");
  addCompressed("/stereo/left/image_raw/compressed", frame_.left, "mono8; png compressed", ".png");
  bag_.close();
  InputOptions options;
  options.left_image = "/stereo/left/image_raw/compressed";
  const BagInput input = chooseInput(rosbag::Bag(path("in.bag")), options);
  EXPECT_EQ(input.topics.left, "/stereo/left/image_raw/compressed");
  EXPECT_EQ(input.topics.right, "/stereo/right/image_raw");
}

TEST_F(ProcessBagTopics, SeveralInputsAreListedWithTheirOptions) {
  addPair("/camera/infra1/", "/camera/infra2/", "image_rect_raw");
  addDepth("/camera/depth/");
  expectWords("", 1,
              "2 inputs fit, choose one:\n"
              "  --input stereo --left-image /camera/infra1/image_rect_raw --right-image /camera/infra2/image_rect_raw\n"
              "  --input depth --depth-image /camera/depth/image_raw\nin the bag are:");
  expectFront("--input depth --depth-image /camera/depth/image_raw");
}

TEST_F(ProcessBagTopics, NoInputSaysWhatIsThereAndWhatIsNeeded) {
  addImage("/camera/rgb/image_raw", cv::Mat3b(480, 640, cv::Vec3b(1, 2, 3)), "bgr8");
  expectWords("", 1,
              "holds no input; needed are a disparity or a depth image with its camera_info, or for stereo:\n"
              "  /stereo/left/camera_info (sensor_msgs/CameraInfo)\n");
  expectWords("", 1, "in the bag are:\n  /camera/rgb/image_raw (sensor_msgs/Image)");
}

TEST_F(ProcessBagTopics, TopicsOfAnotherInputAreRefused) {
  addDepth("/camera/depth/");
  expectWords("--input stereo --depth-image /camera/depth/image_raw", 1, "--depth-image is not part of the input stereo");
  expectWords("--input depth --left-info /x", 1, "--left-info is not part of the input depth");
}

TEST_F(ProcessBagTopics, CompressedPairs) {
  for (const bool png : {true, false}) {
    const std::string format = png ? "mono8; png compressed " : "mono8; jpeg compressed ", side = png ? "/png/" : "/jpeg/";
    addCompressed(side + "left/image_raw/compressed", frame_.left, format, png ? ".png" : ".jpg");
    addCompressed(side + "right/image_raw/compressed", frame_.right, format, png ? ".png" : ".jpg");
    addInfo(side + "left/camera_info");
    addInfo(side + "right/camera_info", true);
  }
  addPair("/raw/left/", "/raw/right/", "image_raw");
  expectFrame("--camera raw");
  const std::string raw = bytes(path("out.bag"));
  expectFrame("--camera png");
  EXPECT_TRUE(bytes(path("out.bag")) == raw);
  expectFrame("--camera jpeg");
  EXPECT_FALSE(bytes(path("out.bag")) == raw) << "JPEG loses something, or the pair above was read again";
  expectFrame("--left-image /jpeg/left/image_raw/compressed --right-image /jpeg/right/image_raw/compressed");
}

TEST_F(ProcessBagTopics, CompressedDepth) {
  addCompressed("/camera/depth/image_raw/compressedDepth", millimetres(), "16UC1; compressedDepth", ".png",
                std::vector<std::uint8_t>(12, 0));
  addInfo("/camera/depth/camera_info");
  expectFront("");
}

TEST_F(ProcessBagTopics, CompressedDepthInMetres) {
  // As compressed_depth_image_transport quantizes for 10 m and 100 m: value = a / depth + b.
  const float a = 100 * 101, b = 1 - a / 10;
  cv::Mat1w inverse(480, 640);
  const cv::Mat1w depth = millimetres();
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) inverse(v, u) = static_cast<std::uint16_t>(std::lround(a / (1e-3F * depth(v, u)) + b));
  inverse.row(0) = 0;
  std::vector<std::uint8_t> header(12);
  std::memcpy(header.data() + 4, &a, 4);
  std::memcpy(header.data() + 8, &b, 4);
  addCompressed("/camera/depth/image/compressedDepth", inverse, "32FC1; compressedDepth png", ".png", header);
  addInfo("/camera/depth/camera_info");
  expectFront("");
}

TEST_F(ProcessBagTopics, ImagesThatCannotBeDecodedAreSkippedAndCounted) {
  addDepth("/rest/");
  sensor_msgs::CompressedImage broken;
  broken.header.stamp = kStamp;
  broken.format = "16UC1; compressedDepth rvl";
  broken.data.assign(100, 1);
  add("/camera/depth/image/compressedDepth", broken);
  addInfo("/camera/depth/camera_info");
  expectWords("--depth-image /camera/depth/image", 1,
              "skipped 1 frames: images that cannot be decoded (first: "
              "/camera/depth/image/compressedDepth: format is '16UC1; compressedDepth rvl', expected PNG");
}

TEST_F(ProcessBagTopics, AJpegThatIsCutOffIsSkippedAndCounted) {
  sensor_msgs::CompressedImage broken;
  broken.header.stamp = kStamp;
  broken.format = "mono8; jpeg compressed ";
  broken.data.assign(3, 0xff);
  for (const std::string side : {"left", "right"}) {
    add("/stereo/" + side + "/image_raw/compressed", broken);
    addInfo("/stereo/" + side + "/camera_info", side == "right");
  }
  expectWords("", 1, "skipped 2 frames: images that cannot be decoded (first: /stereo/right/image_raw/compressed: format is");
}

TEST_F(ProcessBagTopics, DepthInAnotherUnit) {
  cv::Mat1w fifths = millimetres();
  fifths *= 5;
  addImage("/camera/depth/image_raw", fifths, "16UC1");
  addInfo("/camera/depth/camera_info");
  expectFront("--depth-scale 0.0002");
  expectWords("--depth-scale 0", 1, "--depth-scale: setting 'depth_scale' is 0");
  expectWords("--depth-scale 1mm", 1, "--depth-scale: '1mm' is no number");
}

TEST_F(ProcessBagTopics, FloatDepthWithZeroNanAndInfinityAsNothing) {
  cv::Mat1f metres;
  millimetres().convertTo(metres, CV_32F, 1e-3);
  const float nothing[] = {0, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1};
  for (int v = 0; v < metres.rows; v += 7)
    for (int u = v % 5; u < metres.cols; u += 11) metres(v, u) = nothing[(u + v) % 4];
  addImage("/camera/depth/image", metres, "32FC1");
  addInfo("/camera/depth/camera_info");
  expectFront("");
}

/// Half of the sensor in each direction, every second pixel of it.
TEST_F(ProcessBagTopics, CroppedAndBinnedDepth) {
  const cv::Rect roi(120, 100, 400, 320);
  cv::Mat1w crop = millimetres()(roi), binned(roi.height / 2, roi.width / 2);
  for (int v = 0; v < binned.rows; ++v)
    for (int u = 0; u < binned.cols; ++u) binned(v, u) = crop(2 * v, 2 * u);
  sensor_msgs::CameraInfo info = infoOf(simulation_.camera(), false, kStamp);
  info.binning_x = info.binning_y = 2;
  info.roi.x_offset = static_cast<std::uint32_t>(roi.x);
  info.roi.y_offset = static_cast<std::uint32_t>(roi.y);
  info.roi.width = static_cast<std::uint32_t>(roi.width);
  info.roi.height = static_cast<std::uint32_t>(roi.height);
  addImage("/camera/depth/image", binned, "16UC1");
  add("/camera/depth/camera_info", info);
  expectFront("");
}

/// A RealSense's sizes and fields of view.
TEST_F(ProcessBagTopics, WideDepthImages) {
  for (const auto& [width, height, f] : {std::tuple(848, 480, 425.0), std::tuple(1280, 720, 640.0)}) {
    cv::Mat1w depth(height, width, 1500);
    depth(cv::Rect(width / 2 - 50, height / 2 - 60, 240, 160)) = 1000;
    bag_.close();
    bag_.open(path("in.bag"), rosbag::bagmode::Write);
    addImage("/camera/depth/image_rect_raw", depth, "16UC1");
    add("/camera/depth/camera_info", infoOf({width, height, f, f, width / 2 - 0.5, height / 2 - 0.5, 0, 0}, false, kStamp));
    expectFront("", 240 * 160, 1 / f);
  }
}

TEST_F(ProcessBagTopics, WidePairs) {
  for (const auto& [width, height, f] : {std::tuple(848, 480, 600.0), std::tuple(1280, 720, 900.0)}) {
    core::SimulationConfig config = door();
    config.width = width;
    config.height = height;
    config.focal_length = f;
    core::SimulatedStereoCamera simulation(config);
    const core::StereoFrame frame = simulation.frame(12);
    bag_.close();
    bag_.open(path("in.bag"), rosbag::bagmode::Write);
    write(bag_,
          {imageOf(frame.left, kStamp), imageOf(frame.right, kStamp), infoOf(simulation.camera(), false, kStamp),
           infoOf(simulation.camera(), true, kStamp)},
          kStamp);
    expectFrame("");
    const std::vector<Rectangle> found = rectangles();
    EXPECT_EQ(std::count_if(found.begin(), found.end(), isDoor), 1) << width << ", " << found.size() << " rectangles";
  }
}

/// A lens that bends by several pixels, of whose sensor a region is read: the front stays where the ideal camera sees it.
TEST_F(ProcessBagTopics, ARawPairOfARegionOfTheSensor) {
  const auto door = [this] {
    const std::vector<Rectangle> found = rectangles();
    const auto rectangle = std::find_if(found.begin(), found.end(), isDoor);
    return rectangle == found.end() ? std::optional<Rectangle>() : *rectangle;
  };
  addPair("/stereo/left/", "/stereo/right/", "image_raw");
  expectFrame("");
  const auto ideal = door();
  ASSERT_TRUE(ideal);

  bag_.open(path("in.bag"), rosbag::bagmode::Write);
  const cv::Rect roi(40, 20, 560, 440);
  for (const bool right : {false, true}) {
    sensor_msgs::CameraInfo info = infoOf(simulation_.camera(), right, kStamp);
    info.D = {-0.2, 0.1, 0.001, -0.002, 0};
    const cv::Mat raw = throughLens(right ? frame_.right : frame_.left, info);
    info.roi.x_offset = static_cast<std::uint32_t>(roi.x);
    info.roi.y_offset = static_cast<std::uint32_t>(roi.y);
    info.roi.width = static_cast<std::uint32_t>(roi.width);
    info.roi.height = static_cast<std::uint32_t>(roi.height);
    addImage(right ? "/stereo/right/image_raw" : "/stereo/left/image_raw", raw(roi).clone(), "mono8");
    add(right ? "/stereo/right/camera_info" : "/stereo/left/camera_info", info);
  }
  expectFrame("");
  const auto seen = door();
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->pose.pose.position.x, ideal->pose.pose.position.x, 0.002);
  EXPECT_NEAR(seen->pose.pose.position.y, ideal->pose.pose.position.y, 0.002);
  EXPECT_NEAR(seen->pose.pose.position.z, ideal->pose.pose.position.z, 0.002);
}

/// As drivers make it: the colour camera's intrinsics, rows and columns that no depth pixel falls on, and nothing beside the
/// front, where only the colour camera sees the wall.
TEST_F(ProcessBagTopics, DepthThatIsRegisteredToColour) {
  constexpr double kFocalLength = 920;
  cv::Mat1w depth(720, 1280, 1500);
  const cv::Rect front(500, 200, 400, 250);
  depth(front) = 1000;
  depth(cv::Rect(front.x - 24, front.y, 24, front.height)) = 0;
  for (int v = 0; v < depth.rows; v += 7) depth.row(v) = 0;
  for (int u = 3; u < depth.cols; u += 5) depth.col(u) = 0;
  addImage("/camera/depth_registered/image_raw", depth, "16UC1");
  const core::StereoCamera colour{1280, 720, kFocalLength, kFocalLength, 651, 354, 0, 0};
  add("/camera/depth_registered/camera_info", infoOf(colour, false, kStamp));
  expectFront("", front.area(), 1 / kFocalLength);
}

TEST_F(ProcessBagTopics, ASwappedPairIsSaidInWords) {
  addImage("/stereo/left/image_raw", frame_.right, "mono8");
  addImage("/stereo/right/image_raw", frame_.left, "mono8");
  addInfo("/stereo/left/camera_info");
  addInfo("/stereo/right/camera_info", true);
  expectWords("", 0, "at 100.000000 left and right image match only the other way round: are their topics swapped?\n");
}

TEST_F(ProcessBagTopics, SwappedCalibrationsAreSaidInWords) {
  addImage("/stereo/left/image_raw", frame_.right, "mono8");
  addImage("/stereo/right/image_raw", frame_.left, "mono8");
  addInfo("/stereo/left/camera_info", true);
  addInfo("/stereo/right/camera_info");
  expectWords(
      "", 1,
      "/stereo/left/camera_info: P[3] is negative and that of /stereo/right/camera_info is not: left and right are swapped");
}

TEST_F(ProcessBagTopics, FramesOfAnEmitterThatAlternatesAreLeftOutAndCounted) {
  core::SimulationConfig dark = door();
  dark.pattern_cell = 40;
  dark.pattern_blur = 1;
  dark.ambient = 2;
  const core::StereoFrame unlit = core::SimulatedStereoCamera(dark).frame(12);
  for (int i = 0; i < 40; ++i) {
    const core::StereoFrame& frame = i % 2 == 0 ? frame_ : unlit;
    const ros::Time stamp(100 + 0.1 * i);
    write(bag_,
          {imageOf(frame.left, stamp), imageOf(frame.right, stamp), infoOf(simulation_.camera(), false, stamp),
           infoOf(simulation_.camera(), true, stamp)},
          stamp);
  }
  const Outcome outcome = process("");
  EXPECT_EQ(outcome.status, 0);
  int skipped = 0;
  ASSERT_EQ(std::sscanf(outcome.output.c_str(), "skipped %d frames: the projector's pattern is missing", &skipped), 1)
      << outcome.output;
  // Some at the beginning pass until it is known.
  EXPECT_GE(skipped, 16);
  EXPECT_LE(skipped, 20);
}

TEST_F(ProcessBagTopics, ProgressIsForTerminalsOnly) {
  for (int i = 0; i < 200; ++i) addDepth("/camera/depth/");
  bag_.close();
  EXPECT_EQ(run("in.bag out.bag").output.find('\r'), std::string::npos);
  const std::string log = path("terminal.txt");
  const std::string command = "script -qec '" PROCESS_BAG " " + path("in.bag") + " " + path("out.bag") + "' /dev/null > " + log;
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_NE(bytes(log).find(" of 200 frames, "), std::string::npos) << bytes(log);
}

}  // namespace
}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgcodecs.hpp>

#include "messages.h"
#include "ros/images/compressed_images.h"
#include "small_frame.h"

using namespace cabinet_articulation;

namespace {

/// Pixels of the kind as camera drivers compress them, after the bytes `before`.
std::string compressed(const std::string& format, const std::string& suffix, const cv::Mat& pixels,
                       std::vector<std::uint8_t> before = {}) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(suffix, pixels, bytes);
  sensor_msgs::CompressedImage message;
  message.header = test::exampleHeader();
  message.format = format;
  message.data = std::move(before);
  message.data.insert(message.data.end(), bytes.begin(), bytes.end());
  return fuzz::serialized(message);
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  const cv::Mat grey(24, 32, CV_8UC1, cv::Scalar(120)), colour(24, 32, CV_8UC3, cv::Scalar(90, 120, 150)),
      millimetres(24, 32, CV_16UC1, cv::Scalar(1500));
  // Kind 0, then the quantization 100 and 2 as floats.
  const std::vector<std::uint8_t> depth_header{0, 0, 0, 0, 0, 0, 0xc8, 0x42, 0, 0, 0, 0x40};
  std::string large = compressed("mono8; png compressed", ".png", grey);
  const size_t sizes = large.find("IHDR") + 4;
  large.replace(sizes, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));
  return {
      {compressed("mono8; jpeg compressed mono8", ".jpg", grey), compressed("bgr8; jpeg compressed bgr8", ".jpg", colour),
       compressed("mono8; png compressed", ".png", grey), compressed("16UC1; compressedDepth", ".png", millimetres, depth_header),
       compressed("32FC1; compressedDepth png", ".png", millimetres, depth_header)},
      {large}};
}

/// A compressed image, as a bag's reader gets it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    const auto message = reader.next<sensor_msgs::CompressedImage>();
    holdsDepth(*message);
    decompressed(*message, "image");
  });
}

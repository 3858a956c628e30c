// SPDX-License-Identifier: BSD-3-Clause
#include "ros/compressed_images.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation {
namespace {

namespace encodings = sensor_msgs::image_encodings;

/// What compressedDepth puts before the PNG: compressed_depth_image_transport's ConfigHeader, as it lies in memory.
struct DepthHeader {
  std::int32_t kind;      ///< 0: inverse depth
  float quantization[2];  ///< depth = [0] / (value - [1])
};

[[noreturn]] void fail(const std::string& topic, const std::string& text) { throw std::invalid_argument(topic + ": " + text); }

bool isDepthFormat(const std::string& format) { return format.find("compressedDepth") != std::string::npos; }

/// Of the image that was compressed; empty where the format does not say it, as in older recordings.
std::string encodingIn(const std::string& format) {
  const size_t end = format.find(';');
  return end == std::string::npos ? "" : format.substr(0, end);
}

cv::Mat decode(const std::uint8_t* data, size_t size, const sensor_msgs::CompressedImage& message, const std::string& topic) {
  cv::Mat image;
  try {
    if (size > 0)
      image = cv::imdecode(cv::Mat(1, static_cast<int>(size), CV_8UC1, const_cast<std::uint8_t*>(data)), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    fail(topic, "cannot be decoded: " + error.err);
  }
  if (image.empty())
    fail(topic, "format is '" + message.format + "' with " + std::to_string(message.data.size()) +
                    " bytes that cannot be decoded, expected a complete JPEG or PNG");
  return image;
}

/// The declared encoding where the pixels are of it, and else one that they are of.
std::string encodingOf(const cv::Mat& image, const std::string& declared, const std::string& topic) {
  const bool color = image.channels() >= 3;
  try {
    if (!color && !declared.empty() && cv_bridge::getCvType(declared) == image.type()) return declared;
  } catch (const cv_bridge::Exception&) {
    fail(topic, "encoding is '" + declared + "', expected one that ROS knows");
  }
  switch (image.type()) {
    case CV_8UC1:
      return encodings::MONO8;
    case CV_16UC1:
      return encodings::MONO16;
    case CV_8UC3:
      return encodings::BGR8;
    case CV_16UC3:
      return encodings::BGR16;
    case CV_8UC4:
      return encodings::BGRA8;
    default:
      fail(topic, "holds an image of " + std::to_string(image.channels()) + " channels, expected 1, 3 or 4 of 8 or 16 bit");
  }
}

cv::Mat1f metres(const cv::Mat& inverse, const DepthHeader& header) {
  cv::Mat1f depth(inverse.size());
  for (int v = 0; v < inverse.rows; ++v)
    for (int u = 0; u < inverse.cols; ++u) {
      const std::uint16_t value = inverse.at<std::uint16_t>(v, u);
      depth(v, u) =
          value > 0 ? header.quantization[0] / (value - header.quantization[1]) : std::numeric_limits<float>::quiet_NaN();
    }
  return depth;
}

cv_bridge::CvImage decodeDepth(const sensor_msgs::CompressedImage& message, const std::string& topic) {
  if (message.format.find("rvl") != std::string::npos)
    fail(topic, "format is '" + message.format + "', expected PNG: set compressedDepth's parameter format to png");
  DepthHeader header;
  if (message.data.size() < sizeof header)
    fail(topic, "holds " + std::to_string(message.data.size()) + " bytes, expected a header of " + std::to_string(sizeof header) +
                    " and a PNG");
  std::memcpy(&header, message.data.data(), sizeof header);
  const cv::Mat image = decode(message.data.data() + sizeof header, message.data.size() - sizeof header, message, topic);
  if (image.type() != CV_16UC1) fail(topic, "holds a PNG of other than 16 bit and 1 channel, expected depth");
  if (encodingIn(message.format) == encodings::TYPE_32FC1) return {message.header, encodings::TYPE_32FC1, metres(image, header)};
  return {message.header, encodings::TYPE_16UC1, image};
}

}  // namespace

sensor_msgs::ImagePtr decompressed(const sensor_msgs::CompressedImage& message, const std::string& topic) {
  cv_bridge::CvImage image;
  if (isDepthFormat(message.format)) {
    image = decodeDepth(message, topic);
  } else {
    const cv::Mat pixels = decode(message.data.data(), message.data.size(), message, topic);
    image = {message.header, encodingOf(pixels, encodingIn(message.format), topic), pixels};
  }
  try {
    core::requireWithin("width", image.image.cols, core::limits::kImageSide);
    core::requireWithin("height", image.image.rows, core::limits::kImageSide);
  } catch (const std::invalid_argument& error) {
    fail(topic, error.what());
  }
  return image.toImageMsg();
}

bool holdsDepth(const sensor_msgs::CompressedImage& message) {
  const std::string encoding = encodingIn(message.format);
  return isDepthFormat(message.format) || encoding == encodings::TYPE_16UC1 || encoding == encodings::MONO16 ||
         encoding == encodings::TYPE_32FC1;
}

}  // namespace cabinet_articulation

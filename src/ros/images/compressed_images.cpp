// SPDX-License-Identifier: BSD-3-Clause
#include "ros/images/compressed_images.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "ros/checks/image_limits.h"

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

unsigned bigEndian(const std::uint8_t* data, int bytes) {
  unsigned value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8U | data[i];
  return value;
}

struct Size {
  unsigned width = 0, height = 0;  ///< [px]
};

/// As the header of a PNG or JPEG says; 0 by 0 for other bytes. Known before decoding, which makes room for whatever it says.
Size declaredSize(const std::uint8_t* data, size_t size) {
  constexpr std::uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (size >= 24 && std::memcmp(data, kPng, sizeof kPng) == 0 && std::memcmp(data + 12, "IHDR", 4) == 0)
    return {bigEndian(data + 16, 4), bigEndian(data + 20, 4)};
  if (size < 2 || data[0] != 0xff || data[1] != 0xd8) return {};
  // Segments of a JPEG: 0xff, marker, length with its own two bytes. A frame's go on with precision, height, width.
  for (size_t at = 2; at + 9 <= size;) {
    const std::uint8_t marker = data[at + 1];
    const bool alone = marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd7);  // without a length
    if (data[at] != 0xff || marker == 0xff) {
      ++at;
    } else if (alone) {
      at += 2;
    } else if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) {
      return {bigEndian(data + at + 7, 2), bigEndian(data + at + 5, 2)};
    } else {
      at += 2 + bigEndian(data + at + 2, 2);
    }
  }
  return {};
}

cv::Mat decode(const std::uint8_t* data, size_t size, const sensor_msgs::CompressedImage& message, const std::string& topic) {
  cv::Mat image;
  const Size declared = declaredSize(data, size);
  if (declared.width > 0 && declared.height > 0) {
    try {
      requireImageArea(declared.width, declared.height);
      image = cv::imdecode(cv::Mat(1, static_cast<int>(size), CV_8UC1, const_cast<std::uint8_t*>(data)), cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception& error) {
      fail(topic, "cannot be decoded: " + error.err);
    } catch (const std::invalid_argument& error) {
      fail(topic, error.what());
    }
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
  return image.toImageMsg();
}

bool holdsDepth(const sensor_msgs::CompressedImage& message) {
  const std::string encoding = encodingIn(message.format);
  return isDepthFormat(message.format) || encoding == encodings::TYPE_16UC1 || encoding == encodings::MONO16 ||
         encoding == encodings::TYPE_32FC1;
}

}  // namespace cabinet_articulation

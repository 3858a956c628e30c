// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/image_conversions.h"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"
#include "ros/checks/from_messages.h"

namespace cabinet_articulation {
namespace {

namespace encodings = sensor_msgs::image_encodings;

/// Takes the matrix of a camera (rows of `columns`) from the full sensor's pixels to those of the images that come. A CameraInfo
/// describes the full sensor, roi is given in its pixels, and binning reduces what is left (sensor_msgs/CameraInfo).
template <size_t N>
std::array<double, N> asImaged(const sensor_msgs::CameraInfo& info, const boost::array<double, N>& matrix) {
  std::array<double, N> result;
  std::copy(matrix.begin(), matrix.end(), result.begin());
  constexpr size_t columns = N / 3;
  result[2] -= info.roi.x_offset;
  result[columns + 2] -= info.roi.y_offset;
  for (size_t i = 0; i < columns; ++i) {
    result[i] /= std::max(info.binning_x, 1U);
    result[columns + i] /= std::max(info.binning_y, 1U);
  }
  return result;
}

[[noreturn]] void fail(const std::string& topic, const std::string& text) { throw std::invalid_argument(topic + ": " + text); }

std::string sizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

/// The rows of an image message as a matrix that shares its memory; checks that the memory is there.
cv::Mat pixels(const sensor_msgs::Image& image, const std::string& topic, int type) {
  const size_t row = static_cast<size_t>(image.width) * CV_ELEM_SIZE(type);
  if (image.step < row || image.data.size() < static_cast<size_t>(image.step) * image.height)
    fail(topic, "holds " + std::to_string(image.data.size()) + " bytes in rows of " + std::to_string(image.step) +
                    ", too few for " + sizeText(image.width, image.height) + " pixels");
  if (image.width == 0 || image.height == 0) return cv::Mat(0, 0, type);
  return cv::Mat(static_cast<int>(image.height), static_cast<int>(image.width), type,
                 const_cast<std::uint8_t*>(image.data.data()), image.step);
}

/// cv_bridge multiplies in 32 bits, and would read beyond the data of some images. What else it refuses is an error of the topic.
template <class Convert>
cv_bridge::CvImageConstPtr guarded(const sensor_msgs::Image& image, const std::string& topic, const Convert& convert) {
  const size_t expected = static_cast<size_t>(image.step) * image.height;
  if (image.data.size() != expected)
    fail(topic, "holds " + std::to_string(image.data.size()) + " bytes, expected " + std::to_string(expected) + " in " +
                    std::to_string(image.height) + " rows of " + std::to_string(image.step));
  try {
    core::requireWithin("width", image.width, core::limits::kImageSide);
    core::requireWithin("height", image.height, core::limits::kImageSide);
    return convert();
  } catch (const std::invalid_argument& error) {
    fail(topic, error.what());
  } catch (const cv_bridge::Exception& error) {
    fail(topic, error.what());
  } catch (const cv::Exception& error) {
    fail(topic, error.what());
  }
}

/// A message holds focal length and baseline in single precision only.
bool computedFrom(const stereo_msgs::DisparityImage& disparity, const std::array<double, 12>& P_left,
                  const std::array<double, 12>& P_right) {
  return static_cast<float>(P_left[0]) == disparity.f && static_cast<float>(-P_right[3] / P_right[0]) == disparity.T;
}

void fillImage(const cv::Mat& pixels, const std_msgs::Header& header, const std::string& encoding, sensor_msgs::Image* image) {
  image->header = header;
  image->encoding = encoding;
  image->is_bigendian = false;
  image->width = static_cast<std::uint32_t>(pixels.cols);
  image->height = static_cast<std::uint32_t>(pixels.rows);
  const size_t row = pixels.cols * pixels.elemSize();
  image->step = static_cast<std::uint32_t>(row);
  image->data.clear();
  image->data.reserve(row * pixels.rows);
  for (int v = 0; v < pixels.rows; ++v) image->data.insert(image->data.end(), pixels.ptr(v), pixels.ptr(v) + row);
}

/// As many as a convex polygon around pixels has at most, some more for corners that lie on a line.
size_t mostCorners(const sensor_msgs::Image& mask) { return 2 * (static_cast<size_t>(mask.width) + mask.height); }

void requireSane(const Plane& message) {
  const auto& n = message.coefficients;
  core::requireWithin("length of coefficients[0..2]", std::hypot(n[0], n[1], n[2]), core::limits::kUnitLength);
  core::requireWithin("coefficients[3]", n[3], core::limits::kPlaneOffset);
  for (const double value : message.disparity_plane) core::requireWithin("disparity_plane", value, core::limits::kDisparityPlane);
  const double width = message.mask.width, height = message.mask.height;
  core::requireWithin("inliers", message.inliers, {0, width * height, "px, as the mask has"});
  core::requireWithin("number of hull's corners", static_cast<double>(message.hull.size()),
                      {0, static_cast<double>(mostCorners(message.mask)), "for a mask of this size"});
  const double margin = core::limits::kHullMargin.max;
  for (const geometry_msgs::Point32& corner : message.hull) {
    core::requireWithin("hull's x", corner.x, {-margin * width, (1 + margin) * width, "px, near the image"});
    core::requireWithin("hull's y", corner.y, {-margin * height, (1 + margin) * height, "px, near the image"});
  }
}

void requireSize(const cv::Size& size, const cv::Size& expected, const std::string& topic) {
  if (size != expected)
    fail(topic, "size is " + sizeText(size.width, size.height) + ", expected " + sizeText(expected.width, expected.height) +
                    " as its CameraInfo says");
}

}  // namespace

cv::Size imageSize(const sensor_msgs::CameraInfo& info) {
  const bool whole = info.roi.width == 0 || info.roi.height == 0;
  return cv::Size(static_cast<int>((whole ? info.width : info.roi.width) / std::max(info.binning_x, 1U)),
                  static_cast<int>((whole ? info.height : info.roi.height) / std::max(info.binning_y, 1U)));
}

core::StereoCamera toStereoCamera(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right,
                                  const std::string& left_topic, const std::string& right_topic) {
  const cv::Size size = imageSize(left), right_size = imageSize(right);
  if (size != right_size)
    fail(right_topic, "size is " + sizeText(right_size.width, right_size.height) + ", expected that of " + left_topic + ", " +
                          sizeText(size.width, size.height));
  if (left.P[3] < 0 && right.P[3] >= 0)
    fail(left_topic, "P[3] is negative and that of " + right_topic + " is not: left and right are swapped");
  try {
    return core::StereoCamera::fromProjections(size.width, size.height, asImaged(left, left.P), asImaged(right, right.P));
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    fail(text.rfind("right", 0) == 0 ? right_topic : left_topic, text);
  }
}

core::StereoCamera toDepthCamera(const sensor_msgs::CameraInfo& info, const std::string& topic, double virtual_baseline) {
  std::array<double, 9> K = asImaged(info, info.K);
  if (info.P[0] != 0) {
    const std::array<double, 12> P = asImaged(info, info.P);
    K = {P[0], P[1], P[2], P[4], P[5], P[6], P[8], P[9], P[10]};
  }
  const cv::Size size = imageSize(info);
  try {
    return core::StereoCamera::fromDepthCamera(size.width, size.height, K, virtual_baseline);
  } catch (const std::invalid_argument& error) {
    fail(topic, error.what());
  }
}

core::StereoCamera toDisparityCamera(const stereo_msgs::DisparityImage& disparity, const std::string& topic,
                                     const sensor_msgs::CameraInfo& left, const std::string& left_topic,
                                     const sensor_msgs::CameraInfo* right) {
  try {
    core::requireWithin("focal length f", disparity.f, core::limits::kFocalLength);
    core::requireWithin("baseline T", disparity.T, core::limits::kBaseline);
  } catch (const std::invalid_argument& error) {
    fail(topic, error.what());
  }
  const cv::Size size = imageSize(left);
  const std::array<double, 12> P_left = asImaged(left, left.P);
  std::array<double, 12> P_right = right ? asImaged(*right, right->P) : P_left;
  if (!right || !computedFrom(disparity, P_left, P_right)) {
    // The right camera that the message implies: the focal length and the baseline it was computed with.
    const double cx = P_right[2];
    P_right = P_left;
    P_right[2] = cx;
    P_right[3] = -P_right[0] * (static_cast<double>(disparity.f) * disparity.T / P_left[0]);
  }
  try {
    return core::StereoCamera::fromProjections(size.width, size.height, P_left, P_right);
  } catch (const std::invalid_argument& error) {
    fail(left_topic, error.what());
  }
}

cv_bridge::CvImageConstPtr toMono(const sensor_msgs::ImageConstPtr& image, const std::string& topic) {
  const std::string& encoding = image->encoding;
  // Cameras that do not say what a byte stands for: brightness.
  if (encoding == encodings::TYPE_8UC1) return guarded(*image, topic, [&] { return cv_bridge::toCvShare(image); });
  if (!encodings::isMono(encoding) && !encodings::isColor(encoding) && !encodings::isBayer(encoding) &&
      encoding != encodings::YUV422)
    fail(topic, "encoding is '" + encoding + "', expected mono8, 8UC1, mono16, or one of colour or Bayer images");
  return guarded(*image, topic, [&] { return cv_bridge::toCvShare(image, encodings::MONO8); });
}

cv_bridge::CvImageConstPtr toDepth(const sensor_msgs::ImageConstPtr& image, const std::string& topic) {
  const std::string& encoding = image->encoding;
  if (encoding != encodings::TYPE_16UC1 && encoding != encodings::MONO16 && encoding != encodings::TYPE_32FC1)
    fail(topic, "encoding is '" + encoding + "', expected 16UC1 or 32FC1");
  return guarded(*image, topic, [&] { return cv_bridge::toCvShare(image); });
}

void requireSize(const cv::Mat& image, const core::StereoCamera& camera, const std::string& topic) {
  requireSize(image.size(), {camera.width, camera.height}, topic);
}

void requireSize(const cv::Mat& image, const sensor_msgs::CameraInfo& info, const std::string& topic) {
  requireSize(image.size(), imageSize(info), topic);
}

cv::Mat1f toDisparities(const stereo_msgs::DisparityImage& message, const std::string& topic, const core::StereoCamera& camera) {
  const sensor_msgs::Image& image = message.image;
  if (image.encoding != encodings::TYPE_32FC1) fail(topic, "encoding is '" + image.encoding + "', expected '32FC1'");
  const cv::Mat1f disparities = pixels(image, topic, CV_32FC1);
  requireSize(disparities, camera, topic);
  const double no_match = message.min_disparity - 1 - camera.cx_difference;
  if (!(no_match > 0)) return disparities;
  cv::Mat1f cleaned;
  cv::threshold(disparities, cleaned, no_match + 0.5, 0, cv::THRESH_TOZERO);
  return cleaned;
}

stereo_msgs::DisparityImage toMessage(const core::DepthFrame& frame, const std_msgs::Header& header, int min_disparity,
                                      int disparity_range) {
  stereo_msgs::DisparityImage message;
  message.header = header;
  fillImage(frame.disparity, header, encodings::TYPE_32FC1, &message.image);
  message.f = static_cast<float>(frame.camera.fx);
  message.T = static_cast<float>(frame.camera.baseline);
  message.min_disparity = static_cast<float>(min_disparity);
  message.max_disparity = static_cast<float>(min_disparity + disparity_range - 1);
  message.delta_d = 1.0F / 16;  // StereoBM's resolution
  message.valid_window.width = static_cast<std::uint32_t>(frame.disparity.cols);
  message.valid_window.height = static_cast<std::uint32_t>(frame.disparity.rows);
  return message;
}

sensor_msgs::Image toMessage(const cv::Mat1b& image, const std_msgs::Header& header) {
  sensor_msgs::Image message;
  fillImage(image, header, encodings::MONO8, &message);
  return message;
}

void toMessage(const core::PlaneRegion& region, const std_msgs::Header& header, Plane* message) {
  message->coefficients = {region.plane.normal.x(), region.plane.normal.y(), region.plane.normal.z(), region.plane.offset};
  message->disparity_plane = {region.disparity_plane.a, region.disparity_plane.b, region.disparity_plane.c};
  message->inliers = static_cast<std::uint32_t>(std::max(region.inliers, 0));
  message->hull.clear();
  for (const cv::Point2f& point : region.hull) {
    geometry_msgs::Point32 corner;
    corner.x = point.x;
    corner.y = point.y;
    message->hull.push_back(corner);
  }
  fillImage(region.mask, header, encodings::MONO8, &message->mask);
}

core::PlaneRegion fromMessage(const Plane& message) {
  core::PlaneRegion region;
  region.plane = {{message.coefficients[0], message.coefficients[1], message.coefficients[2]}, message.coefficients[3]};
  region.disparity_plane = {message.disparity_plane[0], message.disparity_plane[1], message.disparity_plane[2]};
  region.inliers = static_cast<int>(message.inliers);
  for (const geometry_msgs::Point32& point : message.hull) region.hull.emplace_back(point.x, point.y);
  if (message.mask.encoding != encodings::MONO8) fail("mask", "encoding is '" + message.mask.encoding + "', expected 'mono8'");
  region.mask = pixels(message.mask, "mask", CV_8UC1);
  requireSane(message);
  return region;
}

std::vector<core::PlaneRegion> fromMessage(const PlaneArray& message) {
  return fromMessages<core::PlaneRegion>(message.planes, "planes", core::limits::kMostFronts);
}

}  // namespace cabinet_articulation

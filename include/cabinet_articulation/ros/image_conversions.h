// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/PlaneArray.h>
#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <stereo_msgs/DisparityImage.h>

#include <string>
#include <vector>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation {

/*
 * Cameras, images and masks. "View" means that the pixels stay in the message: the caller keeps it alive and nobody
 * writes to them. Everything throws std::invalid_argument that names the topic, the element, its value and what was
 * expected.
 */

/// Of the images that come: those of the CameraInfo's region of interest, reduced by its binning.
cv::Size imageSize(const sensor_msgs::CameraInfo& info);

/// A rectified pair from the matrices P of its two CameraInfos.
core::StereoCamera toStereoCamera(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right,
                                  const std::string& left_topic, const std::string& right_topic);

/// A rectified depth camera from its P, or from K where P is not filled in.
core::StereoCamera toDepthCamera(const sensor_msgs::CameraInfo& info, const std::string& topic, double virtual_baseline);

/// The camera behind a disparity image. Where the two CameraInfos (the right one may be null) are those it was computed with,
/// the camera is toStereoCamera's to the last bit. Else f and T are the message's own, the principal point is the left
/// CameraInfo's, and the right CameraInfo only tells where the right image's principal point is.
core::StereoCamera toDisparityCamera(const stereo_msgs::DisparityImage& disparity, const std::string& topic,
                                     const sensor_msgs::CameraInfo& left, const std::string& left_topic,
                                     const sensor_msgs::CameraInfo* right = nullptr);

/// 8-bit grey. A view if the image is mono8 or 8UC1 already, else a converted copy. The result keeps the message alive.
cv_bridge::CvImageConstPtr toMono(const sensor_msgs::ImageConstPtr& image, const std::string& topic);

/// A depth image (16UC1, mono16 or 32FC1) as it is. A view that keeps the message alive.
cv_bridge::CvImageConstPtr toDepth(const sensor_msgs::ImageConstPtr& image, const std::string& topic);

/// Throws unless the image has the size that its camera's CameraInfo names.
void requireSize(const cv::Mat& image, const core::StereoCamera& camera, const std::string& topic);
void requireSize(const cv::Mat& image, const sensor_msgs::CameraInfo& info, const std::string& topic);

/// A view of the disparities. Only where the matcher's mark for "no match" (min_disparity - 1, as stereo_image_proc
/// writes it) is a positive number and would pass for a disparity, a copy with those pixels set to 0.
cv::Mat1f toDisparities(const stereo_msgs::DisparityImage& message, const std::string& topic, const core::StereoCamera& camera);

/// What stereo_image_proc would publish, with 0 for "no match". `disparity_range` disparities from `min_disparity` were
/// searched.
stereo_msgs::DisparityImage toMessage(const core::DepthFrame& frame, const std_msgs::Header& header, int min_disparity,
                                      int disparity_range);

sensor_msgs::Image toMessage(const cv::Mat1b& image, const std_msgs::Header& header);

/// Uses the memory of the message again.
void toMessage(const core::PlaneRegion& region, const std_msgs::Header& header, Plane* message);

/// The masks of the regions are views of the message's.
core::PlaneRegion fromMessage(const Plane& message);
std::vector<core::PlaneRegion> fromMessage(const PlaneArray& message);

}  // namespace cabinet_articulation

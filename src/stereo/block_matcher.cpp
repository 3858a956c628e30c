// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/stereo/block_matcher.h"

#include <cassert>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "stereo/image_pool.h"
#include "stereo/image_text.h"
#include "stereo/sad_matcher.h"

namespace cabinet_articulation::core {
namespace {

constexpr size_t kFramesInUse = 4;  ///< results whose memory is lent again (ours: stages and messages hold two or three)

void requireMultiple(const char* key, int value, int divisor, int remainder, const char* expected) {
  if (value % divisor == remainder) return;
  throw ConfigError("setting '" + std::string(key) + "' is " + std::to_string(value) + ", expected " + expected);
}

const StereoConfig& checked(const StereoConfig& config) {
  checkConfig(config);
  requireMultiple("disparity_range", config.disparity_range, 16, 0, "a multiple of 16");
  requireMultiple("correlation_window_size", config.correlation_window_size, 2, 1, "an odd number");
  requireMultiple("prefilter_size", config.prefilter_size, 2, 1, "an odd number");
  return config;
}

cv::Ptr<cv::StereoBM> makeMatcher(const StereoConfig& config) {
  cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(config.disparity_range, config.correlation_window_size);
  matcher->setMinDisparity(config.min_disparity);
  matcher->setPreFilterType(cv::StereoBM::PREFILTER_XSOBEL);
  matcher->setPreFilterSize(config.prefilter_size);
  matcher->setPreFilterCap(config.prefilter_cap);
  matcher->setTextureThreshold(config.texture_threshold);
  matcher->setUniquenessRatio(static_cast<int>(config.uniqueness_ratio));
  matcher->setSpeckleWindowSize(config.speckle_size);
  matcher->setSpeckleRange(config.speckle_range);
  return matcher;
}

void requirePair(const cv::Mat& left, const cv::Mat& right, const StereoCamera& camera, const StereoConfig& config) {
  if (left.type() != CV_8UC1 || right.type() != CV_8UC1 || left.size() != right.size() || left.empty())
    throw std::invalid_argument("the left image is " + describeImage(left) + " and the right image is " + describeImage(right) +
                                ", expected two images of one size with 8 bit and 1 channel");
  if (left.cols != camera.width || left.rows != camera.height)
    throw std::invalid_argument("the images are " + describeImage(left) + ", but their calibration is for " +
                                std::to_string(camera.width) + "x" + std::to_string(camera.height) + " px");
  if (left.cols < config.correlation_window_size || left.rows < config.correlation_window_size)
    throw std::invalid_argument("the images are " + describeImage(left) + ", expected at least the correlation window, " +
                                std::to_string(config.correlation_window_size) + "x" +
                                std::to_string(config.correlation_window_size) + " px");
}

}  // namespace

struct BlockMatcher::Buffers {
  std::unique_ptr<SadMatcher> own;
  cv::Ptr<cv::StereoBM> opencv;  ///< where there is no own one
  cv::Mat left, right;           ///< padded on the left, for StereoBM
  cv::Mat1s padded;              ///< its result
  ImagePool<cv::Mat1f> disparities{kFramesInUse};
};

BlockMatcher::BlockMatcher(const StereoConfig& config) : config_(checked(config)), buffers_(new Buffers) {
  if (config.matcher == "own" && SadMatcher::supports(config))
    buffers_->own = std::make_unique<SadMatcher>(config);
  else
    buffers_->opencv = makeMatcher(config);
}

BlockMatcher::~BlockMatcher() = default;

cv::Mat1s BlockMatcher::match(const cv::Mat& left, const cv::Mat& right) {
  if (buffers_->own) return buffers_->own->compute(left, right);
  // StereoBM leaves the columns empty in which the search would leave the right image.
  const int pad = config_.recover_left_band ? config_.disparity_range + std::max(config_.min_disparity, 0) : 0;
  cv::copyMakeBorder(left, buffers_->left, 0, 0, pad, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  cv::copyMakeBorder(right, buffers_->right, 0, 0, pad, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  buffers_->opencv->compute(buffers_->left, buffers_->right, buffers_->padded);
  return buffers_->padded.colRange(pad, buffers_->padded.cols);
}

DepthFrame BlockMatcher::process(const cv::Mat& left, const cv::Mat& right, const StereoCamera& camera) {
  assert(camera.isSane());
  requirePair(left, right, camera, config_);
  const cv::Mat1s sixteenths = match(left, right);

  DepthFrame frame;
  frame.camera = camera;
  frame.left = left;
  frame.right = right;
  frame.disparity = buffers_->disparities.take(left.size());
  const float half_window = static_cast<float>(config_.correlation_window_size / 2);
  const float smallest = static_cast<float>(config_.min_disparity);
  const float cx_difference = static_cast<float>(camera.cx_difference);
  for (int v = 0; v < left.rows; ++v) {
    const short* in = sixteenths[v];
    float* out = frame.disparity[v];
    for (int u = 0; u < left.cols; ++u) {
      const float searched = in[u] * (1.0F / cv::StereoMatcher::DISP_SCALE);
      const float disparity = searched - cx_difference;
      // A block that reaches over the right image's border was matched to padding.
      const bool seen = (searched >= smallest) & (searched <= u - half_window);
      out[u] = seen & (disparity > 0) ? disparity : 0.0F;
    }
  }
  return frame;
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "cabinet_articulation/simulation/simulation_config.h"

namespace cabinet_articulation::core {

/// Lens and sensor: blur, vignetting, automatic gain, shot and read noise, 8 bits.
class ImageSensor {
 public:
  explicit ImageSensor(const SimulationConfig& config);

  /// Gain that brings the mean of the image to the target, within 1..max_gain. Depends on this image alone.
  double automaticGain(const cv::Mat1f& radiance) const;

  /// `stream` selects the noise: the same stream gives the same noise, different ones are independent.
  cv::Mat1b expose(const cv::Mat1f& radiance, double gain, std::uint64_t stream);

 private:
  SimulationConfig config_;
  cv::Mat1f vignetting_;
  cv::Mat1f noise_;  ///< standard normal numbers, read from a random place on for every row
  cv::Mat1f blurred_;
};

}  // namespace cabinet_articulation::core

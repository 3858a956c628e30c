// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/image_sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

namespace cabinet_articulation::core {
namespace {

constexpr int kNoiseLength = 1 << 18;
constexpr double kWellPerRadiance = 0.35;  ///< a white square on white paper at 1 m fills a third of the wells
constexpr double kBlackLevel = 3;          ///< grey value without light
constexpr double kWhite = 255;

struct Development {
  float gain;  ///< grey values per radiance
  float shot;  ///< variance per grey value above black
  float read;  ///< variance of a dark pixel
};

__attribute__((target_clones("avx2", "default"))) void developRow(const Development& d, const float* radiance,
                                                                  const float* vignetting, const float* noise, int width,
                                                                  std::uint8_t* grey) {
  const Development development = d;
  for (int u = 0; u < width; ++u) {
    const float light = radiance[u] * vignetting[u] * development.gain;
    const float sigma = std::sqrt(development.shot * light + development.read);
    const float value = light + sigma * noise[u] + static_cast<float>(kBlackLevel + 0.5);
    grey[u] = static_cast<std::uint8_t>(static_cast<int>(std::min(std::max(value, 0.0F), 255.0F)));
  }
}

}  // namespace

ImageSensor::ImageSensor(const SimulationConfig& config)
    : config_(config), vignetting_(config.height, config.width), noise_(1, kNoiseLength + config.width) {
  const double radius_squared = (config.width * config.width + config.height * config.height) / 4.0;
  for (int v = 0; v < config.height; ++v)
    for (int u = 0; u < config.width; ++u) {
      const double dx = u - (config.width - 1) / 2.0;
      const double dy = v - (config.height - 1) / 2.0;
      vignetting_(v, u) = static_cast<float>(1 - config.vignetting * (dx * dx + dy * dy) / radius_squared);
    }
  cv::RNG(static_cast<std::uint64_t>(config.noise_seed) + 1).fill(noise_, cv::RNG::NORMAL, 0, 1);
}

double ImageSensor::automaticGain(const cv::Mat1f& radiance) const {
  const double mean = cv::mean(radiance.mul(vignetting_))[0] * kWellPerRadiance * kWhite;
  const double wanted = config_.target_brightness - kBlackLevel;
  return mean * config_.max_gain <= wanted ? config_.max_gain : std::max(1.0, wanted / mean);
}

cv::Mat1b ImageSensor::expose(const cv::Mat1f& radiance, double gain, std::uint64_t stream) {
  if (config_.lens_blur > 0)
    cv::GaussianBlur(radiance, blurred_, {}, config_.lens_blur, config_.lens_blur, cv::BORDER_REPLICATE);
  else
    radiance.copyTo(blurred_);
  const double grey_per_electron = gain * kWhite / config_.full_well;
  const Development development{static_cast<float>(gain * kWellPerRadiance * kWhite), static_cast<float>(grey_per_electron),
                                static_cast<float>(std::pow(grey_per_electron * config_.read_noise, 2))};
  std::seed_seq seed{static_cast<std::uint32_t>(config_.noise_seed), static_cast<std::uint32_t>(stream),
                     static_cast<std::uint32_t>(stream >> 32)};
  std::mt19937 random(seed);
  cv::Mat1b image(radiance.size());
  for (int v = 0; v < image.rows; ++v)
    developRow(development, blurred_[v], vignetting_[v], noise_[0] + random() % kNoiseLength, image.cols, image[v]);
  return image;
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "planes/refinement_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr float kLeastSigma = 0.5F;   ///< [grey levels] quantisation
constexpr size_t kNoisePixels = 512;  ///< enough for a median

/// Where samples lie in the right image, in single precision.
struct Places {
  float a, b, c, last_column;
  int rows_down, last_row, row_stride;
};

// The arrays do not overlap. The look-ups between these loops are apart from them, so that both vectorise.

__attribute__((target_clones("avx2", "default"))) void findPlaces(const Places& to, size_t n, const float* __restrict u,
                                                                  const int* __restrict row, const float* __restrict x,
                                                                  const float* __restrict y, const float* __restrict inside,
                                                                  int* __restrict place, float* __restrict fraction,
                                                                  float* __restrict seen) {
  const float a = to.a, b = to.b, c = to.c, last_column = to.last_column;
  const int rows_down = to.rows_down, last_row = to.last_row, row_stride = to.row_stride;
  for (size_t i = 0; i < n; ++i) {
    const float wanted = u[i] - (a * x[i] + b * y[i] + c);
    const float inner = std::min(std::max(0.0F, wanted), last_column);
    const int column = static_cast<int>(inner);
    const int up = std::min(std::max(row[i] + rows_down, 0), last_row);
    const float is_inside = inside[i];
    fraction[i] = inner - static_cast<float>(column);
    seen[i] = inner == wanted ? is_inside : 0;
    place[i] = up * row_stride + column;
  }
}

__attribute__((target_clones("avx2", "default"))) void interpolate(const RefinementSamples::Corners* __restrict pixels, size_t n,
                                                                   const float* __restrict fraction, float g,
                                                                   float* __restrict value, float* __restrict gradient,
                                                                   float* __restrict row_gradient) {
  for (size_t i = 0; i < n; ++i) {
    const float f = fraction[i];
    const int up_left = pixels[i].up[0], up_right = pixels[i].up[1];
    const int down_left = pixels[i].down[0], down_right = pixels[i].down[1];
    const auto slope_up = static_cast<float>(up_right - up_left), slope_down = static_cast<float>(down_right - down_left);
    const float value_up = static_cast<float>(up_left) + f * slope_up;
    const float value_down = static_cast<float>(down_left) + f * slope_down;
    value[i] = value_up + g * (value_down - value_up);
    gradient[i] = slope_up + g * (slope_down - slope_up);
    row_gradient[i] = value_down - value_up;
  }
}

__attribute__((target_clones("avx2", "default"))) void compare(size_t n, const float* __restrict left,
                                                               const float* __restrict right, float gain, float offset,
                                                               float* __restrict residual) {
  for (size_t i = 0; i < n; ++i) residual[i] = left[i] - gain * right[i] - offset;
}

struct Extent {
  std::int64_t sum;
  int least, most;
};

/// Of whole numbers; there is one at least.
template <class Place>
inline Extent extentOf(const Place* places, size_t n) {
  std::int64_t sum = 0;
  int least = static_cast<int>(places[0]), most = least;
  for (size_t i = 0; i < n; ++i) {
    const int place = static_cast<int>(places[i]);
    sum += place;
    least = std::min(least, place);
    most = std::max(most, place);
  }
  return {sum, least, most};
}

__attribute__((target_clones("avx2", "default"))) void extentOfBoth(const float* u, const int* row, size_t n, Extent* of_u,
                                                                    Extent* of_row) {
  *of_u = extentOf(u, n);
  *of_row = extentOf(row, n);
}

/// (place - center) / scale, rounded once.
template <class Place>
inline void normalise(const Place* __restrict place, double center, double scale, size_t n, float* __restrict out) {
  for (size_t i = 0; i < n; ++i) out[i] = static_cast<float>((place[i] - center) / scale);
}

__attribute__((target_clones("avx2", "default"))) void normaliseBoth(const float* u, const int* row, double center_u,
                                                                     double center_v, double scale, size_t n, float* x,
                                                                     float* y) {
  normalise(u, center_u, scale, n, x);
  normalise(row, center_v, scale, n, y);
}

/// The value in the middle of the sorted ones, the upper of two: sorts only the values of its bin.
float middleValue(std::vector<float>* values) {
  std::array<int, 256> bins{};
  const auto binOf = [&bins](float value) { return static_cast<int>(std::min(static_cast<float>(bins.size() - 1), value)); };
  for (const float value : *values) ++bins[binOf(value)];
  int bin = 0, before = 0;
  const int middle = static_cast<int>(values->size() / 2);
  while (before + bins[bin] <= middle) before += bins[bin++];
  size_t n = 0;
  for (const float value : *values) {
    (*values)[n] = value;
    n += binOf(value) == bin;
  }
  const auto found = values->begin() + (middle - before);
  std::nth_element(values->begin(), found, values->begin() + static_cast<std::ptrdiff_t>(n));
  return *found;
}

}  // namespace

void RefinementSamples::resize(size_t n) {
  row_.resize(n);
  place_.resize(n);
  corners_.resize(n);
  for (std::vector<float>* values :
       {&u_, &x, &y, &left_, &slope, &inside_, &fraction_, &right, &gradient, &row_gradient, &residual, &seen})
    values->resize(n);
}

void RefinementSamples::take(const DepthFrame& frame, const cv::Mat1f& limit, int most, const GrownRegion& region,
                             const RegionSet& set) {
  const int step = 1 + region.cells * kCell * kCell / most;
  const DisparityPlane plane = region.plane;
  size_t n = 0;
  int phase = 0;  // carried over from row to row, so that the pixels do not line up in columns
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    for (int v = run.row * kCell; v < (run.row + 1) * kCell; ++v) {
      const int end = std::min(run.end * kCell, frame.disparity.cols - 1);
      int u = std::max(run.begin * kCell, 1) + phase;
      const size_t room = n + std::max(end - u, 0) / step + 2;
      if (u_.size() < room) {
        u_.resize(room);
        row_.resize(room);
      }
      const float *disparity = frame.disparity[v], *most_residual = limit[v];
      for (; u < end; u += step) {
        u_[n] = static_cast<float>(u);
        row_[n] = v;
        n += !(std::abs(disparity[u] - plane.at(u, v)) > most_residual[u]);
      }
      phase = u - end;
    }
  }
  measureExtent(n);
}

void RefinementSamples::measureExtent(size_t n) {
  Extent u{}, v{};
  if (n > 0) extentOfBoth(u_.data(), row_.data(), n, &u, &v);
  center_u_ = static_cast<double>(u.sum) / static_cast<double>(std::max<size_t>(n, 1));
  center_v_ = static_cast<double>(v.sum) / static_cast<double>(std::max<size_t>(n, 1));
  scale_ = std::max({1.0, center_u_ - u.least, u.most - center_u_, center_v_ - v.least, v.most - center_v_});
  resize((n + kLanes - 1) / kLanes * kLanes);
  for (size_t i = 0; i < size(); ++i) inside_[i] = i < n;
  std::fill(u_.begin() + static_cast<std::ptrdiff_t>(n), u_.end(), u_.empty() ? 0 : u_[0]);
  std::fill(row_.begin() + static_cast<std::ptrdiff_t>(n), row_.end(), row_.empty() ? 0 : row_[0]);
}

void RefinementSamples::describe(const cv::Mat1b& left) {
  normaliseBoth(u_.data(), row_.data(), center_u_, center_v_, scale_, size(), x.data(), y.data());
  for (size_t i = 0; i < size(); ++i) {
    const std::uint8_t* pixel = left[row_[i]] + static_cast<int>(u_[i]);
    left_[i] = pixel[0];
    slope[i] = static_cast<float>(pixel[1] - pixel[-1]) / 2;
  }
}

void RefinementSamples::warp(const cv::Mat1b& image, double cx_difference, const PhotometricEstimate& e) {
  const int rows_down = static_cast<int>(std::floor(e.row_shift));
  const Places places{static_cast<float>(e.a),
                      static_cast<float>(e.b),
                      static_cast<float>(e.c + cx_difference),
                      static_cast<float>(image.cols) - 1.001F,
                      rows_down,
                      image.rows - 2,
                      static_cast<int>(image.step1())};
  findPlaces(places, size(), u_.data(), row_.data(), x.data(), y.data(), inside_.data(), place_.data(), fraction_.data(),
             seen.data());
  for (size_t i = 0; i < size(); ++i) {
    const std::uint8_t* up = image.data + place_[i];
    const std::uint8_t* down = up + places.row_stride;
    std::memcpy(corners_[i].up, up, sizeof(Corners::up));
    std::memcpy(corners_[i].down, down, sizeof(Corners::down));
  }
  interpolate(corners_.data(), size(), fraction_.data(), static_cast<float>(e.row_shift - rows_down), right.data(),
              gradient.data(), row_gradient.data());
  compare(size(), left_.data(), right.data(), static_cast<float>(e.gain), static_cast<float>(e.offset), residual.data());
}

float RefinementSamples::noise() {
  const size_t stride = std::max<size_t>(1, size() / kNoisePixels);
  sorted_.resize(size() / stride + 1);
  size_t n = 0;
  for (size_t i = 0; i < size(); i += stride) {
    sorted_[n] = std::abs(residual[i]);
    n += seen[i] > 0;
  }
  sorted_.resize(n);
  if (sorted_.empty()) return kLeastSigma;
  return std::max(static_cast<float>(kDeviationToSigma) * middleValue(&sorted_), kLeastSigma);
}

}  // namespace cabinet_articulation::core

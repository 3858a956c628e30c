// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/depth_edge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rectangles/chart/depth_noise.h"
#include "rectangles/chart/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kNearEdge = 6;            ///< [px] inside the edge that side faces and the sensor's window may reach (ours)
constexpr double kMostlySurface = 0.5;  ///< share of the strips inside that a surface fills (ours)
constexpr double kEnded = 0.25;         ///< share of a full strip below which the surface, or depth, has ended (ours)
constexpr double kSharedPixels = 9;     ///< along an edge that share an error: the window of depth cameras
constexpr double kStep = 0.25;          ///< [px] between the face's begins that are tried (ours)
constexpr int kRounds = 3;              ///< of finding the face's pixels by its begin, and its begin by them (ours)

}  // namespace

DepthEdge::DepthEdge(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& edge, const SideFace& face)
    : face_(face) {
  addPixels(frame, region, edge);
  measureNoise();
}

void DepthEdge::addPixels(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& edge) {
  const Eigen::Vector2d along = edge.b - edge.a, middle = (edge.a + edge.b) / 2;
  const EdgeBand band = bandAbout(edge, kInside, kOutside, std::max(frame.disparity.cols, frame.disparity.rows));
  pixels_.reserve(static_cast<std::size_t>(area(band.quad) / band.stride) + kStrips);
  forEachSpan(
      band.quad, frame.disparity.cols, frame.disparity.rows, band.upright ? band.stride : 1, [&](int v, int u_begin, int u_end) {
        for (int u = u_begin; u < u_end; u += band.upright ? 1 : band.stride) {
          const Eigen::Vector2d place = Eigen::Vector2d(u, v) - middle;
          const double across = edge.outward.dot(place) + kInside;
          const auto strip = static_cast<int>(std::floor(across));
          if (strip < 0 || strip >= kStrips) continue;
          off_middle_ += across - strip - 0.5;
          const std::uint8_t label = region.mask(v, u);
          const float disparity = frame.disparity(v, u);
          const auto residual = isValidDisparity(disparity) ? static_cast<float>(disparity - region.disparity_plane.at(u, v))
                                                            : std::numeric_limits<float>::quiet_NaN();
          pixels_.push_back({static_cast<std::int8_t>(strip), static_cast<std::int8_t>(along.dot(place) < 0 ? 0 : 1),
                             label == kInPlane, label == kOccluded || label == kOtherPlane,
                             label == kInPlane || label == kOtherPlane, residual});
        }
      });
  off_middle_ /= std::max(1.0, static_cast<double>(pixels_.size()));
}

void DepthEdge::measureNoise() {
  int count = 0;
  double sum = 0, squares = 0;
  for (const Pixel& pixel : pixels_) {
    if (!pixel.in_plane || pixel.strip >= kInside - kNearEdge || std::isnan(pixel.residual)) continue;
    ++count;
    sum += pixel.residual;
    squares += pixel.residual * pixel.residual;
  }
  if (count == 0) return;
  mean_ = sum / count;
  sigma_ = std::sqrt(std::max(squares / count - mean_ * mean_, kLeastSigma * kLeastSigma));
}

DepthEdge::Strips DepthEdge::strips(Halves halves, double face_begin) const {
  Strips strips{};
  for (const Pixel& pixel : pixels_) {
    if (pixel.half < halves.first || pixel.half > halves.last) continue;
    Strip& strip = strips[pixel.strip];
    ++(pixel.hidden ? strip.hidden : strip.seen);
    const bool is_hole = std::isnan(pixel.residual);
    strip.valid += !pixel.hidden && !is_hole;
    const double expected = mean_ + face_.slope * std::max(0.0, placeOf(pixel.strip) - face_begin);
    const bool is_on_surface = is_hole ? pixel.in_plane : std::abs(pixel.residual - expected) <= kOutlier * sigma_;
    if (pixel.hidden || !is_on_surface) continue;
    ++strip.surface;
    if (is_hole) continue;
    ++strip.measured;
    strip.residuals += pixel.residual - mean_;
  }
  return strips;
}

/// [px] A ragged edge lies where as much of the surface is missing inside as there is of it outside. Of the pixels near the edge
/// those without a depth say nothing, for they may be of either surface. What the surface lacks well inside, as at a recessed
/// pull, it lacks near the edge too.
std::optional<double> DepthEdge::endOf(const Strips& strips) {
  constexpr int kNear = kInside - kNearEdge;  // the first strip that may lie beyond
  double full = 0;
  int inside = 0, measured = 0, valid = 0;
  for (int k = 0; k < kNear; ++k) {
    full += static_cast<double>(strips[k].surface) / std::max(1, strips[k].seen);
    inside += strips[k].seen > 0;
    measured += strips[k].measured;
    valid += strips[k].valid;
  }
  if (measured == 0 || full < kMostlySurface * inside) return std::nullopt;
  const double most = static_cast<double>(measured) / valid;
  if (measuredShare(strips, kNear) < kEnded * most) return std::nullopt;  // it ends farther inside than is looked at
  double end = -kNearEdge;
  for (int k = kNear; k < kStrips; ++k) {
    if (strips[k].seen <= strips[k].hidden) return std::nullopt;
    const double share = measuredShare(strips, k);
    end += std::min(share / most, 1.0);
    if (share < kEnded * most) return end;
  }
  return std::nullopt;
}

/// How much of a strip near the edge is the surface's, by what has a depth. Where hardly anything has one, depth has ended.
/// But registration to another camera leaves single rows and columns without one: there the next strip shows that it goes on.
double DepthEdge::measuredShare(const Strips& strips, int k) {
  const auto shareOf = [](const Strip& strip) {
    return strip.measured / std::max({1.0, static_cast<double>(strip.valid), kEnded * strip.seen});
  };
  const double share = shareOf(strips[k]);
  if (strips[k].valid >= kEnded * strips[k].seen || k + 1 == kStrips) return share;
  const double next = shareOf(strips[k + 1]);
  return next < kEnded ? share : next;
}

/// [px^2] By which an explanation of the strips by one number more must be better.
double DepthEdge::evidence() const { return kOutlier * kOutlier * kSharedPixels * sigma_ * sigma_; }

/// [px] Where the strips' mean residuals begin to follow the face's slope, by least squares; `end` if they do not.
double DepthEdge::faceBegin(const Strips& strips, double end) const {
  const auto costOf = [&](double begin) {
    double cost = 0;
    for (int k = 0; k < kStrips && placeOf(k) <= end; ++k) {
      const double expected = face_.slope * std::max(0.0, placeOf(k) - begin);
      const double mean = strips[k].residuals / std::max(1, strips[k].measured);
      cost += strips[k].measured * (mean - expected) * (mean - expected);
    }
    return cost;
  };
  double best = end, least = costOf(end) - evidence();
  for (double begin = end - kStep; begin >= end - kLongestFace; begin -= kStep) {
    const double cost = costOf(begin);
    if (cost >= least) continue;
    least = cost;
    best = begin;
  }
  return best;
}

std::optional<double> DepthEdge::crease(double slope) const {
  if (sigma_ == 0) return std::nullopt;
  Strips strips{};
  for (const Pixel& pixel : pixels_) {
    if (!pixel.near || std::isnan(pixel.residual)) continue;
    ++strips[pixel.strip].measured;
    strips[pixel.strip].residuals += pixel.residual;
  }
  double best = kOutside, least = creaseCost(strips, slope, best) - evidence();
  for (double begin = kOutside - kStep; begin > -kInside; begin -= kStep) {
    const double cost = creaseCost(strips, slope, begin);
    if (cost >= least) continue;
    least = cost;
    best = begin;
  }
  if (best == kOutside) return std::nullopt;
  return best + off_middle_;
}

/// [px^2] What is left of the strips' mean residuals by the best level, from which they rise from `begin` on.
double DepthEdge::creaseCost(const Strips& strips, double slope, double begin) {
  const auto rise = [&](int k) { return slope * std::max(0.0, placeOf(k) - begin); };
  double level = 0, n = 0, cost = 0;
  for (int k = 0; k < kStrips; ++k) {
    level += strips[k].residuals - strips[k].measured * rise(k);
    n += strips[k].measured;
  }
  level /= std::max(1.0, n);
  for (int k = 0; k < kStrips; ++k) {
    const double mean = strips[k].residuals / std::max(1, strips[k].measured);
    cost += strips[k].measured * std::pow(mean - rise(k) - level, 2);
  }
  return cost;
}

std::optional<DepthEdge::Place> DepthEdge::place(Halves halves) const {
  if (sigma_ == 0) return std::nullopt;
  double begin = std::numeric_limits<double>::infinity();  // of the face
  for (int round = 1;; ++round) {
    const Strips found = strips(halves, begin);
    const std::optional<double> end = endOf(found);
    if (!end) return std::nullopt;
    if (face_.slope >= 0) return Place{*end + off_middle_, false};
    begin = faceBegin(found, *end);
    if (round == kRounds) return Place{begin + off_middle_, begin < *end};
  }
}

}  // namespace cabinet_articulation::core

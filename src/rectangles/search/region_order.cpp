// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/region_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <tuple>

namespace cabinet_articulation::core {
namespace {

constexpr double kPlaneDistance = 0.05;  ///< [m] a tracked front moves no farther between frames
constexpr double kFarOutside = 1e6;      ///< [px] that single precision holds, outside every image
constexpr double kPlaneCosine = 0.9;     ///< 26 deg: turn between frames and a small front's error

bool holds(const PlaneRegion& region, const StereoCamera& camera, const Rectangle& expected) {
  if (region.hull.size() < 3 || !(expected.center().z() > 0) || !liesIn(region.plane, expected)) return false;
  const Eigen::Vector2d pixel = camera.project(expected.center()).cwiseMax(-kFarOutside).cwiseMin(kFarOutside);
  return cv::pointPolygonTest(region.hull, cv::Point2f(static_cast<float>(pixel.x()), static_cast<float>(pixel.y())), false) >= 0;
}

}  // namespace

bool liesIn(const Plane& plane, const Rectangle& expected) {
  return expected.normal().dot(plane.normal) > kPlaneCosine && std::abs(plane.distance(expected.center())) < kPlaneDistance;
}

std::vector<int> regionOrder(const std::vector<PlaneRegion>& regions, const StereoCamera& camera,
                             const std::vector<Rectangle>& expected) {
  std::vector<char> tracked;
  tracked.reserve(regions.size());
  for (const PlaneRegion& region : regions)
    tracked.push_back(
        std::any_of(expected.begin(), expected.end(), [&](const Rectangle& r) { return holds(region, camera, r); }));
  std::vector<int> order(regions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::make_tuple(-tracked[a], -regions[a].inliers, a) < std::make_tuple(-tracked[b], -regions[b].inliers, b);
  });
  return order;
}

}  // namespace cabinet_articulation::core

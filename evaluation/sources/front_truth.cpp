// SPDX-License-Identifier: BSD-3-Clause
#include "sources/front_truth.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core::evaluation {
namespace {

/// Samples the front on a grid: how much of it lies inside the image, and how much of it is the nearest surface there.
void measureVisibility(const cv::Mat1f& depth, const StereoCamera& camera, Front* front) {
  constexpr int kColumns = 60, kRows = 30;
  constexpr double kSameSurface = 0.006;  // [m] less than a handle or a neighbour stands out
  int inside = 0, visible = 0;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const double x = ((i % kColumns + 0.5) / kColumns - 0.5) * front->rectangle.width;
    const double y = ((i / kColumns + 0.5) / kRows - 0.5) * front->rectangle.height;
    const Eigen::Vector3d p = front->rectangle.pose * Eigen::Vector3d(x, y, 0);
    if (p.z() <= 0) continue;
    const Eigen::Vector2d pixel = camera.project(p);
    const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
    ++inside;
    visible += std::abs(depth(v, u) - p.z()) < kSameSurface * std::max(1.0, p.z());
  }
  front->in_image = static_cast<double>(inside) / (kColumns * kRows);
  front->visible = static_cast<double>(visible) / (kColumns * kRows);
  front->faces_camera = front->rectangle.plane().offset > 0;
}

}  // namespace

Front makeFront(const FrontTruth& truth, const StereoFrame& image, const StereoCamera& camera) {
  Front front;
  front.name = truth.name;
  front.type = truth.type;
  front.rectangle = truth.rectangle;
  front.opened = truth.q * (truth.type == JointType::kRotational ? truth.rectangle.width : 1);
  measureVisibility(image.depth, camera, &front);
  return front;
}

}  // namespace cabinet_articulation::core::evaluation

// SPDX-License-Identifier: BSD-3-Clause
// A front that leaves the image for a part, or stands edge-on for a while, is kept through its track.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "geometry/degrees.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kRate = 10;
constexpr double kWall = 2.2;  // [m]
constexpr double kWidth = 0.4, kHeight = 0.3;
constexpr double kThickness = 0.018;  // [m] of its board

/// A front before a wall, as a depth camera with noise of a twentieth of a pixel sees it.
DepthFrame seen(const Rectangle& front, int seed) {
  DepthFrame frame;
  frame.camera = {640, 480, 690, 690, 320, 240, 0.09, 0};
  frame.disparity.create(480, 640);
  const Eigen::Vector3d normal = front.pose.linear().col(2);
  double distance = normal.dot(front.center());
  if (distance > 0) distance -= kThickness;  // its back is seen
  cv::RNG noise(seed);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector3d ray = frame.camera.ray(u, v);
      const double z = distance / normal.dot(ray);
      const Eigen::Vector3d p = front.pose.inverse() * (z * ray);
      const bool hit = z > 0 && std::abs(p.x()) < kWidth / 2 && std::abs(p.y()) < kHeight / 2;
      frame.disparity(v, u) = static_cast<float>(frame.camera.disparity(hit ? z : kWall) + noise.gaussian(0.05));
    }
  return frame;
}

/// The track next to the front, or nothing.
const Track* trackOf(const Rectangle& front, const std::vector<Track>& tracks) {
  for (const Track& track : tracks)
    if (!track.observations.empty() && (track.observations.back().rectangle.center() - front.center()).norm() < 0.15)
      return &track;
  return nullptr;
}

/// Shows the front at its places in turn. The track at the first of them must follow it to every other where `must_see` holds,
/// with the right size.
void expectOneTrack(const std::vector<Rectangle>& places, const std::function<bool(size_t)>& must_see) {
  Pipeline pipeline({});
  std::uint32_t id = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    const PipelineResult result = pipeline.process(static_cast<double>(i) / kRate, seen(places[i], static_cast<int>(i)));
    const Track* const track = trackOf(places[i], *result.tracks);
    if (!must_see(i)) continue;
    ASSERT_NE(track, nullptr) << "lost in frame " << i;
    if (i == 0) id = track->id;
    EXPECT_EQ(track->id, id) << "in frame " << i;
    EXPECT_EQ(track->observations.back().stamp, static_cast<double>(i) / kRate) << "seen in frame " << i;
    const Rectangle described = alignDescription(track->observations.back().rectangle, places[i], true);
    EXPECT_LT((described.center() - places[i].center()).norm(), 0.015) << "in frame " << i;
    EXPECT_NEAR(described.width, kWidth, 0.015) << "in frame " << i;
    EXPECT_NEAR(described.height, kHeight, 0.015) << "in frame " << i;
  }
}

TEST(KeptFront, SlidesOutOfTheImageAndBack) {
  std::vector<Rectangle> places;
  for (int i = 0; i <= 80; ++i) {
    Rectangle front{Eigen::Isometry3d::Identity(), kWidth, kHeight};
    // At the turning point less than half of it is left in the image.
    front.pose.translation() = Eigen::Vector3d(0.58 * std::sin(M_PI * i / 80), 0.02, 1.2);
    front.pose.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
    places.push_back(front);
  }
  expectOneTrack(places, [](size_t) { return true; });
}

TEST(KeptFront, TurnsEdgeOnAndBack) {
  std::vector<Rectangle> places;
  std::vector<double> slants;
  for (int i = 0; i <= 60; ++i) {
    const double angle = 100 * kDegree * std::sin(M_PI * i / 60);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(Eigen::Vector3d(-kWidth / 2, 0, 1.4)).rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
    pose.translate(Eigen::Vector3d(kWidth / 2, 0, 0)).rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
    places.push_back({pose, kWidth, kHeight});
    slants.push_back(std::abs(pose.linear().col(2).dot(places.back().center().normalized())));
  }
  ASSERT_LT(*std::min_element(slants.begin(), slants.end()), 0.02) << "it is edge-on in between";
  expectOneTrack(places, [&](size_t i) { return slants[i] > std::sin(12 * kDegree); });
}

}  // namespace
}  // namespace cabinet_articulation::core

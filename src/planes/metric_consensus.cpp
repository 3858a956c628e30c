// SPDX-License-Identifier: BSD-3-Clause
#include "planes/metric_consensus.h"

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <algorithm>
#include <iterator>

namespace cabinet_articulation::core {
namespace {

using Point = pcl::PointXYZ;

constexpr float kLeastArea = 1e-5F;  ///< [m^2] twice the area of the smallest sample, as in PCL 1.13

/// PCL's plane with a seed of ours, and without its messages about collinear samples.
class SeededPlane : public pcl::SampleConsensusModelPlane<Point> {
 public:
  SeededPlane(const PointCloudConstPtr& cloud, int seed) : SampleConsensusModelPlane(cloud) {
    rng_alg_.seed(static_cast<unsigned>(seed));
  }

 private:
  bool isSampleGood(const std::vector<int>& samples) const override {
    const auto point = [&](int i) { return (*input_)[samples[i]].getVector3fMap(); };
    return (point(1) - point(0)).cross(point(2) - point(0)).norm() > kLeastArea;
  }
};

pcl::PointCloud<Point>::Ptr stridedPoints(const DepthFrame& frame, int stride) {
  pcl::PointCloud<Point>::Ptr cloud(new pcl::PointCloud<Point>);
  for (int v = 0; v < frame.disparity.rows; v += stride)
    for (int u = 0; u < frame.disparity.cols; u += stride) {
      const float disparity = frame.disparity(v, u);
      if (!isValidDisparity(disparity)) continue;
      const Eigen::Vector3f p = frame.camera.point(u, v, disparity).cast<float>();
      cloud->push_back(Point(p.x(), p.y(), p.z()));
    }
  return cloud;
}

Plane towardsCamera(const Eigen::VectorXf& coefficients) {
  const Eigen::Vector4d plane = coefficients.cast<double>();
  const double sign = plane[3] < 0 ? -1 : 1;
  return {sign * plane.head<3>(), sign * plane[3]};
}

}  // namespace

MetricConsensus::MetricConsensus(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

std::vector<Plane> MetricConsensus::process(const DepthFrame& frame) const {
  std::vector<Plane> planes;
  const auto cloud = stridedPoints(frame, config_.stride);
  const pcl::SampleConsensusModelPlane<Point>::Ptr model(new SeededPlane(cloud, config_.seed));
  std::vector<int> left = *model->getIndices();
  const auto suffice = [&](const std::vector<int>& points) { return static_cast<int>(points.size()) >= config_.min_inliers; };
  while (static_cast<int>(planes.size()) < config_.max_planes && suffice(left)) {
    pcl::RandomSampleConsensus<Point> ransac(model, config_.plane_distance);
    ransac.setMaxIterations(config_.hypotheses);
    ransac.setProbability(config_.confidence);
    if (!ransac.computeModel()) break;
    Eigen::VectorXf found;
    std::vector<int> inliers, rest;
    ransac.getModelCoefficients(found);
    ransac.getInliers(inliers);
    if (!suffice(inliers)) break;  // PCL complains about so few, too
    model->optimizeModelCoefficients(inliers, found, found);
    model->selectWithinDistance(found, config_.plane_distance, inliers);
    if (!suffice(inliers)) break;
    planes.push_back(towardsCamera(found));
    std::set_difference(left.begin(), left.end(), inliers.begin(), inliers.end(), std::back_inserter(rest));
    left.swap(rest);
    model->setIndices(left);
  }
  return planes;
}

}  // namespace cabinet_articulation::core

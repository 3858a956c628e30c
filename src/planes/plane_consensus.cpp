// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_consensus.h"

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <array>
#include <cmath>
#include <utility>

#include "planes/disparity_tolerance.h"
#include "planes/plane_fit.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::array<int, 3> kSampleRadii = {30, 60, 120};  ///< [px] of samples 2 and 3 about sample 1, used in turn
constexpr int kNeighbourTrials = 10;                        ///< draws of a neighbour before giving up
constexpr float kLeastArea = 30;                            ///< [px^2] twice the area of the smallest useful sample
constexpr int kRefits = 3;

using Point = pcl::PointXYZ;

/// The pixels that no plane has taken yet, in arrays of their own so that counting vectorises.
struct Pixels {
  std::vector<float> u, v, disparity, tolerance;
  std::vector<int> cell;  ///< place in the strided grid

  size_t size() const { return u.size(); }
  void resize(size_t n) {
    for (std::vector<float>* values : {&u, &v, &disparity, &tolerance}) values->resize(n);
    cell.resize(n);
  }
  void move(size_t from, size_t to) {
    for (std::vector<float>* values : {&u, &v, &disparity, &tolerance}) (*values)[to] = (*values)[from];
    cell[to] = cell[from];
  }
};

__attribute__((target_clones("avx2", "default"))) int countInliers(const Pixels& pixels, float a, float b, float c) {
  const float* u = pixels.u.data();
  const float* v = pixels.v.data();
  const float* disparity = pixels.disparity.data();
  const float* tolerance = pixels.tolerance.data();
  const int n = static_cast<int>(pixels.size());
  int count = 0;
  for (int i = 0; i < n; ++i) count += std::abs(a * u[i] + b * v[i] + c - disparity[i]) <= tolerance[i];
  return count;
}

}  // namespace

/// PCL's plane in the space of (u, v, disparity) with coefficients (a, b, -1, c): samples are local, the distance is
/// measured along the disparity and relative to each pixel's tolerance, so that PCL's threshold is 1.
class PlaneConsensus::Model : public pcl::SampleConsensusModelPlane<Point> {
 public:
  /// std::size_t, but int in PCL 1.10.
  using Count = decltype(std::declval<const SampleConsensusModelPlane&>().countWithinDistance(Eigen::VectorXf(), 0));

  Model() : SampleConsensusModelPlane(PointCloudPtr(new PointCloud)) {}

  void setFrame(const DepthFrame& frame, const PlanesConfig& config);
  bool sizeAtLeast(int n) const { return static_cast<int>(pixels_.size()) >= n; }
  void remove(const std::vector<int>& inliers);

  void getSamples(int& iterations, std::vector<int>& samples) override;
  bool computeModelCoefficients(const std::vector<int>& samples, Eigen::VectorXf& model) const override;
  Count countWithinDistance(const Eigen::VectorXf& model, const double) const override {
    return countInliers(pixels_, model[0], model[1], model[3]);
  }
  void selectWithinDistance(const Eigen::VectorXf& model, const double, std::vector<int>& inliers) override;
  void optimizeModelCoefficients(const std::vector<int>& inliers, const Eigen::VectorXf& model,
                                 Eigen::VectorXf& optimized) const override;

 private:
  /// What rnd() of PCL gives, without its way through Boost's distribution: half of 32 bits.
  int draw() { return static_cast<int>(rng_alg_() >> 1); }
  int neighbour(int pixel, int radius);

  Pixels pixels_;
  cv::Mat1i grid_;  ///< index into `pixels_` of each strided pixel, or -1
  int stride_ = 1;
};

void PlaneConsensus::Model::setFrame(const DepthFrame& frame, const PlanesConfig& config) {
  const DisparityTolerance tolerance(frame.camera, config.fit_tolerance_px, config.fit_tolerance_m, config.tolerance_cap);
  stride_ = config.stride;
  const cv::Mat1f& disparity = frame.disparity;
  grid_.create((disparity.rows + stride_ - 1) / stride_, (disparity.cols + stride_ - 1) / stride_);
  pixels_.resize(grid_.total());
  int n = 0;
  for (int row = 0; row < grid_.rows; ++row) {
    const float* values = disparity[row * stride_];
    for (int col = 0; col < grid_.cols; ++col) {
      const float d = values[col * stride_];
      grid_(row, col) = -1;
      if (!isValidDisparity(d)) continue;
      grid_(row, col) = n;
      pixels_.u[n] = static_cast<float>(col * stride_);
      pixels_.v[n] = static_cast<float>(row * stride_);
      pixels_.disparity[n] = d;
      pixels_.tolerance[n] = tolerance.at(d);
      pixels_.cell[n] = row * grid_.cols + col;
      ++n;
    }
  }
  pixels_.resize(n);
  indices_->resize(n);
  rng_alg_.seed(static_cast<unsigned>(config.seed));
}

void PlaneConsensus::Model::remove(const std::vector<int>& inliers) {
  for (const int i : inliers) {
    grid_(pixels_.cell[i]) = -1;
    pixels_.cell[i] = -1;
  }
  size_t kept = 0;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    if (pixels_.cell[i] < 0) continue;
    pixels_.move(i, kept);
    grid_(pixels_.cell[kept]) = static_cast<int>(kept);
    ++kept;
  }
  pixels_.resize(kept);
  indices_->resize(kept);
}

/// A free pixel near `pixel`, or `pixel` itself if none was met.
int PlaneConsensus::Model::neighbour(int pixel, int radius) {
  const int reach = std::max(radius / stride_, 1);
  const int row = pixels_.cell[pixel] / grid_.cols, col = pixels_.cell[pixel] % grid_.cols;
  for (int trial = 0; trial < kNeighbourTrials; ++trial) {
    const int r = row + draw() % (2 * reach + 1) - reach;
    const int c = col + draw() % (2 * reach + 1) - reach;
    if (r < 0 || r >= grid_.rows || c < 0 || c >= grid_.cols) continue;
    const int found = grid_(r, c);
    if (found >= 0 && found != pixel) return found;
  }
  return pixel;
}

void PlaneConsensus::Model::getSamples(int& iterations, std::vector<int>& samples) {
  const int radius = kSampleRadii[iterations % kSampleRadii.size()];
  samples.resize(3);
  samples[0] = draw() % static_cast<int>(pixels_.size());
  samples[1] = neighbour(samples[0], radius);
  samples[2] = neighbour(samples[0], radius);
}

/// Collinear samples propose the plane of constant disparity through the first: RANSAC then never runs dry.
bool PlaneConsensus::Model::computeModelCoefficients(const std::vector<int>& samples, Eigen::VectorXf& model) const {
  const auto point = [this](int i) { return Eigen::Vector3f(pixels_.u[i], pixels_.v[i], pixels_.disparity[i]); };
  const Eigen::Vector3f p = point(samples[0]);
  const Eigen::Vector3f cross = (point(samples[1]) - p).cross(point(samples[2]) - p);
  const bool collinear = std::abs(cross.z()) < kLeastArea;
  const float a = collinear ? 0 : -cross.x() / cross.z();
  const float b = collinear ? 0 : -cross.y() / cross.z();
  model.resize(4);
  model << a, b, -1, p.z() - a * p.x() - b * p.y();
  return true;
}

void PlaneConsensus::Model::selectWithinDistance(const Eigen::VectorXf& model, const double, std::vector<int>& inliers) {
  const float a = model[0], b = model[1], c = model[3];
  inliers.resize(pixels_.size());
  int n = 0;  // every index is written, which spares a branch that no processor foresees
  for (size_t i = 0; i < pixels_.size(); ++i) {
    inliers[n] = static_cast<int>(i);
    n += std::abs(a * pixels_.u[i] + b * pixels_.v[i] + c - pixels_.disparity[i]) <= pixels_.tolerance[i];
  }
  inliers.resize(n);
}

void PlaneConsensus::Model::optimizeModelCoefficients(const std::vector<int>& inliers, const Eigen::VectorXf& model,
                                                      Eigen::VectorXf& optimized) const {
  PlaneFit fit;
  for (const int i : inliers) fit.add(pixels_.u[i], pixels_.v[i], pixels_.disparity[i]);
  optimized = model;
  if (const auto plane = fit.solve()) optimized << plane->a, plane->b, -1, plane->c;
}

/// Kept between frames, for its vectors.
struct PlaneConsensus::Search {
  explicit Search(const PlanesConfig& config) : model(new Model), ransac(pcl::SampleConsensusModel<Point>::Ptr(model), 1.0) {
    ransac.setMaxIterations(config.hypotheses);
    ransac.setProbability(config.confidence);
  }
  Model* const model;  ///< belongs to `ransac`, by PCL's own kind of pointer: Boost's in PCL 1.10
  pcl::RandomSampleConsensus<Point> ransac;
  std::vector<int> inliers;
};

PlaneConsensus::PlaneConsensus(const PlanesConfig& config) : config_(config) {
  checkConfig(config_);
  search_ = std::make_unique<Search>(config_);
}

PlaneConsensus::~PlaneConsensus() = default;

std::vector<DisparityPlane> PlaneConsensus::process(const DepthFrame& frame) {
  Model& model = *search_->model;
  std::vector<int>& inliers = search_->inliers;
  std::vector<DisparityPlane> planes;
  planes.reserve(config_.max_planes);
  Eigen::VectorXf found;
  model.setFrame(frame, config_);
  while (static_cast<int>(planes.size()) < config_.max_planes && model.sizeAtLeast(config_.min_inliers)) {
    if (!search_->ransac.computeModel()) break;
    search_->ransac.getModelCoefficients(found);
    search_->ransac.getInliers(inliers);
    for (int i = 0; i < kRefits; ++i) {
      model.optimizeModelCoefficients(inliers, found, found);
      model.selectWithinDistance(found, 1.0, inliers);
    }
    if (static_cast<int>(inliers.size()) < config_.min_inliers) break;
    planes.push_back({found[0], found[1], found[3]});
    model.remove(inliers);
  }
  return planes;
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/curve_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kShortestPath = 1e-3;  ///< [m]
/// [1/m^2] Typical third derivative of a path by its length: what furniture does over some 15 cm (ours).
constexpr double kTypicalBend = 50;
constexpr double kOrientationFloor = 0.02;  ///< [rad]

class CurveFitter {
 public:
  CurveFitter(const PoseSamples& samples, const std::vector<double>& q, const ArticulationConfig& config)
      : samples_(samples), config_(config), values_(static_cast<Eigen::Index>(samples.size()), 7), near_(samples.size(), 1) {
    fit_.q = q;
    fit_.position_scale = sigmaPosition(samples, config);
    fit_.orientation_scale = sigmaOrientation(samples, config);
    weights_.assign(samples.size(), 1);
    Eigen::Vector4d last = samples.orientations.front().coeffs();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      Eigen::Vector4d turn = samples.orientations[i].coeffs();
      if (turn.dot(last) < 0) turn = -turn;
      values_.row(static_cast<Eigen::Index>(i)) << samples.positions[i].transpose(), turn.transpose();
      last = turn;
    }
  }

  /// From the curve and the scales of another fit.
  CurveFit proceed(CurveFit last) {
    fit_ = std::move(last);
    // Until they are thinned out again, all poses but the last stay the same.
    const std::size_t same = fit_.q.size() <= samples_.size() && !fit_.q.empty() ? fit_.q.size() - 1 : 0;
    fit_.q.resize(samples_.size());
    const double metres_per_radian = metresPerRadian();
    for (std::size_t i = same; i < samples_.size(); ++i) fit_.q[i] = fit_.curve.nearest(poseOf(i), metres_per_radian);
    measure();
    followLength();
    solve();
    measure();
    return fit_;
  }

  CurveFit fit(int rounds) {
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
      solve();
      measure();
      if (std::abs(last - fit_.cost) < 1e-4 * fit_.cost + 1e-12) break;
      last = fit_.cost;
      followLength();
    }
    return fit_;
  }

 private:
  /// Knots from places.
  void solve() {
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (!near_[i]) continue;
      first = std::min(first, fit_.q[i]);
      last = std::max(last, fit_.q[i]);
    }
    const double missing = std::max(0.0, kShortestPath - (last - first));
    first -= missing / 2;
    last += missing / 2;
    const std::size_t knots = std::clamp<std::size_t>(samples_.size() / 6, PoseCurve::kLeastKnots, 16);
    const auto size = static_cast<Eigen::Index>(knots);
    const double step = (last - first) / static_cast<double>(knots - 1);
    Eigen::MatrixXd normal = 1e-9 * Eigen::MatrixXd::Identity(size, size);
    Eigen::MatrixXd right = 1e-9 * values_.colwise().mean().replicate(size, 1);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (!near_[i]) continue;
      const PoseCurve::Weights w = PoseCurve::weights(knots, first, step, fit_.q[i]);
      normal.block<4, 4>(w.first, w.first) += weights_[i] * w.value * w.value.transpose();
      right.middleRows<4>(w.first) += weights_[i] * w.value * values_.row(static_cast<Eigen::Index>(i));
    }
    const double bend = step * step * step * kTypicalBend / fit_.position_scale;
    Eigen::MatrixXd smooth = normal;
    const Eigen::Vector4d third(-1, 3, -3, 1);
    for (Eigen::Index k = 0; k + 4 <= size; ++k) smooth.block<4, 4>(k, k) += third * third.transpose() / (bend * bend);
    const Eigen::LDLT<Eigen::MatrixXd> solver(smooth);
    const Eigen::MatrixXd solution = solver.solve(right);
    std::vector<PoseCurve::Knot> result(knots);
    for (std::size_t k = 0; k < knots; ++k) result[k] = solution.row(static_cast<Eigen::Index>(k)).transpose();
    fit_.curve = PoseCurve(std::move(result), first, last);
    fit_.covariance = solver.solve(Eigen::MatrixXd::Identity(size, size));
    fit_.freedom = solver.solve(normal).trace();
  }

  double metresPerRadian() const {
    return samples_.has_orientation ? fit_.position_scale / std::max(fit_.orientation_scale, config_.sigma_orientation_floor) : 0;
  }

  Eigen::Isometry3d poseOf(std::size_t i) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = samples_.positions[i];
    pose.linear() = samples_.orientations[i].toRotationMatrix();
    return pose;
  }

  /// Places, scales and weights from knots.
  void measure() {
    const double limit = outlierDistance(samples_, config_);
    const double metres_per_radian = metresPerRadian();
    std::vector<double> distances, angles;
    fit_.cost = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      fit_.q[i] = fit_.curve.nearestFrom(fit_.q[i], poseOf(i), metres_per_radian);
      const Eigen::Isometry3d at = fit_.curve.pose(fit_.q[i]);
      const auto row = values_.row(static_cast<Eigen::Index>(i));
      if (!samples_.position_weights.empty()) {
        // What was not observed is taken from the curve.
        const Eigen::Vector3d away = samples_.position_weights[i] * (samples_.positions[i] - at.translation());
        values_.row(static_cast<Eigen::Index>(i)).head<3>() = (at.translation() + away).transpose();
      }
      Eigen::Quaterniond turn(at.linear());
      if (row.tail<4>().dot(turn.coeffs()) < 0) values_.row(static_cast<Eigen::Index>(i)).tail<4>() *= -1;
      distances.push_back((row.head<3>().transpose() - at.translation()).norm());
      angles.push_back(turn.angularDistance(samples_.orientations[i]));
      fit_.cost += std::min(distances.back() * distances.back(), limit * limit);
    }
    weigh(distances, angles);
  }

  void weigh(const std::vector<double>& distances, const std::vector<double>& angles) {
    // Medians of the lengths of normal vectors in two and three dimensions.
    fit_.position_scale = std::max(config_.sigma_position_floor, median(distances) / 1.177);
    fit_.orientation_scale = std::max(kOrientationFloor, median(angles) / 1.538);
    const double nu = config_.degrees_of_freedom;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      double square = std::pow(distances[i] / fit_.position_scale, 2);
      if (samples_.has_orientation) square += std::pow(angles[i] / fit_.orientation_scale, 2);
      const int dimensions = samples_.has_orientation ? 5 : 2;
      weights_[i] = (nu + dimensions) / (nu + square);
      near_[i] = distances[i] <= std::max(outlierDistance(samples_, config_), 5 * fit_.position_scale);
    }
  }

  /// Makes q the length of the way of the positions.
  void followLength() {
    constexpr int kParts = 128;
    const double first = fit_.curve.first(), part = (fit_.curve.last() - first) / kParts;
    std::vector<double> length{0};
    Eigen::Vector3d before = fit_.curve.pose(first).translation();
    for (int k = 1; k <= kParts; ++k) {
      const Eigen::Vector3d here = fit_.curve.pose(first + k * part).translation();
      length.push_back(length.back() + (here - before).norm());
      before = here;
    }
    if (length.back() < kShortestPath) return;
    for (double& q : fit_.q) {
      const double place = std::clamp((q - first) / part, 0.0, kParts - 1e-9);
      const auto k = static_cast<std::size_t>(place);
      const double outside = (q - first) - place * part;
      q = first + length[k] + (place - static_cast<double>(k)) * (length[k + 1] - length[k]) + outside;
    }
  }

  const PoseSamples& samples_;
  const ArticulationConfig& config_;
  Eigen::Matrix<double, Eigen::Dynamic, 7> values_;  ///< poses as knots
  std::vector<double> weights_;
  std::vector<char> near_;  ///< not a false detection
  CurveFit fit_;
};

}  // namespace

CurveFit fitCurve(const PoseSamples& samples, const std::vector<double>& q, const ArticulationConfig& config, int rounds) {
  return CurveFitter(samples, q, config).fit(rounds);
}

CurveFit continueCurve(const PoseSamples& samples, CurveFit last, const ArticulationConfig& config) {
  return CurveFitter(samples, last.q, config).proceed(std::move(last));
}

}  // namespace cabinet_articulation::core

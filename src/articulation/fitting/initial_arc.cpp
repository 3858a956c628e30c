// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/initial_arc.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kScoredPoses = 60;
constexpr int kHypotheses = 30;
constexpr double kStraightRadius = 100;  ///< [m] circles beyond are lines

/// Directions in which points scatter, most first.
struct Scatter {
  Eigen::Vector3d mean;
  Eigen::Matrix3d axes;
};

Scatter scatterOf(const std::vector<Eigen::Vector3d>& points) {
  Scatter scatter{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  for (const Eigen::Vector3d& p : points) scatter.mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) moments += (p - scatter.mean) * (p - scatter.mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  scatter.axes = solver.eigenvectors().rowwise().reverse();
  return scatter;
}

/// The arc around `center` whose middle is where `towards` lies as seen from there.
Arc arcAround(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double radius, const Eigen::Vector3d& towards) {
  Arc arc;
  Eigen::Vector3d outward = towards - center;
  outward -= axis * axis.dot(outward);
  outward = outward.norm() > 1e-9 ? outward.normalized() : axis.unitOrthogonal();
  arc.middle = center + outward * radius;
  arc.curvature = 1 / radius;
  arc.frame.col(0) = axis.cross(outward);
  arc.frame.col(1) = -outward;
  arc.frame.col(2) = axis;
  return arc;
}

Arc lineThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& direction) {
  Arc line;
  line.middle = a;
  line.frame = arcFrame(direction.norm() > 1e-9 ? direction : Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero());
  return line;
}

/// Algebraic circle in the plane of greatest scatter (Taubin's start in its linear, Kasa's, form).
Arc algebraicCircle(const std::vector<Eigen::Vector3d>& points, const Scatter& scatter) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d local = scatter.axes.transpose() * (p - scatter.mean);
    const Eigen::Vector3d row(local.x(), local.y(), 1);
    normal += row * row.transpose();
    right += row * local.head<2>().squaredNorm();
  }
  const Eigen::Vector3d solution = normal.fullPivLu().solve(right);
  const Eigen::Vector2d center = solution.head<2>() / 2;
  const double radius = std::sqrt(std::max(1e-12, solution.z() + center.squaredNorm()));
  if (!std::isfinite(radius) || radius > kStraightRadius) return lineThrough(scatter.mean, scatter.axes.col(0));
  const Eigen::Vector3d center_world = scatter.mean + scatter.axes.leftCols<2>() * center;
  return arcAround(center_world, scatter.axes.col(2), radius, scatter.mean);
}

/// The circle through three points.
Arc circleThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double twice = 2 * normal.squaredNorm();
  if (twice < 1e-16) return lineThrough(a, ac);
  const Eigen::Vector3d to_center = (normal.cross(ab) * ac.squaredNorm() + ac.cross(normal) * ab.squaredNorm()) / twice;
  if (to_center.norm() > kStraightRadius) return lineThrough(a, ac);
  return arcAround(a + to_center, normal.normalized(), to_center.norm(), (a + b + c) / 3);
}

double disagreement(const Arc& arc, const std::vector<Eigen::Vector3d>& points, double sigma) {
  double sum = 0;
  for (const Eigen::Vector3d& p : points) sum += std::min(arc.squaredDistance(p), 9 * sigma * sigma);
  return sum;
}

/// The orientation of the front at s = 0: of the poses near the path, turned back to there. Chordal mean, taken twice so
/// that outliers lose their say.
Eigen::Matrix3d meanOrientation(const PoseSamples& samples, const Arc& arc) {
  Eigen::Quaterniond mean = Eigen::Quaterniond::Identity();
  for (int round = 0; round < 3; ++round) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double theta = arc.curvature * arc.arcLength(samples.positions[i]);
      Eigen::Quaterniond q = Eigen::AngleAxisd(-theta, arc.axis()) * samples.orientations[i];
      if (round == 0 && i == 0) mean = q;
      const double angle = q.angularDistance(mean);
      if (q.dot(mean) < 0) q.coeffs() = -q.coeffs();
      sum += q.coeffs() / (1 + angle * angle / 0.05);
    }
    mean.coeffs() = sum.normalized();
  }
  return mean.toRotationMatrix();
}

Arc centeredOn(const PoseSamples& samples, const Arc& arc) {
  Arc centered = arc.recentered(meanArcLength(arc, samples.positions));
  if (samples.has_orientation) centered.orientation = meanOrientation(samples, centered);
  return centered;
}

}  // namespace

Arc consensusArc(const PoseSamples& samples, PathShape shape, const ArticulationConfig& config) {
  std::vector<Eigen::Vector3d> points;
  const std::size_t count = std::min(samples.size(), kScoredPoses);
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(samples.positions[count < 2 ? 0 : i * (samples.size() - 1) / (count - 1)]);
  const Scatter scatter = scatterOf(points);
  Arc best = shape == PathShape::kLine ? lineThrough(scatter.mean, scatter.axes.col(0)) : algebraicCircle(points, scatter);
  double best_score = disagreement(best, points, sigmaPosition(samples, config));
  std::mt19937 random(static_cast<std::uint32_t>(config.seed));
  const auto draw = [&]() -> const Eigen::Vector3d& { return points[random() % points.size()]; };
  for (int i = 0; i < kHypotheses; ++i) {
    const Eigen::Vector3d &a = draw(), &b = draw(), &c = draw();
    const Arc arc = shape == PathShape::kLine ? lineThrough(a, b - a) : circleThrough(a, b, c);
    const double score = disagreement(arc, points, sigmaPosition(samples, config));
    if (score < best_score) {
      best_score = score;
      best = arc;
    }
  }
  return centeredOn(samples, best);
}

Arc turningCircle(const PoseSamples& samples, const ArticulationConfig& config) {
  const double n = static_cast<double>(samples.size());
  std::vector<Eigen::Matrix3d> rotations;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d mean_rotation = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    rotations.push_back(samples.orientations[i].toRotationMatrix());
    mean += samples.positions[i] / n;
    mean_rotation += rotations.back() / n;
  }
  // x_i + R_i s = c: s is the place of the axis as seen from the front, c in space.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Matrix3d turn = rotations[i] - mean_rotation;
    normal += turn.transpose() * turn / n;
    right -= turn.transpose() * (samples.positions[i] - mean) / n;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  const Eigen::Vector3d axis = (mean_rotation * solver.eigenvectors().col(0)).normalized();
  constexpr double kLeastTurn = 1e-5;  // squared; less is noise
  const Eigen::Vector3d inverse(0, 1 / (solver.eigenvalues()[1] + kLeastTurn), 1 / (solver.eigenvalues()[2] + kLeastTurn));
  const Eigen::Vector3d to_axis = solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose() * right;
  const Eigen::Vector3d center = mean + mean_rotation * to_axis;
  const double radius = std::clamp(to_axis.norm(), config.radius_min, radiusMax(samples, config));
  return centeredOn(samples, arcAround(center, axis, radius, mean));
}

Arc bestCircleStart(const PoseSamples& samples, const ArticulationConfig& config) {
  std::vector<Arc> starts{consensusArc(samples, PathShape::kCircle, config)};
  if (samples.has_orientation && samples.size() > 1) {
    starts.push_back(turningCircle(samples, config));
    for (const Arc& arc : typicalCircles(samples, consensusArc(samples, PathShape::kLine, config), config.prior.door_radius))
      starts.push_back(arc);
  }
  double least = std::numeric_limits<double>::infinity();
  Arc best = starts.front();
  for (const Arc& start : starts) {
    const double cost = arcCost(samples, start, config);
    if (cost < least) {
      least = cost;
      best = start;
    }
  }
  return best;
}

std::vector<Arc> typicalCircles(const PoseSamples& samples, const Arc& line, double typical_radius) {
  const Scatter scatter = scatterOf(samples.positions);
  std::vector<Arc> circles;
  for (const double side : {1.0, -1.0}) {
    Arc arc = line;
    arc.frame = arcFrame(line.tangent(), side * scatter.axes.col(1));
    arc.curvature = 1 / typical_radius;
    circles.push_back(centeredOn(samples, arc));
  }
  return circles;
}

}  // namespace cabinet_articulation::core

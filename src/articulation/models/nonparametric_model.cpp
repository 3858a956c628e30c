// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/nonparametric_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "articulation/fitting/initial_arc.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kCurvePoses = 33;

constexpr double kShortestWay = 1e-6;  ///< [m] ours: fits begin at thousands of it

/// Places along a line or a circle to start from.
std::vector<double> placesAlong(PathShape shape, const PoseSamples& samples, const ArticulationConfig& config) {
  const Arc arc = consensusArc(samples, shape, config);
  std::vector<double> q;
  for (const Eigen::Vector3d& p : samples.positions) q.push_back(arc.arcLength(p));
  return q;
}

bool isCheaper(const CurveFit& a, const CurveFit& b) { return a.cost < b.cost; }

}  // namespace

bool NonparametricModel::hasWay(const LearnedModel& model) {
  return model.curve.size() >= PoseCurve::kLeastKnots && model.q_max - model.q_min >= kShortestWay;
}

bool NonparametricModel::fit(const PoseSequence& track, const WorkBudget& budget) {
  if (track.size() < kLeastPoses) return false;
  const PoseSamples samples(track);
  budget.isUnlimited() ? fitAll(samples) : fitOne(samples);
  take(*std::min_element(fits_.begin(), fits_.end(), isCheaper), track);
  return true;
}

void NonparametricModel::fitAll(const PoseSamples& samples) {
  fits_.clear();
  for (const PathShape shape : {PathShape::kLine, PathShape::kCircle})
    fits_.push_back(fitCurve(samples, placesAlong(shape, samples, config_), config_));
}

/// A round of one of the two fits, each of which costs as much as there is time for.
void NonparametricModel::fitOne(const PoseSamples& samples) {
  if (fits_.size() < 2) {
    const PathShape shape = fits_.empty() ? PathShape::kLine : PathShape::kCircle;
    fits_.push_back(fitCurve(samples, placesAlong(shape, samples, config_), config_, 1));
    return;
  }
  // The worse one only now and then.
  const auto best = std::min_element(fits_.begin(), fits_.end(), isCheaper);
  CurveFit& next = ++refits_ % 4 == 0 ? fits_[best == fits_.begin()] : *best;
  next = continueCurve(samples, std::move(next), config_);
}

void NonparametricModel::take(const CurveFit& fit, const PoseSequence& track) {
  position_scale_ = fit.position_scale;
  orientation_scale_ = fit.orientation_scale;
  metres_per_radian_ =
      track.has_orientation ? position_scale_ / std::max(orientation_scale_, config_.sigma_orientation_floor) : 0;
  freedom_ = fit.freedom;
  samples_ = track.size();
  double first = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < track.size() && std::isnan(first); ++i) {
    const double q = fit.curve.nearest(track.poses[i], metres_per_radian_);
    if ((fit.curve.pose(q).translation() - track.poses[i].translation()).norm() <= outlierDistance(track, config_)) first = q;
  }
  if (std::isnan(first)) first = fit.curve.nearest(track.poses.front(), metres_per_radian_);
  const auto knots = static_cast<std::size_t>(fit.covariance.rows());
  const double step = (fit.curve.last() - fit.curve.first()) / static_cast<double>(knots - 1);
  const PoseCurve::Weights w = PoseCurve::weights(knots, fit.curve.first(), step, first);
  variance_ = w.value.dot(fit.covariance.block<4, 4>(w.first, w.first) * w.value);
  curve_ = fit.curve.reparametrised(first, first - fit.curve.first() > fit.curve.last() - first);
}

int NonparametricModel::complexity(bool with_orientation) const {
  return static_cast<int>(std::lround((with_orientation ? 6 : 3) * freedom_));
}

JointGeometry NonparametricModel::geometry() const {
  JointGeometry geometry;
  const Eigen::Vector3d way = curve_.pose(curve_.last()).translation() - curve_.pose(curve_.first()).translation();
  if (way.norm() > 1e-9) geometry.axis = way.normalized();
  return geometry;
}

std::vector<Eigen::Isometry3d> NonparametricModel::curve(double q_min, double q_max) const {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < kCurvePoses; ++i) poses.push_back(predict(q_min + (q_max - q_min) * i / (kCurvePoses - 1)));
  return poses;
}

Matrix6d NonparametricModel::covariance(const PoseSequence&, const Eigen::Vector3d& p, double correlation) const {
  const double inflation = covarianceInflation(correlation) * variance_;
  return pointCovariance(inflation * position_scale_ * position_scale_, inflation * orientation_scale_ * orientation_scale_,
                         p - predict(0).translation());
}

std::vector<ModelParam> NonparametricModel::parameters() const {
  std::vector<ModelParam> params;
  appendParam("rigid_position", Eigen::Vector3d(predict(0).translation()), &params);
  appendParam("prismatic_dir", geometry().axis, &params);
  params.push_back({"training_samples", static_cast<double>(samples_), ModelParam::kParam});
  return params;
}

Eigen::Isometry3d NonparametricModel::predictLearned(const LearnedModel& model, double q) {
  if (!hasWay(model)) return model.origin;
  return PoseCurve(model.curve, model.q_min, model.q_max).pose(q);
}

double NonparametricModel::configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front) {
  if (!hasWay(model)) return 0;
  return PoseCurve(model.curve, model.q_min, model.q_max).nearest(front, kMetresPerRadian);
}

Matrix6d NonparametricModel::jacobianOfLearned(const LearnedModel&, double) { return Matrix6d::Identity(); }

LearnedModel NonparametricModel::example() {
  constexpr double kTurn = 1;     // [rad]
  constexpr double kSlide = 0.1;  // [m] of the edge that a door would turn about
  LearnedModel folding_door = closedExample(JointType::kNonparametric);
  const Eigen::Translation3d to_edge(-folding_door.width / 2, 0, 0);
  for (int i = 0; i < kCurvePoses; ++i) {
    const double share = static_cast<double>(i) / (kCurvePoses - 1);
    const Eigen::Translation3d slid(kSlide * share, 0, 0);
    const Eigen::AngleAxisd turned(-kTurn * share, Eigen::Vector3d::UnitY());
    folding_door.curve.push_back(folding_door.origin * slid * to_edge * turned * to_edge.inverse());
    if (i > 0) folding_door.q_max += (folding_door.curve[i].translation() - folding_door.curve[i - 1].translation()).norm();
  }
  return folding_door;
}

}  // namespace cabinet_articulation::core

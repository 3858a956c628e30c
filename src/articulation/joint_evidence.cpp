// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/joint_evidence.h"

#include <algorithm>

namespace cabinet_articulation::core {
namespace {

/// [nats] One in a thousand rectangles opens. Measured in a room at rest: up to 3.8; fronts pass 7 within some 8 cm.
constexpr double kPriorOdds = 6.9;

/// A few false detections in a row do not outweigh a joint that came from more poses, however short its way.
constexpr std::size_t kRow = 5;

constexpr double kOffPath = 3;  ///< standard deviations, as for the outliers of a fit

bool fits(const ModelResiduals& residuals, std::size_t i) {
  return std::max(residuals.displaced[i], residuals.turned[i]) <= kOffPath;
}

}  // namespace

void JointEvidence::remember(const LearnedModel& joint) {
  *this = JointEvidence(config_);
  weighed_until_ = joint.stamp;
  given_up_ = joint.doubt >= 1;
  if (given_up_) return;
  support_ = std::max(1.0, joint.support);
  contrary_ = std::max(0.0, joint.doubt) * support_;
}

void JointEvidence::consider(const ArticulationModel& joint, const PoseTrack& poses, double log_odds) {
  if (!isEstablished() && log_odds < kPriorOdds) return;
  *this = JointEvidence(config_);
  const ModelResiduals residuals = joint.residuals(poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (fits(residuals, i)) count(joint.predict(residuals.q[i]), poses);
  support_ = std::max(support_, static_cast<double>(std::min(kRow, poses.size())));
  weighed_until_ = poses.stamps.back();
}

bool JointEvidence::weigh(const ArticulationModel& known, const ArticulationModel* refined, const PoseTrack& poses) {
  const ModelResiduals by_known = known.residuals(poses);
  const ModelResiduals by_refined = refined ? refined->residuals(poses) : ModelResiduals();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    weighed_until_ = poses.stamps[i];
    const bool on_refined = refined && fits(by_refined, i);
    if (on_refined || fits(by_known, i)) {
      contrary_ = std::max(0.0, contrary_ - 1);
      count(on_refined ? refined->predict(by_refined.q[i]) : known.predict(by_known.q[i]), poses);
      continue;
    }
    if (contrary_ == 0) contradicted_since_ = poses.stamps[i];
    if (++contrary_ < support_) continue;
    support_ = 0;
    given_up_ = true;
    return false;
  }
  return true;
}

bool JointEvidence::isOnPath(const ArticulationModel& joint, const PoseTrack& poses) {
  const ModelResiduals residuals = joint.residuals(poses);
  std::size_t on_path = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) on_path += fits(residuals, i);
  return 2 * on_path >= poses.size();
}

void JointEvidence::count(const Eigen::Isometry3d& place, const PoseTrack& poses) {
  const auto moved = [&](const Eigen::Vector3d& point) {
    return (place * point - *counted_ * point).norm() >= config_.sigma_position;
  };
  if (counted_ && std::none_of(poses.outline.begin(), poses.outline.end(), moved)) return;
  counted_ = place;
  ++support_;
}

}  // namespace cabinet_articulation::core

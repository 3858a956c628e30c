// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/joint_evidence.h"

#include <algorithm>
#include <cmath>

#include "geometry/turn_between.h"

namespace cabinet_articulation::core {
namespace {

/// A few false detections do not outweigh a joint, however short its way (ours).
constexpr double kFewest = 5;

/// An observation off the path counts twice: false detections are fewer than those that happen to be on a wrong path (ours).
constexpr double kContraryWeight = 2;

/// Places that are told apart (ours): ways are shorter than 2 m, as doors are narrower than radius_max.
constexpr std::size_t kMostPlaces = 200;

/// The first point of an outline is the observed one, which may change; the others are the front's corners.
std::vector<Eigen::Vector3d> placeOf(const Eigen::Isometry3d& pose, const PoseSequence& poses) {
  std::vector<Eigen::Vector3d> place;
  for (std::size_t k = poses.outline.size() > 1 ? 1 : 0; k < poses.outline.size(); ++k) place.push_back(pose * poses.outline[k]);
  return place;
}

bool fits(const ModelResiduals& residuals, std::size_t i) {
  return std::max(residuals.displaced[i], residuals.turned[i]) <= kOutlierSigmas;
}

}  // namespace

double JointEvidence::enough() const { return std::max(kFewest, support_ / kContraryWeight); }

double JointEvidence::doubt() const { return given_up_ ? 1 : isEstablished() ? contrary_ / enough() : 0; }

void JointEvidence::remember(const LearnedModel& joint) {
  *this = JointEvidence(config_);
  weighed_until_ = joint.stamp;
  given_up_ = joint.doubt >= 1;
  if (given_up_) return;
  support_ = std::max(1.0, joint.support);
  contrary_ = std::max(0.0, joint.doubt) * enough();
}

void JointEvidence::consider(const ArticulationModel& joint, const PoseSequence& poses, double log_odds) {
  if (!isEstablished() && log_odds < std::log(config_.prior.rest_odds)) return;
  *this = JointEvidence(config_);
  const ModelResiduals residuals = joint.residuals(poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (fits(residuals, i)) support(placeOf(joint.predict(residuals.q[i]), poses));
  support_ = std::max(1.0, support_);
  weighed_until_ = poses.stamps.back();
}

bool JointEvidence::weigh(const ArticulationModel& known, const ArticulationModel* refined, const PoseSequence& poses) {
  const ModelResiduals by_known = known.residuals(poses);
  const ModelResiduals by_refined = refined ? refined->residuals(poses) : ModelResiduals();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    weighed_until_ = poses.stamps[i];
    const bool on_refined = refined && fits(by_refined, i);
    if (on_refined || fits(by_known, i)) {
      contrary_ = std::max(0.0, contrary_ - 1);
      if (contrary_ == 0) contradicting_.clear();
      if (!contradicting_.empty()) contradicting_.pop_back();
      support(placeOf(on_refined ? refined->predict(by_refined.q[i]) : known.predict(by_known.q[i]), poses));
      continue;
    }
    const Place place = placeOf(poses.poses[i], poses);
    if (!isNew(place, contradicting_)) continue;
    if (contradicting_.empty()) contradicted_since_ = poses.stamps[i];
    contradicting_.push_back(place);
    if (++contrary_ < enough()) continue;
    support_ = 0;
    given_up_ = true;
    return false;
  }
  return true;
}

bool JointEvidence::isOnPath(const ArticulationModel& joint, const PoseSequence& poses) {
  const ModelResiduals residuals = joint.residuals(poses);
  std::size_t on_path = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) on_path += fits(residuals, i);
  return 2 * on_path >= poses.size();
}

bool JointEvidence::isRefinement(const ArticulationModel& known, double q_min, double q_max,
                                 const ArticulationModel& refined) const {
  for (const double q : {q_min, (q_min + q_max) / 2, q_max}) {
    const Eigen::Isometry3d seen = known.predict(q), now = refined.predict(refined.configuration(seen));
    if ((seen.translation() - now.translation()).norm() > kOutlierSigmas * config_.sigma_position) return false;
    if (turnBetween(seen, now) > kOutlierSigmas * config_.sigma_orientation) return false;
  }
  return true;
}

bool JointEvidence::isNew(const Place& place, const std::vector<Place>& places) const {
  const auto is_here = [&](const Place& other) {
    for (std::size_t k = 0; k < std::min(place.size(), other.size()); ++k)
      if ((place[k] - other[k]).norm() >= config_.sigma_position) return false;
    return true;
  };
  return places.size() < kMostPlaces && std::none_of(places.rbegin(), places.rend(), is_here);
}

void JointEvidence::support(const Place& place) {
  if (!isNew(place, supporting_)) return;
  supporting_.push_back(place);
  support_ = std::max(support_, static_cast<double>(supporting_.size()));
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "articulation/decision/joint_evidence.h"
#include "articulation/decision/joint_type_comparison.h"
#include "articulation/decision/model_selection.h"
#include "articulation/decision/motion_detection.h"
#include "articulation/fitting/reference_point_search.h"
#include "articulation/fitting/work_schedule.h"
#include "articulation/models/known_joint.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Learns one track. Keeps its models, so that an update after a few more observations starts from the last fits. It takes a
/// bounded time: what needs more, as the search for other optima, is spread over the updates that follow. Models of a track whose
/// history was placed anew are fitted as if it had never been seen. A joint that was found once stays until observations
/// contradict it (JointEvidence); then the front is learned anew from those.
class FrontLearner {
 public:
  explicit FrontLearner(const ArticulationConfig& config);

  /// Fits all candidates to the track as it is now. False if it has no usable observation; everything stays as it was.
  bool update(const Track& track);

  /// A joint of this front that was learned in an earlier run.
  void remember(const LearnedModel& joint);

  /// Whether a joint is known that has not been given up.
  bool knowsJoint() const { return evidence_.isEstablished(); }

  /// The selected model; valid after an update that succeeded.
  const LearnedModel& best() const { return learned_; }

  /// All candidates, the best first.
  std::vector<LearnedModel> candidates() const;

 private:
  void learn(const Track& track);
  void learnAnew(const Track& track);
  bool foundJoint() const;
  KnownJoint knownJoint() const;
  bool noteDoubt();
  void consider(const ArticulationModel& joint);
  bool findOtherJoint(const Track& track);
  void weighWhatIsLeftOut();
  bool weighEvidence();
  PoseSequence posesSince(double stamp) const;
  LearnedModel describe(const Candidate& candidate) const;
  LearnedModel describeKnownJoint() const;
  void startAnew();
  void chooseReference(const Track& track);
  void fitModels(const PoseSequence& track, bool parametric);
  void compareMotions(const MotionDetector* detector);

  ArticulationConfig config_;
  ObservationHistory observations_;
  std::vector<std::unique_ptr<ArticulationModel>> models_;
  ReferencePoint reference_;
  std::optional<ReferencePointSearch> reference_search_;
  std::size_t reference_chosen_at_ = 0;  ///< observations when the reference point was chosen last
  Track front_;                          ///< id and size of the track
  PoseSequence poses_;                   ///< of the reference point, in runs
  PoseSequence spaced_;                  ///< of the reference point, evenly spaced
  bool reference_moved_ = false;         ///< in this update
  JointTypeComparison comparison_;
  WorkSchedule schedule_;  ///< of this update
  std::vector<Candidate> candidates_;
  Selection selection_;
  JointEvidence evidence_;
  bool placed_anew_ = false;           ///< all observations of this update are new
  bool distrusts_past_ = false;        ///< the observations that are there at first led to a joint that was given up
  bool doubted_ = false;               ///< the joint was compared again since poses began to contradict it
  std::optional<LearnedModel> joint_;  ///< as it was found last
  LearnedModel learned_;
};

}  // namespace cabinet_articulation::core

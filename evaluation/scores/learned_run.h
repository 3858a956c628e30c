// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "scores/prediction_error.h"
#include "sources/frame_source.h"
#include "sources/track_source.h"

namespace cabinet_articulation::core::evaluation {

/// A joint, as the true poses of its front tell.
struct TrueJoint {
  std::string name;
  JointType type = JointType::kRigid;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();        ///< unit
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();  ///< rotational
  std::vector<ReferencePose> poses;                      ///< one for every frame, in the world
};

/// The joints of the fronts that opened by more than 3 cm.
std::vector<TrueJoint> findJoints(const std::vector<Frame>& frames);

/// How the front moves on which the model's front lies at its stamp. Rigid: that front did not open, or none is there. `all` has
/// what was known at that stamp; throws ModelError if what the model hangs on is not among that (hangsOnKnown()).
JointType trueType(const LearnedModel& model, const std::vector<LearnedModel>& all, const std::vector<Frame>& frames);

/// What was learned about one joint: the model that predicts its front best, of those that moved.
struct LearnedJoint {
  LearnedModel model;
  std::optional<double> right_from;  ///< [m] opening from which on the type was right for good
  double axis_angle = 0;             ///< [rad]
  double axis_distance = 0;          ///< [m] rotational
  PredictionError prediction;        ///< over the whole run
};

/// The models of one run, frame by frame.
class LearnedRun {
 public:
  void add(const std::vector<LearnedModel>& models);

  /// Nothing if no model, with its parents where they were in the end, passes within 5 cm of the front in the mean.
  std::optional<LearnedJoint> find(const TrueJoint& joint) const;

  /// Objects that are called moving in the end.
  int movers() const;

 private:
  std::vector<LearnedModel> last_;
  std::vector<std::map<std::uint32_t, JointType>> types_;  ///< of what moves and is explained, for every frame
};

}  // namespace cabinet_articulation::core::evaluation

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/SceneTruth.h>

#include <map>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/geometry/rectangle.h"

namespace cabinet_articulation {

constexpr double kFoundWithin = 0.05;  ///< [m] farther off, a model describes something else

const char* typeName(int type);

/// [m] from a true front's centre to where the model predicts it, in the description of the rectangle that fits best.
double distanceToModel(const core::LearnedModel& model, const core::Rectangle& front);

/// What a learned model must reach to be called right.
struct TruthLimits {
  double probability = 0.95;
  double axis_degrees = 2;
  double axis_millimetres = 15;        ///< distance of the hinge axes, doors only
  double prediction_millimetres = 10;  ///< front's centre, at every opening of the script
};

/// One true joint beside the learned model nearest to it.
struct JointComparison {
  std::string name;
  int true_type = 0;
  double true_range = 0;  ///< [m or rad] travelled in the script
  bool found = false;     ///< some model passes within 5 cm of the true front in the mean
  ArticulationModel model;
  double probability = 0;
  double axis_degrees = 0;
  double axis_millimetres = 0;  ///< 0 for drawers
  double prediction_mean = 0;   ///< [mm]
  double prediction_max = 0;    ///< [mm]
  bool right = false;
};

struct SceneComparison {
  std::vector<JointComparison> joints;  ///< every joint that moved, in the order of the scene
  int false_movers = 0;                 ///< objects called moving that are none of them
  bool right() const;
};

/// Collects the truth of a run and compares models with it. Truth and models must be in the same frame.
class TruthComparison {
 public:
  void add(const SceneTruth& truth);
  SceneComparison compare(const std::vector<ArticulationModel>& models, const TruthLimits& limits) const;

 private:
  struct History {
    JointTruth last;
    double q_min = 0, q_max = 0;
    std::vector<core::Rectangle> fronts;
  };
  /// A learned model, and in each frame the frame that it is described in.
  struct Placed {
    core::LearnedModel model;
    std::vector<Eigen::Isometry3d> frames;  ///< empty: those of the truth
  };
  Placed placeModel(const ArticulationModel& model, const std::vector<ArticulationModel>& all) const;
  JointComparison compareJoint(const History& truth, const ArticulationModel& model, const Placed& learned) const;

  std::vector<std::string> order_;
  std::map<std::string, History> histories_;
};

/// A table for people: each learned object beside the truth.
std::string format(const SceneComparison& comparison);

}  // namespace cabinet_articulation

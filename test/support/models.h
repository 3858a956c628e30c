// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "cabinet_articulation/articulation/articulation_learner.h"

namespace cabinet_articulation {
namespace test {

/// A pose at (x, y, z) whose z axis looks back along the z axis of its frame: a front that faces a camera.
inline Eigen::Isometry3d facingCamera(double x, double y, double z) {
  return Eigen::Translation3d(x, y, z) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
}

/// A front that has not moved yet, in an optical frame.
inline core::LearnedModel restingModel() {
  core::LearnedModel model;
  model.id = 1;
  model.origin = facingCamera(-0.3, 0.2, 1.4);
  model.width = 0.4;
  model.height = 0.2;
  model.probabilities = {1, 0, 0, 0};
  return model;
}

/// A door that is half a radian open; its hinge is vertical (y is down), at its left edge.
inline core::LearnedModel doorModel() {
  core::LearnedModel model;
  model.id = 3;
  model.type = core::JointType::kRotational;
  model.moved = true;
  model.support = 20;
  model.observations = 60;
  model.probabilities = {0.01, 0.02, 0.97, 0};
  model.origin = facingCamera(0.1, 0, 1.2);
  model.axis = Eigen::Vector3d::UnitY();
  model.axis_point = Eigen::Vector3d(-0.1, 0, 1.2);
  model.radius = 0.2;
  model.q = 0.5;
  model.q_max = 1.2;
  model.width = 0.4;
  model.height = 0.6;
  return model;
}

/// A drawer that came out 20 cm towards the camera.
inline core::LearnedModel drawerModel() {
  core::LearnedModel model;
  model.id = 4;
  model.type = core::JointType::kPrismatic;
  model.moved = true;
  model.support = 20;
  model.observations = 60;
  model.probabilities = {0, 0.99, 0.01, 0};
  model.origin = facingCamera(0.1, 0.3, 1.3);
  model.axis = -Eigen::Vector3d::UnitZ();
  model.q = 0.2;
  model.q_max = 0.3;
  model.width = 0.4;
  model.height = 0.15;
  return model;
}

/// The second leaf of a folding door, hinged to the far edge of doorModel(), in whose front's frame it is described.
inline core::LearnedModel leafModel() {
  core::LearnedModel model = doorModel();
  model.id = 7;
  model.parent = 3;
  model.origin = Eigen::Translation3d(0.4, 0, 0);
  model.axis_point = Eigen::Vector3d(0.2, 0, 0);
  return model;
}

/// A garage door's front, half way up: it slides and turns.
inline core::LearnedModel garageModel() {
  core::LearnedModel model;
  model.id = 6;
  model.type = core::JointType::kNonparametric;
  model.moved = true;
  model.support = 20;
  model.observations = 60;
  model.probabilities = {0, 0, 0.02, 0.98};
  model.width = 0.8;
  model.height = 0.5;
  model.q = 0.2;
  model.q_max = 0.4;
  constexpr int kSteps = 8;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = M_PI / 2 * i / kSteps, radius = model.q_max / (M_PI / 2);
    model.curve.push_back(facingCamera(0, radius * std::cos(angle), 1.5 + radius * std::sin(angle)) *
                          Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitX()));
  }
  model.origin = model.curve.front();
  model.axis = (model.curve.back().translation() - model.curve.front().translation()).normalized();
  return model;
}

/// Something that moved in a way no model describes.
inline core::LearnedModel unexplainedModel() {
  core::LearnedModel model = restingModel();
  model.id = 5;
  model.moved = true;
  model.support = 20;
  model.explained = false;
  return model;
}

}  // namespace test
}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/joints/known_fronts.h"
#include "support/models.h"

namespace cabinet_articulation {
namespace test {

/// A front with a history from q_min to q_max that ends at `stamp` [s], and a covariance without zeros.
inline core::KnownFront learned(core::LearnedModel model, int observations = 20, double stamp = 1795323255.25) {
  model.stamp = stamp;
  model.position_error = 0.0012345;
  model.orientation_error = 0.02;
  model.observations = observations;
  model.pitch = 0.0125;
  model.q_min_is_end = true;
  model.q_max_is_end = false;
  model.probabilities = {0.01, 0.02, 0.94, 0.03, 0};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) model.covariance(i, j) = 1e-5 / (1 + i + j);
  model.params = {{"sigma_position", 0.01, core::ModelParam::kPrior}, {"q_min[0]", model.q_min, core::ModelParam::kEval}};
  core::KnownFront front{model, {}};
  front.track.id = model.id;
  front.track.width = model.width;
  front.track.height = model.height;
  for (int i = 0; i < observations; ++i) {
    core::TrackedObservation observation;
    observation.stamp = model.stamp - 0.1 * (observations - 1 - i);
    observation.rectangle = {model.predict(model.q_max * i / (observations - 1)), model.width, model.height + 0.001 * i};
    observation.covariance = model.covariance;
    observation.edge_support = {1, 0.5F, 0.25F, 0};
    front.track.observations.push_back(observation);
  }
  return front;
}

/// The same model elsewhere.
inline core::LearnedModel moved(core::LearnedModel model, const Eigen::Vector3d& by) {
  model.origin.pretranslate(by);
  model.axis_point += by;
  for (Eigen::Isometry3d& pose : model.curve) pose.pretranslate(by);
  return model;
}

inline void setId(std::uint32_t id, core::KnownFront* front) { front->model.id = front->track.id = id; }

}  // namespace test
}  // namespace cabinet_articulation

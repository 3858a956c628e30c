// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"

namespace cabinet_articulation::core::evaluation {

/**
 * The prior of the original release, by its formulas: tracks begin at the identity, so that those of like joints can share a
 * model. A new track has a model of its own, or is merged into a stored one, whose poses it joins; the least sum of BIC over all
 * models decides. Likelihoods are its own, without the penalty for free configurations: Gaussian, with outliers at 1.96 standard
 * deviations. Parameters are fitted by this package, in place of its random sampling.
 */
class MergedModels {
 public:
  /// All tracks are given with the same settings.
  explicit MergedModels(const ArticulationConfig& config) : config_(config) {}

  void store(const Track& track);

  /// The model that the track would have, prismatic or rotational, in the track's frame.
  LearnedModel modelOf(const Track& track) const;

 private:
  struct Model {
    std::vector<TrackedObservation> poses;  ///< as seen from the first of their track
    LearnedModel joint;
    double bic = 0;
  };
  struct Choice {
    std::size_t index = 0;  ///< of a stored model; their number: a new one
    Model model;
  };

  Model fitted(std::vector<TrackedObservation> poses) const;
  Choice choose(const Track& track) const;

  ArticulationConfig config_;
  std::vector<Model> models_;
};

}  // namespace cabinet_articulation::core::evaluation

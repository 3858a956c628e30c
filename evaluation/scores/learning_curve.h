// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "scores/prediction_error.h"
#include "sources/track_source.h"

namespace cabinet_articulation::core::evaluation {

/// Settings for a source: positions alone count where it has no orientations.
ArticulationConfig learnerConfig(const SourceFacts& facts);

/// rigid, prismatic, rotational, or other if no model explains the motion.
std::string selectedName(const LearnedModel& model);

/// True if the selected answer is the source's true one.
bool isRight(const LearnedModel& model, const SourceFacts& truth);

/// At most this many of the source's reference poses, evenly spaced.
std::vector<ReferencePose> thinnedReference(const TrackSource& source, std::size_t count);

/// A front after all of the picked frames. The model is the pipeline's, as a robot would have it; of a log of poses, that of one
/// fit to all of them.
struct LearnedFront {
  Track track;
  std::optional<LearnedModel> model;  ///< nothing if the front was not seen
};

LearnedFront observeAll(const TrackSource& source, const std::vector<int>& picked);

/// What had been learned in one run after a number of observations.
struct CurvePoint {
  int run = 0, observations = 0;
  LearnedModel model;
  PredictionError error;  ///< over the whole motion, seen or not
};

/// The paper's protocol (IV-B): `runs` ordered random sub-samples of at most `frames` frames (80 % of a shorter source); the
/// model after each of the numbers of observations in `counts`.
std::vector<CurvePoint> learningCurve(const TrackSource& source, int runs, int frames, const std::vector<int>& counts);

/// The frames before the front had opened by a share of its range for the first time, and the farthest tenth of the opening.
struct OpeningSplit {
  std::vector<int> seen;
  std::vector<ReferencePose> far_end;
};

OpeningSplit splitOpening(const TrackSource& source, double share);

/// Trained on what came before the front had opened by `share` of its range for the first time.
struct UnseenOpening {
  double share = 0;
  std::optional<LearnedModel> selected;                            ///< nothing if the front was not seen until then
  std::optional<PredictionError> selected_error, true_type_error;  ///< over the farthest tenth of the opening
};

UnseenOpening predictUnseen(const TrackSource& source, double share);

}  // namespace cabinet_articulation::core::evaluation

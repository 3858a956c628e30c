// SPDX-License-Identifier: BSD-3-Clause
#include "scores/learning_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>

#include "articulation/models/model_registry.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr std::size_t kReferences = 100;

/// `count` of 0 .. size - 1, ascending.
std::vector<int> randomSelection(int size, int count, cv::RNG* random) {
  std::vector<int> all(size);
  std::iota(all.begin(), all.end(), 0);
  for (int i = 0; i < count; ++i) std::swap(all[i], all[random->uniform(i, size)]);
  all.resize(count);
  std::sort(all.begin(), all.end());
  return all;
}

/// By the pipeline that saw the front, or else by `learner`; nothing as long as nobody learned anything.
std::optional<LearnedModel> learnedOf(const SeenFront& front, ArticulationLearner* learner) {
  if (front.model) return *front.model;
  const std::vector<LearnedModel> models = learner->process({front.track});
  return models.empty() ? std::nullopt : std::optional<LearnedModel>(models[0]);
}

}  // namespace

ArticulationConfig learnerConfig(const SourceFacts& facts) {
  ArticulationConfig config;
  config.use_orientation = facts.has_orientation;
  return config;
}

std::string selectedName(const LearnedModel& model) { return model.explained ? modelName(model.type) : "other"; }

bool isRight(const LearnedModel& model, const SourceFacts& truth) {
  if (truth.explainable) return model.explained && model.type == truth.type;
  return !model.explained || !modelEntry(model.type).is_parametric;
}

std::vector<ReferencePose> thinnedReference(const TrackSource& source, std::size_t count) {
  const std::vector<ReferencePose>& all = source.reference();
  if (all.size() <= count) return all;
  std::vector<ReferencePose> thinned;
  for (std::size_t i = 0; i < count; ++i) thinned.push_back(all[i * (all.size() - 1) / (count - 1)]);
  return thinned;
}

LearnedFront observeAll(const TrackSource& source, const std::vector<int>& picked) {
  LearnedFront result;
  source.observe(picked, [&](const SeenFront& front) {
    result.track = front.track;
    result.model = front.model ? std::optional<LearnedModel>(*front.model) : std::nullopt;
  });
  ArticulationLearner learner(learnerConfig(source.facts()));
  if (!result.model) result.model = learnedOf({result.track}, &learner);
  return result;
}

std::vector<CurvePoint> learningCurve(const TrackSource& source, int runs, int frames, const std::vector<int>& counts) {
  const std::vector<ReferencePose> reference = thinnedReference(source, kReferences);
  const int size = static_cast<int>(source.reference().size());
  const int picked = std::min(frames, static_cast<int>(std::ceil(0.8 * size)));
  std::vector<CurvePoint> points;
  for (int run = 0; run < runs; ++run) {
    cv::RNG random(run + 1);
    ArticulationLearner learner(learnerConfig(source.facts()));
    source.observe(randomSelection(size, picked, &random), [&](const SeenFront& front) {
      const int count = static_cast<int>(front.track.observations.size());
      if (std::find(counts.begin(), counts.end(), count) == counts.end()) return;
      if (const auto model = learnedOf(front, &learner))
        points.push_back({run, count, *model, predictionError(*model, reference, source.facts().has_orientation)});
    });
  }
  return points;
}

OpeningSplit splitOpening(const TrackSource& source, double share) {
  constexpr double kFarEnd = 0.9;
  double farthest = 0;
  for (const ReferencePose& pose : source.reference()) farthest = std::max(farthest, pose.opened);
  OpeningSplit split;
  for (std::size_t i = 0; i < source.reference().size(); ++i) {
    const ReferencePose& pose = source.reference()[i];
    if (pose.opened >= kFarEnd * farthest) split.far_end.push_back(pose);
    if (split.seen.size() == i && pose.opened <= share * farthest) split.seen.push_back(static_cast<int>(i));
  }
  return split;
}

UnseenOpening predictUnseen(const TrackSource& source, double share) {
  const auto [seen, far_end] = splitOpening(source, share);
  UnseenOpening result;
  result.share = share;
  const ArticulationConfig config = learnerConfig(source.facts());
  const LearnedFront front = observeAll(source, seen);
  if (!front.model) return result;
  result.selected = front.model;
  result.selected_error = predictionError(*front.model, far_end, source.facts().has_orientation);
  for (const LearnedModel& model : fitAllModels(front.track, config))
    if (model.type == source.facts().type)
      result.true_type_error = predictionError(model, far_end, source.facts().has_orientation);
  return result;
}

}  // namespace cabinet_articulation::core::evaluation

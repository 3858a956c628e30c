// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/arc_fit.h"

#include "articulation/fitting/arc_fit_iteration.h"

namespace cabinet_articulation::core {
namespace {

template <bool kWithOrientation>
ArcFit fitted(const PoseSamples& samples, PathShape shape, const ArcFit& start, const FitEffort& effort,
              const ArticulationConfig& config) {
  IndependentNoise noise(config, start.position_scale, start.orientation_scale);
  const auto result = ArcFitIteration<kWithOrientation>(samples, config).fit(start.arc, shape, &noise, effort);
  return {result.arc, noise.noise().position, noise.noise().orientation, result.cost};
}

template <bool kWithOrientation>
double costOf(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  using Problem = ArcProblem<kWithOrientation>;
  IndependentNoise noise(config);
  const Problem problem(samples, noise.noise(), arc, Curvature::kFixed);
  return noise.template estimate<Problem>(problem.rawResiduals()) + problem.hingeCost();
}

template <bool kWithOrientation>
SequenceFit fittedSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const SequenceFit& start,
                           const FitEffort& effort, const ArticulationConfig& config) {
  SequenceNoise noise(samples, start.noise, fit.position_scale, fit.orientation_scale);
  const auto result = ArcFitIteration<kWithOrientation>(samples, config).fit(start.arc, shape, &noise, effort);
  const bool settled = effort.steps > 0 ? result.settled || !effort.continues : start.settled;
  return {result.arc, -result.cost, noise.noise(), settled};
}

template <bool kWithOrientation>
Eigen::MatrixXd covarianceOf(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  const Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
  const Eigen::MatrixXd information = ArcFitIteration<kWithOrientation>(samples, config).information(fit, curvature);
  // A line does not know its own frame's rotation about itself: the pseudo-inverse gives such directions no variance.
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace

double arcCost(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  return samples.has_orientation ? costOf<true>(samples, arc, config) : costOf<false>(samples, arc, config);
}

ArcFit fitArc(const PoseSamples& samples, PathShape shape, const ArcFit& start, const FitEffort& effort,
              const ArticulationConfig& config) {
  return samples.has_orientation ? fitted<true>(samples, shape, start, effort, config)
                                 : fitted<false>(samples, shape, start, effort, config);
}

Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  return samples.has_orientation ? covarianceOf<true>(samples, shape, fit, config)
                                 : covarianceOf<false>(samples, shape, fit, config);
}

SequenceFit sequenceStart(const PoseSamples& samples, const ArcFit& fit, const Arc& start, const ArticulationConfig& config) {
  const SequenceNoise noise(samples, config, fit.position_scale, fit.orientation_scale);
  return {start, -std::numeric_limits<double>::infinity(), noise.noise(), false};
}

SequenceFit fitArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const SequenceFit& start,
                           const FitEffort& effort, const ArticulationConfig& config) {
  return samples.has_orientation ? fittedSequence<true>(samples, shape, fit, start, effort, config)
                                 : fittedSequence<false>(samples, shape, fit, start, effort, config);
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/arc_fit.h"

#include "articulation/fitting/arc_fitter.h"

namespace cabinet_articulation::core {
namespace {

template <bool kWithOrientation>
ArcFit fitFrom(const PoseSamples& samples, PathShape shape, const Arc& start, double tolerance,
               const ArticulationConfig& config) {
  IndependentNoise noise(config);
  const auto result = ArcFitter<kWithOrientation>(samples, config).refine(start, shape, &noise, std::nullopt, tolerance);
  return {result.arc, noise.noise().position, noise.noise().orientation, result.cost};
}

template <bool kWithOrientation>
ArcFit continued(const PoseSamples& samples, PathShape shape, const ArcFit& last, int steps, const ArticulationConfig& config) {
  IndependentNoise noise(config, last.position_scale, last.orientation_scale);
  const auto result = ArcFitter<kWithOrientation>(samples, config).proceed(last.arc, shape, steps, &noise);
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
SequenceFit sequenceFrom(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const Arc& start,
                         std::optional<double> rival, const ArticulationConfig& config) {
  SequenceNoise noise(samples, config, fit.position_scale, fit.orientation_scale);
  if (rival) rival = -*rival;
  const auto result = ArcFitter<kWithOrientation>(samples, config).refine(start, shape, &noise, rival);
  return {result.arc, -result.cost, noise.noise()};
}

template <bool kWithOrientation>
SequenceFit sequenceContinued(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const SequenceFit& last, int steps,
                              const ArticulationConfig& config) {
  SequenceNoise noise(samples, last.noise, fit.position_scale, fit.orientation_scale);
  const auto result = ArcFitter<kWithOrientation>(samples, config).proceed(last.arc, shape, steps, &noise);
  return {result.arc, -result.cost, noise.noise(), steps > 0 ? result.settled : last.settled};
}

template <bool kWithOrientation>
Eigen::MatrixXd covarianceOf(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  const Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
  const Eigen::MatrixXd information = ArcFitter<kWithOrientation>(samples, config).information(fit, curvature);
  // A line does not know its own frame's rotation about itself: the pseudo-inverse gives such directions no variance.
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace

double arcCost(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  return samples.has_orientation ? costOf<true>(samples, arc, config) : costOf<false>(samples, arc, config);
}

ArcFit fitArc(const PoseSamples& samples, PathShape shape, const Arc& start, const ArticulationConfig& config, double tolerance) {
  return samples.has_orientation ? fitFrom<true>(samples, shape, start, tolerance, config)
                                 : fitFrom<false>(samples, shape, start, tolerance, config);
}

ArcFit continueArc(const PoseSamples& samples, PathShape shape, const ArcFit& last, int steps, const ArticulationConfig& config) {
  return samples.has_orientation ? continued<true>(samples, shape, last, steps, config)
                                 : continued<false>(samples, shape, last, steps, config);
}

Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  return samples.has_orientation ? covarianceOf<true>(samples, shape, fit, config)
                                 : covarianceOf<false>(samples, shape, fit, config);
}

SequenceFit fitArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const Arc& start,
                           std::optional<double> rival, const ArticulationConfig& config) {
  return samples.has_orientation ? sequenceFrom<true>(samples, shape, fit, start, rival, config)
                                 : sequenceFrom<false>(samples, shape, fit, start, rival, config);
}

SequenceFit sequenceStart(const PoseSamples& samples, const ArcFit& fit, const Arc& start, const ArticulationConfig& config) {
  const SequenceNoise noise(samples, config, fit.position_scale, fit.orientation_scale);
  return {start, -std::numeric_limits<double>::infinity(), noise.noise(), false};
}

SequenceFit continueArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const SequenceFit& last,
                                int steps, const ArticulationConfig& config) {
  return samples.has_orientation ? sequenceContinued<true>(samples, shape, fit, last, steps, config)
                                 : sequenceContinued<false>(samples, shape, fit, last, steps, config);
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/arc_fit.h"

#include <Eigen/QR>
#include <limits>
#include <type_traits>

#include "articulation/fitting/arc_fit_iteration.h"

namespace cabinet_articulation::core {
namespace {

/// Calls `f` with std::true_type where the poses have orientations, else with std::false_type.
template <class Function>
auto dispatch(const PoseSamples& samples, const Function& f) {
  return samples.has_orientation ? f(std::true_type()) : f(std::false_type());
}

}  // namespace

double arcCost(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  return dispatch(samples, [&](auto with_orientation) {
    IndependentNoise noise(config);
    return arcCost<with_orientation>(samples, arc, &noise);
  });
}

ArcFit fitArc(const PoseSamples& samples, PathShape shape, const ArcFit& start, const FitEffort& effort,
              const ArticulationConfig& config) {
  return dispatch(samples, [&](auto with_orientation) -> ArcFit {
    IndependentNoise noise(config, start.position_scale, start.orientation_scale);
    const auto result = ArcFitIteration<with_orientation>(samples, config).fit(start.arc, shape, &noise, effort);
    return {result.arc, noise.noise().position, noise.noise().orientation, result.cost};
  });
}

Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  const Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
  const Eigen::MatrixXd information = dispatch(samples, [&](auto with_orientation) {
    return ArcFitIteration<with_orientation>(samples, config).information(fit, curvature);
  });
  // A line does not know its own frame's rotation about itself: the pseudo-inverse gives such directions no variance.
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

SequenceFit sequenceStart(const PoseSamples& samples, const ArcFit& fit, const Arc& start, const ArticulationConfig& config) {
  const SequenceNoise noise(samples, config, fit.position_scale, fit.orientation_scale);
  return {start, -std::numeric_limits<double>::infinity(), noise.noise(), false};
}

SequenceFit fitArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const SequenceFit& start,
                           const FitEffort& effort, const ArticulationConfig& config) {
  return dispatch(samples, [&](auto with_orientation) -> SequenceFit {
    SequenceNoise noise(samples, start.noise, fit.position_scale, fit.orientation_scale);
    const auto result = ArcFitIteration<with_orientation>(samples, config).fit(start.arc, shape, &noise, effort);
    const bool settled = effort.steps > 0 ? result.settled || !effort.continues : start.settled;
    return {result.arc, -result.cost, noise.noise(), settled};
  });
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
// A log of poses -> how the front moved. One pose a line: x y z qx qy qz qw, in metres. Needs no ROS at run time.
#include <cstdio>
#include <fstream>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/evaluation.h"

namespace core = cabinet_articulation::core;

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: fit_log FILE\n"), 2;
  core::Track track;
  std::ifstream log(argv[1]);
  double x, y, z, qx, qy, qz, qw;
  while (log >> x >> y >> z >> qx >> qy >> qz >> qw) {
    core::TrackedObservation seen;
    seen.stamp = static_cast<double>(track.observations.size());
    seen.rectangle.pose = Eigen::Translation3d(x, y, z) * Eigen::Quaterniond(qw, qx, qy, qz).normalized();
    track.observations.push_back(seen);
  }

  const char* const names[] = {"rigid", "prismatic", "rotational", "nonparametric", "screw"};
  const std::vector<core::LearnedModel> models = core::fitAllModels(track, {});  // the best first
  for (const core::LearnedModel& model : models) {
    const auto type = static_cast<std::size_t>(model.type);
    const core::TrackEvaluation fit = core::evaluateOnTrack(model, track, {});
    std::printf("%-13s probability %.3f, log-likelihood %.1f, mean residual %.1f mm\n", names[type], model.probabilities[type],
                fit.log_likelihood, 1000 * fit.position_error);
  }
  if (models.empty()) return std::fprintf(stderr, "%s has no poses\n", argv[1]), 1;

  // Where the front will be if it opens a little farther than it was seen.
  const Eigen::Vector3d next = models.front().predict(models.front().q_max + 0.1).translation();
  std::printf("farther open by 0.1: %.3f %.3f %.3f\n", next.x(), next.y(), next.z());
  return 0;
}

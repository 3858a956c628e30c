// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "fuzz_target.h"
#include "model_uses.h"
#include "tools/input/pose_log.h"

using namespace cabinet_articulation;

namespace {

constexpr std::size_t kMostFitted = 100;  ///< poses; how long tracks take is another test's matter

std::string logOf(const core::Track& track) {
  std::ostringstream out;
  core::writePoseLog(track, out);
  return out.str();
}

core::PoseLog read(const std::string& text) {
  std::istringstream in(text);
  return core::readPoseLog(in, "log");
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  std::vector<std::string> logs = {"1 2 3\n1.1 2 3\n1.2 2 3.01\n1.3 2 3\n",
                                   "0 0.5 1 0 0 0 1\n0.1 0.5 1 0 0.1 0 0.995\n0.2 0.5 1 0 0.2 0 0.98\n"};
  for (const core::Track& track : tracksOf(exampleFronts())) logs.push_back(logOf(track));
  return {logs};
}

/// What fit_track does with a file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  return fuzz::examine<core::PoseLogError>([&text] {
    const core::PoseLog log = read(text);
    if (log.columns == 9 && read(logOf(log.track)).columns != 9) fuzz::detail::report("a log cannot be written again");
    if (log.track.observations.size() > kMostFitted) return;
    core::ArticulationConfig config;
    config.use_orientation = log.columns > 3;
    const std::vector<core::LearnedModel> models = core::ArticulationLearner(config).process({log.track});
    if (models.empty()) fuzz::detail::report("a log has no model");
    fuzz::useModels(models, "map");
  });
}

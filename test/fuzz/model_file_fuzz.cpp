// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/model_file.h"
#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "fuzz_target.h"
#include "model_uses.h"
#include "scratch_file.h"

using namespace cabinet_articulation;

namespace {

constexpr double kLater = 1795323300;  ///< [s] after all that the seeds know

}  // namespace

fuzz::Seeds fuzz::seeds() {
  const ScratchFile file("seed.yaml");
  core::saveModelFile(file.path(), {"map", exampleFronts()});
  const std::string all = file.read();
  file.remove();
  core::saveModelFile(file.path(), {"odom", {exampleFronts()[0]}});
  return {{all, file.read()}};
}

/// A file that somebody wrote, by hand perhaps, and all that starts from it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file("models.yaml");
  file.write(data, size);
  return fuzz::examine<core::ModelFileError>([] {
    const core::ModelFile models = core::readModelFile(file.path());
    fuzz::useModels(core::modelsOf(models.fronts), models.frame);
    fuzz::saveAndLoad(models.fronts, models.frame);
    core::ArticulationLearner learner{core::ArticulationConfig()};
    core::RectangleTracker tracker{core::TrackingConfig()};
    core::KnownFronts known;
    known.replace(models.fronts);
    learner.remember(core::modelsOf(models.fronts));
    tracker.remember(fuzz::tracksOf(models.fronts));
    const std::vector<core::Track> tracks = tracker.process(kLater, fuzz::seenAgain(models.fronts));
    known.follow(core::TrackUpdates().of(tracks, kLater));
    known.update(learner.process(known.tracks()));
    fuzz::saveAndLoad(known.joints(), models.frame);
  });
}

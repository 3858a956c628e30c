// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/model_file.h"
#include "cabinet_articulation/structure/structure_finder.h"
#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "fuzz_target.h"
#include "kinds/kind_memory.h"
#include "model_uses.h"
#include "ros/messages/kind_messages.h"
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
  const std::string one = file.read();
  file.remove();
  core::ModelFile with_kinds{"map", hangingFronts()};
  with_kinds.kinds.resize(2);
  with_kinds.kinds[1] = {core::JointType::kRotational, Eigen::Matrix3d::Identity(), 0.35, 0.4, 0.7, 1.25};
  core::saveModelFile(file.path(), with_kinds);
  return {{all, one, file.read()}};
}

/// A file that somebody wrote, by hand perhaps, and all that starts from it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file("models.yaml");
  file.write(data, size);
  return fuzz::examine<core::ModelFileError>([] {
    const core::ModelFile models = core::readModelFile(file.path());
    fuzz::useModels(core::modelsOf(models.fronts), models.frame);
    fuzz::saveAndLoad(models.fronts, models.frame, models.kinds);
    core::ArticulationLearner learner{core::ArticulationConfig()};
    core::RectangleTracker tracker{core::TrackingConfig()};
    core::StructureFinder structure{core::ArticulationConfig()};
    core::KindMemory kinds{core::LearningConfig()};
    core::KnownFronts known;
    known.replace(models.fronts);
    learner.remember(core::thoseOfTheWorld(core::modelsOf(models.fronts)));
    structure.remember(core::modelsOf(models.fronts));
    kinds.startFrom(models.kinds, core::modelsOf(models.fronts));
    tracker.remember(fuzz::tracksOf(models.fronts));
    const std::vector<core::Track> tracks = tracker.process(kLater, fuzz::seenAgain(models.fronts));
    known.follow(core::TrackUpdates().of(tracks, kLater));
    std::vector<core::LearnedModel> learned = learner.process(known.tracks());
    structure.complete(known.tracks(), &learned);
    known.update(learned);
    kinds.complete(known.tracks(), &learned);
    fuzz::useModels(learned, models.frame);
    toMessages(kinds.kinds());
    fuzz::saveAndLoad(known.joints(), models.frame, kinds.votesBeside({}));
  });
}

// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/pipeline/pipeline.h"
#include "messages.h"
#include "ros/settings/live_settings.h"

using namespace cabinet_articulation;

namespace {

template <class Config>
Config tuned(const core::ConfigValues& values) {
  Config config;
  core::applyConfig(values, config);
  toTuning(config);
  return config;
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  return {{"0" + serialized(toTuning(core::StereoConfig())), "1" + serialized(toTuning(core::PlanesConfig())),
           "2" + serialized(toTuning(core::RectanglesConfig())), "3" + serialized(toTuning(core::TrackingConfig())),
           "4" + serialized(toTuning(core::LearningConfig()))}};
}

/// What rqt_reconfigure sends to a stage, whose number is the first byte.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  return fuzz::examineMessages<core::ConfigError>(data + 1, size - 1, [stage = data[0]](fuzz::MessageReader& reader) {
    const core::ConfigValues values = fromTuning(*reader.next<dynamic_reconfigure::Config>());
    if (stage == '0') core::BlockMatcher{tuned<core::StereoConfig>(values)};
    if (stage == '1') core::PlaneSegmenter{tuned<core::PlanesConfig>(values)};
    if (stage == '2') core::RectangleDetector{tuned<core::RectanglesConfig>(values), {}};
    if (stage == '3') core::RectangleTracker{tuned<core::TrackingConfig>(values)};
    if (stage == '4') core::ArticulationLearner{tuned<core::LearningConfig>(values).articulation};
  });
}

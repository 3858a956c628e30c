// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.h"
#include "pipeline/bend_file.h"
#include "scratch_file.h"
#include "small_frame.h"

using namespace cabinet_articulation;

namespace {

core::KnownBend exampleBend(const core::StereoCamera& camera) {
  core::KnownBend known;
  known.camera = camera;
  known.bend = core::BendVector::LinSpaced(-0.125, 0.25);
  known.views = 81;
  return known;
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  const core::KnownBend known = exampleBend(SmallFrame().camera());
  const ScratchFile file("seed.yaml");
  core::saveBends(file.path(), {{"kinect", known}});
  const std::string one = file.read();
  core::saveBends(file.path(), {{"left: one", known}});
  const std::string nested = "bends: " + std::string(20000, '[');
  return {{one, file.read()}, {nested, "bends: &a\n  - *a\n"}};
}

/// What the planes stage does with a file that somebody wrote: every camera of it may be the one that is there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file("bends.yaml");
  static const fuzz::SmallFrame small;
  file.write(data, size);
  return fuzz::examine<std::runtime_error>([] {
    core::BendsOfCameras bends = core::readBendFile(file.path());
    for (auto& [frame, known] : bends) {
      core::SensorBend bend;
      bend.startFrom(known);
      known = bend.known();
      core::DepthFrame depth;
      depth.camera = small.camera();
      depth.disparity = cv::Mat1f(depth.camera.height, depth.camera.width, 20.0F);
      bend.correct(depth);
      bend.learn(depth, {});
    }
    try {
      core::saveBends(file.path(), bends);
      core::readBendFile(file.path());
    } catch (const std::exception& error) {
      fuzz::detail::report(std::string("what was read cannot be saved and read again: ") + error.what());
    }
  });
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "sources/frame_source.h"

namespace cabinet_articulation::core::evaluation {

/// What block matching finds in the pair, or the depth image that takes its place, as the nodelets treat one.
DepthFrame depthFrame(const Frame& frame, const StereoCamera& camera, BlockMatcher* matcher);

/// One way to detect fronts: the pipeline's settings, and what it is given.
struct Variant {
  std::string name;
  PipelineConfig config;
  bool from_depth = false;  ///< gets a depth image in place of the stereo pair
};

/// The defaults.
Variant ourVariant();

/// The defaults behind a camera that delivers depth: block matching's, holes included, in whole millimetres. It is treated as
/// the nodelets treat one.
Variant depthVariant();

/// The paper's recipe in all five stages: PipelineConfig::paper(), which is also in config/paper.
Variant paperVariant();

/// A pipeline that is shown frames as its variant says: Pipeline::process() and nothing else, as in process_bag.
class Observer {
 public:
  explicit Observer(const Variant& variant);

  const std::string& name() const { return variant_.name; }
  PipelineResult see(const Frame& frame, const StereoCamera& camera);

  /// The next frame has nothing to do with the ones before: a front that hangs somewhere else each time cannot be tracked.
  void forget() { pipeline_.reset(); }

 private:
  Variant variant_;
  BlockMatcher matcher_;
  Pipeline pipeline_;
};

}  // namespace cabinet_articulation::core::evaluation

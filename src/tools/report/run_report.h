// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "tools/report/page.h"

namespace cabinet_articulation {

/// Collects a run, frame by frame, and writes FOLDER/index.html at its end. Throws std::runtime_error, with the folder and the
/// reason in words, where that cannot be written; what can be known before the run, before the run.
class RunReport {
 public:
  /// The folder may be missing, empty, or that of a report before, which is replaced.
  explicit RunReport(const std::string& folder);

  void add(double stamp, const core::PipelineResult& result, const Eigen::Isometry3d& T_fixed_camera);

  /// Returns the page's path.
  std::string write(const RunFacts& facts, const RunSummary& summary);

 private:
  std::filesystem::path folder_;
  RunRecord record_;
  FramePictures pictures_;
};

/// The direction in `frame` that points upwards, as REP 103 names frames: -y of optical ones, else z. An empty name is a
/// camera's.
Eigen::Vector3d upwardsIn(const std::string& frame);

}  // namespace cabinet_articulation

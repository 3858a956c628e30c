// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/tracking/track.h"
#include "sources/frame_source.h"

namespace cabinet_articulation::core::evaluation {

/// Where a front really was, or the best that is known about it.
struct ReferencePose {
  Rectangle rectangle;
  double opened = 0;  ///< [m] from where it started
};

/// What is known about a moving front beforehand.
struct SourceFacts {
  std::string name;
  JointType type = JointType::kRigid;
  bool explainable = true;      ///< false: moves like no joint
  bool has_orientation = true;  ///< false: its poses are mere positions
};

/// What has been seen of the front so far. Valid only while it is shown.
struct SeenFront {
  const Track& track;
  const LearnedModel* model = nullptr;  ///< what the pipeline that saw the frames learned; null: poses that nobody learned from
};

/// One moving front that can be observed again and again, each time through another selection of its frames.
class TrackSource {
 public:
  virtual ~TrackSource() = default;

  virtual const SourceFacts& facts() const = 0;
  virtual const std::vector<ReferencePose>& reference() const = 0;  ///< one for every frame

  /// Shows the frames `picked` (ascending indices into reference()) and calls `visit` each time the front's track got longer.
  virtual void observe(const std::vector<int>& picked, const std::function<void(const SeenFront&)>& visit) const = 0;
};

/// A run with images: the pipeline sees the picked frames. The front is the one that opens farthest; the reference is
/// its true pose in the source's world. Holds all frames.
std::unique_ptr<TrackSource> trackFrames(FrameSource& frames);

/// A log in a folder, and how its front moves.
struct LabelledLog {
  std::string path, file, type;
};

/// `labels.csv` in the folder names the logs and their types (file,type,...); none for an empty name. Throws std::runtime_error.
std::vector<LabelledLog> findLogs(const std::string& folder);

/// A log of poses in a text file (3, 7 or 9 columns). The reference is the log itself. `type` is rigid, prismatic,
/// rotational or other. Throws std::runtime_error for another type or a bad file.
std::unique_ptr<TrackSource> openPoseLog(const std::string& path, const std::string& name, const std::string& type);

}  // namespace cabinet_articulation::core::evaluation

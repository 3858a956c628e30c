// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"

namespace cabinet_articulation::core {

/// A file of learned models cannot be read or written. The message names the file and what is wrong.
class ModelFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a file of learned models holds: joints, and a thinned history of each, so that learning goes on where it stopped.
struct ModelFile {
  std::string frame;  ///< of all poses
  std::vector<KnownFront> fronts;
};

/// Writes YAML, as a whole or not at all: whoever reads the file finds the old or the new one, even after a power cut.
/// Throws ModelFileError; also if there is a file that readModelFile() refuses or whose models are in another frame, which is
/// then left as it is.
void writeModelFile(const std::string& path, const ModelFile& models);

/// Throws ModelFileError for a file that is missing, damaged, cut off or of another version.
ModelFile readModelFile(const std::string& path);

}  // namespace cabinet_articulation::core

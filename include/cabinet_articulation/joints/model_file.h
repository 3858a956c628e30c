// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"
#include "cabinet_articulation/kinds/joint_shape.h"

namespace cabinet_articulation::core {

/// A file of learned models cannot be read or written. The message names the file and what is wrong.
class ModelFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a file of learned models holds: joints, and a thinned history of each, so that learning goes on where it stopped. Kinds
/// are those of these joints and of some more.
struct ModelFile {
  std::string frame;  ///< of all poses
  std::vector<KnownFront> fronts;
  std::vector<IdChange> changes = {};  ///< of a file that gives a front the id 0, which is nobody's
  std::vector<JointShape> kinds = {};  ///< joints of fronts that are not known any more
  bool replaces_kinds = false;         ///< when this is saved, `kinds` of the file are forgotten
};

/// How saving went.
struct SavedModels {
  std::size_t fronts = 0;                    ///< that the file holds now
  std::size_t from_file = 0;                 ///< so many of them are as the file had them
  std::vector<IdChange> changes;             ///< of the file's fronts
  std::vector<IdChange> known_changes = {};  ///< of those whose ids a file cannot hold
  std::vector<NameChange> renamed = {};      ///< of the file's fronts
  std::size_t kinds = 0;                     ///< joints of fronts that are not known any more
  std::string kept = {};                     ///< why the file that was there could not be merged, and where it is; or empty

  /// "3 fronts saved to 'FILE', 1 of them ...".
  std::string inWords(const std::string& file) const;
};

/*
 * Files are written as a whole or not at all. Whoever reads one finds the old or the new one, even after a power cut, and the
 * file keeps its owner and mode. Links are followed, and stay links. Reading, merging and writing are one transaction. Others
 * that save to a file of the same folder wait for up to 20 s, in this process or another. The lock is flock on the folder, which
 * ends with a process that dies. What a saver that died has left behind is cleared away by the next.
 */

/// Merges models and kinds into what the file holds, without what was `removed`. Beyond kMostShapes, kinds of the file are lost.
/// Of two fronts in one place that of `models` stays, unless the file's is much better known. A model file that is damaged, of
/// another version or in another frame cannot be merged. It is kept beside the new one as FILE.kept-1 (or the next number that is
/// free, up to 100). Throws ModelFileError; also for what is there and is no model file, and stays as it is.
SavedModels saveModelFile(const std::string& path, const ModelFile& models, const std::vector<ForgottenFront>& removed = {});

/// Takes the fronts of these places from the file, and returns how many there were. `kinds`: what they taught, which the file
/// keeps. A file that is missing or in another frame has none of them. Throws ModelFileError.
std::size_t removeFromModelFile(const std::string& path, const std::string& frame, const std::vector<ForgottenFront>& removed,
                                const std::vector<JointShape>& kinds = {});

/// Throws ModelFileError for a file that is missing, damaged, cut off, of another version or no ordinary file. Everything is
/// checked, stamps too: what is returned can be used.
ModelFile readModelFile(const std::string& path);

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/model_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "cabinet_articulation/tracking/history.h"
#include "model_file_fields.h"

namespace cabinet_articulation::core {
namespace {

constexpr char kFormat[] = "cabinet_articulation models";
constexpr char kEnd[] = "complete";  ///< the last key, so that a file that was cut off is noticed
constexpr int kVersion = 1;
constexpr int kObservations = 200;  ///< enough for the fits, which use no more themselves

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw ModelFileError("model file '" + path + "': " + what);
}

std::string toText(const ModelFile& models) {
  YAML::Node root;
  root["format"] = kFormat;
  root["version"] = kVersion;
  root["frame"] = models.frame;
  root["fronts"] = YAML::Node(YAML::NodeType::Sequence);
  for (KnownFront front : models.fronts) {
    while (thinOut(front.track.observations, kObservations)) continue;
    root["fronts"].push_back(toYaml(front));
  }
  root[kEnd] = true;
  YAML::Emitter emitter;
  emitter << root;
  return std::string("# Doors and drawers that were learned. Metres and radians; poses are x y z qx qy qz qw.\n") +
         emitter.c_str() + "\n";
}

/// A rename replaces a file at once; what it replaces it with must be on the disk before.
void writeAtomically(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".new";
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail(path, std::string("cannot be written: ") + std::strerror(errno));
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = ::write(file, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) break;
    written += static_cast<std::size_t>(n);
  }
  const bool synced = written == text.size() && ::fsync(file) == 0;
  const bool closed = ::close(file) == 0;
  if (synced && closed && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  ::unlink(temporary.c_str());
  fail(path, "cannot be written: " + reason);
}

void checkHead(const YAML::Node& root) {
  if (!root.IsMap() || !root["format"] || !root["format"].IsScalar() || root["format"].Scalar() != kFormat)
    throw std::runtime_error("holds no models of this program");
  const std::string version = root["version"] && root["version"].IsScalar() ? root["version"].Scalar() : "missing";
  if (version != std::to_string(kVersion))
    throw std::runtime_error("its version is " + version + ", this program reads version " + std::to_string(kVersion));
  if (!root[kEnd]) throw std::runtime_error("is cut off: its last line is missing");
  if (!root["frame"] || !root["frame"].IsScalar() || !root["fronts"] || !root["fronts"].IsSequence())
    throw std::runtime_error("'frame' or 'fronts' is missing");
}

}  // namespace

void writeModelFile(const std::string& path, const ModelFile& models) {
  if (std::filesystem::exists(path)) {
    try {
      const ModelFile old = readModelFile(path);
      if (!old.fronts.empty() && old.frame != models.frame)
        fail(path, "its poses are in the frame '" + old.frame + "', and the new ones in '" + models.frame + "'");
    } catch (const ModelFileError& error) {
      throw ModelFileError(std::string(error.what()) + "; it is left as it is, and nothing is saved");
    }
  }
  writeAtomically(path, toText(models));
}

ModelFile readModelFile(const std::string& path) {
  if (!std::ifstream(path)) fail(path, "cannot be opened");
  ModelFile models;
  try {
    const YAML::Node root = YAML::LoadFile(path);
    checkHead(root);
    models.frame = root["frame"].Scalar();
    std::set<std::uint32_t> ids;
    for (std::size_t i = 0; i < root["fronts"].size(); ++i) {
      const std::string where = "front " + std::to_string(i + 1) + ": ";
      try {
        models.fronts.push_back(frontFromYaml(root["fronts"][i]));
      } catch (const std::exception& error) {
        throw std::runtime_error(where + error.what());
      }
      if (!ids.insert(models.fronts.back().model.id).second) throw std::runtime_error(where + "its id is there twice");
    }
  } catch (const std::exception& error) {
    fail(path, error.what());
  }
  return models;
}

}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/bend_file.h"

#include <filesystem>
#include <optional>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"
#include "config/ordinary_file.h"
#include "joints/safe_file.h"
#include "joints/yaml_fields.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kLargestFile = 1U << 20U;  ///< [bytes] ours: a camera takes 400
constexpr std::uint32_t kMostViews = 1000000;    ///< ours: more than any run keeps

YAML::Node toYaml(const std::string& frame, const KnownBend& known) {
  const StereoCamera& camera = known.camera;
  YAML::Node node;
  node["camera"] = frame;
  node["width"] = camera.width;
  node["height"] = camera.height;
  node["focal_length"] = yaml::list(yaml::Numbers{camera.fx, camera.fy});
  node["principal_point"] = yaml::list(yaml::Numbers{camera.cx, camera.cy});
  node["baseline"] = yaml::toText(camera.baseline);
  node["views"] = known.views;
  node["remaining"] = yaml::toText(known.remaining);
  node["bend"] = yaml::list(yaml::Numbers(known.bend.data(), known.bend.data() + kBendTerms));
  return node;
}

KnownBend fromYaml(const YAML::Node& node) {
  KnownBend known;
  StereoCamera& camera = known.camera;
  const auto side = [&node](const char* field) { return static_cast<int>(yaml::within(node[field], field, limits::kImageSide)); };
  camera.width = side("width");
  camera.height = side("height");
  requireWithin("width times height", static_cast<double>(camera.width) * camera.height, limits::kImageArea);
  const yaml::Numbers focal_length = yaml::numbers(node["focal_length"], "focal_length", 2);
  const yaml::Numbers middle = yaml::numbers(node["principal_point"], "principal_point", 2);
  camera.fx = focal_length[0];
  camera.fy = focal_length[1];
  camera.cx = middle[0];
  camera.cy = middle[1];
  camera.baseline = yaml::within(node["baseline"], "baseline", limits::kBaseline);
  known.views = yaml::count(node["views"], "views", kMostViews);
  if (node["remaining"].IsDefined()) known.remaining = yaml::within(node["remaining"], "remaining", {0, kMostBend, "px"});
  const yaml::Numbers bend = yaml::numbers(node["bend"], "bend", kBendTerms);
  for (const double term : bend) requireWithin("bend", term, limits::kBend);
  known.bend = BendVector(bend.data());
  return known;
}

BendsOfCameras fromText(const std::string& text) {
  const YAML::Node list = YAML::Load(text)["bends"];
  if (!list.IsDefined() || !list.IsSequence()) throw std::runtime_error("has no list 'bends'");
  BendsOfCameras bends;
  for (const YAML::Node& node : list) {
    if (!node.IsMap() || !node["camera"].IsDefined() || !node["camera"].IsScalar())
      throw std::runtime_error("an entry of 'bends' does not say of what camera it is");
    const std::string frame = node["camera"].Scalar();
    try {
      bends[frame] = fromYaml(node);
    } catch (const std::exception& error) {
      throw std::runtime_error("camera '" + frame + "': " + error.what());
    }
  }
  return bends;
}

template <class Work>
auto onFile(const std::string& path, const Work& work) {
  return withErrorsOf<std::runtime_error>("bend file '" + path + "'", work);
}

BendsOfCameras readIfThere(const std::filesystem::path& path) {
  const std::optional<std::string> text = readFileIfThere(path, kLargestFile);
  return text ? fromText(*text) : BendsOfCameras();
}

}  // namespace

BendsOfCameras readBendFile(const std::string& path) {
  return onFile(path, [&] { return readIfThere(path); });
}

void saveBends(const std::string& path, const BendsOfCameras& bends) {
  onFile(path, [&] {
    const std::filesystem::path file = std::filesystem::absolute(followLinks(path));
    const FolderLock lock(file.parent_path());
    BendsOfCameras all = readIfThere(file);
    for (const auto& [frame, known] : bends) all[frame] = known;
    YAML::Node document;
    for (const auto& [frame, known] : all) document["bends"].push_back(toYaml(frame, known));
    const std::string about = "# How depth cameras bend what is flat: factors of the terms of doc/bend.md. [px]\n";
    replaceFile(file, about + YAML::Dump(document) + "\n", lock);
  });
}

}  // namespace cabinet_articulation::core

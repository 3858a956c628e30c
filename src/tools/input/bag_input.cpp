// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/bag_input.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tools/input/bag_topics.h"

namespace cabinet_articulation {
namespace {

constexpr char kDefaultCamera[] = "/stereo";
constexpr char kImage[] = "sensor_msgs/Image";
constexpr char kInfo[] = "sensor_msgs/CameraInfo";
constexpr char kDisparity[] = "stereo_msgs/DisparityImage";

/// Names of images in a camera's namespace, the best first (image_proc, drivers).
struct ImageName {
  const char* name;
  bool rectified;
};
constexpr ImageName kImageNames[] = {{"image_raw", false},     {"image_rect", true},  {"image_rect_color", true},
                                     {"image_rect_raw", true}, {"image_mono", false}, {"image_color", false}};

/// How the namespaces of left and right cameras differ.
constexpr const char* kSides[][2] = {{"left", "right"}, {"infra1", "infra2"}, {"cam0", "cam1"}};

/// The first if it is not empty.
std::string oneOf(const std::string& named, const std::string& other) { return named.empty() ? other : named; }

class InputSearch {
 public:
  InputSearch(const BagTopics& topics, const InputOptions& options) : topics_(topics), options_(options) {}

  /// Complete inputs of a kind, found by type.
  std::vector<BagInput> byType(const std::string& kind) const {
    std::vector<BagInput> inputs;
    const auto add = [&](const BagInput& input) {
      if (missing(input).empty()) inputs.push_back(input);
    };
    if (kind == "stereo")
      for (const std::string& info : seeds(oneOf(options_.left_info, infoBeside(options_.left_image)), kInfo)) add(stereo(info));
    if (kind == "disparity")
      for (const std::string& topic : seeds(options_.disparity, kDisparity)) add(disparity(namespaceOf(topic), topic));
    if (kind == "depth")
      for (const std::string& topic : seeds(options_.depth_image, kImage))
        if (topics_.holdsDepth(topic)) add(depth(topic));
    return inputs;
  }

  /// That of the default names below the camera, complete or not.
  BagInput byName(const std::string& kind) const {
    const std::string camera = oneOf(options_.camera, kDefaultCamera) + "/";
    if (kind == "stereo")
      return stereo(oneOf(options_.left_info, oneOf(infoBeside(options_.left_image), camera + "left/camera_info")));
    if (kind == "disparity") return disparity(camera, oneOf(options_.disparity, camera + "disparity"));
    return depth(oneOf(options_.depth_image, camera + "depth/image"));
  }

  /// One line for each topic that is not in the bag; empty if all are there.
  std::string missing(const BagInput& input) const {
    std::vector<std::pair<std::string, const char*>> needed{{input.topics.info, kInfo}};
    if (input.kind == "stereo")
      needed.insert(needed.end(), {{input.topics.left, kImage}, {input.topics.right, kImage}, {input.topics.right_info, kInfo}});
    else
      needed.emplace_back(input.topics.frame, input.kind == "depth" ? kImage : kDisparity);
    std::string text;
    for (const auto& [topic, type] : needed)
      if (!topics_.has(topic, type)) text += "\n  " + topic + " (" + type + ")";
    return text;
  }

  /// With the names that images have in the bag, or were named with.
  BagInput recorded(BagInput input, const InputOptions& given = {}) const {
    const auto resolve = [this](const std::string& named, std::string* image) {
      *image = uncompressed(named) == *image && topics_.hasExactly(named) ? named : topics_.recorded(*image);
    };
    resolve(given.left_image, &input.topics.left);
    resolve(given.right_image, &input.topics.right);
    if (input.kind == "depth") resolve(given.depth_image, &input.topics.frame);
    return input;
  }

 private:
  std::vector<std::string> seeds(const std::string& named, const char* type) const {
    if (!named.empty()) return {named};
    return topics_.all(type, options_.camera);
  }

  static std::string infoBeside(const std::string& image) { return image.empty() ? "" : namespaceOf(image) + "camera_info"; }

  /// The same topic of the right camera; empty if the name tells no side.
  static std::string rightOf(const std::string& left) {
    for (const auto& [from, to] : kSides)
      if (const size_t at = left.rfind(from); at != std::string::npos)
        return std::string(left).replace(at, std::string(from).size(), to);
    return "";
  }

  BagInput stereo(const std::string& left_info) const {
    const std::string right_info = oneOf(options_.right_info, oneOf(infoBeside(options_.right_image), rightOf(left_info)));
    const std::string left = namespaceOf(left_info), right = namespaceOf(right_info);
    std::vector<ImageName> names(std::begin(kImageNames), std::end(kImageNames));
    if (options_.rectified)
      std::stable_partition(names.begin(), names.end(), [](const ImageName& image) { return image.rectified; });
    const auto is_there = [&](const ImageName& image) {
      return topics_.has(left + image.name, kImage) && topics_.has(right + image.name, kImage);
    };
    const auto named = std::find_if(names.begin(), names.end(), is_there);
    const ImageName& found = named == names.end() ? names.front() : *named;
    BagInput input{"stereo", {"", left_info, right_info, left + found.name, right + found.name}, found.rectified};
    if (!options_.left_image.empty()) {
      input.topics.left = options_.left_image;
      input.topics.right = oneOf(options_.right_image, rightOf(options_.left_image));
      if (input.topics.right.empty())
        throw std::invalid_argument("--right-image is missing: the name " + options_.left_image + " tells no right one");
      input.rectified = options_.left_image.find("image_rect") != std::string::npos;
    }
    if (options_.left_image.empty() && !options_.right_image.empty()) input.topics.right = options_.right_image;
    input.rectified = input.rectified || options_.rectified;
    return input;
  }

  BagInput disparity(const std::string& camera, const std::string& topic) const {
    FrameTopics topics = FrameTopics::below(camera, "disparity");
    topics.frame = topic;
    topics.info = oneOf(options_.left_info, topics.info);
    topics.right_info = oneOf(options_.right_info, topics.right_info);
    topics.left = oneOf(options_.left_image, topics.left);
    topics.right = oneOf(options_.right_image, topics.right);
    return {"disparity", topics};
  }

  BagInput depth(const std::string& topic) const {
    return {"depth", {topic, oneOf(options_.depth_info, infoBeside(topic)), "", "", ""}};
  }

  const BagTopics& topics_;
  const InputOptions& options_;
};

/// Throws std::invalid_argument unless the kind is known and the named topics belong to it.
void requireConsistent(const InputOptions& options, const std::string& kind) {
  if (kind != "stereo" && kind != "disparity" && kind != "depth")
    throw std::invalid_argument("input is '" + kind + "', expected stereo, disparity or depth");
  const std::pair<const char*, const std::string*> foreign[] = {
      {"--left-image", kind == "depth" ? &options.left_image : nullptr},
      {"--left-info", kind == "depth" ? &options.left_info : nullptr},
      {"--right-image", kind == "depth" ? &options.right_image : nullptr},
      {"--right-info", kind == "depth" ? &options.right_info : nullptr},
      {"--disparity", kind != "disparity" ? &options.disparity : nullptr},
      {"--depth-image", kind != "depth" ? &options.depth_image : nullptr},
      {"--depth-info", kind != "depth" ? &options.depth_info : nullptr}};
  for (const auto& [name, value] : foreign)
    if (value && !value->empty()) throw std::invalid_argument(std::string(name) + " is not part of the input " + kind);
}

/// The kind that is given or that the named topics belong to, else all.
std::vector<std::string> kindsOf(const InputOptions& options) {
  const bool depth = !options.depth_image.empty() || !options.depth_info.empty();
  const bool pair = options.rectified || !options.left_image.empty() || !options.right_image.empty() ||
                    !options.left_info.empty() || !options.right_info.empty();
  std::vector<std::string> kinds{options.kind};
  if (options.kind.empty() && !options.disparity.empty()) kinds = {"disparity"};
  if (options.kind.empty() && options.disparity.empty() && (depth || pair)) kinds = {depth ? "depth" : "stereo"};
  if (kinds[0].empty()) return {"stereo", "disparity", "depth"};
  requireConsistent(options, kinds[0]);
  return kinds;
}

/// The options that choose an input.
std::string optionsFor(const BagInput& input) {
  const FrameTopics& topics = input.topics;
  if (input.kind == "stereo") return "--left-image " + topics.left + " --right-image " + topics.right;
  return (input.kind == "depth" ? "--depth-image " : "--disparity ") + topics.frame;
}

InputOptions withoutTransports(InputOptions options) {
  for (std::string* image : {&options.left_image, &options.right_image, &options.depth_image}) *image = uncompressed(*image);
  return options;
}

}  // namespace

BagInput chooseInput(const rosbag::Bag& bag, const InputOptions& given) {
  const InputOptions options = withoutTransports(given);
  const std::vector<std::string> kinds = kindsOf(options);
  const BagTopics topics(bag);
  const InputSearch search(topics, options);
  const BagInput expected = search.byName(kinds[0]);
  const std::string missing = search.missing(expected);
  if (missing.empty()) return search.recorded(expected, given);
  std::vector<BagInput> found;
  for (const std::string& kind : kinds)
    for (const BagInput& input : search.byType(kind)) found.push_back(input);
  if (found.size() == 1) return search.recorded(found[0], given);
  std::string text = bag.getFileName() + ": ";
  if (found.empty()) {
    text += kinds.size() > 1 ? "holds no input; needed are a disparity or a depth image with its camera_info, or for stereo"
                             : "missing topics";
    text += ":" + missing;
  } else {
    text += std::to_string(found.size()) + " inputs fit, choose one:";
    for (const BagInput& input : found) text += "\n  --input " + input.kind + " " + optionsFor(search.recorded(input));
  }
  throw std::runtime_error(text + "\nin the bag are:" + topics.text());
}

}  // namespace cabinet_articulation

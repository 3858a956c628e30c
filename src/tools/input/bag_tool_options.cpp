// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/bag_tool_options.h"

#include <getopt.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace cabinet_articulation {

const char kBagInputUsage[] =
    "The input is that of pipeline.launch's topics, else the only one in the bag that fits; images may be compressed (JPEG, "
    "PNG):\n"
    "  --input KIND        stereo, disparity or depth (16UC1 or 32FC1)\n"
    "  --camera NAMESPACE  of its topics (default: /stereo)\n"
    "  --rectified         stereo: the images are rectified already\n"
    "  --left-image, --left-info, --right-image, --right-info, --disparity, --depth-image, --depth-info TOPIC\n"
    "  --sync-tolerance S  stamps of a pair may differ by so much (default: 0)\n"
    "  --depth-scale M     the unit of 16 bit depth (default: 0.001)\n"
    "  --virtual-baseline M  depth: of the pair that it is treated as (default: 0.075)\n";

namespace {

/// Sets the field of a nodelet's setting. Throws std::invalid_argument for what that refuses.
template <class Config>
std::function<void(const char*)> number(const char* field, Config* config) {
  return [field, config](const char* text) {
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end == text || *end) throw std::invalid_argument("'" + std::string(text) + "' is no number");
    core::applyConfig({{field, value}}, *config);
  };
}

std::function<void(const char*)> text(std::string* value) {
  return [value](const char* given) { *value = given; };
}

/// A bag's names are absolute.
std::function<void(const char*)> topic(std::string* value) {
  return [value](const char* given) { *value = std::string(*given == '/' ? "" : "/") + given; };
}

std::function<void(const char*)> flag(bool* value) {
  return [value](const char*) { *value = true; };
}

/// What all tools know that read frames from a bag.
std::vector<Choice> choicesOf(BagToolOptions* options) {
  InputOptions& input = options->bag.input;
  SyncConfig& sync = options->bag.sync;
  const auto tolerance = [&sync, set = number("sync_tolerance", &sync)](const char* given) {
    set(given);
    sync.approximate_sync = sync.sync_tolerance > 0;
  };
  return {{"config", required_argument, text(&options->config)},
          {"input", required_argument, text(&input.kind)},
          {"camera", required_argument, topic(&input.camera)},
          {"rectified", no_argument, flag(&input.rectified)},
          {"left-image", required_argument, topic(&input.left_image)},
          {"left-info", required_argument, topic(&input.left_info)},
          {"right-image", required_argument, topic(&input.right_image)},
          {"right-info", required_argument, topic(&input.right_info)},
          {"disparity", required_argument, topic(&input.disparity)},
          {"depth-image", required_argument, topic(&input.depth_image)},
          {"depth-info", required_argument, topic(&input.depth_info)},
          {"sync-tolerance", required_argument, tolerance},
          {"depth-scale", required_argument, number("depth_scale", &options->bag.frames)},
          {"virtual-baseline", required_argument, number("virtual_baseline", &options->bag.frames)}};
}

void set(const Choice& choice, const char* value) {
  try {
    choice.set(value);
  } catch (const std::exception& error) {
    throw std::invalid_argument(std::string("--") + choice.name + ": " + error.what());
  }
}

}  // namespace

bool parseBagToolOptions(int argc, char** argv, const std::vector<Choice>& own, BagToolOptions* options) {
  std::vector<Choice> choices = choicesOf(options);
  choices.insert(choices.end(), own.begin(), own.end());
  std::vector<option> known;
  for (const Choice& choice : choices) known.push_back({choice.name, choice.argument, nullptr, 0});
  known.insert(known.end(), {{"help", no_argument, nullptr, 'h'}, {nullptr, 0, nullptr, 0}});
  opterr = 0;
  int index = 0;
  for (int found; (found = getopt_long(argc, argv, "h", known.data(), &index)) != -1;) {
    if (found == 'h') return false;
    if (found == '?') throw std::invalid_argument(std::string("unknown option or missing value: ") + argv[optind - 1]);
    set(choices[static_cast<size_t>(index)], optarg);
  }
  if (argc - optind != 2) throw std::invalid_argument("expected two bags, got " + std::to_string(argc - optind));
  options->input = argv[optind];
  options->output = argv[optind + 1];
  std::error_code missing;
  if (std::filesystem::equivalent(options->input, options->output, missing))
    throw std::invalid_argument("input and output are the same file: " + options->input);
  return true;
}

}  // namespace cabinet_articulation

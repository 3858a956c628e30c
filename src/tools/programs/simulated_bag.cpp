// SPDX-License-Identifier: BSD-3-Clause
// A simulated scene in a bag, as replay.launch and process_bag read it.
#include <getopt.h>

#include <cstdio>
#include <optional>
#include <set>
#include <vector>

#include "tools/input/scene_bag.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: simulated_bag SCENE OUT.bag [options]\n"
    "  SCENE              door, drawer, kitchen, pedestal, bifold, trolley, cupboard or static\n"
    "  --input INPUT      stereo (the default), disparity or depth, as in pipeline.launch; again for a further one\n"
    "  --camera-motion M  how far the camera wanders about its place, in metres (default: 0, it stands)\n"
    "  --first N          begins at this frame of the scene's motion (default: 0)\n"
    "  --frames N         default: to the end of the scene's motion\n"
    "  --rounds N         the same frames N times, with the same stamps, as a bag in a loop (default: 1)\n"
    "  --rate HZ          default: 15\n"
    "  --width N, --height N  of the images, in pixels (default: 640, 480); the view stays as wide\n"
    "  --seed N           varies the scene (default: 1)\n"
    "  --camera NAMESPACE of the topics (default: /stereo)\n"
    "The camera's place in the frame 'world' is in /tf, what is true in SCENE in <camera>/truth.\n";

struct Options {
  std::string output;
  SceneBagConfig config;
  std::set<std::string> inputs;
};

double number(const std::string& option, const std::string& text) {
  try {
    size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size()) return value;
  } catch (const std::logic_error&) {
  }
  throw std::invalid_argument("--" + option + " expects a number, got '" + text + "'");
}

int wholeNumber(const std::string& option, const std::string& text, int least = 1) {
  const double value = number(option, text);
  if (value < least || value > 1e6 || value != static_cast<int>(value))
    throw std::invalid_argument("--" + option + " expects a whole number from " + std::to_string(least) + " to 1000000, got '" +
                                text + "'");
  return static_cast<int>(value);
}

void set(const std::string& option, const std::string& value, Options* options) {
  core::SimulationConfig& simulation = options->config.simulation;
  if (option == "input") options->inputs.insert(value);
  if (option == "camera-motion") simulation.camera_motion = number(option, value);
  if (option == "first") options->config.first_frame = wholeNumber(option, value, 0);
  if (option == "frames") options->config.frames = wholeNumber(option, value);
  if (option == "rounds") options->config.rounds = wholeNumber(option, value);
  if (option == "rate") simulation.rate = number(option, value);
  if (option == "width") {
    const int width = wholeNumber(option, value);
    simulation.focal_length *= static_cast<double>(width) / simulation.width;
    simulation.width = width;
  }
  if (option == "height") simulation.height = wholeNumber(option, value);
  if (option == "seed") simulation.scene_seed = wholeNumber(option, value);
  if (option == "camera") options->config.camera = value[0] == '/' ? value : "/" + value;
}

/// Throws std::invalid_argument. Nothing if only help was asked for.
std::optional<Options> parseOptions(int argc, char** argv) {
  std::vector<option> known;
  for (const char* name : {"input", "camera-motion", "first", "frames", "rounds", "rate", "width", "height", "seed", "camera"})
    known.push_back({name, required_argument, nullptr, 'o'});
  known.push_back({"help", no_argument, nullptr, 'h'});
  known.push_back({nullptr, 0, nullptr, 0});
  Options options;
  opterr = 0;
  int index = 0;
  for (int choice; (choice = getopt_long(argc, argv, "h", known.data(), &index)) != -1;) {
    if (choice == 'h') return std::nullopt;
    if (choice == '?') throw std::invalid_argument(std::string("unknown option or missing value: ") + argv[optind - 1]);
    set(known[index].name, optarg, &options);
  }
  if (argc - optind != 2) throw std::invalid_argument("expected a scene and a bag, got " + std::to_string(argc - optind));
  if (!options.inputs.empty()) options.config.inputs = options.inputs;
  options.config.simulation.scene = argv[optind];
  options.output = argv[optind + 1];
  return options;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  return runProgram("simulated_bag", kUsage, [&] {
    const auto options = parseOptions(argc, argv);
    if (options) {
      const int frames = writeSceneBag(options->output, options->config);
      std::printf("%s: %d frames of the scene '%s'\n", options->output.c_str(), frames, options->config.simulation.scene.c_str());
    } else {
      std::printf("%s", kUsage);
    }
    return 0;
  });
}

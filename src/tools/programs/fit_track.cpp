// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/articulation/articulation_learner.h"
#include "geometry/degrees.h"
#include "kinds/joint_kinds.h"
#include "tools/input/pose_log.h"
#include "tools/report/track_plot.h"

namespace cabinet_articulation::core {
namespace {

constexpr char kUsage[] =
    "usage: fit_track FILE... [--sigma-position M] [--sigma-orientation RAD] [--positions-only] [--seed N]\n"
    "                         [--config DIR] [--plot FILE.png] [--kinds FILE]...\n"
    "Learns how the front of each log moves and prints one CSV line per file. A log has one pose a line, in metres:\n"
    "x y z [qx qy qz qw [width height]]. DIR/articulation.yaml has other settings than the defaults.\n"
    "--kinds takes a log of another front first: where that is of the same kind of joint, it says how this one goes on.\n"
    "--plot draws one log: poses and axis from above and from the side, openings, and the types' probabilities.\n";

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> kinds;  ///< logs that teach kinds of joints
  std::string plot;                ///< a picture; empty: none
  ArticulationConfig config;
  KindsConfig kinds_config;  ///< for `kinds`
};

/// The settings that other options change. Throws ConfigError.
LearningConfig baseConfig(int argc, char** argv) {
  const auto option = std::find(argv + 1, argv + argc, std::string("--config"));
  if (option == argv + argc) return {};
  if (option + 1 == argv + argc) throw ConfigError("--config needs a folder");
  std::vector<std::string> warnings;
  const auto config = loadConfig<LearningConfig>(std::string(option[1]) + "/articulation.yaml", &warnings);
  for (const std::string& warning : warnings) std::fprintf(stderr, "fit_track: %s\n", warning.c_str());
  return config;
}

/// Throws ConfigError for an option that is unknown, incomplete or out of range.
Options parseOptions(int argc, char** argv) {
  Options options;
  const LearningConfig base = baseConfig(argc, argv);
  options.config = base.articulation;
  options.kinds_config = base.kinds;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&](const char* what) {
      if (++i >= argc) throw ConfigError(word + " needs " + what);
      return argv[i];
    };
    const auto number = [&]() {
      value("a number");
      char* end = nullptr;
      const double value = std::strtod(argv[i], &end);
      if (end == argv[i] || *end != '\0') throw ConfigError(word + " needs a number, not '" + argv[i] + "'");
      return value;
    };
    if (word == "--sigma-position") {
      options.config.sigma_position = number();
    } else if (word == "--sigma-orientation") {
      options.config.sigma_orientation = number();
    } else if (word == "--positions-only") {
      options.config.use_orientation = false;
    } else if (word == "--seed") {
      options.config.seed = static_cast<int>(number());
    } else if (word == "--config") {
      ++i;  // see baseConfig()
    } else if (word == "--plot") {
      options.plot = value("a file's name");
    } else if (word == "--kinds") {
      options.kinds.push_back(value("a file's name"));
    } else if (word.rfind("--", 0) == 0) {
      throw ConfigError("unknown option " + word);
    } else {
      options.files.push_back(word);
    }
  }
  checkConfig(options.config);
  if (options.files.empty()) throw ConfigError("no files given");
  if (!options.plot.empty() && std::filesystem::path(options.plot).extension() != ".png")
    throw ConfigError("--plot writes a picture, whose name ends with .png, not '" + options.plot + "'");
  if (!options.plot.empty() && options.files.size() > 1)
    throw ConfigError("--plot draws one log, but " + std::to_string(options.files.size()) + " were given");
  return options;
}

/// From the axis to the middle of the front's edge that is farthest from it, or to the given position.
double farRadius(const LearnedModel& model) {
  double radius = 0;
  for (const Eigen::Vector3d& edge : {Eigen::Vector3d(model.width / 2, 0, 0), Eigen::Vector3d(-model.width / 2, 0, 0),
                                      Eigen::Vector3d(0, model.height / 2, 0), Eigen::Vector3d(0, -model.height / 2, 0)}) {
    const Eigen::Vector3d away = model.origin * edge - model.axis_point;
    radius = std::max(radius, away.cross(model.axis).norm());
  }
  return radius;
}

void printModel(const std::string& file, const LearnedModel& model, double milliseconds) {
  const bool is_joint = model.explained && modelEntry(model.type).is_parametric;
  const char* type = is_joint ? modelName(model.type) : "other";
  std::string radius;
  if (is_joint && model.radius > 0) radius = std::to_string(farRadius(model));
  std::printf("%s,%s,%.6f,%.6f,%.6f,%s,%.6f,%.6f,%.4f,%.3f\n", file.c_str(), type, model.probabilities[0], model.probabilities[1],
              model.probabilities[2], radius.c_str(), model.q_max - model.q_min, model.position_error,
              toDegrees(model.orientation_error), milliseconds);
}

/// A log with the settings that are right for it.
struct LogToFit {
  Track track;
  ArticulationConfig config;
  std::string warning;

  LearnedModel learn() const { return ArticulationLearner(config).process({track}).at(0); }
};

LogToFit readLog(const std::string& file, const Options& options) {
  const PoseLog log = readPoseLog(file);
  LogToFit result{log.track, options.config, log.warning};
  result.config.use_orientation = options.config.use_orientation && log.columns > 3;
  return result;
}

void warnOf(const std::string& file, const LogToFit& log) {
  if (!log.warning.empty()) std::fprintf(stderr, "fit_track: %s: %s\n", file.c_str(), log.warning.c_str());
}

/// The log without its folder is the heading.
void plotFile(const std::string& file, const Options& options) {
  const std::string name = std::filesystem::path(file).filename().string();
  const LogToFit log = readLog(file, options);
  if (!cv::imwrite(options.plot, plotTrack(log.track, log.config, name)))
    throw std::runtime_error(options.plot + " cannot be written");
}

/// Throws PoseLogError.
JointKinds learnKinds(const Options& options) {
  JointKinds kinds(options.kinds_config, options.config.prior);
  for (const std::string& file : options.kinds) {
    const LogToFit log = readLog(file, options);
    warnOf(file, log);
    if (!kinds.add(log.learn(), log.track, log.config))
      std::fprintf(stderr, "fit_track: %s teaches no kind: no door or drawer was seen to move there\n", file.c_str());
  }
  return kinds;
}

void fitFile(const std::string& file, const JointKinds& kinds, const Options& options) {
  const LogToFit log = readLog(file, options);
  warnOf(file, log);
  const auto start = std::chrono::steady_clock::now();
  const LearnedModel model = kinds.predict(log.learn(), log.track, log.config);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  printModel(file, model, elapsed.count());
}

int run(int argc, char** argv) {
  Options options;
  std::optional<JointKinds> kinds;
  try {
    options = parseOptions(argc, argv);
    kinds = learnKinds(options);
  } catch (const PoseLogError& error) {
    std::fprintf(stderr, "fit_track: --kinds: %s\n", error.what());
    return 2;
  } catch (const ConfigError& error) {
    std::fprintf(stderr, "fit_track: %s\n%s", error.what(), kUsage);
    return 2;
  }
  std::printf("file,type,p_rigid,p_prismatic,p_rotational,radius,q_range,position_error,orientation_error_deg,milliseconds\n");
  int status = 0;
  for (const std::string& file : options.files) {
    try {
      fitFile(file, *kinds, options);
    } catch (const std::exception& error) {
      std::printf("%s,error,,,,,,,,\n", file.c_str());
      std::fprintf(stderr, "fit_track: %s\n", error.what());
      status = 1;
    }
  }
  if (status != 0 || options.plot.empty()) return status;
  try {
    plotFile(options.files.front(), options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fit_track: %s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation::core

int main(int argc, char** argv) { return cabinet_articulation::core::run(argc, argv); }

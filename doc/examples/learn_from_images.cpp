// SPDX-License-Identifier: BSD-3-Clause
// A folder of rectified image pairs -> the doors and drawers that move in it. Needs no ROS at run time.
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/pipeline/pipeline.h"

namespace core = cabinet_articulation::core;

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: learn_from_images FOLDER\n"), 2;
  const std::string folder = argv[1];
  // camera.yaml has `rate` [Hz], `fx fy cx cy` [px] and `baseline` [m]; left_0000.png and right_0000.png are the first pair.
  const cv::FileStorage file(folder + "/camera.yaml", cv::FileStorage::READ);
  const auto read = [&file](const char* name) { return static_cast<double>(file[name]); };

  core::Pipeline pipeline{core::PipelineConfig()};
  core::PipelineResult result;
  for (int i = 0;; ++i) {
    const cv::Mat left = cv::imread(folder + cv::format("/left_%04d.png", i), cv::IMREAD_GRAYSCALE);
    const cv::Mat right = cv::imread(folder + cv::format("/right_%04d.png", i), cv::IMREAD_GRAYSCALE);
    if (left.empty() || right.empty()) break;
    const core::StereoCamera camera{left.cols, left.rows, read("fx"), read("fy"), read("cx"), read("cy"), read("baseline"), 0};
    result = pipeline.process((i + 1) / read("rate"), left, right, camera);
  }

  for (const core::LearnedModel& model : result.models) {
    if (!core::isJoint(model)) continue;
    const bool turns = model.type == core::JointType::kRotational;
    std::printf("%s, %.0f %%: %.3f x %.3f m, from q = %.3f to %.3f %s\n", turns ? "door" : "drawer or other",
                100 * model.probabilities[static_cast<std::size_t>(model.type)], model.width, model.height, model.q_min,
                model.q_max, turns ? "rad" : "m");
  }
  return result.models.empty() ? 1 : 0;
}

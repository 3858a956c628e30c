// SPDX-License-Identifier: BSD-3-Clause
// Writes a simulated drawer as a folder of image pairs, for learn_from_images.
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace core = cabinet_articulation::core;

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: simulate_pairs FOLDER\n"), 2;
  const std::string folder = argv[1];
  core::SimulationConfig scene;
  scene.scene = "drawer";
  scene.rate = 5;
  core::SimulatedStereoCamera simulation(scene);

  const core::StereoCamera& camera = simulation.camera();
  cv::FileStorage file(folder + "/camera.yaml", cv::FileStorage::WRITE);
  file << "rate" << scene.rate << "fx" << camera.fx << "fy" << camera.fy;
  file << "cx" << camera.cx << "cy" << camera.cy << "baseline" << camera.baseline;

  // Until the drawer is wide open.
  double widest = 0;
  for (int i = 0; i < simulation.frameCount(); ++i) {
    const core::StereoFrame frame = simulation.frame(i);
    if (frame.truth.joints[0].q < widest) break;
    widest = frame.truth.joints[0].q;
    cv::imwrite(folder + cv::format("/left_%04d.png", i), frame.left);
    cv::imwrite(folder + cv::format("/right_%04d.png", i), frame.right);
  }
  std::printf("a drawer that comes out by %.3f m\n", widest);
  return 0;
}

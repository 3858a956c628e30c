// SPDX-License-Identifier: BSD-3-Clause
#include "model_uses.h"

#include "cabinet_articulation/joints/model_file.h"
#include "cabinet_articulation/joints/prediction.h"
#include "cabinet_articulation/joints/urdf.h"
#include "cabinet_articulation/ros/conversions.h"
#include "fuzz_target.h"
#include "joints/learned_fronts.h"
#include "ros/answers/joints.h"
#include "ros/drawing/markers.h"
#include "ros/drawing/model_drawing.h"
#include "ros/drawing/overlay.h"
#include "scratch_file.h"
#include "small_frame.h"

namespace cabinet_articulation::fuzz {
namespace {

/// Some models have no answer, and say so.
template <class Question>
void ask(const Question& question) {
  try {
    question();
  } catch (const core::ModelError&) {
  }
}

}  // namespace

std::vector<core::KnownFront> exampleFronts() {
  std::vector<core::KnownFront> fronts;
  for (const core::LearnedModel& model : {test::doorModel(), test::drawerModel(), test::garageModel()})
    fronts.push_back(test::learned(model, 6));
  return fronts;
}

std::vector<core::KnownFront> hangingFronts() {
  std::vector<core::KnownFront> fronts = exampleFronts();
  core::LearnedModel drawer = test::drawerModel();
  drawer.id = 19;
  drawer.parent = fronts[0].model.id;
  drawer.parent_probability = 0.9375;
  drawer.hollow = true;
  drawer.origin = Eigen::Isometry3d(Eigen::Translation3d(0.02, -0.1, -0.1));
  drawer.axis = Eigen::Vector3d::UnitZ();
  fronts.push_back(test::learned(drawer, 6));
  return fronts;
}

std::vector<core::Track> tracksOf(const std::vector<core::KnownFront>& fronts) {
  std::vector<core::Track> tracks;
  for (const core::KnownFront& front : fronts) tracks.push_back(front.track);
  return tracks;
}

std::vector<core::DetectedRectangle> seenAgain(const std::vector<core::KnownFront>& fronts) {
  std::vector<core::DetectedRectangle> rectangles;
  for (const core::KnownFront& front : fronts) {
    if (front.track.observations.empty()) continue;
    core::DetectedRectangle rectangle;
    rectangle.rectangle = front.track.observations.back().rectangle;
    rectangle.covariance.diagonal().setConstant(4e-6);
    rectangle.edge_support = {1, 1, 1, 1};
    rectangle.precision = rectangle.recall = 0.95;
    rectangles.push_back(rectangle);
  }
  return rectangles;
}

void useModels(const std::vector<core::LearnedModel>& models, const std::string& frame) {
  std_msgs::Header header = test::exampleHeader();
  header.frame_id = frame;
  toMessage(models, header);
  jointTransforms(models, header, "cabinet");
  jointStates(models, header);
  lastJointStates(models, frame);
  visualization_msgs::MarkerArray markers;
  addMarkers(models, header, &markers);
  const SmallFrame small;
  cv::Mat3b picture(small.camera().height, small.camera().width);
  drawOverlay(small.camera(), {}, models, &picture);
  ask([&] { core::toUrdf(models, frame, "cabinet"); });
  for (const core::LearnedModel& model : models) {
    ask([&] { core::toUrdf({model}, frame, "cabinet"); });
    ask([&] { core::predictWithCovariance(model, model.q_max); });
    ask([&] { core::findConfiguration(model, test::facingCamera(0.1, 0.2, 1.5)); });
    ask([&] { core::handlePath(model, test::facingCamera(0.1, 0, 0), model.q_min, model.q_max, 3); });
  }
}

void saveAndLoad(const std::vector<core::KnownFront>& fronts, const std::string& frame,
                 const std::vector<core::JointShape>& kinds) {
  static const ScratchFile file("saved.yaml");
  file.remove();
  try {
    core::ModelFile models{frame, fronts};
    models.kinds = kinds;
    core::saveModelFile(file.path(), models);
    core::readModelFile(file.path());
  } catch (const core::ModelFileError& error) {
    detail::report(std::string("what is known cannot be saved and loaded: ") + error.what());
  }
}

}  // namespace cabinet_articulation::fuzz

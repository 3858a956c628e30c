// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/image_conversions.h"
#include "messages.h"
#include "model_uses.h"
#include "ros/drawing/markers.h"
#include "ros/drawing/model_drawing.h"
#include "ros/drawing/overlay.h"
#include "ros/input/input_settings.h"
#include "small_frame.h"

using namespace cabinet_articulation;

fuzz::Seeds fuzz::seeds() {
  const SmallFrame frame;
  std::vector<core::LearnedModel> models = modelsOf(hangingFronts());
  models.push_back(test::unexplainedModel());
  const RectangleArray rectangles = toMessage(seenAgain(exampleFronts()), frame.header);
  return {{serialized(frame.info(false), exampleTransform(), rectangles, toMessage(models, frame.header))}};
}

/// Rectangles and models, as the overlay stage gets them, with the camera to draw them for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    const core::StereoCamera camera =
        toDepthCamera(*reader.next<sensor_msgs::CameraInfo>(), "info", FrameInputConfig().virtual_baseline);
    const Eigen::Isometry3d T_fixed_camera = fuzz::throughTf(*reader.next<geometry_msgs::TransformStamped>());
    const auto rectangles = fromMessage(*reader.next<RectangleArray>());
    const auto message = reader.next<ArticulationModelArray>();
    std::vector<core::LearnedModel> models = core::allPlaced(fromMessage(*message));
    visualization_msgs::MarkerArray markers;
    addMarkers(rectangles, message->header, &markers);
    addMarkers(models, message->header, &markers);
    for (core::LearnedModel& model : models) model = transformed(model, T_fixed_camera.inverse());
    cv::Mat3b picture(48, 64);
    drawOverlay(camera, rectangles, models, &picture);
  });
}

// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include "bag_transforms.h"
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "frame_bag.h"
#include "fuzz_target.h"
#include "scratch_file.h"
#include "small_frame.h"

using namespace cabinet_articulation;

namespace {

std::string bagOf(const std::function<void(const fuzz::SmallFrame&, rosbag::Bag*)>& write) {
  const fuzz::SmallFrame frame;
  const fuzz::ScratchFile file("seed.bag");
  rosbag::Bag bag(file.path(), rosbag::bagmode::Write);
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {fuzz::exampleTransform()};
  bag.write("/tf", frame.header.stamp, transforms);
  write(frame, &bag);
  bag.close();
  return file.read();
}

}  // namespace

std::vector<std::string> fuzz::seeds() {
  return {bagOf([](const SmallFrame& frame, rosbag::Bag* bag) {
            for (const bool right : {false, true}) {
              const std::string camera = right ? "/stereo/right/" : "/stereo/left/";
              bag->write(camera + "camera_info", frame.header.stamp, frame.info(right));
              bag->write(camera + "image_raw", frame.header.stamp, frame.image(right));
            }
          }),
          bagOf([](const SmallFrame& frame, rosbag::Bag* bag) {
            bag->write("/stereo/left/camera_info", frame.header.stamp, frame.info(false));
            bag->write("/stereo/disparity", frame.header.stamp, frame.disparity());
          }),
          bagOf([](const SmallFrame& frame, rosbag::Bag* bag) {
            bag->write("/stereo/depth/camera_info", frame.header.stamp, frame.info(false));
            bag->write("/stereo/depth/image", frame.header.stamp, frame.depth());
          })};
}

/// The way of process_bag from a file to the frames; it tells in words of every exception. Which input it is looks the bag up.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file("input.bag");
  static core::PlaneSegmenter segmenter{core::PlanesConfig()};
  file.write(data, size);
  return fuzz::examine<std::exception>([] {
    std::optional<FrameBag> bag;
    for (const char* const kind : {"disparity", "depth", "stereo"}) {
      try {
        bag.emplace(file.path(), kind, "");
        break;
      } catch (const std::exception&) {
        bag.reset();
      }
    }
    if (!bag) throw std::runtime_error("no input");
    const BagTransforms transforms(bag->bag());
    SkippedFrames skipped;
    bag->forEachFrame(
        [&](const std_msgs::Header& header, const FrameViews& views) {
          try {
            transforms.lookup("map", header.frame_id, header.stamp);
          } catch (const tf2::TransformException& error) {
            skipped.add("no transform", error.what());
          }
          if (!views.frame.disparity.empty()) segmenter.process(views.frame);
        },
        &skipped);
  });
}

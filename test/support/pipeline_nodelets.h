// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

#include <string>
#include <vector>

namespace cabinet_articulation {
namespace test {

/// The whole pipeline behind a simulated camera, as loadNodelet() knows it.
inline const std::vector<std::string> kNodelets = {"/stereo/camera",      "/cabinet/stereo",   "/cabinet/planes",
                                                   "/cabinet/rectangles", "/cabinet/tracking", "/cabinet/articulation",
                                                   "/cabinet/overlay"};

/// Into the manager "/manager". False if that fails.
inline bool loadNodelet(const std::string& name) {
  nodelet::NodeletLoad load;
  load.request.name = name;
  load.request.type = "cabinet_articulation/" + (name == "/stereo/camera" ? "simulated_stereo_camera" : name.substr(9));
  for (const std::string side : {"left", "right"}) {
    load.request.remap_source_args.push_back("/cabinet/" + side + "/image_rect");
    load.request.remap_target_args.push_back("/stereo/" + side + "/image_raw");
    load.request.remap_source_args.push_back("/cabinet/" + side + "/camera_info");
    load.request.remap_target_args.push_back("/stereo/" + side + "/camera_info");
  }
  return ros::service::call("/manager/load_nodelet", load);
}

inline bool unloadNodelet(const std::string& name) {
  nodelet::NodeletUnload unload;
  unload.request.name = name;
  return ros::service::call("/manager/unload_nodelet", unload);
}

}  // namespace test
}  // namespace cabinet_articulation

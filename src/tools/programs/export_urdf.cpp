// SPDX-License-Identifier: BSD-3-Clause
// export_urdf [ID]...: prints the joints that a running pipeline has learned (all, or these) as a robot description.
#include <cabinet_articulation/ExportUrdf.h>
#include <ros/ros.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace {

constexpr double kPatience = 5;  // [s] for a pipeline that is just starting

cabinet_articulation::ExportUrdf::Response ask(int argc, char** argv) {
  cabinet_articulation::ExportUrdf call;
  for (int i = 1; i < argc; ++i) call.request.ids.push_back(static_cast<std::uint32_t>(std::stoul(argv[i])));
  if (!ros::master::check()) throw std::runtime_error("no master at " + ros::master::getURI());
  ros::NodeHandle nh;
  const std::string service = nh.resolveName("export_urdf");
  if (!ros::service::waitForService(service, ros::Duration(kPatience)) || !ros::service::call(service, call))
    throw std::runtime_error(service + " does not answer; is the pipeline running in this namespace (__ns:=cabinet)?");
  if (!call.response.success) throw std::runtime_error(call.response.message);
  return call.response;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "export_urdf", ros::init_options::AnonymousName);
  try {
    std::printf("%s\n", ask(argc, argv).urdf.c_str());
  } catch (const std::invalid_argument&) {
    std::fprintf(stderr, "usage: export_urdf [ID]... [__ns:=NAMESPACE] > FILE\n");
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "export_urdf: %s\n", error.what());
    return 1;
  }
  return 0;
}

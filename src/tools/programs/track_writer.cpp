// SPDX-License-Identifier: BSD-3-Clause
// Writes every track of a bag that has `tracks` (a recording, or process_bag's result) as a log in the original release's
// format, as it was when it was seen last: FOLDER/track_ID.log.
#include <cabinet_articulation/TrackArray.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "cabinet_articulation/ros/conversions.h"
#include "config/ordinary_file.h"
#include "tools/input/message_stream.h"
#include "tools/input/pose_log.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] = "usage: track_writer IN.bag FOLDER\n";

std::map<std::uint32_t, core::Track> lastTracks(const std::string& path) {
  core::requireOrdinaryFile(path);
  const rosbag::Bag bag(path, rosbag::bagmode::Read);
  core::TrackAssembly assembly;
  std::map<std::uint32_t, core::Track> ended;
  for (const rosbag::MessageInstance& entry : rosbag::View(bag)) {
    const TrackArrayConstPtr message = readMessage<TrackArray>(entry);
    if (!message) continue;
    assembly.add(fromMessage(*message));
    for (const core::Track& track : assembly.ended()) ended[track.id] = track;
  }
  std::map<std::uint32_t, core::Track> tracks = std::move(ended);
  for (const core::Track& track : assembly.tracks()) tracks[track.id] = track;
  return tracks;
}

void write(const std::string& bag, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& [id, track] : lastTracks(bag)) {
    const std::filesystem::path path = folder / ("track_" + std::to_string(id) + ".log");
    std::ofstream out(path);
    core::writePoseLog(track, out);
    if (!out.flush()) throw std::runtime_error(path.string() + " cannot be written");
    std::printf("%s: %zu poses\n", path.c_str(), track.observations.size());
  }
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  return runProgram("track_writer", kUsage, [&] {
    if (argc != 3) throw std::invalid_argument("two arguments are expected");
    write(argv[1], argv[2]);
    return 0;
  });
}

// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "sources/track_source.h"
#include "tools/input/pose_log.h"

namespace cabinet_articulation::core::evaluation {
namespace {

class PoseLogSource : public TrackSource {
 public:
  PoseLogSource(const std::string& path, const std::string& name, const std::string& type) : log_(readPoseLog(path)) {
    static const std::map<std::string, JointType> kTypes{{"rigid", JointType::kRigid},
                                                         {"prismatic", JointType::kPrismatic},
                                                         {"rotational", JointType::kRotational},
                                                         {"other", JointType::kRigid}};
    const auto known = kTypes.find(type);
    if (known == kTypes.end()) throw std::runtime_error(path + ": unknown type " + type);
    facts_ = {name, known->second, type != "other", log_.columns > 3};
    const Eigen::Vector3d start = log_.track.observations.at(0).rectangle.center();
    for (const TrackedObservation& observation : log_.track.observations)
      reference_.push_back({observation.rectangle, (observation.rectangle.center() - start).norm()});
  }

  const SourceFacts& facts() const override { return facts_; }
  const std::vector<ReferencePose>& reference() const override { return reference_; }

  void observe(const std::vector<int>& picked, const std::function<void(const SeenFront&)>& visit) const override {
    Track track = log_.track;
    track.observations.clear();
    for (const int i : picked) {
      track.observations.push_back(log_.track.observations[i]);
      visit({track});
    }
  }

 private:
  PoseLog log_;
  SourceFacts facts_;
  std::vector<ReferencePose> reference_;
};

}  // namespace

std::vector<LabelledLog> findLogs(const std::string& folder) {
  std::vector<LabelledLog> logs;
  if (folder.empty()) return logs;
  std::ifstream labels(folder + "/labels.csv");
  if (!labels) throw std::runtime_error("cannot read " + folder + "/labels.csv");
  std::string line, file, type;
  std::getline(labels, line);  // header
  while (std::getline(labels, line)) {
    std::istringstream cells(line);
    if (std::getline(cells, file, ',') && std::getline(cells, type, ',')) logs.push_back({folder + "/" + file, file, type});
  }
  return logs;
}

std::unique_ptr<TrackSource> openPoseLog(const std::string& path, const std::string& name, const std::string& type) {
  return std::make_unique<PoseLogSource>(path, name, type);
}

}  // namespace cabinet_articulation::core::evaluation

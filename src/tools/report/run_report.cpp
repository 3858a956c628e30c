// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/run_report.h"

#include <unistd.h>

#include <stdexcept>

#include "joints/safe_file.h"

namespace cabinet_articulation {
namespace {

namespace fs = std::filesystem;

constexpr char kPage[] = "index.html";

/// Throws for one with things that no report has.
void requireNothingElse(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != kPage || !entry.is_regular_file())
      throw std::runtime_error("holds other things, such as '" + entry.path().filename().string() +
                               "'; name a folder that is new or empty");
}

/// Adds the folder to what is thrown.
template <class Action>
void onFolder(const fs::path& folder, const Action& action) {
  try {
    action();
  } catch (const fs::filesystem_error& error) {
    throw std::runtime_error("--report " + folder.string() + ": cannot be written (" + error.code().message() + ")");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("--report " + folder.string() + ": " + error.what());
  }
}

}  // namespace

RunReport::RunReport(const std::string& folder) : folder_(folder) {
  onFolder(folder_, [this] {
    fs::path there = fs::absolute(folder_);
    while (!fs::exists(there)) there = there.parent_path();
    if (!fs::is_directory(there)) throw std::runtime_error("'" + there.string() + "' is no folder");
    if (::access(there.c_str(), W_OK | X_OK) != 0) throw std::runtime_error("you may not write in '" + there.string() + "'");
    if (fs::exists(folder_)) requireNothingElse(folder_);
  });
}

void RunReport::add(double stamp, const core::PipelineResult& result, const Eigen::Isometry3d& T_fixed_camera) {
  const std::vector<std::uint32_t> new_joints = record_.add(stamp, result);
  pictures_.add(record_.end(), result, T_fixed_camera, new_joints);
}

std::string RunReport::write(const RunFacts& facts, const RunSummary& summary) {
  record_.close();
  const std::string page = reportPage(facts, record_, pictures_, summary);
  const fs::path path = folder_ / kPage;
  onFolder(folder_, [&] {
    fs::create_directories(folder_);
    core::replaceFile(path, page, core::FolderLock(folder_));
  });
  return path.string();
}

Eigen::Vector3d upwardsIn(const std::string& frame) {
  const bool optical = frame.empty() || frame.find("optical") != std::string::npos;
  return optical ? Eigen::Vector3d(-Eigen::Vector3d::UnitY()) : Eigen::Vector3d::UnitZ();
}

}  // namespace cabinet_articulation

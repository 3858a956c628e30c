// SPDX-License-Identifier: BSD-3-Clause
// Paper, Fig. 11: how often a front is found, how many planes must be searched for it, and how far its pose errs, against its
// distance.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <tuple>

#include "csv_writer.h"
#include "detection_score.h"
#include "failure_picture.h"
#include "options.h"
#include "parallel.h"
#include "recorded_sequence.h"
#include "simulated_sources.h"
#include "statistics.h"
#include "variants.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr double kBin = 0.3;  // [m] of the table against distance

/// One front in one frame in which it can be detected.
struct Judged {
  std::string source, variant, front;
  int frame = 0;
  double distance = 0;  ///< [m] from the camera to the front's centre
  int planes = 0;       ///< that the frame offers
  double searched = 0;  ///< planes searched until the front was found, NaN if it was not
  int others = 0;       ///< rectangles of the frame that are no judged front
  DetectionScore score;
};

/// Frames [first, last) of one source, seen by one variant, in order.
struct Job {
  SourceFactory open;
  Variant variant;
  int first, last;
  std::vector<Judged> result;
};

void judgeFrame(const Frame& frame, const StereoCamera& camera, const std::vector<DetectedRectangle>& rectangles, Judged common,
                const std::string& failures, std::vector<Judged>* result) {
  const std::size_t begin = result->size();
  int found = 0;
  for (const Front& front : frame.fronts) {
    if (!canBeDetected(front)) continue;
    common.front = front.name;
    common.distance = front.rectangle.center().norm();
    common.score = scoreDetection(front.rectangle, rectangles);
    common.searched = common.score.detected ? rectangles[common.score.best].region + 1 : std::nan("");
    result->push_back(common);
    found += common.score.detected;
    if (common.score.detected || failures.empty()) continue;
    std::string name = common.source + "_" + common.variant + "_" + front.name + "_" + std::to_string(common.frame);
    std::replace(name.begin(), name.end(), '/', '-');
    cv::imwrite(failures + "/" + name + ".png", drawFailure(frame, camera, front.rectangle, rectangles, common.score));
  }
  for (std::size_t i = begin; i < result->size(); ++i) (*result)[i].others = static_cast<int>(rectangles.size()) - found;
}

void runJob(const std::string& failures, Job* job) {
  const std::unique_ptr<FrameSource> source = job->open();
  Pipeline pipeline(job->variant.config);
  for (int i = job->first; i < std::min(job->last, source->size()); ++i) {
    const Frame frame = source->frame(i);
    if (source->independent() || !job->variant.tracks_guide) pipeline.reset();
    const PipelineResult seen = pipeline.process(frame.stamp, frame.left, frame.right, source->camera(), frame.T_world_camera);
    Judged common;
    common.source = source->name();
    common.variant = job->variant.name;
    common.frame = i;
    common.planes = static_cast<int>(seen.planes.size());
    judgeFrame(frame, source->camera(), seen.rectangles, common, failures, &job->result);
  }
}

void addJobs(const SourceFactory& open, std::vector<Job>* jobs) {
  constexpr int kBlock = 25;  // independent frames need not be seen by one thread
  const std::unique_ptr<FrameSource> source = open();
  const int step = source->independent() ? kBlock : source->size();
  for (int first = 0; first < source->size(); first += step)
    for (const Variant& variant : {ourVariant(), paperVariant()}) jobs->push_back({open, variant, first, first + step, {}});
}

std::vector<Job> makeJobs(const Options& options) {
  std::vector<Job> jobs;
  const int poses = options.count("poses"), seed = options.count("seed");
  if (poses > 0) addJobs([=] { return simulateHangingDrawer(poses, seed); }, &jobs);
  for (int i = 0; i < options.count("scenes"); ++i)
    for (const char* scene : {"door", "drawer", "pedestal"}) {
      SimulationConfig config;
      config.scene = scene;
      config.scene_seed = seed + i;
      addJobs([=] { return simulateRun(config); }, &jobs);
    }
  for (const std::string& folder : findSequences(options.text("sequences"), false))
    addJobs([=] { return openRecordedSequence(folder); }, &jobs);
  return jobs;
}

template <class Value>
std::vector<double> collect(const std::vector<Judged>& rows, bool detected_only, Value value) {
  std::vector<double> values;
  for (const Judged& row : rows)
    if (row.score.detected || !detected_only) values.push_back(value(row));
  return values;
}

const char* const kStatisticsHeader =
    "judged,detected,rate,planes_mean,searched_mean,center_mm_mean,center_mm_median,normal_deg_mean,normal_deg_median,"
    "in_plane_deg_median,width_mm_median,height_mm_median,others_median";

template <class... Keys>
void writeStatistics(CsvWriter* csv, const std::vector<Judged>& rows, const Keys&... keys) {
  const auto of = [&rows](auto value) { return collect(rows, true, value); };
  const auto center = of([](const Judged& row) { return 1e3 * row.score.center; });
  const auto normal = of([](const Judged& row) { return kDegrees * row.score.normal; });
  csv->row(keys..., static_cast<int>(rows.size()), static_cast<int>(center.size()),
           static_cast<double>(center.size()) / rows.size(),
           mean(collect(rows, false, [](const Judged& row) { return row.planes; })),
           mean(of([](const Judged& row) { return row.searched; })), mean(center), median(center), mean(normal), median(normal),
           median(of([](const Judged& row) { return kDegrees * row.score.in_plane; })),
           median(of([](const Judged& row) { return std::abs(1e3 * row.score.width); })),
           median(of([](const Judged& row) { return std::abs(1e3 * row.score.height); })),
           median(collect(rows, false, [](const Judged& row) { return row.others; })));
}

void writeTables(const std::vector<Judged>& judged, const Options& options) {
  CsvWriter frames(options.out("fig11_frames.csv"),
                   "source,variant,front,frame,distance_m,planes,searched,others,detected,iou,center_mm,offset_mm,normal_deg,"
                   "in_plane_deg,width_mm,height_mm");
  std::map<std::tuple<std::string, std::string, int>, std::vector<Judged>> by_distance;
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<Judged>> by_front;
  for (const Judged& row : judged) {
    const DetectionScore& score = row.score;
    frames.row(row.source, row.variant, row.front, row.frame, row.distance, row.planes, row.searched, row.others, score.detected,
               score.iou, 1e3 * score.center, 1e3 * score.offset, kDegrees * score.normal, kDegrees * score.in_plane,
               1e3 * score.width, 1e3 * score.height);
    by_distance[{row.source, row.variant, static_cast<int>(std::floor(row.distance / kBin))}].push_back(row);
    by_front[{row.source, row.front, row.variant}].push_back(row);
  }
  CsvWriter distances(options.out("fig11.csv"), std::string("source,variant,distance_from_m,distance_to_m,") + kStatisticsHeader);
  for (const auto& [key, rows] : by_distance)
    writeStatistics(&distances, rows, std::get<0>(key), std::get<1>(key), kBin * std::get<2>(key), kBin * (std::get<2>(key) + 1));
  CsvWriter fronts(options.out("fig11_fronts.csv"), std::string("source,front,variant,") + kStatisticsHeader);
  for (const auto& [key, rows] : by_front) writeStatistics(&fronts, rows, std::get<0>(key), std::get<1>(key), std::get<2>(key));
}

int run(int argc, char** argv) {
  const Options options(argc, argv, {{"poses", "500"}, {"scenes", "1"}, {"seed", "1"}, {"sequences", ""}, {"failures", ""}});
  const std::string failures = options.text("failures");
  if (!failures.empty()) std::filesystem::create_directories(failures);
  cv::setNumThreads(1);  // the cores work on different frames
  std::vector<Job> jobs = makeJobs(options);
  parallelFor(static_cast<int>(jobs.size()), [&](int i) { runJob(failures, &jobs[i]); });
  std::vector<Judged> judged;
  for (Job& job : jobs) std::move(job.result.begin(), job.result.end(), std::back_inserter(judged));
  writeTables(judged, options);
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  return cabinet_articulation::core::evaluation::runProgram(argc, argv, cabinet_articulation::core::evaluation::run);
}

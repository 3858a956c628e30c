// SPDX-License-Identifier: BSD-3-Clause
#include "tables/detection_table.h"

#include <cmath>
#include <map>
#include <tuple>

#include "geometry/degrees.h"
#include "tables/csv_writer.h"
#include "tables/statistics.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kBin = 0.3;  // [m] of the table against distance

template <class Value>
std::vector<double> collect(const std::vector<Judged>& rows, bool detected_only, Value value) {
  std::vector<double> values;
  for (const Judged& row : rows)
    if (row.score.detected || !detected_only) values.push_back(value(row));
  return values;
}

const char* const kStatisticsHeader =
    "judged,detected,rate,planes_mean,searched_mean,center_mm_mean,center_mm_median,orientation_deg_mean,normal_deg_median,"
    "in_plane_deg_median,width_mm_median,height_mm_median,others_median";

template <class... Keys>
void writeStatistics(CsvWriter* csv, const std::vector<Judged>& rows, const Keys&... keys) {
  const auto of = [&rows](auto value) { return collect(rows, true, value); };
  const auto center = of([](const Judged& row) { return 1e3 * row.score.center; });
  csv->row(keys..., static_cast<int>(rows.size()), static_cast<int>(center.size()),
           static_cast<double>(center.size()) / rows.size(),
           mean(collect(rows, false, [](const Judged& row) { return row.planes; })),
           mean(of([](const Judged& row) { return row.searched; })), mean(center), median(center),
           mean(of([](const Judged& row) { return toDegrees(row.score.orientation); })),
           median(of([](const Judged& row) { return toDegrees(row.score.normal); })),
           median(of([](const Judged& row) { return toDegrees(row.score.in_plane); })),
           median(of([](const Judged& row) { return std::abs(1e3 * row.score.width); })),
           median(of([](const Judged& row) { return std::abs(1e3 * row.score.height); })),
           median(collect(rows, false, [](const Judged& row) { return row.others; })));
}

}  // namespace

std::vector<Judged> judge(const Frame& frame, const PipelineResult& seen) {
  std::vector<Judged> judged;
  int found = 0;
  for (const Front& front : frame.fronts) {
    if (!canBeDetected(front)) continue;
    Judged row;
    row.front = front.name;
    row.distance = front.rectangle.center().norm();
    row.planes = static_cast<int>(seen.planes.size());
    row.score = scoreDetection(front.rectangle, seen.rectangles);
    row.searched = row.score.detected ? seen.rectangles[row.score.best].region + 1 : std::nan("");
    found += row.score.detected;
    judged.push_back(row);
  }
  for (Judged& row : judged) row.others = static_cast<int>(seen.rectangles.size()) - found;
  return judged;
}

void writeDetectionTables(const std::vector<Judged>& judged, const std::string& prefix) {
  CsvWriter frames(prefix + "_frames.csv",
                   "source,variant,front,frame,distance_m,planes,searched,others,detected,iou,center_mm,offset_mm,"
                   "orientation_deg,normal_deg,in_plane_deg,width_mm,height_mm");
  std::map<std::tuple<std::string, std::string, int>, std::vector<Judged>> by_distance;
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<Judged>> by_front;
  for (const Judged& row : judged) {
    const DetectionScore& score = row.score;
    frames.row(row.source, row.variant, row.front, row.frame, row.distance, row.planes, row.searched, row.others, score.detected,
               score.iou, 1e3 * score.center, 1e3 * score.offset, toDegrees(score.orientation), toDegrees(score.normal),
               toDegrees(score.in_plane), 1e3 * score.width, 1e3 * score.height);
    by_distance[{row.source, row.variant, static_cast<int>(std::floor(row.distance / kBin))}].push_back(row);
    by_front[{row.source, row.front, row.variant}].push_back(row);
  }
  CsvWriter distances(prefix + ".csv", std::string("source,variant,distance_from_m,distance_to_m,") + kStatisticsHeader);
  for (const auto& [key, rows] : by_distance) {
    const auto& [source, variant, bin] = key;
    writeStatistics(&distances, rows, source, variant, kBin * bin, kBin * (bin + 1));
  }
  CsvWriter fronts(prefix + "_fronts.csv", std::string("source,front,variant,") + kStatisticsHeader);
  for (const auto& [key, rows] : by_front) {
    const auto& [source, front, variant] = key;
    writeStatistics(&fronts, rows, source, front, variant);
  }
}

}  // namespace cabinet_articulation::core::evaluation

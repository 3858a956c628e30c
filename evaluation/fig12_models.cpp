// SPDX-License-Identifier: BSD-3-Clause
// Paper, Fig. 12: which type of joint is learned, and how well it predicts, against the number of observations. Beyond the
// paper: openings that were never seen, and whether the published covariances are right.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <opencv2/core/utility.hpp>
#include <sstream>

#include "cabinet_articulation/articulation/model_registry.h"
#include "csv_writer.h"
#include "interval_coverage.h"
#include "learning_curve.h"
#include "options.h"
#include "parallel.h"
#include "recorded_sequence.h"
#include "simulated_sources.h"
#include "statistics.h"
#include "track_source.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr double kConfident = 0.95;
constexpr int kFrames = 100;  // of each sub-sample (paper, IV-B)
const std::vector<int> kCounts{2, 3, 5, 8, 10, 15, 20, 30, 40, 50, 60, 80, 100};
const std::vector<double> kShares{0.3, 0.5};

/// All that is asked about one source.
struct Study {
  std::function<std::unique_ptr<TrackSource>()> open;
  std::unique_ptr<TrackSource> source;
  std::vector<CurvePoint> curve;
  std::vector<UnseenOpening> unseen;
  std::optional<IntervalCheck> halves;
};

void runStudy(int runs, Study* study) {
  study->source = study->open();
  study->curve = learningCurve(*study->source, runs, kFrames, kCounts);
  if (!study->source->explainable()) return;
  for (const double share : kShares) study->unseen.push_back(predictUnseen(*study->source, share));
  study->halves = compareHalves(*study->source);
}

/// `labels.csv` in the folder names the logs and their types: file,type,...
std::vector<Study> logStudies(const std::string& folder) {
  std::vector<Study> studies;
  if (folder.empty()) return studies;
  std::ifstream labels(folder + "/labels.csv");
  if (!labels) throw std::runtime_error("cannot read " + folder + "/labels.csv");
  std::string line, file, type;
  std::getline(labels, line);  // header
  while (std::getline(labels, line)) {
    std::istringstream cells(line);
    if (!std::getline(cells, file, ',') || !std::getline(cells, type, ',')) continue;
    studies.push_back({[=] { return openPoseLog(folder + "/" + file, file, type); }, nullptr, {}, {}, {}});
  }
  return studies;
}

std::vector<Study> makeStudies(const Options& options) {
  std::vector<Study> studies = logStudies(options.text("tracks"));
  for (int i = 0; i < options.count("scenes"); ++i)
    for (const char* scene : {"door", "drawer"}) {
      SimulationConfig config;
      config.scene = scene;
      config.scene_seed = options.count("seed") + i;
      config.rate = 30;  // more frames than one sub-sample takes
      studies.push_back({[=] { return trackFrames(*simulateRun(config)); }, nullptr, {}, {}, {}});
    }
  for (const std::string& folder : findSequences(options.text("sequences"), false)) {
    const Frame first = openRecordedSequence(folder)->frame(0);
    const auto moves = [](const Front& front) { return front.type != JointType::kRigid; };
    if (std::any_of(first.fronts.begin(), first.fronts.end(), moves))
      studies.push_back({[=] { return trackFrames(*openRecordedSequence(folder)); }, nullptr, {}, {}, {}});
  }
  return studies;
}

std::string trueName(const TrackSource& source) { return source.explainable() ? modelName(source.type()) : "other"; }

double probabilityOfTruth(const CurvePoint& point, const TrackSource& source) {
  return isRight(point.model, source) ? point.model.probabilities[static_cast<std::size_t>(point.model.type)] : 0;
}

void writeCurveSummary(const TrackSource& source, int observations, const std::vector<const CurvePoint*>& points,
                       CsvWriter* csv) {
  std::vector<double> right, confident, position, orientation, residual, p[3];
  for (const CurvePoint* point : points) {
    right.push_back(isRight(point->model, source));
    confident.push_back(probabilityOfTruth(*point, source) > kConfident);
    for (std::size_t i = 0; i < 3; ++i) p[i].push_back(point->model.probabilities[i]);
    position.push_back(1e3 * point->error.position);
    orientation.push_back(kDegrees * point->error.orientation);
    residual.push_back(1e3 * point->model.position_error);
  }
  csv->row(source.name(), trueName(source), observations, static_cast<int>(points.size()), mean(right), mean(confident),
           mean(p[0]), mean(p[1]), mean(p[2]), mean(position), standardDeviation(position),
           source.hasOrientation() ? mean(orientation) : std::nan(""), mean(residual));
}

void writeCurves(const std::vector<Study>& studies, const Options& options) {
  CsvWriter runs(options.out("fig12_runs.csv"),
                 "source,type,run,observations,selected,p_rigid,p_prismatic,p_rotational,error_mm,error_deg,residual_mm");
  CsvWriter summary(options.out("fig12.csv"),
                    "source,type,observations,runs,right_share,confident_share,p_rigid,p_prismatic,p_rotational,error_mm_mean,"
                    "error_mm_deviation,error_deg_mean,residual_mm_mean");
  for (const Study& study : studies) {
    const TrackSource& source = *study.source;
    std::map<int, std::vector<const CurvePoint*>> by_count;
    for (const CurvePoint& point : study.curve) {
      const LearnedModel& model = point.model;
      by_count[model.observations].push_back(&point);
      runs.row(source.name(), trueName(source), point.run, model.observations, selectedName(model), model.probabilities[0],
               model.probabilities[1], model.probabilities[2], 1e3 * point.error.position,
               source.hasOrientation() ? kDegrees * point.error.orientation : std::nan(""), 1e3 * model.position_error);
    }
    for (const auto& [count, points] : by_count) writeCurveSummary(source, count, points, &summary);
  }
}

void writeUnseen(const std::vector<Study>& studies, const Options& options) {
  CsvWriter csv(options.out("fig12_unseen.csv"),
                "source,type,trained_share,observations,selected,error_mm,error_deg,true_type_error_mm,true_type_error_deg");
  for (const Study& study : studies)
    for (const UnseenOpening& unseen : study.unseen) {
      const auto millimetres = [](const auto& error) { return error ? 1e3 * error->position : std::nan(""); };
      const auto degrees = [&](const auto& error) {
        return error && study.source->hasOrientation() ? kDegrees * error->orientation : std::nan("");
      };
      csv.row(study.source->name(), trueName(*study.source), unseen.share, unseen.selected ? unseen.selected->observations : 0,
              unseen.selected ? selectedName(*unseen.selected) : "none", millimetres(unseen.selected_error),
              degrees(unseen.selected_error), millimetres(unseen.true_type_error), degrees(unseen.true_type_error));
    }
}

/// One row: how many of the checks fall inside the interval, and the median in standard deviations.
void writeCoverage(const std::string& name, const std::string& quantity, const std::vector<double>& checks, CsvWriter* csv) {
  std::vector<double> inside;
  for (const double check : checks) inside.push_back(check <= 1);
  csv->row(name, quantity, static_cast<int>(checks.size()), mean(inside), median(checks));
}

void writeIntervals(const std::vector<Study>& studies, const Options& options) {
  CsvWriter csv(options.out("fig12_intervals.csv"), "source,quantity,checks,inside_95,median_of_limit");
  const int fronts = options.count("fronts");
  for (const JointType type : {JointType::kPrismatic, JointType::kRotational}) {
    std::vector<std::optional<IntervalCheck>> checks(fronts);
    parallelFor(fronts, [&](int i) {
      const NoisyFront front = simulateNoisyFront(type, options.count("seed") + i);
      const LearnedModel model = ArticulationLearner({}).process({front.track}).at(0);
      if (model.type == type) checks[i] = checkIntervals(AxisEstimate::of(model), front.truth);
    });
    std::vector<double> axis, radius;
    for (const auto& check : checks) {
      if (check) axis.push_back(check->axis);
      if (check && check->radius) radius.push_back(*check->radius);
    }
    const std::string name = std::string("simulated_") + modelName(type);
    writeCoverage(name, "axis", axis, &csv);
    if (type == JointType::kRotational) writeCoverage(name, "radius", radius, &csv);
  }
  std::vector<double> axis, radius;
  for (const Study& study : studies) {
    if (study.halves) axis.push_back(study.halves->axis);
    if (study.halves && study.halves->radius) radius.push_back(*study.halves->radius);
  }
  writeCoverage("halves_of_sources", "axis", axis, &csv);
  writeCoverage("halves_of_sources", "radius", radius, &csv);
}

int run(int argc, char** argv) {
  const Options options(argc, argv,
                        {{"runs", "50"}, {"scenes", "2"}, {"fronts", "300"}, {"seed", "1"}, {"sequences", ""}, {"tracks", ""}});
  cv::setNumThreads(1);  // the cores work on different sources
  std::vector<Study> studies = makeStudies(options);
  const int runs = options.count("runs");
  parallelFor(static_cast<int>(studies.size()), [&](int i) { runStudy(runs, &studies[i]); });
  writeCurves(studies, options);
  writeUnseen(studies, options);
  writeIntervals(studies, options);
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  return cabinet_articulation::core::evaluation::runProgram(argc, argv, cabinet_articulation::core::evaluation::run);
}

// SPDX-License-Identifier: BSD-3-Clause
// Paper, Fig. 12: which type of joint is learned, and how well it predicts, against the number of observations. Beyond the
// paper: openings that were never seen, and whether the published covariances are right.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <opencv2/core/utility.hpp>

#include "articulation/models/model_registry.h"
#include "geometry/degrees.h"
#include "programs/options.h"
#include "programs/parallel.h"
#include "scores/interval_coverage.h"
#include "scores/learning_curve.h"
#include "sources/recorded_sequence.h"
#include "sources/simulated_sources.h"
#include "sources/track_source.h"
#include "tables/csv_writer.h"
#include "tables/statistics.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kConfident = 0.95;
constexpr int kFrames = 100;  // of each sub-sample (paper, IV-B)
const std::vector<int> kCounts{2, 3, 5, 8, 10, 15, 20, 30, 40, 50, 60, 80, 100};
const std::vector<double> kShares{0.3, 0.5};

/// All that is asked about one source.
struct Study {
  const char* kind;  ///< logs or images
  std::function<std::unique_ptr<TrackSource>()> open;
  SourceFacts facts;
  std::vector<CurvePoint> curve;
  std::vector<UnseenOpening> unseen;
  std::optional<IntervalCheck> halves;
};

void runStudy(int runs, Study* study) {
  const std::unique_ptr<TrackSource> source = study->open();
  study->facts = source->facts();
  study->curve = learningCurve(*source, runs, kFrames, kCounts);
  if (!study->facts.explainable) return;
  for (const double share : kShares) study->unseen.push_back(predictUnseen(*source, share));
  study->halves = compareHalves(*source);
}

std::vector<Study> makeStudies(const Options& options) {
  std::vector<Study> studies;
  for (const LabelledLog& log : findLogs(options.text("tracks")))
    studies.push_back({"logs", [=] { return openPoseLog(log.path, log.file, log.type); }, {}, {}, {}, {}});
  for (int i = 0; i < options.count("scenes"); ++i)
    for (const char* scene : {"door", "drawer"}) {
      SimulationConfig config;
      config.scene = scene;
      config.scene_seed = options.count("seed") + i;
      config.rate = 30;  // more frames than one sub-sample takes
      studies.push_back({"images", [=] { return trackFrames(*simulateRun(config)); }, {}, {}, {}, {}});
    }
  for (const std::string& folder : findSequences(options.text("sequences"), false)) {
    const Frame first = openRecordedSequence(folder)->frame(0);
    const auto moves = [](const Front& front) { return front.type != JointType::kRigid; };
    if (std::any_of(first.fronts.begin(), first.fronts.end(), moves))
      studies.push_back({"images", [=] { return trackFrames(*openRecordedSequence(folder)); }, {}, {}, {}, {}});
  }
  return studies;
}

std::string trueName(const SourceFacts& facts) { return facts.explainable ? modelName(facts.type) : "other"; }

double probabilityOfTruth(const CurvePoint& point, const SourceFacts& facts) {
  return isRight(point.model, facts) ? point.model.probabilities[static_cast<std::size_t>(point.model.type)] : 0;
}

std::vector<double> meanProbabilities(const std::vector<const CurvePoint*>& points) {
  std::vector<double> result(modelRegistry().size());
  for (const CurvePoint* point : points)
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += point->model.probabilities.at(i) / points.size();
  return result;
}

/// p_rigid,p_prismatic,... for every type of joint.
std::string probabilityColumns() {
  std::string columns;
  for (const ModelEntry& entry : modelRegistry()) columns += std::string(columns.empty() ? "p_" : ",p_") + entry.name;
  return columns;
}

void writeCurveSummary(const SourceFacts& facts, int observations, const std::vector<const CurvePoint*>& points, CsvWriter* csv) {
  std::vector<double> right, confident, position, orientation, residual;
  for (const CurvePoint* point : points) {
    right.push_back(isRight(point->model, facts));
    confident.push_back(probabilityOfTruth(*point, facts) > kConfident);
    position.push_back(1e3 * point->error.position);
    orientation.push_back(toDegrees(point->error.orientation));
    residual.push_back(1e3 * point->model.position_error);
  }
  csv->row(facts.name, trueName(facts), observations, static_cast<int>(points.size()), mean(right), mean(confident),
           meanProbabilities(points), mean(position), standardDeviation(position),
           facts.has_orientation ? mean(orientation) : std::nan(""), mean(residual));
}

void writeCurves(const std::vector<Study>& studies, const Options& options) {
  CsvWriter runs(options.out("fig12_runs.csv"),
                 "source,type,run,observations,selected," + probabilityColumns() + ",error_mm,error_deg,residual_mm");
  CsvWriter summary(options.out("fig12.csv"), "source,type,observations,runs,right_share,confident_share," +
                                                  probabilityColumns() +
                                                  ",error_mm_mean,error_mm_deviation,error_deg_mean,residual_mm_mean");
  for (const Study& study : studies) {
    const SourceFacts& facts = study.facts;
    std::map<int, std::vector<const CurvePoint*>> by_count;
    for (const CurvePoint& point : study.curve) {
      const LearnedModel& model = point.model;
      by_count[point.observations].push_back(&point);
      runs.row(facts.name, trueName(facts), point.run, point.observations, selectedName(model), model.probabilities,
               1e3 * point.error.position, facts.has_orientation ? toDegrees(point.error.orientation) : std::nan(""),
               1e3 * model.position_error);
    }
    for (const auto& [count, points] : by_count) writeCurveSummary(facts, count, points, &summary);
  }
}

void writeUnseen(const std::vector<Study>& studies, const Options& options) {
  CsvWriter csv(options.out("fig12_unseen.csv"),
                "source,type,trained_share,observations,selected,error_mm,error_deg,true_type_error_mm,true_type_error_deg");
  for (const Study& study : studies)
    for (const UnseenOpening& unseen : study.unseen) {
      const auto millimetres = [](const auto& error) { return error ? 1e3 * error->position : std::nan(""); };
      const auto degrees = [&](const auto& error) {
        return error && study.facts.has_orientation ? toDegrees(error->orientation) : std::nan("");
      };
      csv.row(study.facts.name, trueName(study.facts), unseen.share, unseen.selected ? unseen.selected->observations : 0,
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
  for (const std::string kind : {"logs", "images"}) {
    std::vector<double> axis, radius;
    for (const Study& study : studies) {
      if (study.kind != kind || !study.halves) continue;
      axis.push_back(study.halves->axis);
      if (study.halves->radius) radius.push_back(*study.halves->radius);
    }
    writeCoverage("halves_of_" + kind, "axis", axis, &csv);
    writeCoverage("halves_of_" + kind, "radius", radius, &csv);
  }
}

int run(int argc, char** argv) {
  const Options options(argc, argv,
                        {{"runs", "50"}, {"scenes", "1"}, {"fronts", "300"}, {"seed", "1"}, {"sequences", ""}, {"tracks", ""}});
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
  return cabinet_articulation::runProgram("fig12_models", "",
                                          [&] { return cabinet_articulation::core::evaluation::run(argc, argv); });
}

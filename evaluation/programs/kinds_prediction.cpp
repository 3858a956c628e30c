// SPDX-License-Identifier: BSD-3-Clause
// How well openings never seen are predicted by a front's own poses, and with kinds of joints that other logs taught.
#include <limits>
#include <map>
#include <opencv2/core/utility.hpp>

#include "articulation/models/model_registry.h"
#include "kinds/joint_kinds.h"
#include "programs/options.h"
#include "programs/parallel.h"
#include "scores/learning_curve.h"
#include "scores/merged_models.h"
#include "sources/track_source.h"
#include "tables/csv_writer.h"
#include "tables/statistics.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kShare = 0.3;

struct Log {
  std::string set;
  std::unique_ptr<TrackSource> source;
  LearnedFront whole, begun;
  std::vector<ReferencePose> far_end;
};

struct Prediction {
  LearnedModel model;
  double error = std::numeric_limits<double>::quiet_NaN();  ///< [m]
};

std::vector<Log> readLogs(const std::string& folder) {
  std::vector<Log> logs;
  for (const LabelledLog& log : findLogs(folder)) {
    std::unique_ptr<TrackSource> source = openPoseLog(log.path, log.file, log.type);
    if (source->facts().explainable) logs.push_back({log.file.substr(0, log.file.rfind('/')), std::move(source), {}, {}, {}});
  }
  return logs;
}

void learn(Log* log) {
  std::vector<int> all;
  for (std::size_t i = 0; i < log->source->reference().size(); ++i) all.push_back(static_cast<int>(i));
  log->whole = observeAll(*log->source, all);
  const auto [seen, far_end] = splitOpening(*log->source, kShare);
  log->begun = observeAll(*log->source, seen);
  log->far_end = far_end;
}

Prediction predictionOf(const Log& log, const LearnedModel& model) {
  return {model, predictionError(model, log.far_end, log.source->facts().has_orientation).position};
}

/// With kinds that all other logs taught, or all others of the same set.
Prediction withKinds(const std::vector<Log>& logs, const Log& log, bool mixed) {
  JointKinds kinds({}, {});
  for (const Log& other : logs)
    if (&other != &log && (mixed || other.set == log.set) && other.whole.model)
      kinds.add(*other.whole.model, other.whole.track, learnerConfig(other.source->facts()));
  return predictionOf(log, kinds.predict(*log.begun.model, log.begun.track, learnerConfig(log.source->facts())));
}

/// As the original release would, with all other logs of the same set.
Prediction withMergedModels(const std::vector<Log>& logs, const Log& log) {
  MergedModels models(learnerConfig(log.source->facts()));
  for (const Log& other : logs)
    if (&other != &log && other.set == log.set) models.store(other.whole.track);
  return predictionOf(log, models.modelOf(log.begun.track));
}

int run(int argc, char** argv) {
  const Options options(argc, argv, {{"tracks", ""}});
  cv::setNumThreads(1);  // the cores work on different logs
  std::vector<Log> logs = readLogs(options.text("tracks"));
  const int count = static_cast<int>(logs.size());
  parallelFor(count, [&](int i) { learn(&logs[i]); });
  std::vector<Prediction> alone(count), of_set(count), mixed(count), merged(count);
  parallelFor(count, [&](int i) {
    if (!logs[i].begun.model) return;
    alone[i] = predictionOf(logs[i], *logs[i].begun.model);
    of_set[i] = withKinds(logs, logs[i], false);
    mixed[i] = withKinds(logs, logs[i], true);
    merged[i] = withMergedModels(logs, logs[i]);
  });
  CsvWriter csv(options.out("kinds.csv"), "source,type,observations,alone,alone_mm,set,set_mm,mixed,mixed_mm,merged,merged_mm");
  std::map<std::pair<std::string, std::string>, std::vector<std::vector<double>>> sets;
  for (int i = 0; i < count; ++i) {
    const SourceFacts& facts = logs[i].source->facts();
    csv.row(facts.name, modelName(facts.type), static_cast<int>(logs[i].begun.track.observations.size()),
            selectedName(alone[i].model), 1e3 * alone[i].error, selectedName(of_set[i].model), 1e3 * of_set[i].error,
            selectedName(mixed[i].model), 1e3 * mixed[i].error, selectedName(merged[i].model), 1e3 * merged[i].error);
    auto& errors = sets[{logs[i].set, modelName(facts.type)}];
    errors.resize(4);
    errors[0].push_back(1e3 * alone[i].error);
    errors[1].push_back(1e3 * of_set[i].error);
    errors[2].push_back(1e3 * mixed[i].error);
    errors[3].push_back(1e3 * merged[i].error);
  }
  CsvWriter summary(options.out("kinds_sets.csv"), "set,type,logs,alone_mm,set_mm,mixed_mm,merged_mm");
  for (const auto& [set, errors] : sets)
    summary.row(set.first, set.second, static_cast<int>(errors[0].size()), mean(errors[0]), mean(errors[1]), mean(errors[2]),
                mean(errors[3]));
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  return cabinet_articulation::runProgram("kinds_prediction", "",
                                          [&] { return cabinet_articulation::core::evaluation::run(argc, argv); });
}

// SPDX-License-Identifier: BSD-3-Clause
// Writes all that is learned from given logs and sequences, to the last bit: compare_answers.py tells what a change changed.
#include <cstdio>
#include <fstream>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <sstream>
#include <string>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "programs/options.h"
#include "programs/parallel.h"
#include "sources/recorded_sequence.h"
#include "sources/track_source.h"
#include "sources/variants.h"
#include "tools/input/pose_log.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr std::size_t kEvery = 10;  // observations between two answers that are written

/// Lines of `answer,field,value`, in memory until all of one source are there.
class Answers {
 public:
  void add(const std::string& answer, const LearnedModel& model) {
    prefix_ = answer + ',';
    add("type", static_cast<int>(model.type));
    addAll("probability", model.probabilities.data(), model.probabilities.size());
    for (const auto& [name, flag] : {std::pair("moved", model.moved),
                                     {"explained", model.explained},
                                     {"hollow", model.hollow},
                                     {"q_min_is_end", model.q_min_is_end},
                                     {"q_max_is_end", model.q_max_is_end}})
      add(name, flag ? 1 : 0);
    for (const auto& [name, value] : {std::pair("support", model.support),
                                      {"doubt", model.doubt},
                                      {"pitch", model.pitch},
                                      {"radius", model.radius},
                                      {"q", model.q},
                                      {"q_min", model.q_min},
                                      {"q_max", model.q_max},
                                      {"opening", model.opening},
                                      {"width", model.width},
                                      {"height", model.height},
                                      {"position_error", model.position_error},
                                      {"orientation_error", model.orientation_error},
                                      {"observations", static_cast<double>(model.observations)}})
      add(name, value);
    add("origin", model.origin);
    addAll("axis", model.axis.data(), 3);
    addAll("axis_point", model.axis_point.data(), 3);
    addAll("covariance", model.covariance.data(), static_cast<std::size_t>(model.covariance.size()));
    for (const ModelParam& param : model.params) add("params." + param.name, param.value);
    for (std::size_t i = 0; i < model.curve.size(); ++i) add("curve" + std::to_string(i), model.curve[i]);
  }

  void addRefusal(const std::string& answer) {
    prefix_ = answer + ',';
    add("refused", 1);
  }

  const std::string& lines() const { return lines_; }

 private:
  void add(const std::string& field, double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    lines_ += prefix_ + field + ',' + digits + '\n';
  }

  void addAll(const std::string& field, const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(field + std::to_string(i), values[i]);
  }

  void add(const std::string& field, const Eigen::Isometry3d& pose) {
    const Eigen::Quaterniond orientation(pose.linear());
    addAll(field + ".position", pose.translation().data(), 3);
    addAll(field + ".orientation", orientation.coeffs().data(), 4);
  }

  std::string prefix_, lines_;
};

/// All candidates for the whole log, and what is known while it grows.
void answerLog(const LabelledLog& label, Answers* answers) {
  PoseLog log;
  try {
    log = readPoseLog(label.path);
  } catch (const PoseLogError&) {
    return answers->addRefusal(label.file + ",log");
  }
  ArticulationConfig config;
  config.use_orientation = log.columns > 3;
  const std::vector<LearnedModel> candidates = fitAllModels(log.track, config);
  for (std::size_t i = 0; i < candidates.size(); ++i) answers->add(label.file + ",candidate" + std::to_string(i), candidates[i]);
  ArticulationLearner learner(config);
  Track track = log.track;
  track.observations.clear();
  for (const TrackedObservation& observation : log.track.observations) {
    track.observations.push_back(observation);
    const std::vector<LearnedModel> models = learner.process({track});
    const std::size_t count = track.observations.size();
    if (!models.empty() && (count % kEvery == 0 || count == log.track.observations.size()))
      answers->add(label.file + ",after" + std::to_string(count), models[0]);
  }
}

void answerSequence(const std::string& folder, const Variant& variant, Answers* answers) {
  const std::unique_ptr<FrameSource> source = openRecordedSequence(folder);
  if (source->independent()) return;
  Observer observer(variant);
  for (int i = 0; i < source->size(); ++i) {
    const PipelineResult seen = observer.see(source->frame(i), source->camera());
    if (i % static_cast<int>(kEvery) != 0 && i + 1 != source->size()) continue;
    for (const LearnedModel& model : seen.models)
      answers->add(source->name() + '/' + variant.name + ",frame" + std::to_string(i) + '/' + std::to_string(model.id), model);
  }
}

int run(int argc, char** argv) {
  const Options options(argc, argv, {{"sequences", ""}, {"tracks", ""}});
  cv::setNumThreads(1);  // the cores work on different sources
  std::vector<std::function<void(Answers*)>> sources;
  for (const LabelledLog& log : findLogs(options.text("tracks")))
    sources.push_back([=](Answers* answers) { answerLog(log, answers); });
  for (const std::string& folder : findSequences(options.text("sequences"), false))
    for (const Variant& variant : {ourVariant(), depthVariant()})
      sources.push_back([=](Answers* answers) { answerSequence(folder, variant, answers); });
  std::vector<Answers> answers(sources.size());
  parallelFor(static_cast<int>(sources.size()), [&](int i) { sources[i](&answers[i]); });
  const std::string path = options.out("answers.csv");
  std::ofstream file(path);
  file << "source,answer,field,value\n";
  for (const Answers& some : answers) file << some.lines();
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  return cabinet_articulation::runProgram("learner_answers", "",
                                          [&] { return cabinet_articulation::core::evaluation::run(argc, argv); });
}

// SPDX-License-Identifier: BSD-3-Clause
// Writes all that is learned from given logs and sequences, to the last bit: compare_answers.py tells what a change changed.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <sstream>
#include <string>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/hanging.h"
#include "programs/options.h"
#include "programs/parallel.h"
#include "scores/learned_run.h"
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
                                     {"observed", model.observed},
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

  /// How that front moves in truth.
  void addTruth(const std::string& answer, JointType type) {
    prefix_ = answer + ',';
    add("truth", static_cast<int>(type));
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

/// A motion that no joint makes is that of a curve.
JointType typeOfLabel(const LabelledLog& label) {
  const SourceFacts facts = openPoseLog(label.path, label.file, label.type)->facts();
  return facts.explainable ? facts.type : JointType::kNonparametric;
}

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
  const JointType truth = typeOfLabel(label);
  ArticulationLearner learner(config);
  Track track = log.track;
  track.observations.clear();
  for (const TrackedObservation& observation : log.track.observations) {
    track.observations.push_back(observation);
    const std::vector<LearnedModel> models = learner.process({track});
    const std::size_t count = track.observations.size();
    if (models.empty() || (count % kEvery != 0 && count != log.track.observations.size())) continue;
    const std::string answer = label.file + ",after" + std::to_string(count);
    answers->add(answer, models[0]);
    answers->addTruth(answer, truth);
  }
}

void answerSequence(const std::string& folder, const Variant& variant, Answers* answers) {
  const std::unique_ptr<FrameSource> source = openRecordedSequence(folder);
  if (source->independent()) return;
  // Scenes of several folders may have the same name.
  const std::filesystem::path of_folder = std::filesystem::absolute(folder).lexically_normal().parent_path().filename();
  const std::string name = (of_folder / source->name() / variant.name).string();
  Observer observer(variant);
  std::vector<Frame> frames;  // without images
  std::vector<std::pair<int, std::vector<LearnedModel>>> learned;
  for (int i = 0; i < source->size(); ++i) {
    const Frame frame = source->frame(i);
    if (!frame.depth.empty() && variant.from_depth) return;  // it delivers depth as it is
    frames.push_back({frame.stamp, frame.T_world_camera, {}, {}, {}, frame.fronts});
    const PipelineResult seen = observer.see(frame, source->camera());
    if (i % static_cast<int>(kEvery) != 0 && i + 1 != source->size()) continue;
    learned.emplace_back(i, seen.models);
  }
  for (const auto& [i, models] : learned)
    for (const LearnedModel& model : models) {
      const std::string answer = name + ",frame" + std::to_string(i) + '/' + std::to_string(model.id);
      answers->add(answer, model);
      // Without its parent nothing says where the front lies.
      if (hangsOnKnown(model, models)) answers->addTruth(answer, trueType(model, models, frames));
    }
}

int run(int argc, char** argv) {
  const Options options(argc, argv, {{"sequences", ""}, {"tracks", ""}});
  cv::setNumThreads(1);  // the cores work on different sources
  std::vector<std::function<void(Answers*)>> sources;
  for (const std::string& folder : options.texts("tracks"))
    for (const LabelledLog& log : findLogs(folder)) sources.push_back([=](Answers* answers) { answerLog(log, answers); });
  for (const std::string& all : options.texts("sequences"))
    for (const std::string& folder : findSequences(all, false))
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

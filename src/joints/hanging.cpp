// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/hanging.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "cabinet_articulation/geometry/limits.h"
#include "geometry/turned_covariance.h"

namespace cabinet_articulation::core {
namespace {

std::string inWords(std::uint32_t id) { return "front " + std::to_string(id); }

using Find = std::function<const LearnedModel*(std::uint32_t id)>;

Find among(const std::vector<LearnedModel>& models) {
  return [&models](std::uint32_t id) { return findModel(id, models); };
}

/// The same for as many questions as there are models, which a list would answer in a time that grows with their square.
Find indexed(const std::vector<LearnedModel>& models) {
  std::unordered_map<std::uint32_t, const LearnedModel*> index;
  for (const LearnedModel& model : models) index.emplace(model.id, &model);
  return [index = std::move(index)](std::uint32_t id) {
    const auto found = index.find(id);
    return found == index.end() ? nullptr : found->second;
  };
}

/// The model's parent, its parent, and so on, as far as they are found. Throws ModelError for a cycle, and for too many.
std::vector<const LearnedModel*> parentsOf(const LearnedModel& model, const Find& find) {
  std::vector<const LearnedModel*> parents;
  std::set<std::uint32_t> seen{model.id};
  std::string chain = inWords(model.id);
  for (const LearnedModel* at = &model; at->parent != 0;) {
    chain += " hangs on " + inWords(at->parent);
    if (!seen.insert(at->parent).second) throw ModelError(chain + ", in a cycle; one of them must have the parent 0, the world");
    if (parents.size() == limits::kMostParents)
      throw ModelError(chain + "; expected at most " + std::to_string(limits::kMostParents) + " from a front to the world");
    chain += ", which";
    const LearnedModel* parent = find(at->parent);
    if (parent == nullptr) break;
    parents.push_back(parent);
    at = parent;
  }
  return parents;
}

Eigen::Isometry3d frameFrom(const LearnedModel& model, const Find& find) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (model.parent == 0) return T;
  const LearnedModel* child = &model;
  for (const LearnedModel* parent : parentsOf(model, find)) {
    requireJoint(*parent);
    T = parent->predict(parent->q) * T;
    child = parent;
  }
  if (child->parent != 0)
    throw ModelError(inWords(child->id) + " hangs on " + inWords(child->parent) +
                     ", which is not known, so that nobody can tell where it is");
  return T;
}

/// Nothing if it cannot be told.
std::optional<Eigen::Isometry3d> frameIfKnown(const LearnedModel& model, const Find& find) {
  try {
    return frameFrom(model, find);
  } catch (const ModelError&) {
    return std::nullopt;
  }
}

}  // namespace

const LearnedModel* findModel(std::uint32_t id, const std::vector<LearnedModel>& models) {
  const auto found = std::find_if(models.begin(), models.end(), [id](const LearnedModel& model) { return model.id == id; });
  return found == models.end() ? nullptr : &*found;
}

void removeCoupledRatio(LearnedModel* model) {
  const auto is_ratio = [](const ModelParam& param) { return param.name == kCoupledRatio; };
  model->params.erase(std::remove_if(model->params.begin(), model->params.end(), is_ratio), model->params.end());
}

LearnedModel transformed(const LearnedModel& model, const Eigen::Isometry3d& T_target_source) {
  LearnedModel result = model;
  result.origin = T_target_source * model.origin;
  result.axis = T_target_source.linear() * model.axis;
  result.axis_point = T_target_source * model.axis_point;
  for (Eigen::Isometry3d& pose : result.curve) pose = T_target_source * pose;
  result.covariance = turned(model.covariance, T_target_source.linear());
  return result;
}

Eigen::Isometry3d frameOf(const LearnedModel& model, const std::vector<LearnedModel>& all) {
  return frameFrom(model, among(all));
}

bool hangsOnKnown(const LearnedModel& model, const std::vector<LearnedModel>& all) {
  return frameIfKnown(model, among(all)).has_value();
}

std::vector<LearnedModel> thoseOnKnown(const std::vector<LearnedModel>& models) {
  const Find find = indexed(models);
  std::vector<LearnedModel> result;
  std::copy_if(models.begin(), models.end(), std::back_inserter(result),
               [&](const LearnedModel& model) { return frameIfKnown(model, find).has_value(); });
  return result;
}

std::vector<LearnedModel> withParents(std::vector<LearnedModel> models, const std::vector<LearnedModel>& all) {
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (models[i].parent == 0 || findModel(models[i].parent, models) != nullptr) continue;
    const LearnedModel* parent = findModel(models[i].parent, all);
    if (parent != nullptr) models.push_back(*parent);
  }
  return models;
}

LearnedModel placed(const LearnedModel& model, const std::vector<LearnedModel>& all) {
  return model.parent == 0 ? model : transformed(model, frameOf(model, all));
}

LearnedModel setDown(const LearnedModel& model, const std::vector<LearnedModel>& all) {
  LearnedModel result = placed(model, all);
  result.parent = 0;
  result.parent_probability = LearnedModel().parent_probability;
  removeCoupledRatio(&result);
  return result;
}

std::vector<LearnedModel> allPlaced(const std::vector<LearnedModel>& models) {
  const Find find = indexed(models);
  std::vector<LearnedModel> result;
  for (const LearnedModel& model : models) {
    const std::optional<Eigen::Isometry3d> frame = frameIfKnown(model, find);
    if (frame) result.push_back(model.parent == 0 ? model : transformed(model, *frame));
  }
  return result;
}

std::vector<LearnedModel> thoseOfTheWorld(const std::vector<LearnedModel>& models) {
  std::vector<LearnedModel> result;
  std::copy_if(models.begin(), models.end(), std::back_inserter(result),
               [](const LearnedModel& model) { return model.parent == 0; });
  return result;
}

void requireNoCycle(const std::vector<LearnedModel>& models) {
  const Find find = indexed(models);
  for (const LearnedModel& model : models) parentsOf(model, find);
}

}  // namespace cabinet_articulation::core

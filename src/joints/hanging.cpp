// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/hanging.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>

#include "geometry/turned_covariance.h"

namespace cabinet_articulation::core {
namespace {

std::string inWords(std::uint32_t id) { return "front " + std::to_string(id); }

/// The model's parent, its parent, and so on, as far as they are among `all`. Throws ModelError for a cycle.
std::vector<const LearnedModel*> parentsOf(const LearnedModel& model, const std::vector<LearnedModel>& all) {
  std::vector<const LearnedModel*> parents;
  std::set<std::uint32_t> seen{model.id};
  std::string chain = inWords(model.id);
  for (const LearnedModel* at = &model; at->parent != 0;) {
    chain += " hangs on " + inWords(at->parent);
    if (!seen.insert(at->parent).second) throw ModelError(chain + ", in a cycle; one of them must have the parent 0, the world");
    chain += ", which";
    const LearnedModel* parent = findModel(at->parent, all);
    if (parent == nullptr) break;
    parents.push_back(parent);
    at = parent;
  }
  return parents;
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
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const LearnedModel* child = &model;
  for (const LearnedModel* parent : parentsOf(model, all)) {
    requireJoint(*parent);
    T = parent->predict(parent->q) * T;
    child = parent;
  }
  if (child->parent != 0)
    throw ModelError(inWords(child->id) + " hangs on " + inWords(child->parent) +
                     ", which is not known, so that nobody can tell where it is");
  return T;
}

bool hangsOnKnown(const LearnedModel& model, const std::vector<LearnedModel>& all) {
  if (model.parent == 0) return true;
  try {
    frameOf(model, all);
    return true;
  } catch (const ModelError&) {
    return false;
  }
}

std::vector<LearnedModel> thoseOnKnown(const std::vector<LearnedModel>& models) {
  std::vector<LearnedModel> result;
  std::copy_if(models.begin(), models.end(), std::back_inserter(result),
               [&](const LearnedModel& model) { return hangsOnKnown(model, models); });
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
  std::vector<LearnedModel> result = thoseOnKnown(models);
  for (LearnedModel& model : result) model = placed(model, models);
  return result;
}

std::vector<LearnedModel> thoseOfTheWorld(const std::vector<LearnedModel>& models) {
  std::vector<LearnedModel> result;
  std::copy_if(models.begin(), models.end(), std::back_inserter(result),
               [](const LearnedModel& model) { return model.parent == 0; });
  return result;
}

void requireNoCycle(const std::vector<LearnedModel>& models) {
  for (const LearnedModel& model : models) parentsOf(model, models);
}

}  // namespace cabinet_articulation::core

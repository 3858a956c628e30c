// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/geometry/rectangle.h"

namespace cabinet_articulation::core {

/// A learned model cannot answer a question. The message says which front and why.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// True for a front that moved in a way that one of the models describes, and is not doubted too much.
bool isJoint(const LearnedModel& model);

/// True for a model that as many observations contradict as support (LearnedModel::doubt).
bool isGivenUp(const LearnedModel& model);

/// True for what is a joint, or would be if it were not given up.
bool wasJoint(const LearnedModel& model);

/// What the front is called: the name that people gave it, or "front_<id>", which stays when the type changes.
std::string nameOf(const LearnedModel& model);

/// Of the model's type, 0 to 1; 0 where the probabilities are not given.
double typeProbability(const LearnedModel& model);

/// Throws ModelError, with the reason in words, unless isJoint().
void requireJoint(const LearnedModel& model);

/// The frame that rests: at the axis point (where q is an angle) or at the front with q = 0, z along the axis.
Eigen::Isometry3d jointBase(const LearnedModel& model);

/// The front at q.
Rectangle frontAt(const LearnedModel& model, double q);

/// The end of the range that was seen which is farther from where the front is closed: the widest seen, or its end.
double openEnd(const LearnedModel& model, double q_closed);

/// 0 closed, 1 at openEnd(); NaN while the closed position is unknown.
double openingAt(const LearnedModel& model, double q);

/// Throws ModelError for what is no joint, or a joint that was not seen closed.
void requireClosed(const LearnedModel& model);

/// The q of an opening. Throws ModelError while the closed position is unknown.
double configurationAtOpening(const LearnedModel& model, double opening);

/// The same joint with q = 0 where it is closed, growing as it opens. Its closed position must be known.
LearnedModel countedFromClosed(const LearnedModel& model);

/// Those whose closed position is known, counted from there. A joint is never in this list with another zero.
std::vector<LearnedModel> allCountedFromClosed(const std::vector<LearnedModel>& models);

/// In words, that some q of an answer lie outside the range that was seen; empty if none do.
std::string outsideSeenRange(const LearnedModel& model, double q_lowest, double q_highest);

}  // namespace cabinet_articulation::core

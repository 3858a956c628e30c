// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/kind_description.h"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "geometry/cross_matrix.h"

namespace cabinet_articulation::core {
namespace {

void leaveOutGeometry(LearnedModel* model) {
  const auto names_geometry = [](const ModelParam& param) { return param.kind == ModelParam::kParam; };
  model->params.erase(std::remove_if(model->params.begin(), model->params.end(), names_geometry), model->params.end());
}

}  // namespace

void describe(const Arc& arc, JointType type, const PoseSamples& samples, LearnedModel* learned) {
  const bool turns = type == JointType::kRotational;
  learned->type = type;
  learned->origin.translation() = arc.middle;
  learned->origin.linear() = samples.has_orientation ? arc.orientation : samples.orientations.front().toRotationMatrix();
  learned->axis = turns ? arc.axis() : arc.tangent();
  learned->axis_point = turns ? arc.center() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  learned->radius = turns ? arc.radius() : 0;
  learned->pitch = 0;
  learned->curve.clear();
  leaveOutGeometry(learned);
  learned->q_min = learned->q_max = 0;
  learned->q_min_is_end = learned->q_max_is_end = false;
  for (const Eigen::Vector3d& position : samples.positions) {
    learned->q = (turns ? arc.curvature : 1) * arc.arcLength(position);
    learned->q_min = std::min(learned->q_min, learned->q);
    learned->q_max = std::max(learned->q_max, learned->q);
  }
  if (learned->q_max >= -learned->q_min) return;
  // A front that is closing: q grows as it was first seen to go.
  learned->axis = -learned->axis;
  learned->q = -learned->q;
  std::swap(learned->q_min, learned->q_max);
  learned->q_min = -learned->q_min;
  learned->q_max = -learned->q_max;
}

void describe(const JointShape& shape, const Eigen::MatrixXd& covariance, LearnedModel* front) {
  const Eigen::Matrix3d frame = front->origin.linear() * shape.frame;
  front->type = shape.type;
  front->axis = frame.col(shape.turns() ? 2 : 0);
  front->radius = shape.radius;
  if (shape.turns()) front->axis_point = front->origin.translation() + shape.radius * frame.col(1);
  leaveOutGeometry(front);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, shape.dimensions());
  if (shape.turns()) {
    J.topLeftCorner<3, 3>() = -shape.radius * frame * crossMatrix(Eigen::Vector3d::UnitY());
    J.topRightCorner<3, 1>() = shape.radius * frame.col(1);
    J.bottomLeftCorner<3, 3>() = frame;
    front->covariance.setZero();
  } else {
    // The place is as certain as it was.
    J.bottomRightCorner<3, 2>() = frame.rightCols<2>();
    front->covariance.bottomRows<3>().setZero();
    front->covariance.rightCols<3>().setZero();
  }
  front->covariance += J * covariance * J.transpose();
}

void describe(const JointKind& kind, LearnedModel* front) {
  const ShapePrior next = kind.next(front->width, front->height);
  describe(next.mean, next.covariance(), front);
  front->q = front->q_min = 0;
  front->q_max = kind.range();
}

}  // namespace cabinet_articulation::core

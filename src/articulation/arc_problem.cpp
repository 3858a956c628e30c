// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/arc_problem.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// How exp(v) turns when v changes: exp(v + dv) = exp(J dv) exp(v).
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (angle < 1e-9) return Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d cross = crossMatrix(v);
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / (angle * angle) * cross +
         (angle - std::sin(angle)) / (angle * angle * angle) * cross * cross;
}

/// Where on the arc a pose belongs, with what the derivatives need. All in the arc's frame.
struct Place {
  double theta = 0, cosine = 1, sine = 0;
  double outward = 0;  ///< [m] signed distance from the arc
  double along = 0;    ///< [m] left over along the tangent
  double bend = 0;     ///< [m^2] (1 - cos theta) / curvature^2: how the arc moves inward when it bends more
  double stretch = 0;  ///< [m^2] (theta - sin theta) / curvature^2: the same along the tangent, at fixed s
  double length = 0;   ///< [m] s
};

/// The nearest point of the arc. Written with g = curvature * |p|^2 - 2 y, which keeps its digits where the arc is
/// nearly straight.
Place nearestPlace(const Eigen::Vector3d& p, double curvature) {
  Place place;
  const double in_plane = p.x() * p.x() + p.y() * p.y();
  const double g = curvature * in_plane - 2 * p.y();
  const double root = std::sqrt(std::max(1 + curvature * g, 1e-18));
  place.outward = g / (1 + root);
  place.cosine = (1 - curvature * p.y()) / root;
  place.sine = curvature * p.x() / root;
  // 1 - cos = sin^2 / (1 + cos) before the quarter turn.
  place.bend =
      place.cosine > 0 ? p.x() * p.x() / (root * root * (1 + place.cosine)) : (1 - place.cosine) / (curvature * curvature);
  return place;
}

void addArcLength(const Eigen::Vector3d& p, double curvature, Place* place) {
  if (std::abs(curvature) < 1e-9) {
    place->length = p.x();
    return;
  }
  place->theta = std::atan2(place->sine, place->cosine);
  place->length = place->theta / curvature;
  const double theta = place->theta;
  place->stretch = std::abs(theta) < 0.05 ? curvature * std::pow(place->length, 3) / 6 * (1 - theta * theta / 20)
                                          : (theta - place->sine) / (curvature * curvature);
}

/// The place at which an arc turns by `theta`.
Place placeAtAngle(const Eigen::Vector3d& p, double curvature, double theta) {
  Place place;
  place.theta = theta;
  place.cosine = std::cos(theta);
  place.sine = std::sin(theta);
  place.length = theta / curvature;
  place.bend = (1 - place.cosine) / (curvature * curvature);
  place.stretch = (theta - place.sine) / (curvature * curvature);
  const double dx = p.x() - place.sine / curvature;
  const double dy = p.y() - (1 - place.cosine) / curvature;
  place.along = place.cosine * dx + place.sine * dy;
  place.outward = place.sine * dx - place.cosine * dy;
  return place;
}

/// What one evaluation needs for all poses.
struct Evaluation {
  Arc arc;
  Eigen::Matrix3d to_frame;
  Eigen::Quaterniond left, right;  ///< a pose's rotation in the arc's frame is left * orientation * right
  // The increments' effects in the arc's own frame.
  Eigen::Matrix<double, 3, 2> middle;
  Eigen::Matrix3d frame, orientation;
  bool free_curvature;
  bool orientation_places;  ///< the radius is so small that the orientation says better where a pose belongs
  bool weighted;
};

Evaluation evaluationAt(const Arc& arc, const Eigen::Vector3d& frame_increment, const Eigen::Vector3d& orientation_increment,
                        const ResidualNoise& noise, bool weighted) {
  Evaluation evaluation;
  evaluation.arc = arc;
  evaluation.to_frame = arc.frame.transpose();
  evaluation.left = Eigen::Quaterniond(evaluation.to_frame);
  evaluation.right = Eigen::Quaterniond(arc.orientation.transpose() * arc.frame);
  const Eigen::Matrix3d back = rotationFromVector(-frame_increment);
  evaluation.middle = back.rightCols<2>();
  evaluation.frame = leftJacobian(-frame_increment);
  evaluation.orientation = back * leftJacobian(orientation_increment);
  evaluation.orientation_places = std::abs(arc.curvature) * 2.5 * noise.placing_position > noise.placing_orientation;
  evaluation.weighted = weighted;
  return evaluation;
}

/// Residual (first column) and its derivatives of one pose.
template <int kRows, int kParameters>
using Block = Eigen::Matrix<double, kRows, kParameters + 1>;

void fillBlock(const PoseSamples& samples, std::size_t i, const Evaluation& evaluation, const ResidualNoise&,
               Block<2, 6>* block) {
  const Eigen::Vector3d p = evaluation.to_frame * (samples.positions[i] - evaluation.arc.middle);
  const Place place = nearestPlace(p, evaluation.arc.curvature);
  const Eigen::Vector3d outward(place.sine, -place.cosine, 0);
  block->col(0) << place.outward, p.z();
  block->middleCols<2>(1).row(0) = -outward.transpose() * evaluation.middle;
  block->middleCols<2>(1).row(1) = -evaluation.middle.row(2);
  block->middleCols<3>(3).row(0) = -p.cross(outward).transpose() * evaluation.frame;
  block->middleCols<3>(3).row(1) = -p.cross(Eigen::Vector3d::UnitZ()).transpose() * evaluation.frame;
  block->col(6) << place.bend, 0;
}

/// Removes what a pose could make up for by moving along the path (variable projection).
template <class AnyBlock>
void projectOutMotion(const Eigen::Matrix<double, 6, 1>& motion, AnyBlock* block) {
  block->noalias() -= motion * ((motion.transpose() * *block) / motion.squaredNorm()).eval();
}

void fillBlock(const PoseSamples& samples, std::size_t i, const Evaluation& evaluation, const ResidualNoise& noise,
               Block<6, 9>* block) {
  const double curvature = evaluation.arc.curvature;
  const Eigen::Vector3d p = evaluation.to_frame * (samples.positions[i] - evaluation.arc.middle);
  const Eigen::Quaterniond turned = evaluation.left * samples.orientations[i] * evaluation.right;
  Place place;
  if (evaluation.orientation_places) {
    place = placeAtAngle(p, curvature, 2 * std::atan2(turned.w() < 0 ? -turned.z() : turned.z(), std::abs(turned.w())));
  } else {
    place = nearestPlace(p, curvature);
    addArcLength(p, curvature, &place);
  }
  Eigen::Matrix3d axes;  // rows: along, outward, axis
  axes << place.cosine, place.sine, 0, place.sine, -place.cosine, 0, 0, 0, 1;
  Eigen::Matrix3d turn;
  turn << place.cosine, -place.sine, 0, place.sine, place.cosine, 0, 0, 0, 1;

  block->setZero();
  block->topRows<3>().col(0) << place.along, place.outward, p.z();
  block->block<3, 2>(0, 1) = -axes * evaluation.middle;
  for (int row = 0; row < 3; ++row)
    block->block<1, 3>(row, 3) = -p.cross(axes.row(row).transpose()).transpose() * evaluation.frame;
  block->block<3, 1>(0, 6) << -place.stretch, place.bend, 0;

  const double half = place.theta / 2;
  Eigen::Quaterniond rest = turned * Eigen::Quaterniond(std::cos(half), 0, 0, -std::sin(half));
  if (rest.w() < 0) rest.coeffs() = -rest.coeffs();
  const double sine = rest.vec().norm();
  block->block<3, 1>(3, 0) = (sine < 1e-9 ? 2 : 2 * std::atan2(sine, rest.w()) / sine) * rest.vec();
  // The derivative of a rotation vector by a small turn is a matrix that leaves the vector itself alone, so that the
  // identity in its place gives the exact gradient of its square.
  block->block<3, 3>(3, 3) = -(Eigen::Matrix3d::Identity() - turn) * evaluation.frame;
  block->block<3, 1>(3, 6) << 0, 0, -place.length;
  block->block<3, 3>(3, 7) = -turn * evaluation.orientation;

  Eigen::Matrix<double, 6, 1> motion;
  motion << 1, 0, 0, 0, 0, curvature;
  if (evaluation.weighted) {
    const Eigen::Matrix3d to_axes = axes * evaluation.to_frame;
    const Eigen::Matrix3d position = to_axes * samples.position_weights[i] * to_axes.transpose();
    const Eigen::Matrix3d orientation = evaluation.to_frame * samples.orientation_weights[i] * evaluation.to_frame.transpose();
    block->topRows<3>() = (position * block->topRows<3>()).eval();
    block->bottomRows<3>() = (orientation * block->bottomRows<3>()).eval();
    motion.head<3>() = (position * motion.head<3>()).eval();
    motion.tail<3>() = (orientation * motion.tail<3>()).eval();
  }
  const double ratio = noise.placing_position / noise.placing_orientation;
  block->bottomRows<3>() *= ratio;
  motion.tail<3>() *= ratio;
  if (motion.squaredNorm() > 1e-12) projectOutMotion(motion, block);
  block->bottomRows<3>() /= ratio;
}

/// Turns residuals r with scale s into r' with |r'|^2 = (nu + d) ln(1 + |r|^2 / (nu s^2)), the negative log-likelihood of
/// Student's t in d dimensions, and their derivatives likewise. `dimensions` is d where rows are dependent.
template <class Rows>
void makeRobust(double scale, double nu, int dimensions, Rows rows) {
  rows /= scale;
  const double square = rows.col(0).squaredNorm();
  const double ratio = (nu + dimensions) / (nu + square);
  if (square < 1e-8) {
    rows *= std::sqrt((nu + dimensions) / nu);
    return;
  }
  const double value = std::sqrt((nu + dimensions) * std::log1p(square / nu));
  const double length = std::sqrt(square);
  const Eigen::Matrix<double, Rows::RowsAtCompileTime, 1> direction = rows.col(0) / length;
  const double across = value / length;
  const double along = ratio * length / value;
  constexpr int kDerivatives = Rows::ColsAtCompileTime - 1;
  const Eigen::Matrix<double, 1, kDerivatives> radial = direction.transpose() * rows.template rightCols<kDerivatives>();
  rows *= across;
  rows.template rightCols<kDerivatives>() += (along - across) * direction * radial;
}

}  // namespace

template <bool kWithOrientation>
Arc ArcProblem<kWithOrientation>::arc(const double* parameters) const {
  const Eigen::Map<const Eigen::Matrix<double, NUM_PARAMETERS, 1>> x(parameters);
  Arc arc = base_;
  arc.middle += base_.frame.rightCols<2>() * x.template head<2>();
  arc.frame = base_.frame * rotationFromVector(x.template segment<3>(2));
  if (curvature_ == Curvature::kFree) arc.curvature += x[5];
  if constexpr (kWithOrientation) arc.orientation = rotationFromVector(base_.frame * x.template tail<3>()) * base_.orientation;
  return arc;
}

template <bool kWithOrientation>
bool ArcProblem<kWithOrientation>::operator()(const double* parameters, double* residuals, double* jacobian) const {
  const Eigen::Map<const Eigen::Matrix<double, NUM_PARAMETERS, 1>> x(parameters);
  Eigen::Vector3d orientation_increment = Eigen::Vector3d::Zero();
  if constexpr (kWithOrientation) orientation_increment = x.template tail<3>();
  const Evaluation evaluation =
      evaluationAt(arc(parameters), x.template segment<3>(2), orientation_increment, noise_, !samples_.position_weights.empty());
  const int rows = NumResiduals();
  Eigen::Map<Eigen::VectorXd> out(residuals, rows);
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, NUM_PARAMETERS>> out_jacobian(jacobian, jacobian ? rows : 0, NUM_PARAMETERS);
  Block<kRows, NUM_PARAMETERS> block, current, previous = Block<kRows, NUM_PARAMETERS>::Zero();
  constexpr int kRotationRows = kRows - kPositionRows;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    fillBlock(samples_, i, evaluation, noise_, &current);
    if (curvature_ == Curvature::kFixed) current.col(6).setZero();
    block = current;
    if (noise_.sequence && i == 0) {
      block.template topRows<kPositionRows>() /= noise_.first_position;
      block.template bottomRows<kRotationRows>() /= noise_.first_orientation;
    } else {
      if (noise_.sequence) {
        block.template topRows<kPositionRows>() -= noise_.position_correlation * previous.template topRows<kPositionRows>();
        block.template bottomRows<kRotationRows>() -=
            noise_.orientation_correlation * previous.template bottomRows<kRotationRows>();
      }
      makeRobust(noise_.position, noise_.degrees_of_freedom, 2, block.template topRows<kPositionRows>());
      if constexpr (kWithOrientation)
        makeRobust(noise_.orientation, noise_.degrees_of_freedom, 3, block.template bottomRows<kRotationRows>());
    }
    previous = current;
    out.template segment<kRows>(kRows * i) = block.col(0);
    if (jacobian) out_jacobian.template middleRows<kRows>(kRows * i) = block.template rightCols<NUM_PARAMETERS>();
  }
  return true;
}

template <bool kWithOrientation>
typename ArcProblem<kWithOrientation>::Residuals ArcProblem<kWithOrientation>::rawResiduals() const {
  const Evaluation evaluation =
      evaluationAt(base_, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), noise_, !samples_.position_weights.empty());
  Residuals residuals(kRows, static_cast<Eigen::Index>(samples_.size()));
  Block<kRows, NUM_PARAMETERS> block;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    fillBlock(samples_, i, evaluation, noise_, &block);
    residuals.col(static_cast<Eigen::Index>(i)) = block.col(0);
  }
  return residuals;
}

template class ArcProblem<false>;
template class ArcProblem<true>;

}  // namespace cabinet_articulation::core

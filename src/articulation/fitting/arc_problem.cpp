// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/arc_problem.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "articulation/fitting/robust_residuals.h"
#include "articulation/paths/nearest_on_arc.h"

namespace cabinet_articulation::core {
namespace {

/// What one evaluation needs for all poses.
struct Evaluation {
  Evaluation(const Arc& arc, const ResidualNoise& noise, bool is_weighted)
      : curvature(arc.curvature),
        middle(arc.middle),
        to_frame(arc.frame.transpose()),
        left(to_frame),
        right(arc.orientation.transpose() * arc.frame),
        ratio(noise.placing_position / noise.placing_orientation),
        orientation_places(std::abs(arc.curvature) * kReachOfOrientations * ratio > 1),
        weighted(is_weighted) {}

  double curvature;
  Eigen::Vector3d middle;
  Eigen::Matrix3d to_frame;
  Eigen::Quaterniond left, right;  ///< a pose's rotation in the arc's frame is left * orientation * right
  double ratio;                    ///< [m/rad] a position's worth of an angle
  bool orientation_places;         ///< close to the axis, as kReachOfOrientations says
  bool weighted;
};

/// Residual (first column) of one pose and, unless kColumns is 1, its derivatives.
template <int kRows, int kColumns>
using Block = Eigen::Matrix<double, kRows, kColumns>;

template <int kColumns>
void fillBlock(const PoseSamples& samples, std::size_t i, const Evaluation& evaluation, Block<2, kColumns>* block) {
  const Eigen::Vector3d p = evaluation.to_frame * (samples.positions[i] - evaluation.middle);
  const ArcPlace place = nearestPlace(p, evaluation.curvature);
  block->col(0) << place.outward, p.z();
  if constexpr (kColumns > 1) {
    const double c = place.cosine, s = place.sine;
    block->template rightCols<6>() << c, 0, -p.z() * c, -p.z() * s, p.x() * c + p.y() * s, place.bend,  //
        0, -1, -p.y(), p.x(), 0, 0;
  }
}

/// rotationVector() in less time: the series is exact to 1e-7 up to 0.1, where most residuals are.
Eigen::Vector3d residualRotation(Eigen::Quaterniond q) {
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double square = q.vec().squaredNorm();
  if (square < 0.01) return (2 + square / 3 + 0.15 * square * square) * q.vec();
  return rotationVector(q);
}

/// Rotation by -theta about the axis, from its cosine and sine.
Eigen::Quaterniond turnBack(double cosine, double sine) {
  if (cosine >= 0) {
    const double half = std::sqrt((1 + cosine) / 2);
    return {half, 0, 0, -sine / (2 * half)};
  }
  const double half = std::copysign(std::sqrt((1 - cosine) / 2), sine);
  return {sine / (2 * half), 0, 0, -half};
}

/// Removes from the rows what a pose could make up for by moving along the path (variable projection). `motion` is the
/// rows' change with that.
template <int kColumns>
void projectOutMotion(const Eigen::Matrix<double, 6, 1>& motion, Block<6, kColumns>* block) {
  const double square = motion.squaredNorm();
  if (square > 1e-12) *block -= motion * ((motion.transpose() * *block) / square).eval();
}

/// The same where nothing is weighted: only the row along the path and that of turning about the axis are concerned. `turn` is
/// what moving by a metre changes in the latter; it changes by `ratio` with the curvature.
template <int kColumns>
void projectOutMotion(double turn, double ratio, Block<6, kColumns>* block) {
  const double square = 1 + turn * turn;
  const double along = (*block)(0, 0), turned = (*block)(5, 0);
  const Eigen::Matrix<double, 1, kColumns> common = (block->row(0) + turn * block->row(5)) / square;
  block->row(0) -= common;
  block->row(5) -= turn * common;
  if constexpr (kColumns > 1) {
    const double change = ratio * (turned * (1 - turn * turn) - 2 * turn * along) / (square * square);
    (*block)(0, 6) -= change;
    (*block)(5, 6) -= turn * change + ratio * common(0);
  }
}

/// Weighs a pose's rows, of which positions are along, outward and along the axis, and takes its motion along the path out.
template <int kColumns>
void weigh(const PoseSamples& samples, std::size_t i, const Evaluation& evaluation, const ArcPlace& place,
           Block<6, kColumns>* block) {
  Eigen::Matrix3d axes;  // rows: along, outward, axis
  axes << place.cosine, place.sine, 0, place.sine, -place.cosine, 0, 0, 0, 1;
  const Eigen::Matrix3d to_axes = axes * evaluation.to_frame;
  const Eigen::Matrix3d position = to_axes * samples.position_weights[i] * to_axes.transpose();
  const Eigen::Matrix3d orientation = evaluation.to_frame * samples.orientation_weights[i] * evaluation.to_frame.transpose();
  block->template topRows<3>() = (position * block->template topRows<3>()).eval();
  block->template bottomRows<3>() = (orientation * block->template bottomRows<3>()).eval();
  Eigen::Matrix<double, 6, 1> motion;
  motion << position.col(0), orientation.col(2) * evaluation.ratio * evaluation.curvature;
  projectOutMotion<kColumns>(motion, block);
}

template <int kColumns>
void fillBlock(const PoseSamples& samples, std::size_t i, const Evaluation& evaluation, Block<6, kColumns>* block) {
  const double curvature = evaluation.curvature;
  const Eigen::Vector3d p = evaluation.to_frame * (samples.positions[i] - evaluation.middle);
  const Eigen::Quaterniond turned = evaluation.left * samples.orientations[i] * evaluation.right;
  ArcPlace place;
  if (evaluation.orientation_places) {
    place = placeAtAngle(p, curvature, 2 * std::atan2(turned.w() < 0 ? -turned.z() : turned.z(), std::abs(turned.w())));
  } else {
    place = kColumns > 1 ? nearestPlaceWithLength(p, curvature) : nearestPlace(p, curvature);
  }
  const double c = place.cosine, s = place.sine;
  block->template topRows<3>().col(0) << place.along, place.outward, p.z();
  block->template bottomRows<3>().col(0) = residualRotation(turned * turnBack(c, s));
  if constexpr (kColumns > 1) {
    // A rotation vector's derivative by a small turn is a matrix that leaves the vector itself alone. The identity in its place
    // gives the exact gradient of its square.
    block->template rightCols<9>() << -s, 0, p.z() * s, -p.z() * c, p.y() * c - p.x() * s, -place.stretch, 0, 0, 0,  //
        c, 0, -p.z() * c, -p.z() * s, p.x() * c + p.y() * s, place.bend, 0, 0, 0,                                    //
        0, -1, -p.y(), p.x(), 0, 0, 0, 0, 0,                                                                         //
        0, 0, c - 1, -s, 0, 0, -c, s, 0,                                                                             //
        0, 0, s, c - 1, 0, 0, -s, -c, 0,                                                                             //
        0, 0, 0, 0, 0, -place.length, 0, 0, -1;
  }
  block->template bottomRows<3>() *= evaluation.ratio;
  const double turn = evaluation.ratio * curvature;
  if (kColumns > 1 && !evaluation.orientation_places) {
    // The nearest place goes along with the arc, so that nothing is ever left over along it.
    block->row(5) -= turn / (1 + curvature * place.outward) * block->row(0);
    block->row(0).setZero();
  }
  if (evaluation.weighted)
    weigh<kColumns>(samples, i, evaluation, place, block);
  else
    projectOutMotion<kColumns>(turn, evaluation.ratio, block);
  block->template bottomRows<3>() /= evaluation.ratio;
}

}  // namespace

template <bool kWithOrientation>
double ArcProblem<kWithOrientation>::hingeCost() const {
  return expectsHinge() ? 0.5 * samples_.hinge.residuals(base_).squaredNorm() : 0;
}

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
template <int kColumns>
Eigen::Matrix<double, kColumns, kColumns> ArcProblem<kWithOrientation>::products(const Arc& arc) const {
  const Evaluation evaluation(arc, noise_, !samples_.position_weights.empty());
  Eigen::Matrix<double, kColumns, kColumns> sum = Eigen::Matrix<double, kColumns, kColumns>::Zero();
  Block<kRows, kColumns> block, current, previous = Block<kRows, kColumns>::Zero();
  constexpr int kRotationRows = kRows - kPositionRows;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    fillBlock<kColumns>(samples_, i, evaluation, &current);
    if constexpr (kColumns > 1)
      if (curvature_ == Curvature::kFixed) current.col(6).setZero();
    block = current;
    if (noise_.sequence && samples_.run_starts[i]) {
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
    if (noise_.sequence) previous = current;
    for (int a = 0; a < kColumns; ++a)
      for (int b = a; b < kColumns; ++b) sum(b, a) += block.col(a).dot(block.col(b));
  }
  return sum;
}

template <bool kWithOrientation>
bool ArcProblem<kWithOrientation>::operator()(const double* parameters, double* residuals, double* jacobian) const {
  constexpr int kColumns = 1 + NUM_PARAMETERS;
  Eigen::Map<Eigen::Matrix<double, NUM_RESIDUALS, 1>> out(residuals);
  out.setZero();
  const Arc moved = arc(parameters);
  if (jacobian) {
    Eigen::Map<Eigen::Matrix<double, NUM_RESIDUALS, NUM_PARAMETERS>> out_jacobian(jacobian);
    out_jacobian.setZero();
    if (!Eigen::Map<const Eigen::Matrix<double, NUM_PARAMETERS, 1>>(parameters).isZero(0)) return true;
    const Eigen::LDLT<Eigen::Matrix<double, kColumns, kColumns>> factors(products<kColumns>(base_));
    Eigen::Matrix<double, kColumns, kColumns> root = factors.transpositionsP() * decltype(root)::Identity();
    root = factors.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal() * (factors.matrixU() * root).eval();
    out.template head<kColumns>() = root.col(0);
    out_jacobian.template topRows<kColumns>() = root.template rightCols<NUM_PARAMETERS>();
    if constexpr (kWithOrientation) {
      if (expectsHinge()) out_jacobian.template bottomRows<2>() = samples_.hinge.jacobian(base_);
      if (curvature_ == Curvature::kFixed) out_jacobian.col(5).setZero();
    }
  } else {
    out[0] = std::sqrt(products<1>(moved)(0, 0));
  }
  if (expectsHinge()) out.template tail<2>() = samples_.hinge.residuals(moved);
  return true;
}

template <bool kWithOrientation>
typename ArcProblem<kWithOrientation>::Residuals ArcProblem<kWithOrientation>::rawResiduals() const {
  const Evaluation evaluation(base_, noise_, !samples_.position_weights.empty());
  Residuals residuals(kRows, static_cast<Eigen::Index>(samples_.size()));
  Block<kRows, 1> block;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    fillBlock<1>(samples_, i, evaluation, &block);
    residuals.col(static_cast<Eigen::Index>(i)) = block;
  }
  return residuals;
}

template class ArcProblem<false>;
template class ArcProblem<true>;

}  // namespace cabinet_articulation::core

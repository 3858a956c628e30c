// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/arc_problem.h"

#include <gtest/gtest.h>

#include <random>

namespace cabinet_articulation::core {
namespace {

Arc exampleArc(double curvature) {
  Arc arc;
  arc.middle << 0.3, -0.2, 1.4;
  arc.frame = rotationFromVector(Eigen::Vector3d(0.3, -1.1, 0.7));
  arc.curvature = curvature;
  arc.orientation = rotationFromVector(Eigen::Vector3d(-0.2, 0.4, 2.0));
  return arc;
}

PoseSequence noisyTrack(const Arc& arc, double noise, bool with_orientation) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto vector = [&]() { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  PoseSequence track;
  track.has_orientation = with_orientation;
  for (int i = 0; i < 12; ++i) {
    Eigen::Isometry3d pose = arc.pose(-0.25 + 0.05 * i);
    pose.pretranslate(noise * vector());
    pose.linear() = rotationFromVector(5 * noise * vector()) * pose.linear();
    track.poses.push_back(pose);
    track.stamps.push_back(i);
  }
  return track;
}

TEST(Arc, StaysOrthonormalHoweverOftenItIsRecentered) {
  Arc arc = exampleArc(2.5);
  for (int i = 0; i < 1000; ++i) arc = arc.recentered(i % 2 ? 0.35 : -0.35);
  EXPECT_LT((arc.frame.transpose() * arc.frame - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((arc.orientation.transpose() * arc.orientation - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(Arc, PosesGoRoundTheCentre) {
  const Arc arc = exampleArc(2.5);
  for (const double s : {-0.7, -0.1, 0.0, 0.3, 1.1}) {
    const Eigen::Isometry3d pose = arc.pose(s);
    EXPECT_NEAR((pose.translation() - arc.center()).norm(), 0.4, 1e-12);
    EXPECT_NEAR(arc.arcLength(pose.translation()), s, 1e-12);
    EXPECT_NEAR(arc.squaredDistance(pose.translation()), 0, 1e-20);
    EXPECT_TRUE(pose.linear().isApprox(Eigen::AngleAxisd(2.5 * s, arc.axis()) * arc.orientation, 1e-12));
    EXPECT_TRUE(arc.recentered(0.2).pose(s - 0.2).isApprox(pose, 1e-12));
  }
}

TEST(Arc, ALineIsTheLimitOfSmallCurvature) {
  const Arc line = exampleArc(0), arc = exampleArc(1e-7);
  EXPECT_TRUE(line.pose(0.5).isApprox(arc.pose(0.5), 1e-6));
  const Eigen::Vector3d p = line.point(0.3) + 0.1 * line.frame.col(1) + 0.2 * line.axis();
  EXPECT_NEAR(line.arcLength(p), arc.arcLength(p), 1e-6);
  EXPECT_NEAR(line.squaredDistance(p), 0.05, 1e-9);
  EXPECT_NEAR(arc.squaredDistance(p), 0.05, 1e-6);
}

template <bool kWithOrientation>
void expectGradient(const ResidualNoise& noise, double curvature, bool weighted) {
  using Problem = ArcProblem<kWithOrientation>;
  PoseSequence track = noisyTrack(exampleArc(curvature), 0.005, kWithOrientation);
  if (weighted) {
    track.position_weights.assign(track.size(), Eigen::Vector3d(1, 0.2, 0.7).asDiagonal());
    track.orientation_weights.assign(track.size(), Eigen::Vector3d(0.9, 1, 0.5).asDiagonal());
  }
  const PoseSamples samples(track);
  Arc base = exampleArc(curvature);
  base.middle += Eigen::Vector3d(0.004, -0.002, 0.006);
  base.frame = base.frame * rotationFromVector(Eigen::Vector3d(0.01, 0.02, -0.03));
  const Problem problem(samples, noise, base, Curvature::kFree);
  using Parameters = Eigen::Matrix<double, Problem::NUM_PARAMETERS, 1>;
  const Parameters x = Parameters::Zero();
  Eigen::Matrix<double, Problem::NUM_RESIDUALS, 1> residuals;
  Eigen::Matrix<double, Problem::NUM_RESIDUALS, Problem::NUM_PARAMETERS> jacobian;
  problem(x.data(), residuals.data(), jacobian.data());
  const Parameters gradient = jacobian.transpose() * residuals;
  const auto cost = [&](const Parameters& at) {
    problem(at.data(), residuals.data(), nullptr);
    return residuals.squaredNorm() / 2;
  };
  const double scale = gradient.cwiseAbs().maxCoeff();
  for (int i = 0; i < x.size(); ++i) {
    const double step = 1e-6;
    Parameters plus = x, minus = x;
    plus[i] += step;
    minus[i] -= step;
    // The place along the path is eliminated to first order only where orientations and weights have a say.
    EXPECT_NEAR(gradient[i], (cost(plus) - cost(minus)) / (2 * step), (kWithOrientation ? 0.03 : 1e-4) * scale)
        << i << " curvature " << curvature;
  }
}

TEST(ArcProblem, JacobianGivesTheGradientOfTheCost) {
  ResidualNoise noise;
  noise.position = 0.004;
  noise.orientation = 0.03;
  for (const double curvature : {0.0, 0.9, 2.5, -2.5}) {
    expectGradient<false>(noise, curvature, false);
    expectGradient<true>(noise, curvature, false);
  }
  expectGradient<true>(noise, 2.5, true);
}

TEST(ArcProblem, JacobianGivesTheGradientForSequences) {
  ResidualNoise noise;
  noise.position = 0.004;
  noise.orientation = 0.03;
  noise.sequence = true;
  noise.position_correlation = 0.8;
  noise.orientation_correlation = 0.5;
  for (const double curvature : {0.0, 2.5}) {
    expectGradient<false>(noise, curvature, false);
    expectGradient<true>(noise, curvature, false);
  }
}

TEST(HingePrior, AnAxisOnAnEdgeCostsNothing) {
  Arc arc;  // turns about z, 0.3 m along y; the front's x lies along y
  arc.curvature = 1 / 0.3;
  arc.orientation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  HingePrior prior;
  prior.sigma = 0.05;
  prior.half_size << 0.2, 0.35;
  prior.center << 0.1, 0, 0;  // the reference point is 0.1 m off the centre, away from the hinge
  EXPECT_LT(prior.residuals(arc).norm(), 1e-12);
  arc.curvature = 1 / 0.34;
  EXPECT_LT((prior.residuals(arc) - Eigen::Vector2d(0, 0.8)).norm(), 1e-12) << "4 cm beyond the edge";
  arc.curvature = -1 / 0.07;
  EXPECT_LT((prior.residuals(arc) - Eigen::Vector2d(0, -0.6)).norm(), 1e-12) << "3 cm inside of the other edge";
  arc.curvature = 1 / 0.3;
  arc.orientation = rotationFromVector({0, 0, 0.1}) * arc.orientation;
  EXPECT_NEAR(std::abs(prior.residuals(arc)[0]), 0.3 * std::sin(0.1) / 0.05, 1e-12) << "off the plane";
}

TEST(ArcProblem, AHingeAwayFromWhereHingesAreCosts) {
  const Arc arc = exampleArc(2.5);
  PoseSequence track = noisyTrack(arc, 0.005, true);
  track.hinge.sigma = 0.05;
  track.hinge.center << 0.11, -0.07, 0;
  track.hinge.half_size << 0.2, 0.35;
  const PoseSamples samples(track);
  const ResidualNoise noise;
  const ArcProblem<true> problem(samples, noise, arc, Curvature::kFree);
  constexpr int rows = ArcProblem<true>::NUM_RESIDUALS;
  using Parameters = Eigen::Matrix<double, 9, 1>;
  Eigen::Matrix<double, rows, 1> residuals, moved;
  Eigen::Matrix<double, rows, 9> jacobian;
  problem(Parameters::Zero().eval().data(), residuals.data(), jacobian.data());
  EXPECT_TRUE(residuals.tail<2>().isApprox(track.hinge.residuals(arc), 1e-12));
  EXPECT_NEAR(problem.hingeCost(), 0.5 * residuals.tail<2>().squaredNorm(), 1e-9);
  for (int i = 0; i < 9; ++i) {
    const Parameters step = 1e-6 * Parameters::Unit(i);
    problem(step.data(), moved.data(), nullptr);
    for (int row = rows - 2; row < rows; ++row) EXPECT_NEAR(jacobian(row, i), (moved[row] - residuals[row]) / 1e-6, 1e-3) << i;
  }
  const ArcProblem<true> line(samples, noise, exampleArc(0), Curvature::kFixed);
  line(Parameters::Zero().eval().data(), residuals.data(), nullptr);
  EXPECT_TRUE(residuals.tail<2>().isZero(0)) << "lines have none";
}

TEST(ArcProblem, HalfTheSquareSumIsTheNegativeLogLikelihoodOfStudentsT) {
  const Arc arc = exampleArc(2.5);
  const PoseSamples samples(noisyTrack(arc, 0.005, false));
  ResidualNoise noise;
  noise.position = 0.004;
  const ArcProblem<false> problem(samples, noise, arc, Curvature::kFree);
  Eigen::Matrix<double, ArcProblem<false>::NUM_RESIDUALS, 1> residuals;
  const Eigen::Matrix<double, 6, 1> zero = Eigen::Matrix<double, 6, 1>::Zero();
  problem(zero.data(), residuals.data(), nullptr);
  const auto raw = problem.rawResiduals();
  double expected = 0;
  for (Eigen::Index i = 0; i < raw.cols(); ++i)
    expected += 0.5 * (5 + 2) * std::log(1 + raw.col(i).squaredNorm() / (5 * 0.004 * 0.004));
  EXPECT_NEAR(residuals.squaredNorm() / 2, expected, 1e-9);
}

TEST(ArcProblem, PosesOnThePathHaveNoResiduals) {
  for (const double curvature : {0.0, 0.8, 5.0, 40.0}) {
    const Arc arc = exampleArc(curvature);
    PoseSequence track;
    for (const double s : {-0.05, 0.0, 0.02}) {
      track.poses.push_back(arc.pose(s));
      track.stamps.push_back(s);
    }
    const PoseSamples samples(track);
    EXPECT_LT(ArcProblem<true>(samples, ResidualNoise(), arc, Curvature::kFree).rawResiduals().cwiseAbs().maxCoeff(), 1e-9)
        << curvature;
  }
}

}  // namespace
}  // namespace cabinet_articulation::core

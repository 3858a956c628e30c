// SPDX-License-Identifier: BSD-3-Clause
#include "closing/surface_plane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kLeastPoints = 6;  ///< twice the parameters
constexpr int kIterations = 6;           ///< converged to 0.1 mm (measured)
constexpr double kTukey = 4.685;         ///< 95 % efficiency for Gaussian noise (Huber, Robust Statistics)
constexpr double kLeastSigma = 0.001;    ///< [m] depth cameras quantise to a millimetre
constexpr double kCorrelation = 4;  ///< on variances: neighbouring cells share windows of matching and bumps of the depth (ours)

}  // namespace

std::optional<SurfacePlane> fitSurface(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < kLeastPoints) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixX3d A(n, 3);
  Eigen::VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d& point = points[static_cast<std::size_t>(i)];
    A.row(i) << 1, point.x(), point.y();
    z(i) = point.z();
  }
  SurfacePlane plane;
  plane.c(0) = median({z.data(), z.data() + n});
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  double sigma = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXd residual = z - A * plane.c;
    const Eigen::VectorXd size = residual.cwiseAbs();
    sigma = std::max(kLeastSigma, kDeviationToSigma * median({size.data(), size.data() + n}));
    const Eigen::ArrayXd share = 1 - (size.array() / (kTukey * sigma)).square();
    const Eigen::VectorXd weight = share.max(0.0).square();
    normal_matrix = A.transpose() * weight.asDiagonal() * A;
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal_matrix);
    const double smallest = solver.vectorD().minCoeff();
    if (!(smallest > 0)) return std::nullopt;
    plane.c += solver.solve(A.transpose() * weight.asDiagonal() * residual);
  }
  plane.covariance = kCorrelation * sigma * sigma * normal_matrix.inverse();
  if (!plane.c.allFinite() || !plane.covariance.allFinite()) return std::nullopt;
  return plane;
}

}  // namespace cabinet_articulation::core

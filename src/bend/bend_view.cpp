// SPDX-License-Identifier: BSD-3-Clause
#include "bend/bend_view.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "cabinet_articulation/stereo/depth_frame.h"
#include "geometry/degrees.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kLeastShare = 0.03;  ///< of the image (ours): a bend shows in what reaches across a sixth of its sides
constexpr int kStep = 5;              ///< [px] between samples: three along a window
constexpr double kWindow = 15 * 15;   ///< [px] a window of matching, within which noise is one and the same
/// The finest terms go up and down within a quarter of the image, 14 degrees of a depth camera with 57: half of it is told apart.
constexpr double kOtherAngle = 7 * kDegree;
constexpr double kOtherDistance = 1.2;  ///< ratio (ours): what is in the middle of a half moves by a tenth of that half's width

constexpr int kPlaneTerms = 3;
constexpr int kTerms = kPlaneTerms + kBendTerms;
using TermsVector = Eigen::Matrix<double, kTerms, 1>;
using TermsMatrix = Eigen::Matrix<double, kTerms, kTerms>;

/// The sums of least squares over a region's samples.
struct Sums {
  int samples = 0;
  double squares = 0;
  TermsVector gradient = TermsVector::Zero();
  TermsMatrix information = TermsMatrix::Zero();

  void add(const BendVector& terms, double x, double y, double residual) {
    TermsVector row;
    row << 1, x, y, terms;
    ++samples;
    squares += residual * residual;
    gradient += residual * row;
    information.selfadjointView<Eigen::Lower>().rankUpdate(row);
  }
};

/// Without the plane.
std::optional<BendView> reduced(const Sums& sums, const PlaneRegion& region) {
  const Eigen::Matrix<double, kTerms, kTerms> all = sums.information.selfadjointView<Eigen::Lower>();
  const Eigen::LLT<Eigen::Matrix3d> of_plane(all.topLeftCorner<kPlaneTerms, kPlaneTerms>());
  if (of_plane.info() != Eigen::Success) return std::nullopt;
  const auto across = all.topRightCorner<kPlaneTerms, kBendTerms>();
  const Eigen::Vector3d right = sums.gradient.head<kPlaneTerms>();
  const Eigen::Vector3d solved = of_plane.solve(right);
  const double windows_of_sample = kStep * kStep / kWindow;
  BendView view;
  view.plane = region.plane;
  view.pixels = region.inliers;
  view.windows = windows_of_sample * sums.samples;
  view.squares = windows_of_sample * std::max(0.0, sums.squares - right.dot(solved));
  view.gradient = windows_of_sample * (sums.gradient.tail<kBendTerms>() - across.transpose() * solved);
  view.information =
      windows_of_sample * (all.bottomRightCorner<kBendTerms, kBendTerms>() - across.transpose() * of_plane.solve(across));
  return view;
}

}  // namespace

bool showsBend(const PlaneRegion& region) { return region.inliers >= kLeastShare * static_cast<double>(region.mask.total()); }

bool sameSight(const Plane& a, const Plane& b) {
  static const double least_cos = std::cos(kOtherAngle);
  return a.normal.dot(b.normal) > least_cos && std::max(a.offset, b.offset) < kOtherDistance * std::min(a.offset, b.offset);
}

std::optional<BendView> BendSurvey::process(const cv::Mat1f& disparity, const PlaneRegion& region) {
  if (region.hull.empty()) return std::nullopt;
  if (basis_.size() != disparity.size()) basis_ = BendBasis(disparity.size());
  inside_.create(disparity.size());
  inside_.setTo(0);
  const std::vector<cv::Point> hull(region.hull.begin(), region.hull.end());
  cv::fillConvexPoly(inside_, hull, 1);
  Sums sums;
  for (int v = 0; v < disparity.rows; v += kStep)
    for (int u = 0; u < disparity.cols; u += kStep) {
      if (inside_(v, u) == 0 || region.mask(v, u) != kInPlane || !isValidDisparity(disparity(v, u))) continue;
      const double x = static_cast<double>(u) / disparity.cols, y = static_cast<double>(v) / disparity.rows;
      sums.add(basis_.at(u, v), x, y, disparity(v, u) - region.disparity_plane.at(u, v));
    }
  return reduced(sums, region);
}

}  // namespace cabinet_articulation::core

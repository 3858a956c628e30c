// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace cabinet_articulation::core {

/// Terms of the bend: the products of two Legendre polynomials of total degree 2 to 4. Degrees 0 and 1 cannot be told from a
/// plane.
constexpr int kBendTerms = 12;                            // 3 + 4 + 5 of degrees 2, 3 and 4
using BendVector = Eigen::Matrix<double, kBendTerms, 1>;  ///< [px] one factor for each term
using BendMatrix = Eigen::Matrix<double, kBendTerms, kBendTerms>;

/// The terms over an image, whose sides go from -1 to 1. All are within -1 and 1, and orthogonal over the whole image.
///
/// Source: Herrera et al. (PAMI 2012) and Teichman et al. (RSS 2013) calibrate an image of such errors for each sensor. Theirs
/// fade or grow with the distance, which is neglected here, and has pixels instead of smooth terms.
class BendBasis {
 public:
  explicit BendBasis(cv::Size size = {});

  cv::Size size() const { return {static_cast<int>(columns_.size()), static_cast<int>(rows_.size())}; }

  BendVector at(int u, int v) const;

  /// [px] the bend of every pixel. Uses the memory of `image` again if it has the right size.
  void draw(const BendVector& bend, cv::Mat1f* image) const;

 private:
  static constexpr int kDegrees = 5;  ///< 0 to 4
  using Polynomials = std::array<double, kDegrees>;

  static Polynomials legendre(int pixel, int pixels);

  std::vector<Polynomials> columns_, rows_;
};

}  // namespace cabinet_articulation::core

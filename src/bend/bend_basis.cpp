// SPDX-License-Identifier: BSD-3-Clause
#include "bend/bend_basis.h"

namespace cabinet_articulation::core {

BendBasis::BendBasis(cv::Size size) {
  for (int u = 0; u < size.width; ++u) columns_.push_back(legendre(u, size.width));
  for (int v = 0; v < size.height; ++v) rows_.push_back(legendre(v, size.height));
}

/// Bonnet's recursion.
BendBasis::Polynomials BendBasis::legendre(int pixel, int pixels) {
  const double x = (2 * pixel + 1.0) / pixels - 1;
  Polynomials p{1, x};
  for (int n = 2; n < kDegrees; ++n) p[n] = ((2 * n - 1) * x * p[n - 1] - (n - 1) * p[n - 2]) / n;
  return p;
}

BendVector BendBasis::at(int u, int v) const {
  const Polynomials& x = columns_[u];
  const Polynomials& y = rows_[v];
  BendVector terms;
  int term = 0;
  for (int degree = 2; degree < kDegrees; ++degree)
    for (int i = 0; i <= degree; ++i) terms[term++] = x[degree - i] * y[i];
  return terms;
}

/// A row of the image is a polynomial of the column alone.
void BendBasis::draw(const BendVector& bend, cv::Mat1f* image) const {
  image->create(size());
  for (int v = 0; v < image->rows; ++v) {
    Polynomials factors{};
    int term = 0;
    for (int degree = 2; degree < kDegrees; ++degree)
      for (int i = 0; i <= degree; ++i) factors[degree - i] += bend[term++] * rows_[v][i];
    for (int u = 0; u < image->cols; ++u) {
      double sum = 0;
      for (int n = 0; n < kDegrees; ++n) sum += factors[n] * columns_[u][n];
      (*image)(v, u) = static_cast<float>(sum);
    }
  }
}

}  // namespace cabinet_articulation::core

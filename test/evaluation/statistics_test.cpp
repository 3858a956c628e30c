// SPDX-License-Identifier: BSD-3-Clause
#include "tables/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core::evaluation {
namespace {

TEST(Statistics, OfKnownNumbers) {
  const std::vector<double> values{4, 1, 3, 2};
  EXPECT_DOUBLE_EQ(mean(values), 2.5);
  EXPECT_DOUBLE_EQ(standardDeviation(values), std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(median(values), 2.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 4);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 3.7);
}

TEST(Statistics, OfNothingAreNoNumbers) {
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(standardDeviation({})));
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

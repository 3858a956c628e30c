// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "cabinet_articulation/pipeline/pipeline.h"

namespace cabinet_articulation::core {

inline void expectSameBits(const PipelineResult& a, const PipelineResult& b) {
  ASSERT_EQ(a.planes.size(), b.planes.size());
  for (size_t k = 0; k < a.planes.size(); ++k) {
    EXPECT_EQ(a.planes[k].plane.normal, b.planes[k].plane.normal);
    EXPECT_EQ(a.planes[k].plane.offset, b.planes[k].plane.offset);
    EXPECT_EQ(cv::norm(a.planes[k].mask, b.planes[k].mask, cv::NORM_INF), 0);
  }
  ASSERT_EQ(a.rectangles.size(), b.rectangles.size());
  for (size_t k = 0; k < a.rectangles.size(); ++k) {
    EXPECT_EQ(a.rectangles[k].rectangle.pose.matrix(), b.rectangles[k].rectangle.pose.matrix());
    EXPECT_EQ(a.rectangles[k].covariance, b.rectangles[k].covariance);
  }
  ASSERT_EQ(a.models.size(), b.models.size());
  for (size_t k = 0; k < a.models.size(); ++k) {
    EXPECT_EQ(a.models[k].type, b.models[k].type);
    EXPECT_EQ(a.models[k].axis, b.models[k].axis);
    EXPECT_EQ(a.models[k].axis_point, b.models[k].axis_point);
    EXPECT_EQ(a.models[k].covariance, b.models[k].covariance);
  }
}

}  // namespace cabinet_articulation::core

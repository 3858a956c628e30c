// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <limits>

#include "cabinet_articulation/ros/conversions.h"
#include "geometry/message_precision.h"
#include "support/throws_saying.h"

namespace cabinet_articulation {
namespace {

using test::ThrowsSaying;
using testing::HasSubstr;

core::DepthView example() {
  core::DepthView view;
  view.columns = 3;
  view.rows = 2;
  view.fx = 70.1;
  view.fy = 71.2;
  view.cx = 39.3;
  view.cy = 29.4;
  view.depth = {1.5F, 0, 2, 2.5F, 0, 3};
  view.T_fixed_camera = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized());
  return view;
}

TEST(ViewConversion, IsWhatThePipelineTakesForSent) {
  const core::DepthView view = example(), back = fromMessage(toMessage(view));
  EXPECT_EQ(back.columns, view.columns);
  EXPECT_EQ(back.rows, view.rows);
  EXPECT_EQ(back.depth, view.depth);
  for (const auto& field : {&core::DepthView::fx, &core::DepthView::fy, &core::DepthView::cx, &core::DepthView::cy})
    EXPECT_EQ(back.*field, view.*field);
  EXPECT_EQ(back.T_fixed_camera.matrix(), core::asSent(view.T_fixed_camera).matrix());
}

TEST(ViewConversion, OfAMessageThatHasNoneIsEmpty) { EXPECT_TRUE(fromMessage(TrackArray().view).empty()); }

TEST(ViewConversion, RefusesWhatNoCameraSees) {
  const auto refused = [](const std::string& words, const auto& damage) {
    DepthView message = toMessage(example());
    damage(&message);
    EXPECT_THAT([&] { fromMessage(message); }, ThrowsSaying<std::invalid_argument>(HasSubstr(words)));
  };
  refused("the view's depth has 5 cells, expected 6", [](DepthView* view) { view->depth.pop_back(); });
  refused("columns of the view", [](DepthView* view) { view->columns = 0; });
  refused("rows of the view", [](DepthView* view) { view->rows = 4000000000U; });
  refused("fx of the view", [](DepthView* view) { view->fx = 0; });
  refused("cy of the view", [](DepthView* view) { view->cy = std::numeric_limits<double>::quiet_NaN(); });
  refused("depth of the view", [](DepthView* view) { view->depth[1] = -1; });
  refused("depth of the view", [](DepthView* view) { view->depth[1] = std::numeric_limits<float>::quiet_NaN(); });
  refused("expected a unit quaternion", [](DepthView* view) { view->camera.orientation.w = 9; });
}

}  // namespace
}  // namespace cabinet_articulation

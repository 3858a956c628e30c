// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "cabinet_articulation/joints/joint.h"
#include "geometry/degrees.h"
#include "support/models.h"
#include "tools/report/front_charts.h"
#include "tools/report/svg_canvas.h"
#include "tools/report/thinned.h"
#include "tools/report_document.h"

namespace cabinet_articulation {
namespace {

const Eigen::Vector3d kUpwards = -Eigen::Vector3d::UnitY();  // in an optical frame
const TimeAxis kTime{"time [s]", {0, 2}, 0.1};

/// Seen without error at `steps` even openings from q = 0 to q_max, every tenth of a second.
FrontRecord watched(const core::LearnedModel& model, int steps = 20) {
  FrontRecord front;
  front.model = model;
  for (int i = 0; i <= steps; ++i) {
    const double time = 0.1 * i;
    front.observations.add({time, frontAt(model, model.q_max * i / steps), {1, 0, 0.5F, 1}});
    front.opinions.add({time, model.probabilities});
  }
  return front;
}

const Layer& layerOf(const Chart& chart, const std::string& name) {
  for (const Layer& layer : chart.layers)
    if (layer.name == name) return layer;
  throw std::out_of_range("no layer '" + name + "' in '" + chart.title + "'");
}

TEST(Thinned, KeepsEvenlySpacedValuesAndTheNewest) {
  Thinned<int> thinned(8);
  for (int i = 0; i <= 1000; ++i) {
    thinned.add(i);
    const std::vector<int> values = thinned.values();
    ASSERT_EQ(values.front(), 0);
    ASSERT_EQ(values.back(), i);
    ASSERT_LE(values.size(), 9U);
    ASSERT_GE(values.size(), std::min<std::size_t>(4, static_cast<std::size_t>(i) + 1));
    for (std::size_t k = 2; k + 1 < values.size(); ++k) ASSERT_EQ(values[k] - values[k - 1], values[1] - values[0]);
  }
  EXPECT_EQ(thinned.count(), 1001U);
}

TEST(Thinned, MakesOnlyWhatItKeeps) {
  Thinned<int> thinned(8);
  int made = 0;
  for (int i = 0; i < 10000; ++i) thinned.offer([&] { return ++made; });
  EXPECT_LT(made, 100);
}

TEST(Chart, TicksAreRoundNumbersWithinTheRange) {
  EXPECT_EQ(ticksOf({0, 10}, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  const std::vector<double> ticks = ticksOf({-0.13, 0.27}, 8);
  ASSERT_EQ(ticks.size(), 8U);
  EXPECT_NEAR(ticks.front(), -0.10, 1e-12);
  EXPECT_NEAR(ticks.back(), 0.25, 1e-12);
}

TEST(Chart, PointsLieWhereTheScaleSays) {
  Chart chart;
  chart.x = Range{0, 10};
  chart.y = Range{-1, 1};
  const ChartScale scale(chart, {100, 50, 200, 80});
  EXPECT_TRUE(scale.pixel({0, -1}).isApprox(Eigen::Vector2d(100, 130)));
  EXPECT_TRUE(scale.pixel({5, 0}).isApprox(Eigen::Vector2d(200, 90)));
  chart.y_down = true;
  EXPECT_TRUE(ChartScale(chart, {100, 50, 200, 80}).pixel({10, 1}).isApprox(Eigen::Vector2d(300, 130)));
}

TEST(Chart, AMetreIsAsLongInBothDirectionsOfAView) {
  const FrontRecord door = watched(test::doorModel());
  const ChartScale scale(topChart(door, beforeTheFront(door.model, kUpwards)), {0, 0, 400, 300});
  const Eigen::Vector2d origin = scale.pixel({0, 0});
  EXPECT_NEAR(scale.pixel({1, 0}).x() - origin.x(), scale.pixel({0, 1}).y() - origin.y(), 1e-9);
}

TEST(Chart, IsDrawnWithEveryDotInItsPlace) {
  const FrontRecord drawer = watched(test::drawerModel());
  const Chart chart = openingChart(drawer, kTime);
  SvgCanvas canvas(500, 300);
  const ChartScale scale = drawChart(chart, {0, 0, 500, 300}, &canvas);
  const auto circles = test::elements(test::parsed(canvas.element("openings")), "circle");
  ASSERT_EQ(circles.size(), 21U + 1U) << "one is in the legend";
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector2d expected = scale.pixel({0.1 * i, 1.5 * i});
    EXPECT_NEAR(circles[static_cast<std::size_t>(i) + 1].get<double>("<xmlattr>.cx"), expected.x(), 0.06) << i;
    EXPECT_NEAR(circles[static_cast<std::size_t>(i) + 1].get<double>("<xmlattr>.cy"), expected.y(), 0.06) << i;
  }
}

TEST(FrontCharts, OpeningsAreThoseThatWereObserved) {
  const Layer doors = layerOf(openingChart(watched(test::doorModel()), kTime), "observed");
  const Layer drawers = layerOf(openingChart(watched(test::drawerModel()), kTime), "observed");
  for (int i = 0; i <= 20; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_TRUE(doors.points[k].isApprox(Eigen::Vector2d(0.1 * i, core::toDegrees(1.2) * i / 20), 1e-6)) << i;
    EXPECT_TRUE(drawers.points[k].isApprox(Eigen::Vector2d(0.1 * i, 30.0 * i / 20), 1e-6)) << i;
  }
}

TEST(FrontCharts, OfWhatIsNoJointTheDistanceIsShown) {
  FrontRecord front = watched(test::drawerModel());
  front.model.explained = false;
  const Layer observed = layerOf(openingChart(front, kTime), "observed");
  EXPECT_NEAR(observed.points.back().y(), 30, 1e-9) << "cm";
}

TEST(FrontCharts, ADrawerComesOutInBothViews) {
  const FrontRecord drawer = watched(test::drawerModel());
  const Viewpoint view = beforeTheFront(drawer.model, kUpwards);
  const Layer top = layerOf(topChart(drawer, view), "observed centre, from light to dark");
  const Layer side = layerOf(sideChart(drawer, view), "observed centre, from light to dark");
  EXPECT_NEAR((top.points.back() - Eigen::Vector2d(0, 0.3)).norm(), 0, 1e-9);
  EXPECT_NEAR((side.points.back() - Eigen::Vector2d(0.3, 0)).norm(), 0, 1e-9);
}

TEST(FrontCharts, ADoorsHingeIsOnItsSide) {
  const FrontRecord door = watched(test::doorModel());
  const Viewpoint view = beforeTheFront(door.model, kUpwards);
  EXPECT_TRUE(view.right.isApprox(Eigen::Vector3d::UnitX())) << "as the camera sees it";
  EXPECT_TRUE(view.out.isApprox(-Eigen::Vector3d::UnitZ()));
  const Layer axis = layerOf(topChart(door, view), "learned axis");
  for (const Eigen::Vector2d& p : axis.points) EXPECT_NEAR((p - Eigen::Vector2d(-0.2, 0)).norm(), 0, 1e-9) << "at the left";
  const Layer upright = layerOf(sideChart(door, view), "learned axis");
  EXPECT_NEAR(std::abs(upright.points[0].y() - upright.points[1].y()), 0.6, 1e-9) << "as long as the door";
}

TEST(FrontCharts, EdgesAreNamedAsTheyAreSeenHoweverTheFrontIsDescribed) {
  const core::LearnedModel door = test::doorModel();
  const core::Rectangle front = frontAt(door, 0);
  for (int k = 0; k < 4; ++k) {
    core::LearnedModel turned = door;
    turned.origin = core::describe(front, k).pose;
    const Viewpoint view = beforeTheFront(turned, kUpwards);
    EXPECT_TRUE(view.up.isApprox(kUpwards)) << k;
    const std::array<Side, 4> sides = sidesOf(turned, view);
    for (std::size_t edge = 0; edge < 4; ++edge) {
      const Eigen::Vector3d out = turned.origin.linear().col(static_cast<Eigen::Index>(edge / 2)) * (edge % 2 == 0 ? -1 : 1);
      const std::array<Eigen::Vector3d, 4> directions{kUpwards, -kUpwards, -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX()};
      EXPECT_NEAR(out.dot(directions[sides[edge]]), 1, 1e-9) << k << ' ' << nameOf(sides[edge]);
    }
  }
}

TEST(FrontCharts, PosesOfAMarkerAreSeenAlongTheAxis) {
  core::LearnedModel door = test::doorModel();
  door.width = door.height = 0;
  const FrontRecord marker = watched(door);
  const Viewpoint view = alongTheMotion(marker, kUpwards);
  EXPECT_TRUE(view.up.isApprox(kUpwards));
  const Layer side = layerOf(sideChart(marker, view), "observed centre, from light to dark");
  for (const Eigen::Vector2d& p : side.points) EXPECT_NEAR(p.y(), 0, 1e-9) << "the circle is seen from its side";
}

}  // namespace
}  // namespace cabinet_articulation

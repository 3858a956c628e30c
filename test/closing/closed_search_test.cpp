// SPDX-License-Identifier: BSD-3-Clause
// Views of a wall with one front whose truth is known, and the joint that was learned of it.
#include "closing/closed_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "cabinet_articulation/joints/joint.h"
#include "geometry/degrees.h"
#include "support/models.h"
#include "support/wall_view.h"

namespace cabinet_articulation::core {
namespace {

using test::WallView;

class ClosedSearch : public testing::Test {
 protected:
  static LearnedModel door() {
    LearnedModel door = test::doorModel();
    door.q_min = 0.15;  // it was not detected closed
    return door;
  }

  static LearnedModel drawer() {
    LearnedModel drawer = test::drawerModel();
    drawer.q_min = 0.04;
    return drawer;
  }

  /// The wall around the front where q = 0.
  static Rectangle wallAround(const LearnedModel& front) { return {front.predict(0), 3, 3}; }

  /// The front at each q in turn; it is detected from `least` on, where `joint` has it then.
  void show(WallView kitchen, const LearnedModel& truth, const LearnedModel& joint, const std::vector<double>& qs, double least) {
    for (const double q : qs) {
      views_.push_back(kitchen.at(truth.predict(q), stamp_ += period_));
      if (q < least) continue;
      addSighting(joint, q, views_.back(), &history_);
    }
  }

  /// The opening that the found place has; NaN if none was found.
  double find(const LearnedModel& joint) const {
    const std::optional<ClosedPlace> place = findClosed(joint, history_, views_);
    if (!place) return std::numeric_limits<double>::quiet_NaN();
    const Eigen::Vector3d axis = joint.predict(0).linear().transpose() * joint.axis;
    const Eigen::Isometry3d T = joint.predict(0).inverse() * place->front.pose;
    return joint.type == JointType::kPrismatic
               ? T.translation().dot(axis)
               : Eigen::AngleAxisd(T.linear()).axis().dot(axis) * Eigen::AngleAxisd(T.linear()).angle();
  }

  FrontHistory history_;
  std::vector<DepthView> views_;
  double stamp_ = 0, period_ = 0.1;  // [s]
};

const std::vector<double> kDoorOpens = {0, 0, 0, 0, 0.002, 0.013, 0.04, 0.08, 0.16, 0.3, 0.5, 0.7, 0.9, 1.1, 1.2};
const std::vector<double> kDrawerOpens = {0, 0, 0, 0, 0.0002, 0.0017, 0.0054, 0.012, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3};

TEST_F(ClosedSearch, ADrawerThatBeginsToOpenDoesNotPullItsPlaceOut) {
  const LearnedModel drawer = ClosedSearch::drawer();
  show({frontAt(drawer, 0), wallAround(drawer)}, drawer, drawer, kDrawerOpens, drawer.q_min);
  EXPECT_NEAR(find(drawer), 0, 0.0003);
}

/// A front that is detected with a turn of a degree, as where depth bends, has its place right and its direction wrong.
TEST_F(ClosedSearch, ADoorThatIsTurnedAgainstItsJointIsClosedWhereItsPlaceIs) {
  const LearnedModel truth = door();
  LearnedModel joint = truth;
  joint.origin.rotate(Eigen::AngleAxisd(-1.2 * kDegree, Eigen::Vector3d::UnitY()));
  show({frontAt(truth, 0), wallAround(truth)}, truth, joint, kDoorOpens, truth.q_min);
  const std::optional<ClosedPlace> place = findClosed(joint, history_, views_);
  ASSERT_TRUE(place);
  EXPECT_NEAR(std::abs(place->turn.value_or(0)), 1.2 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(find(joint), 0, 0.2 * kDegree);
  joint.q_closed = 0;
  EXPECT_TRUE(showsShut(joint, place->turn, history_.edges, views_[0]).value_or(false)) << "it is turned there, too";
  EXPECT_NE(showsShut(joint, std::nullopt, history_.edges, views_[0]), false) << "the turn may be what makes it look ajar";
  EXPECT_FALSE(showsShut(joint, std::nullopt, history_.edges, views_.back()).value_or(true)) << "wide open";
}

TEST_F(ClosedSearch, AnUnknownTurnSaysNothingOfADoorThatSeemsAjar) {
  LearnedModel joint = door();
  joint.q_closed = 0;
  WallView kitchen(frontAt(joint, 0), wallAround(joint));
  const auto shuts = [&](double degrees, std::optional<double> turn) {
    return showsShut(joint, turn, OwnEdges(), kitchen.at(joint.predict(degrees * kDegree), 1));
  };
  EXPECT_EQ(shuts(0, std::nullopt), true);
  EXPECT_EQ(shuts(3, std::nullopt), std::nullopt);
  EXPECT_EQ(shuts(3, 0), false);
}

TEST_F(ClosedSearch, ATurnIsMeasuredInViewsThatShowTheDoorOpen) {
  const LearnedModel truth = door();
  EXPECT_FALSE(turnOf(truth, history_.sightings, views_)) << "it was not seen";
  EXPECT_EQ(turnOf(drawer(), {}, {}), 0);
  show({frontAt(truth, 0), wallAround(truth)}, truth, truth, kDoorOpens, truth.q_min);
  EXPECT_NEAR(turnOf(truth, history_.sightings, views_).value_or(1), 0, 0.1 * kDegree);
}

TEST_F(ClosedSearch, ADoorThatWasAjarByTwoDegreesWasNotSeenClosed) {
  const LearnedModel truth = door();
  std::vector<double> ajar = kDoorOpens;
  for (double& q : ajar) q = std::max(q, 2 * kDegree);
  show({frontAt(truth, 0), wallAround(truth)}, truth, truth, ajar, truth.q_min);
  EXPECT_TRUE(std::isnan(find(truth)));
}

TEST_F(ClosedSearch, AGlassDoorFillsItsPlaceAsItDidWhileItWasOpen) {
  LearnedModel glass = door();
  WallView kitchen(frontAt(glass, 0), wallAround(glass));
  kitchen.frame = 0.07;
  show(kitchen, glass, glass, kDoorOpens, glass.q_min);
  ASSERT_LT(history_.edges.fill().value_or(1), 0.7);
  EXPECT_TRUE(std::isnan(find(glass))) << "a door without a hole is not closed if it is half there";
  glass.hollow = true;
  EXPECT_NEAR(find(glass), 0, 0.2 * kDegree);
  glass.q_closed = 0;
  EXPECT_TRUE(showsShut(glass, 0, history_.edges, views_[0]).value_or(false));
  EXPECT_FALSE(showsShut(glass, 0, history_.edges, views_.back()).value_or(true)) << "wide open";
  for (const std::size_t i : {std::size_t{0}, views_.size() - 1})
    EXPECT_FALSE(showsShut(glass, 0, OwnEdges(), views_[i])) << "how much of it is there is not known";
}

/// Noise takes points out of a front's plane while it is open as it does while it is closed.
TEST_F(ClosedSearch, WhatAFrontFillsIsMeasuredAsItIsUsed) {
  const LearnedModel truth = door();
  WallView kitchen(frontAt(truth, 0), wallAround(truth));
  kitchen.noise = 0.02;
  show(kitchen, truth, truth, {0, 0.4, 0.5, 0.6}, truth.q_min);
  const CellCount closed = look(views_[0], frontAt(truth, 0), kNear).inside;
  const double used = 1.0 * closed.in_plane / (closed.in_plane + closed.behind);
  EXPECT_NEAR(history_.edges.fill().value_or(0), used, 0.05);
}

/// As beside a fridge: a base unit, and nothing above it.
TEST_F(ClosedSearch, ANeighbourThatIsHalfAsHighIsEnough) {
  const LearnedModel truth = door();
  Rectangle wall = wallAround(truth);
  wall.height = 1;
  wall.pose.translation() += truth.origin.linear() * Eigen::Vector3d(0, 0.5 - 0.02, 0);
  show({frontAt(truth, 0), wall}, truth, truth, kDoorOpens, truth.q_min);
  EXPECT_NEAR(find(truth), 0, 0.2 * kDegree);
}

/// No view tells the direction of a neighbour on one side to half a degree; views of some seconds do. Those of one second may
/// share their noise.
TEST_F(ClosedSearch, ViewsTellOneNoisyNeighbourTogether) {
  const LearnedModel truth = door();
  Rectangle wall = wallAround(truth);
  wall.pose.translation() += truth.origin.linear() * Eigen::Vector3d((truth.width + wall.width) / 2, 0, 0);
  WallView kitchen(frontAt(truth, 0), wall);
  kitchen.noise = 0.004;
  std::vector<double> opens(20, 0.0);
  opens.insert(opens.end(), kDoorOpens.begin(), kDoorOpens.end());
  for (const double period : {0.01, 0.3}) {
    period_ = period;
    views_.clear();
    history_ = {};
    show(kitchen, truth, truth, opens, truth.q_min);
    if (period < 0.1)
      EXPECT_TRUE(std::isnan(find(truth)));
    else
      EXPECT_NEAR(find(truth), 0, 0.5 * kDegree);
  }
}

TEST_F(ClosedSearch, AnEmptyPlaceWithoutDepthIsNotShut) {
  LearnedModel joint = door();
  WallView kitchen(frontAt(joint, 0), wallAround(joint));
  DepthView view = kitchen.at(joint.predict(0), 1);
  joint.q_closed = 0;
  const OwnEdges edges;
  ASSERT_TRUE(showsShut(joint, 0, edges, view).value_or(false));
  DepthView hidden = view;
  for (int row = 0; row < view.rows; ++row)
    for (int column = 0; column < view.columns; ++column)
      if (test::hit(view.ray(column, row), frontAt(joint, 0))) view.depth[row * view.columns + column] = 0;
  EXPECT_FALSE(showsShut(joint, 0, edges, view).value_or(true)) << "the wall around it is seen";
  hidden.depth.assign(hidden.depth.size(), 0);
  EXPECT_FALSE(showsShut(joint, 0, edges, hidden)) << "nothing is seen, which says nothing";
}

/// As where light blinds the camera: one neighbour that is seen does not tell that the front is gone.
TEST_F(ClosedSearch, AFrontThatIsBlindWithThreeOfItsSidesSaysNothing) {
  LearnedModel joint = door();
  joint.q_closed = 0;
  WallView kitchen(frontAt(joint, 0), wallAround(joint));
  for (const double side : {-1, 1}) {
    Rectangle blind = wallAround(joint);
    blind.pose = joint.predict(0) * Eigen::Translation3d(side * (blind.width - joint.width) / 2, 0, 0);
    DepthView view = kitchen.at(joint.predict(0), 1);
    for (int row = 0; row < view.rows; ++row)
      for (int column = 0; column < view.columns; ++column)
        if (test::hit(view.ray(column, row), blind)) view.depth[row * view.columns + column] = 0;
    EXPECT_FALSE(showsShut(joint, 0, OwnEdges(), view)) << side;
  }
}

TEST(WallView, IsHitInFrontOfTheCameraOnly) {
  const Rectangle wall{test::facingCamera(0, 0, 1), 1, 1};
  EXPECT_TRUE(test::hit({0, 0, 1}, wall));
  EXPECT_FALSE(test::hit({0, 0, 1}, {test::facingCamera(0, 0, -1), 1, 1})) << "behind it";
  const Eigen::Isometry3d edge_on =
      Eigen::Translation3d(0, 0, 1) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
  EXPECT_FALSE(test::hit({0, 0, 0}, {edge_on, 1, 1})) << "no ray";
}

}  // namespace
}  // namespace cabinet_articulation::core

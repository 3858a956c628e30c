// SPDX-License-Identifier: BSD-3-Clause
// A joint of an earlier run whose front is watched: when it is held for shut, and when no longer.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_finder.h"
#include "geometry/degrees.h"
#include "support/models.h"
#include "support/wall_view.h"

namespace cabinet_articulation::core {
namespace {

using Ids = std::set<std::uint32_t>;

class ShutWatch : public testing::Test {
 protected:
  static LearnedModel door() {
    LearnedModel door = test::doorModel();
    door.q_min = 0.15;
    return door;
  }

  /// The joint, as a model file has it.
  void startWith(const LearnedModel& joint) {
    joint_ = joint;
    LearnedModel kept = joint;
    kept.q_closed = 0;
    kept.closed_known = true;
    finder_.remember({kept});
  }

  /// What is known of the joint once a frame showed the front at q.
  LearnedModel show(double q, bool detected) {
    stamp_ += period_;
    if (detected) {
      joint_.q = q;
      joint_.stamp = stamp_;
    }
    finder_.see(kitchen_.at(truth_.predict(q), stamp_));
    std::vector<LearnedModel> models{joint_};
    finder_.complete(&models);
    return models[0];
  }

  void open() {
    for (const double q : {0.3, 0.5, 0.8, 1.0, 0.8, 0.5}) show(q, true);
  }

  /// [s] until the front at q, which no detector sees, is told to be shut, or not to be any more; NaN: never.
  double timeUntil(double q, bool shut) {
    const double start = stamp_ + period_;
    while (stamp_ < start + 2)
      if ((show(q, false).opening == 0) == shut) return stamp_ - start;
    return std::nan("");
  }

  const LearnedModel truth_ = door();
  test::WallView kitchen_{frontAt(truth_, 0), {truth_.predict(0), 3, 3}};
  LearnedModel joint_;
  ClosedFinder finder_;
  double stamp_ = 0, period_ = 0.1;
};

TEST_F(ShutWatch, TakesTheSameTimeAtEveryFrameRate) {
  startWith(truth_);
  for (const double rate : {60.0, 30.0, 10.0}) {
    period_ = 1 / rate;
    open();
    EXPECT_NEAR(timeUntil(0, true), 0.3, period_ + 1e-6) << rate;
    EXPECT_NEAR(timeUntil(1.5, false), 0.3, period_ + 1e-6) << rate;
  }
}

TEST_F(ShutWatch, TellsWhichFrontLeftItsClosedPlace) {
  startWith(truth_);
  open();
  ASSERT_FALSE(std::isnan(timeUntil(0, true)));
  EXPECT_TRUE(finder_.leftClosed().empty());
  ASSERT_FALSE(std::isnan(timeUntil(1.5, false)));
  EXPECT_EQ(finder_.leftClosed(), Ids{joint_.id}) << "its q changed in this frame, though nothing was detected";
  const LearnedModel left = show(1.5, false);
  EXPECT_EQ(left.q, 0.5) << "as it was detected last";
  EXPECT_TRUE(finder_.leftClosed().empty()) << "only once";
}

/// A model file does not have the angle by which depth turns the front where it is.
TEST_F(ShutWatch, MeasuresHowViewsTurnTheFrontAnew) {
  LearnedModel turned = truth_;
  turned.origin.rotate(Eigen::AngleAxisd(-1.5 * kDegree, Eigen::Vector3d::UnitY()));
  startWith(turned);
  open();
  EXPECT_NEAR(timeUntil(0, true), 0.3, period_ + 1e-6);
  EXPECT_TRUE(std::isnan(timeUntil(0, false)));
}

}  // namespace
}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/limits.h"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::ThrowsSaying;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Limits, BothEndsAreWithinAndNotANumberIsNot) {
  EXPECT_NO_THROW(requireWithin("q", -100, limits::kConfiguration));
  EXPECT_NO_THROW(requireWithin("q", 100, limits::kConfiguration));
  EXPECT_THAT([] { requireWithin("q", 1e300, limits::kConfiguration); },
              ThrowsSaying<std::invalid_argument>("q is 1e+300, expected -100 to 100 m or rad"));
  EXPECT_THAT([] { requireWithin("q", kNan, limits::kConfiguration); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("q is nan")));
}

TEST(Limits, SidesMayBeUnknown) {
  EXPECT_NO_THROW(requireSideOrUnknown("width", 0));
  EXPECT_NO_THROW(requireSideOrUnknown("width", limits::kSide.min));
  EXPECT_THAT([] { requireSideOrUnknown("width", -1); },
              ThrowsSaying<std::invalid_argument>("width is -1, expected 0.001 to 10 m, or 0: not known"));
  EXPECT_THAT([] { requireSideOrUnknown("width", 1e18); }, ThrowsSaying<std::invalid_argument>(HasSubstr("1e+18")));
}

TEST(Limits, EachCoordinateCounts) {
  EXPECT_NO_THROW(requireWithin("position", Eigen::Vector3d(5e6, -5e6, 0), limits::kFromOrigin));
  EXPECT_THAT([] { requireWithin("position", Eigen::Vector3d(0, 1e155, 1), limits::kFromOrigin); },
              ThrowsSaying<std::invalid_argument>("position is (0, 1e+155, 1), expected -1e+08 to 1e+08 m"));
  EXPECT_THROW(requireWithin("position", Eigen::Vector3d(0, 0, kNan), limits::kFromOrigin), std::invalid_argument);
}

TEST(Limits, ListsMayBeLongButNotEndless) {
  EXPECT_NO_THROW(requireAtMost("ids", limits::kMostEntries, limits::kMostEntries));
  EXPECT_THAT([] { requireAtMost("ids", limits::kMostEntries + 1, limits::kMostEntries); },
              ThrowsSaying<std::invalid_argument>("there are 10001 ids, expected 10000 at most"));
}

}  // namespace
}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
// What kinds tell and what they are taught stay apart.
#include "kinds/taught_kinds.h"

namespace cabinet_articulation::core {
namespace {

using test::completed;
using test::doorOf;
using test::expectSame;
using test::seen;
using test::teach;
using test::votes;

TEST(KindFeedback, IsTaughtNothingByWhatItTold) {
  KindMemory memory({});
  teach(doorOf(0.5), 3, &memory);
  const LearnedModel own = learn(seen(doorOf(0.5), 10, 0.3));
  KindMemory next({});
  next.startFrom(memory.votesBeside({}), {own});
  EXPECT_EQ(votes(next), 3u);
  const LearnedModel told = next.told(own);
  EXPECT_NE(told.axis, own.axis);
  expectSame(told, memory.told(own));
  expectSame(told, completed({seen(doorOf(0.5), 10, 0.3)}, &memory).at(0));
  EXPECT_EQ(votes(memory), 3u);
}

TEST(KindFeedback, CountsOpeningsOfWhatItTellsFromWhereTheFrontIsClosed) {
  KindMemory memory({});
  teach(doorOf(0.5), 3, &memory);
  LearnedModel own = learn(seen(doorOf(0.5), 10, 0.3));
  own.closed_known = true;
  own.q_closed = own.q_min - 0.1;
  own.q = 0.6 * own.q_max;
  own.opening = (own.q - own.q_closed) / (own.q_max - own.q_closed);
  const LearnedModel told = memory.told(own);
  const Eigen::Vector3d closed = own.predict(own.q_closed).translation();
  EXPECT_LT((told.predict(told.q_closed).translation() - closed).norm(), 0.01);
  EXPECT_NEAR(told.opening, (told.q - told.q_closed) / (told.q_max - told.q_closed), 0.01);
}

TEST(KindFeedback, LeavesFrontsThatHangOnOthersAlone) {
  KindMemory memory({});
  teach(doorOf(0.5), 3, &memory);
  for (const double q : {1.5, 0.3}) {
    LearnedModel hanging = learn(seen(doorOf(0.5), 2, q));
    hanging.parent = 7;
    std::vector<LearnedModel> models{hanging};
    memory.complete({seen(doorOf(0.5), 2, q)}, &models);
    expectSame(models[0], hanging);
    EXPECT_EQ(votes(memory), 2u) << "what it taught before it was seen to hang was wrong";
    KindMemory next({});
    next.startFrom({}, {hanging});
    EXPECT_EQ(votes(next), 0u);
  }
}

}  // namespace
}  // namespace cabinet_articulation::core

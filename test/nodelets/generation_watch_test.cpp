// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/models/generation_watch.h"

#include <gtest/gtest.h>

namespace cabinet_articulation {
namespace {

TEST(GenerationWatch, UsesTracksThatFollowAndThoseOfATrackerThatNobodyTells) {
  GenerationWatch watch;
  EXPECT_TRUE(watch.judge(5, true, 0).use) << "no list was sent yet";
  watch.expect(7);
  EXPECT_TRUE(watch.judge(7, true, 0).use);
  EXPECT_TRUE(watch.judge(5, false, 0).use) << "nobody listens to known_fronts";
  EXPECT_FALSE(watch.judge(5, true, 0).use);
}

TEST(GenerationWatch, AsksAgainInWordsAndIsNotSilentForEver) {
  GenerationWatch watch;
  watch.expect(7);
  int sent = 0, used = 0;
  for (int i = 0; i <= 150; ++i) {
    const GenerationWatch::Verdict verdict = watch.judge(5, true, 100 + 0.1 * i);
    sent += verdict.send_again;
    used += verdict.use;
    EXPECT_TRUE(i > 29 || verdict.trouble.empty()) << "a tracker needs a moment";
    EXPECT_TRUE(i < 32 || !verdict.trouble.empty()) << i;
    EXPECT_TRUE(i > 100 || !verdict.use) << i;
  }
  EXPECT_EQ(sent, 3);
  EXPECT_GT(used, 40);
  EXPECT_NE(watch.judge(5, true, 120).trouble.find("generation 5, expected 7"), std::string::npos);
  EXPECT_EQ(watch.judge(7, true, 121).trouble, "") << "it follows after all";
  watch.expect(8);
  EXPECT_FALSE(watch.judge(5, true, 122).use) << "the next list, the next chance";
}

TEST(GenerationWatch, APauseIsNoAnswer) {
  GenerationWatch watch;
  watch.expect(7);
  EXPECT_FALSE(watch.judge(5, true, 0).use);
  EXPECT_FALSE(watch.judge(5, true, 3600).use) << "published before the tracker could hear of it";
  EXPECT_TRUE(watch.judge(7, true, 3600.1).use);
}

}  // namespace
}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/running/orderly_exit.h"

#include <gtest/gtest.h>

#include <csignal>

namespace cabinet_articulation {
namespace {

void ofRos(int) {}
void ofTheProcess(int) {}

sighandler_t handlerOf(int signal) {
  struct sigaction action = {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler;
}

class OrderlyExit : public testing::Test {
 protected:
  ~OrderlyExit() override {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }
};

TEST_F(OrderlyExit, SigtermDoesWhatSigintDoes) {
  std::signal(SIGINT, ofRos);
  endOnSigtermAsOnSigint();
  EXPECT_EQ(handlerOf(SIGTERM), ofRos);
}

TEST_F(OrderlyExit, AProcessKeepsItsOwnHandler) {
  std::signal(SIGINT, ofRos);
  for (const sighandler_t own : {ofTheProcess, SIG_IGN}) {
    std::signal(SIGTERM, own);
    endOnSigtermAsOnSigint();
    EXPECT_EQ(handlerOf(SIGTERM), own);
  }
}

TEST_F(OrderlyExit, AProcessThatIgnoresSigintStillEndsOnSigterm) {
  for (const sighandler_t none : {SIG_IGN, SIG_DFL}) {
    std::signal(SIGINT, none);
    endOnSigtermAsOnSigint();
    EXPECT_EQ(handlerOf(SIGTERM), SIG_DFL);
  }
}

}  // namespace
}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/running/orderly_exit.h"

#include <csignal>

namespace cabinet_articulation {
namespace {

bool hasHandler(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) != 0 || (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN);
}

}  // namespace

// The handler that is there for SIGINT is used, not one of ours: this library may be unloaded before the process ends.
void endOnSigtermAsOnSigint() {
  struct sigaction on_sigint = {}, on_sigterm = {};
  sigaction(SIGINT, nullptr, &on_sigint);
  sigaction(SIGTERM, nullptr, &on_sigterm);
  const bool is_default = (on_sigterm.sa_flags & SA_SIGINFO) == 0 && on_sigterm.sa_handler == SIG_DFL;
  if (is_default && hasHandler(on_sigint)) sigaction(SIGTERM, &on_sigint, nullptr);
}

}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <exception>
#include <stdexcept>

namespace cabinet_articulation {

/// Runs the body of the program `name`, which returns its exit status. What it throws becomes one line on stderr and status 1;
/// a std::invalid_argument is the user's mistake, so that the usage follows.
template <class Body>
int runProgram(const char* name, const char* usage, const Body& body) {
  try {
    return body();
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s: %s\n%s", name, error.what(), usage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
  }
  return 1;
}

}  // namespace cabinet_articulation

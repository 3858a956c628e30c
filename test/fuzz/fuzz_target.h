// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <vector>

/// Of each target, as libFuzzer wants it: tries one input. Returns 0, or does not return: see examine().
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace cabinet_articulation::fuzz {

/*
 * What all fuzz targets have in common. A target takes bytes as somebody outside might send them, through the boundary that the
 * package has there, and what is accepted through the stages behind. It may refuse them by the exceptions that are documented.
 * Everything else is a finding: any other exception, a sanitizer's word, more time or more memory than one input may take.
 */

constexpr double kLongestRun = 2;               ///< [s] of processor time for one input, with sanitizers
constexpr std::size_t kMostMemory = 512 << 20;  ///< [bytes] by which one input may raise the peak
constexpr std::size_t kLargestInput = 1 << 16;  ///< [bytes] mutations do not grow beyond

/// Inputs that are built by the code, so that they follow the messages' definitions.
struct Seeds {
  std::vector<std::string> valid;         ///< mutations start from these
  std::vector<std::string> hostile = {};  ///< what once ended a process
};

/// Of each target.
Seeds seeds();

/// Whether the last input was taken to the end, not refused.
bool wasAccepted();

namespace detail {

/// Aborts with a message that explains the finding.
[[noreturn]] void report(const std::string& finding);

/// Runs `work`, which tells whether the input was accepted, and reports if it takes too much time or memory.
void measure(const std::function<bool()>& work);

template <class Work>
bool accepted(const Work& work) {
  work();
  return true;
}

template <class Refusal, class... Others, class Work>
bool accepted(const Work& work) {
  try {
    return accepted<Others...>(work);
  } catch (const Refusal&) {
    return false;
  }
}

}  // namespace detail

/// Runs `work`, which may throw the `Refusals`. For the return of LLVMFuzzerTestOneInput.
template <class... Refusals, class Work>
int examine(const Work& work) {
  try {
    detail::measure([&] { return detail::accepted<Refusals...>(work); });
  } catch (const std::exception& error) {
    detail::report(std::string("an exception that is no documented refusal: ") + error.what());
  }
  return 0;
}

}  // namespace cabinet_articulation::fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.h"

#include <console_bridge/console.h>
#include <ros/console.h>
#include <ros/time.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace cabinet_articulation::fuzz {
namespace {

bool was_accepted = false;

/// Of all threads, so that a busy machine makes no finding.
double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::size_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// Libraries have much to say about malformed input, for every one of a million.
void silenceLibraries() {
  ros::Time::init();
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
}

const bool silent = (silenceLibraries(), true);

}  // namespace

bool wasAccepted() { return was_accepted; }

namespace detail {

void report(const std::string& finding) {
  std::fprintf(stderr, "FINDING: %s\n", finding.c_str());
  std::abort();
}

void measure(const std::function<bool()>& work) {
  was_accepted = false;
  const double start = processorSeconds();
  const std::size_t memory = peakMemory();
  was_accepted = work();
  const double seconds = processorSeconds() - start;
  if (seconds > kLongestRun) report("one input took " + std::to_string(seconds) + " s of processor time");
  const std::size_t more = peakMemory() - memory;
  if (more > kMostMemory) report("one input took " + std::to_string(more >> 20U) + " MB more than all before");
}

}  // namespace detail

}  // namespace cabinet_articulation::fuzz

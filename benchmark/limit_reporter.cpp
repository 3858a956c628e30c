// SPDX-License-Identifier: BSD-3-Clause
#include "limit_reporter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace cabinet_articulation::core::evaluation {

namespace {

double timeOf(const benchmark::BenchmarkReporter::Run& run) {
  return run.run_name.time_type == "manual_time" ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime();
}

}  // namespace

void LimitReporter::ReportRuns(const std::vector<Run>& runs) {
  if (runs.at(0).run_type != Run::RT_Iteration) return;  // means and the like
  const Run& best = *std::min_element(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return timeOf(a) < timeOf(b); });
  ConsoleReporter::ReportRuns({best});
  if (timeOf(best) == 0) return;  // it was skipped
  constexpr double kMilliseconds = 1e3;
  const std::string& args = best.run_name.args;
  shortest_[best.run_name.function_name + (args.empty() ? "" : "/" + args)] =
      kMilliseconds * timeOf(best) / benchmark::GetTimeUnitMultiplier(best.time_unit);
}

double LimitReporter::shortest(const std::string& name) const {
  const auto known = shortest_.find(name);
  return known == shortest_.end() ? std::numeric_limits<double>::quiet_NaN() : known->second;
}

void LimitReporter::compare(const std::string& what, const std::string& name, double limit) const {
  const double time = shortest(name);
  if (std::isnan(time) || std::isnan(limit)) return;
  std::printf("%-64s %8.3f ms, limit %8.3f ms: %s\n", what.c_str(), time, limit, time <= limit ? "holds" : "EXCEEDED");
}

void LimitReporter::compare(const std::string& what, const std::string& name, const std::string& other, double factor) const {
  compare(what, name, factor * shortest(other));
}

void LimitReporter::compareAll(const std::string& start, double limit) const {
  for (const auto& [name, time] : shortest_)
    if (name.compare(0, start.size(), start) == 0) compare(name, name, limit);
}

int runBenchmarks(int argc, char** argv, void (*report)(const LimitReporter&)) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  LimitReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  report(reporter);
  return 0;
}

}  // namespace cabinet_articulation::core::evaluation

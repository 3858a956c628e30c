// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace cabinet_articulation::core::evaluation {

/// Google Benchmark's console output, of the repetition with the shortest CPU time: other load on the machine only adds. Times
/// that a benchmark takes itself are CPU times already.
class LimitReporter : public benchmark::ConsoleReporter {
 public:
  LimitReporter() : ConsoleReporter(OO_Tabular) {}

  void ReportRuns(const std::vector<Run>& runs) override;

  /// Prints one line: does the benchmark `name` stay below `limit` [ms], or below `factor` times another benchmark? Prints
  /// nothing if one of them was not run.
  void compare(const std::string& what, const std::string& name, double limit) const;
  void compare(const std::string& what, const std::string& name, const std::string& other, double factor = 1) const;

  /// One line for each benchmark whose name starts so.
  void compareAll(const std::string& start, double limit) const;

 private:
  /// [ms] NaN if it was not run.
  double shortest(const std::string& name) const;

  std::map<std::string, double> shortest_;
};

/// Runs what is registered, with the usual options, and lets `report` say what the limits are. The program's status.
int runBenchmarks(int argc, char** argv, void (*report)(const LimitReporter&));

}  // namespace cabinet_articulation::core::evaluation

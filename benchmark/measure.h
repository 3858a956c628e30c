// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include "allocation_counter.h"

namespace cabinet_articulation::core::evaluation {

constexpr int kWarmUps = 3;  ///< calls (ours) in which buffers grow: some stages have two that alternate

/// Times `work` and counts what it takes from the heap.
template <class Work>
void measure(benchmark::State& state, Work&& work) {
  for (int i = 0; i < kWarmUps; ++i) benchmark::DoNotOptimize(work());
  const Allocations before = allocations();
  for (auto _ : state) benchmark::DoNotOptimize(work());
  const Allocations after = allocations();
  using benchmark::Counter;
  state.counters["allocations"] = Counter(static_cast<double>(after.count - before.count), Counter::kAvgIterations);
  state.counters["largest_kB"] = static_cast<double>(after.largest) / 1024;
  state.counters["kB"] = Counter(static_cast<double>(after.bytes - before.bytes) / 1024, Counter::kAvgIterations);
}

}  // namespace cabinet_articulation::core::evaluation

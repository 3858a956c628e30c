// SPDX-License-Identifier: BSD-3-Clause
#include "programs/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <thread>
#include <vector>

namespace cabinet_articulation::core::evaluation {

void parallelFor(int count, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::future<void>> threads;
  const int cores = std::max(1U, std::thread::hardware_concurrency());
  for (int i = 0; i < std::min(cores, count); ++i) threads.push_back(std::async(std::launch::async, run));
  for (const auto& thread : threads) thread.wait();
  for (auto& thread : threads) thread.get();
}

}  // namespace cabinet_articulation::core::evaluation

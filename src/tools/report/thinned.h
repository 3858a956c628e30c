// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace cabinet_articulation {

/// Values of a run of unknown length in bounded memory: evenly spaced, from half of `most` on to `most` of them, and the newest.
template <class Value>
class Thinned {
 public:
  explicit Thinned(std::size_t most) : most_(most) {}

  void add(const Value& value) {
    newest_ = value;
    offer([&] { return value; });
  }

  /// For values that are costly: `make` is called only if the value would be kept, also where it is the newest.
  template <class Make>
  void offer(const Make& make) {
    newest_is_kept_ = count_++ % step_ == 0;
    if (!newest_is_kept_) return;
    kept_.push_back(make());
    if (kept_.size() <= most_) return;
    for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
    kept_.resize((kept_.size() + 1) / 2);
    newest_is_kept_ = (count_ - 1) % (2 * step_) == 0;
    step_ *= 2;
  }

  std::vector<Value> values() const {
    std::vector<Value> values = kept_;
    if (newest_ && !newest_is_kept_) values.push_back(*newest_);
    return values;
  }

  std::size_t count() const { return count_; }  ///< that were given

 private:
  std::size_t most_, step_ = 1, count_ = 0;
  std::vector<Value> kept_;
  std::optional<Value> newest_;
  bool newest_is_kept_ = false;
};

}  // namespace cabinet_articulation

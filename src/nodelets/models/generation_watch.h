// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace cabinet_articulation {

/// Decides whether tracks follow from the list of known fronts that the tracker was sent last (KnownFrontArray), by their
/// generation. Tracks of an earlier one are not used, for their ids may mean other fronts. A tracker that never follows is
/// sent the list again, and after some time its tracks are used as they are: that is better than silence.
class GenerationWatch {
 public:
  struct Verdict {
    bool use = true;
    bool send_again = false;
    std::string trouble;  ///< what is to be said; or empty
  };

  GenerationWatch() = default;

  /// A list was sent that names this generation.
  void expect(std::uint32_t generation) { *this = GenerationWatch(generation); }

  /// For tracks that came at `now` [s]. `listens`: somebody gets the list.
  Verdict judge(std::uint32_t generation, bool listens, double now) {
    if (expected_ == 0 || !listens || generation == expected_) {
      waiting_since_.reset();
      return {};
    }
    if (generation == tolerated_)
      return {true, false, "the tracker takes over no known fronts, so they do not get their ids back" + numbers(generation)};
    if (!waiting_since_) {
      waiting_since_ = asked_ = now;
      frames_ = 0;
    }
    ++frames_;
    const double waited = now - *waiting_since_;
    if (waited > kLongest && frames_ >= kFrames) tolerated_ = generation;
    const bool ask = now - asked_ > kPatience;
    if (ask) asked_ = now;
    return {false, ask, waited > kPatience ? "waits for the tracker to take over what is known" + numbers(generation) : ""};
  }

 private:
  static constexpr double kPatience = 3;  ///< [s] a tracker hears of the list with its next frame
  static constexpr double kLongest = 10;  ///< [s]
  static constexpr int kFrames = 5;       ///< that came meanwhile, so that a pause is not mistaken for an answer

  explicit GenerationWatch(std::uint32_t expected) : expected_(expected) {}

  std::string numbers(std::uint32_t generation) const {
    return " (its tracks are of generation " + std::to_string(generation) + ", expected " + std::to_string(expected_) +
           "; see known_fronts)";
  }

  std::uint32_t expected_ = 0;
  std::optional<std::uint32_t> tolerated_;
  std::optional<double> waiting_since_;
  double asked_ = 0;
  int frames_ = 0;
};

}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace cabinet_articulation {

/// Counts the frames that could not be used, by reason, and keeps the first one's details.
class SkippedFrames {
 public:
  void add(const std::string& reason, const std::string& details) {
    Entry& entry = entries_[reason];
    if (entry.count++ == 0) entry.first = details;
  }

  /// One line for each reason; empty if nothing was skipped.
  std::string text() const {
    std::string text;
    for (const auto& [reason, entry] : entries_)
      text += "skipped " + std::to_string(entry.count) + " frames: " + reason + " (first: " + entry.first + ")\n";
    return text;
  }

 private:
  struct Entry {
    int count = 0;
    std::string first;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace cabinet_articulation

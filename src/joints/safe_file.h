// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <filesystem>
#include <mutex>
#include <string>

namespace cabinet_articulation::core {

/*
 * Ordinary files that several programs read and replace. All throw std::runtime_error with the reason in words.
 */

/// Runs the work; its errors become one of type Error that says what it was done to.
template <class Error, class Work>
auto withErrorsOf(const std::string& what, const Work& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    throw Error(what + ": " + error.what());
  }
}

/// What a chain of links ends at, whether that exists or not.
std::filesystem::path followLinks(std::filesystem::path path);

/// The right to replace files in one folder, among the threads of this process and among processes. Waits for it. Where
/// folders cannot be locked (some network drives), it holds among threads only.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  bool holdsAmongProcesses() const { return locked_; }

 private:
  std::unique_lock<std::timed_mutex> threads_;
  int folder_ = -1;
  bool locked_ = false;
};

/// Replaces the file at once, with its owner and mode, and writes it to the disk. No link is followed. Clears away what others
/// that died while they replaced it have left.
void replaceFile(const std::filesystem::path& file, const std::string& text, const FolderLock& lock);

/// The same, but what was there stays, under a name that is free: <file>.kept-1 or the next, which is returned.
std::filesystem::path keepAndReplaceFile(const std::filesystem::path& file, const std::string& text, const FolderLock& lock);

}  // namespace cabinet_articulation::core

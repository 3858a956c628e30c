// SPDX-License-Identifier: BSD-3-Clause
#include "joints/safe_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <random>
#include <stdexcept>
#include <thread>

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;

constexpr int kLongestChain = 40;  // symbolic links, as path_resolution(7)
constexpr int kMostKept = 100;
constexpr std::chrono::seconds kPatience{20};
constexpr std::chrono::milliseconds kPause{5};
constexpr mode_t kMode = 0644;
constexpr char kSaving[] = ".saving-";
constexpr int kSuffix = 8;  // characters that make its name unique

[[noreturn]] void failWithErrno(const std::string& what) { throw std::runtime_error(what + ": " + std::strerror(errno)); }

/// Closes its file at the end.
class Descriptor {
 public:
  explicit Descriptor(int file) : file_(file) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool close() {
    const bool closed = file_ < 0 || ::close(file_) == 0;
    file_ = -1;
    return closed;
  }
  int get() const { return file_; }

 private:
  int file_;
};

/// One for all folders: who saves in two at once merely waits.
std::timed_mutex& threadsMutex() {
  static std::timed_mutex mutex;
  return mutex;
}

/// ".kitchen.yaml.saving-": hidden, in the file's folder, because a rename cannot go from one disk to another.
std::string temporaryPrefix(const fs::path& file) { return "." + file.filename().string() + kSaving; }

fs::path temporaryName(const fs::path& file) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::random_device random;
  std::string name = temporaryPrefix(file);
  for (int i = 0; i < kSuffix; ++i) name += kDigits[random() % 16];
  return file.parent_path() / name;
}

void clearLeftovers(const fs::path& file) {
  const std::string prefix = temporaryPrefix(file);
  std::error_code error;
  for (fs::directory_iterator entry(file.parent_path(), error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (name.size() == prefix.size() + kSuffix && name.rfind(prefix, 0) == 0) fs::remove(entry->path(), ignored);
  }
}

/// What replaces a file looks like it. The owner can be kept by root only.
void takeOverOwnerAndMode(const fs::path& from, int to) {
  struct stat status {};
  if (::stat(from.c_str(), &status) != 0) return;
  if (::fchown(to, status.st_uid, status.st_gid) != 0) errno = 0;
  ::fchmod(to, status.st_mode & 07777);
}

bool writeAll(int file, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = ::write(file, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    written += static_cast<std::size_t>(n);
  }
  return ::fsync(file) == 0;
}

/// So that the new name survives a power cut, too. Some drives cannot; the file is there all the same.
void syncFolder(const fs::path& folder) {
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) ::fsync(directory.get());
}

/// Gives the file a second name that is free.
fs::path keepUnderAnotherName(const fs::path& file) {
  for (int i = 1; i <= kMostKept; ++i) {
    const fs::path name = file.string() + ".kept-" + std::to_string(i);
    // A second name first: so there is no moment without the file, and nothing is overwritten.
    if (::link(file.c_str(), name.c_str()) == 0) return name;
    if (errno == EEXIST) continue;
    // Some drives know no second names.
    if (errno != EPERM && errno != EOPNOTSUPP && errno != ENOSYS) failWithErrno("cannot be kept as '" + name.string() + "'");
    if (fs::exists(fs::symlink_status(name))) continue;
    if (::rename(file.c_str(), name.c_str()) == 0) return name;
    failWithErrno("cannot be kept as '" + name.string() + "'");
  }
  throw std::runtime_error("there are " + std::to_string(kMostKept) + " files kept beside it already; remove some");
}

}  // namespace

fs::path followLinks(fs::path path) {
  path = fs::absolute(path);
  for (int i = 0; i < kLongestChain; ++i) {
    std::error_code error;
    const fs::path target = fs::read_symlink(path, error);
    if (error) return path;
    path = path.parent_path() / target;  // an absolute target stands for itself
  }
  throw std::runtime_error("is a link that leads nowhere");
}

FolderLock::FolderLock(const fs::path& folder) : threads_(threadsMutex(), kPatience) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  if (!threads_) throw std::runtime_error("is busy: others have been saving for 20 s");
  folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  while (folder_ >= 0 && !locked_) {
    locked_ = ::flock(folder_, LOCK_EX | LOCK_NB) == 0;
    if (locked_ || (errno != EWOULDBLOCK && errno != EINTR)) return;
    if (std::chrono::steady_clock::now() > end) {
      ::close(folder_);
      throw std::runtime_error("is busy: another program has locked its folder for 20 s");
    }
    std::this_thread::sleep_for(kPause);
  }
}

FolderLock::~FolderLock() {
  if (folder_ >= 0) ::close(folder_);
}

void replaceFile(const fs::path& file, const std::string& text, const FolderLock& lock) {
  if (lock.holdsAmongProcesses()) clearLeftovers(file);
  const fs::path temporary = temporaryName(file);
  Descriptor out(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kMode));
  if (out.get() < 0) failWithErrno("cannot be written");
  takeOverOwnerAndMode(file, out.get());
  // A rename replaces a file at once; what it replaces it with must be on the disk before.
  if (writeAll(out.get(), text) && out.close() && ::rename(temporary.c_str(), file.c_str()) == 0) {
    syncFolder(file.parent_path());
    return;
  }
  const int reason = errno;
  ::unlink(temporary.c_str());
  errno = reason;
  failWithErrno("cannot be written");
}

fs::path keepAndReplaceFile(const fs::path& file, const std::string& text, const FolderLock& lock) {
  const fs::path kept = keepUnderAnotherName(file);
  try {
    replaceFile(file, text, lock);
  } catch (...) {
    std::error_code ignored;
    fs::exists(file) ? void(fs::remove(kept, ignored)) : fs::rename(kept, file, ignored);
    throw;
  }
  return kept;
}

}  // namespace cabinet_articulation::core

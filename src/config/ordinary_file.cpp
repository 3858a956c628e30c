// SPDX-License-Identifier: BSD-3-Clause
#include "config/ordinary_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace cabinet_articulation::core {
namespace {

constexpr char kMissing[] = "cannot be opened: there is no such file";

[[noreturn]] void failWithErrno(const std::string& what) { throw std::runtime_error(what + ": " + std::strerror(errno)); }

[[noreturn]] void failAsTooLarge(std::size_t largest) {
  throw std::runtime_error("is larger than " + std::to_string(largest >> 20U) + " MB, the most that such a file may hold");
}

void requireOrdinary(const struct stat& status) {
  if (S_ISREG(status.st_mode)) return;
  const char* const kind = S_ISDIR(status.st_mode)    ? "folder"
                           : S_ISFIFO(status.st_mode) ? "pipe"
                           : S_ISSOCK(status.st_mode) ? "socket"
                                                      : "device";
  throw std::runtime_error(std::string("is a ") + kind + ", expected an ordinary file");
}

/// Closes its file at the end.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : file_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
    if (file_ < 0) failWithErrno("cannot be opened");
  }
  ~OpenFile() { ::close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int get() const { return file_; }

 private:
  int file_;
};

/// What a size says before the end is reached may be wrong: a file may grow, and those of /proc have none.
std::string readAll(int file, std::size_t expected, std::size_t largest) {
  std::string text(expected + 1, '\0');
  std::size_t size = 0;
  while (true) {
    const ssize_t n = ::read(file, &text[size], text.size() - size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) failWithErrno("cannot be read");
    if (n == 0) break;
    size += static_cast<std::size_t>(n);
    if (size > largest) failAsTooLarge(largest);
    if (size == text.size()) text.resize(2 * size);
  }
  text.resize(size);
  return text;
}

}  // namespace

std::optional<std::string> readFileIfThere(const std::filesystem::path& path, std::size_t largest) {
  struct stat status {};
  // Looked at before it is opened: to open a device may do something.
  if (::stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return std::nullopt;
    failWithErrno("cannot be opened");
  }
  requireOrdinary(status);
  const OpenFile file(path);
  // Another file may have its name by now.
  if (::fstat(file.get(), &status) != 0) failWithErrno("cannot be opened");
  requireOrdinary(status);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > largest) failAsTooLarge(largest);
  return readAll(file.get(), size, largest);
}

std::string readOrdinaryFile(const std::filesystem::path& path, std::size_t largest) {
  std::optional<std::string> text = readFileIfThere(path, largest);
  if (!text) throw std::runtime_error(kMissing);
  return *std::move(text);
}

void requireOrdinaryFile(const std::filesystem::path& path) {
  try {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
      if (errno == ENOENT) throw std::runtime_error(kMissing);
      failWithErrno("cannot be opened");
    }
    requireOrdinary(status);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace cabinet_articulation::core

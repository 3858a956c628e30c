// SPDX-License-Identifier: BSD-3-Clause
#include "config/ordinary_file.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;
using test::ThrowsSaying;
using testing::HasSubstr;

constexpr std::size_t kMegabyte = 1U << 20U;

class OrdinaryFile : public testing::Test {
 protected:
  OrdinaryFile() : folder_(fs::temp_directory_path() / ("ordinary_file_test." + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~OrdinaryFile() override { fs::remove_all(folder_); }

  /// By both ways, and none of them waits.
  static void expectRefused(const fs::path& path, const std::string& words) {
    EXPECT_THAT([&] { readOrdinaryFile(path, kMegabyte); }, ThrowsSaying<std::runtime_error>(HasSubstr(words)));
    EXPECT_THAT([&] { requireOrdinaryFile(path); }, ThrowsSaying<std::runtime_error>(HasSubstr(path.string() + ": " + words)));
  }

  const fs::path folder_;
};

TEST_F(OrdinaryFile, IsReadWholeAlsoByALink) {
  const std::string text = std::string("two\nlines\0and a zero", 20);
  std::ofstream(folder_ / "file", std::ios::binary) << text;
  fs::create_symlink(folder_ / "file", folder_ / "link");
  EXPECT_EQ(readOrdinaryFile(folder_ / "link", kMegabyte), text);
  EXPECT_NO_THROW(requireOrdinaryFile(folder_ / "link"));
}

TEST_F(OrdinaryFile, ThatIsMissingIsNothingOrAnError) {
  EXPECT_EQ(readFileIfThere(folder_ / "none", kMegabyte), std::nullopt);
  expectRefused(folder_ / "none", "cannot be opened: there is no such file");
  expectRefused(folder_ / std::string(5000, 'a'), "cannot be opened: File name too long");
}

TEST_F(OrdinaryFile, IsNoPipeDeviceSocketOrFolder) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  expectRefused(folder_ / "pipe", "is a pipe, expected an ordinary file");
  expectRefused("/dev/zero", "is a device, expected an ordinary file");
  expectRefused(folder_, "is a folder, expected an ordinary file");
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (folder_ / "socket").c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  expectRefused(folder_ / "socket", "is a socket, expected an ordinary file");
  ::close(socket);
}

TEST_F(OrdinaryFile, HasABound) {
  std::ofstream(folder_ / "file") << "12345678";
  fs::resize_file(folder_ / "file", kMegabyte);
  EXPECT_EQ(readOrdinaryFile(folder_ / "file", kMegabyte).size(), kMegabyte);
  fs::resize_file(folder_ / "file", kMegabyte + 1);
  EXPECT_THAT([&] { readOrdinaryFile(folder_ / "file", kMegabyte); },
              ThrowsSaying<std::runtime_error>(HasSubstr("is larger than 1 MB")));
  // Its size is said to be 0.
  EXPECT_THAT([] { readOrdinaryFile("/proc/self/maps", 100); }, ThrowsSaying<std::runtime_error>(HasSubstr("is larger than")));
}

}  // namespace
}  // namespace cabinet_articulation::core

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace cabinet_articulation {
namespace test {

/// An X server without a screen, on a number that is free, for as long as this lives; OpenGL is drawn by the processor.
class VirtualDisplay {
 public:
  VirtualDisplay() {
    int number[2];
    if (pipe(number) != 0) throw std::runtime_error("no pipe");
    server_ = fork();
    if (server_ == 0) {
      close(number[0]);
      const std::string fd = std::to_string(number[1]);
      execl(XVFB, "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "1024x768x24", "-nolisten", "tcp", nullptr);
      _exit(1);
    }
    close(number[1]);
    std::string text;
    for (char digit = 0; read(number[0], &digit, 1) == 1 && digit != '\n';) text += digit;
    close(number[0]);
    if (text.empty()) throw std::runtime_error("Xvfb does not start");
    setenv("DISPLAY", (":" + text).c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("QT_QPA_PLATFORM", "xcb", 1);
  }

  ~VirtualDisplay() {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }

  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  pid_t server_ = -1;
};

}  // namespace test
}  // namespace cabinet_articulation

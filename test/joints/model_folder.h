// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "cabinet_articulation/joints/model_file.h"
#include "support/throws_saying.h"

namespace cabinet_articulation {
namespace test {

/// A folder of its own for a test, with a model file that may be damaged.
class ModelFolder : public testing::Test {
 protected:
  ModelFolder() : folder_(std::filesystem::temp_directory_path() / ("model_file_test." + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
    path_ = folder_ / "kitchen.yaml";
  }
  ~ModelFolder() override { std::filesystem::remove_all(folder_); }

  static std::string textOf(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::stringstream stream;
    stream << in.rdbuf();
    return stream.str();
  }
  std::string text() const { return textOf(path_); }

  void write(const std::string& text) const { std::ofstream(path_) << text; }

  /// Replaces the first `from` in the file.
  void damage(const std::string& from, const std::string& to) const {
    std::string content = text();
    const size_t at = content.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(content.replace(at, from.size(), to));
  }

  /// Reading the file fails, in words that name it and these.
  void expectRefused(const std::string& words) const {
    EXPECT_THAT([&] { core::readModelFile(path_); },
                ThrowsSaying<core::ModelFileError>(testing::AllOf(testing::HasSubstr(path_), testing::HasSubstr(words))));
  }

  int filesInFolder() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }

  const std::filesystem::path folder_;
  std::string path_;
};

}  // namespace test
}  // namespace cabinet_articulation

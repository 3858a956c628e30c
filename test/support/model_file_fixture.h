// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/Predict.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "support/moving_fronts.h"

namespace cabinet_articulation {
namespace test {

inline const std::string kName = "/cabinet/articulation";

/// The articulation nodelet with a model file in a folder of its own, which the test loads and unloads.
class ModelFile : public MovingFronts {
 protected:
  ModelFile()
      : MovingFronts("cabinet"), folder_(std::filesystem::temp_directory_path() / ("model_file." + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / "kitchen.yaml").string();
    nh_.setParam(kName + "/models_file", path_);
    nh_.setParam(kName + "/save_at_exit", true);
    nh_.setParam(kName + "/diagnostic_period", 0.1);
    loadNodelet();
  }

  ~ModelFile() override {
    unloadNodelet();
    std::filesystem::remove_all(folder_);
  }

  void SetUp() override {
    MovingFronts::SetUp();
    ASSERT_TRUE(spinUntil([&] { return reports_.hears(2); }));
  }

  Predict::Response predict(std::uint32_t id, double q) {
    Predict predict;
    predict.request.id = id;
    predict.request.q = {q};
    EXPECT_TRUE(ros::service::call("/cabinet/predict", predict));
    return predict.response;
  }

  template <class Service>
  std::pair<bool, std::string> callWithFile(const std::string& name, const std::string& file) {
    Service call;
    call.request.file = file;
    EXPECT_TRUE(ros::service::call("/cabinet/" + name, call));
    return {call.response.success, call.response.message};
  }

  std::string text() const {
    std::ifstream in(path_);
    std::stringstream stream;
    stream << in.rdbuf();
    return stream.str();
  }

  static bool contains(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

  const std::filesystem::path folder_;
  std::string path_;
  Reports reports_;
};

}  // namespace test
}  // namespace cabinet_articulation

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "../../src/tools/config_catalogue.h"

namespace cabinet_articulation::core {
namespace {

class ConfigFiles : public testing::TestWithParam<ConfigFile> {};

TEST_P(ConfigFiles, LoadAndListEveryFieldWithItsDefault) {
  const std::string path = std::string(CONFIG_DIR) + "/" + GetParam().stage + ".yaml";
  const ConfigValues values = readYamlFile(path);
  EXPECT_EQ(values.size(), GetParam().fields.size());
  for (const detail::FieldText& field : GetParam().fields) EXPECT_EQ(values.count(field.key), 1u) << field.key;
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_EQ(text, GetParam().yaml) << "scripts/update_config.sh writes the files again";
}

TEST_P(ConfigFiles, EveryFieldSaysWhatItMeans) {
  for (const detail::FieldText& field : GetParam().fields) EXPECT_GE(field.meaning.size(), 10u) << field.key;
}

INSTANTIATE_TEST_SUITE_P(Stages, ConfigFiles, testing::ValuesIn(configCatalogue()),
                         [](const auto& info) { return info.param.stage; });

}  // namespace
}  // namespace cabinet_articulation::core

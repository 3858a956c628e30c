// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "tools/settings/config_catalogue.h"
#include "tools/settings/parameter_tables.h"

namespace cabinet_articulation::core {
namespace {

class ConfigFiles : public testing::TestWithParam<ConfigFile> {};

TEST_P(ConfigFiles, LoadAndListEveryFieldWithItsValue) {
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

class NodeletPages : public testing::TestWithParam<ParameterTable> {};

TEST_P(NodeletPages, EndWithTheParametersOfTheCode) {
  std::ifstream file(std::string(DOC_DIR) + "/nodelets/" + GetParam().nodelet + ".md");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const size_t at = text.find("## Parameters\n");
  ASSERT_NE(at, std::string::npos) << "no page, or no parameters on it";
  EXPECT_EQ(text.substr(at), "## Parameters\n" + GetParam().markdown) << "scripts/update_config.sh writes the pages again";
}

INSTANTIATE_TEST_SUITE_P(Nodelets, NodeletPages, testing::ValuesIn(parameterTables()),
                         [](const auto& info) { return info.param.nodelet; });

INSTANTIATE_TEST_SUITE_P(Stages, ConfigFiles, testing::ValuesIn(configCatalogue()), [](const auto& info) {
  std::string name = info.param.stage;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

template <class Config>
void expectSame(const Config& loaded, const Config& expected) {
  const std::vector<detail::FieldText> a = describeConfig(loaded), b = describeConfig(expected);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].value, b[i].value) << a[i].key;
}

void expectSame(const PipelineConfig& loaded, const PipelineConfig& expected) {
  expectSame(loaded.stereo, expected.stereo);
  expectSame(loaded.planes, expected.planes);
  expectSame(loaded.rectangles, expected.rectangles);
  expectSame(loaded.tracking, expected.tracking);
  expectSame(loaded.articulation, expected.articulation);
}

TEST(ConfigFolders, LoadToTheSettingsOfTheCode) {
  std::vector<std::string> warnings;
  expectSame(PipelineConfig::load(CONFIG_DIR, &warnings), {});
  expectSame(PipelineConfig::load(CONFIG_DIR "/paper", &warnings), PipelineConfig::paper());
  EXPECT_EQ(warnings, std::vector<std::string>());
}

}  // namespace
}  // namespace cabinet_articulation::core

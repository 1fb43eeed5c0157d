// SPDX-License-Identifier: BSD-3-Clause
// What the package ships agrees with the code: the sensor sets, nodelets.xml and doc/parameters.md.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "parameter_tables.h"
#include "run_bag/sensor_set.h"
#include "run_bag/stage_types.h"
#include "yaml_options.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/display/camera_view_options.h"
#include "datmo_fusion/ros/display/grid_views_options.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo::shipped_settings_test {
namespace {

const std::filesystem::path kPackage = DATMO_FUSION_SOURCE_DIR;

std::vector<std::string> sensorSets() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kPackage / "config")) {
    if (entry.path().extension() == ".yaml") {
      files.push_back(entry.path().string());
    }
  }
  return files;
}

TEST(SensorSets, AreReadWithoutAnUnknownKeyOrABadValue) {
  const auto files = sensorSets();
  EXPECT_GE(files.size(), 2U);
  for (const std::string& file : files) {
    EXPECT_NO_THROW(SensorSet{file}) << file;
    for (const char* const name : {"markers", "lidar_markers", "stereo_markers"}) {
      if (const YAML::Node markers = loadYaml(file)[name]) {
        EXPECT_NO_THROW(readOptions<MarkersOptions>(optionValues(markers))) << file;
      }
    }
    if (const YAML::Node view = loadYaml(file)["camera_view"]) {
      EXPECT_NO_THROW(readOptions<CameraViewOptions>(optionValues(view))) << file;
    }
    if (const YAML::Node views = loadYaml(file)["grid_views"]) {
      EXPECT_NO_THROW(readOptions<GridViewsOptions>(optionValues(views)).panelNames()) << file;
    }
  }
}

TEST(SensorSets, SharedSectionsApplyToAllStages) {
  SensorSet sensors((kPackage / "config/demonstrator.yaml").string());
  EXPECT_FALSE(sensors.shared().motion.usesImu());
  sensors.set("motion", "source", std::string("imu_and_wheels"));
  EXPECT_TRUE(sensors.shared().motion.usesImu());
}

TEST(ThesisPreset, OverridesAnySensorSet) {
  const std::string thesis = kPackage / "config" / "thesis.yaml";
  for (const std::string& file : sensorSets()) {
    const SensorSet sensors(file, {thesis});
    EXPECT_EQ(std::get<std::string>(sensors.values("road_border").at("method")), "thesis") << file;
    OptionValues scanner = SensorSet(file).values("scanner");
    scanner["beam_width"] = 0.0;
    scanner["end_margin"] = 0.0;
    EXPECT_EQ(sensors.values("scanner"), scanner) << file;
  }
}

TEST(ParameterPage, ListsTheCurrentParameters) {
  std::ifstream file(kPackage / "doc" / "parameters.md");
  if (!file) {
    GTEST_SKIP() << "no doc/parameters.md in " << kPackage;
  }
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_EQ(page.str(), parameterTables()) << "make it again: list_parameters > doc/parameters.md";
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(ParameterPage, PublicParametersAreFewAndManyOfThemAreLive) {
  const std::string page = parameterTables();
  const std::string of_users = page.substr(0, page.find("# Expert parameters"));
  ASSERT_LT(of_users.size(), page.size());
  constexpr std::size_t kMaxPublic = 120;
  constexpr std::size_t kMinLive = 15;
  EXPECT_GT(countOf(of_users, "\n| `"), 0U);
  EXPECT_LE(countOf(of_users, "\n| `"), kMaxPublic);
  EXPECT_GE(countOf(of_users, "*live* |"), kMinLive);
  EXPECT_EQ(countOf(page, "*live* |"), countOf(of_users, "*live* |"));
}

/// The number may only fall: a new expert option belongs in its struct, where tests set it.
TEST(ParameterPage, ExpertParametersDoNotBecomeMore) {
  const std::string page = parameterTables();
  const auto begin = page.find("# Expert parameters");
  ASSERT_NE(begin, std::string::npos);
  constexpr std::size_t kMaxExpert = 973;
  EXPECT_LE(countOf(page.substr(begin), "\n| `"), kMaxExpert);
}

TEST(StageTypes, EachRowOfTheGraphHasAnEntryAndEachEntryARow) {
  EXPECT_NO_THROW(checkStageTypes(stageGraph(allSwitches())));
}

TEST(StageTypes, MissingEntriesAndRowsAreNamed) {
  std::vector<GraphStage> graph = stageGraph(allSwitches());
  std::replace_if(
      graph.begin(), graph.end(), [](const GraphStage& stage) { return stage.type == "risk"; },
      GraphStage{"parking", "parking_spaces", {}, {}});
  try {
    checkStageTypes(graph);
    FAIL() << "expected an error";
  } catch (const std::logic_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("expected a class datmo_fusion/parking_spaces in nodelets.xml"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("expected a row 'risk' in src/ros/stage/stage_graph.cpp"),
              std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace datmo::shipped_settings_test

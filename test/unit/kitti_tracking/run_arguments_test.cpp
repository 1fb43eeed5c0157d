// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/run_arguments.h"

#include "text_file.h"
#include <gtest/gtest.h>

namespace datmo::kitti::run_arguments_test {
namespace {

const std::string kShipped = std::string(DATMO_FUSION_SOURCE_DIR) + "/config/kitti_tracking";

TEST(RunArgumentsTest, FoldersAndDefaults) {
  const RunArguments arguments = parseRunArguments({"d", "c", "r"});
  EXPECT_EQ(arguments.detections, "d");
  EXPECT_EQ(arguments.calibrations, "c");
  EXPECT_EQ(arguments.results, "r");
  EXPECT_TRUE(arguments.options.estimate_ego_motion);
}

TEST(RunArgumentsTest, TheShippedConfigurationIsRead) {
  const RunOptions options = parseRunArguments({"d", "c", "r", "--config", kShipped}).options;
  for (const ClassTrackingOptions& one : options.classes) {
    EXPECT_FALSE(one.tracker.require_motion);
  }
  EXPECT_NE(options.classes[0].detections.score_even, options.classes[1].detections.score_even);
}

TEST(RunArgumentsTest, OptionsOverrideTheConfiguration) {
  const RunOptions options =
      parseRunArguments({"--set", "car/tracker/require_motion=true", "d", "c", "r", "--config",
                         kShipped, "--set", "ego_motion/gate=2"})
          .options;
  EXPECT_TRUE(options.classes[0].tracker.require_motion);
  EXPECT_EQ(options.ego_motion.gate, 2.0);
}

TEST(RunArgumentsTest, ErrorsAreNamed) {
  const auto message = [](const std::vector<std::string>& words) {
    return messageOf([&] { parseRunArguments(words); });
  };
  EXPECT_NE(message({"d", "c"}).find("2 folders"), std::string::npos);
  EXPECT_NE(message({"d", "c", "r", "--car", "x"}).find("--car"), std::string::npos);
  EXPECT_NE(message({"d", "c", "r", "--set"}).find("--set"), std::string::npos);
  EXPECT_NE(message({"d", "c", "r", "--set", "car/tracker/asociation=gnn"}).find("association"),
            std::string::npos);
  EXPECT_NE(message({"d", "c", "r", "--config", "/nowhere"}).find("/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace datmo::kitti::run_arguments_test

// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/score_arguments.h"

#include "text_file.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/options.h"

namespace datmo::kitti::score_arguments_test {
namespace {

std::string errorOf(const std::vector<std::string>& words) {
  return messageOf([&words] { parseScoreArguments(words); });
}

TEST(ScoreArguments, AllClassesAndPublishedOverlapsByDefault) {
  const ScoreArguments arguments = parseScoreArguments({"labels", "results"});
  EXPECT_EQ(arguments.labels, "labels");
  EXPECT_EQ(arguments.results, "results");
  EXPECT_EQ(arguments.averaging, Averaging::kOnce);
  EXPECT_TRUE(arguments.output.empty());
  ASSERT_EQ(arguments.kinds.size(), 9U);
  EXPECT_EQ(arguments.kinds.front().type, ObjectType::kCar);
  EXPECT_EQ(arguments.kinds.front().min_overlap, 0.25);
  EXPECT_EQ(arguments.kinds.back().type, ObjectType::kCyclist);
  EXPECT_EQ(arguments.kinds.back().min_overlap, 0.7);
}

TEST(ScoreArguments, OneClassAndOverlap) {
  const ScoreArguments arguments =
      parseScoreArguments({"--class", "pedestrian", "labels", "--iou", "0.5", "results", "--out",
                           "report.json", "--averaging", "repeated"});
  ASSERT_EQ(arguments.kinds.size(), 1U);
  EXPECT_EQ(arguments.kinds[0].type, ObjectType::kPedestrian);
  EXPECT_EQ(arguments.kinds[0].min_overlap, 0.5);
  EXPECT_EQ(arguments.averaging, Averaging::kRepeated);
  EXPECT_EQ(arguments.output, "report.json");
}

TEST(ScoreArguments, NamesTheError) {
  EXPECT_THROW(parseScoreArguments({}), OptionError);
  EXPECT_EQ(errorOf({"labels"}), "1 folders are given: expected LABELS_DIR RESULTS_DIR");
  EXPECT_EQ(errorOf({"a", "b", "--class", "van"}),
            "--class 'van': expected car, pedestrian, cyclist or all");
  EXPECT_EQ(errorOf({"a", "b", "--iou"}), "--iou: expected a value after it");
  EXPECT_EQ(errorOf({"a", "b", "--averaging", "never"}),
            "--averaging 'never': expected once or repeated");
  EXPECT_EQ(errorOf({"a", "b", "--frames"}),
            "'--frames': expected --class, --iou, --averaging or --out");
  for (const char* overlap : {"0", "1.1", "nan", "0.5x", "x"}) {
    EXPECT_EQ(
        errorOf({"a", "b", "--iou", overlap}),
        "--iou '" + std::string(overlap) + "': expected a number above 0 and up to 1, or all");
  }
}

}  // namespace
}  // namespace datmo::kitti::score_arguments_test

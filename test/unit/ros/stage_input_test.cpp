// SPDX-License-Identifier: BSD-3-Clause
// The inputs of scripts/fuzz stages: any bytes are one.
#include "stage_input.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::stage_input_test {
namespace {

fuzz::StageInput sample() {
  fuzz::StageInput input;
  input.graph = 3;
  for (const fuzz::Door& door :
       {fuzz::Door{"scan", "sensor_msgs/LaserScan"}, {"/tf", "tf2_msgs/TFMessage"}}) {
    doorIn(input, door);
  }
  input.records = {{1, 0, {7, 8, 9}}, {0, 60000, {}}, {1, 255, {255, 0}}};
  return input;
}

TEST(StageInput, IsReadAsWritten) {
  const fuzz::StageInput read = fuzz::decodeStageInput(encode(sample()));
  EXPECT_EQ(read.graph, 3);
  EXPECT_EQ(read.doors, sample().doors);
  ASSERT_EQ(read.records.size(), 3U);
  for (std::size_t i = 0; i < read.records.size(); ++i) {
    EXPECT_EQ(read.records[i].door, sample().records[i].door) << i;
    EXPECT_EQ(read.records[i].wait, sample().records[i].wait) << i;
    EXPECT_EQ(read.records[i].bytes, sample().records[i].bytes) << i;
  }
}

TEST(StageInput, OfWhichTheEndIsMissingHasShorterRecords) {
  const std::string whole = encode(sample());
  const auto begin = std::string_view(whole).substr(0, whole.size() - 1);
  const fuzz::StageInput read = fuzz::decodeStageInput(begin);
  ASSERT_EQ(read.records.size(), 3U);
  EXPECT_EQ(read.records.back().bytes, std::vector<std::uint8_t>{255});
  EXPECT_TRUE(fuzz::decodeStageInput("").records.empty());
  EXPECT_TRUE(fuzz::decodeStageInput(std::string(2, '\0') + "no doors").records.empty());
}

TEST(StageInput, KeepsOneDoorOfEachTopicAndType) {
  fuzz::StageInput input = sample();
  EXPECT_EQ(doorIn(input, input.doors[1]), 1);
  EXPECT_EQ(doorIn(input, {"scan", "sensor_msgs/MultiEchoLaserScan"}), 2);
  EXPECT_EQ(input.doors.size(), 3U);
  EXPECT_EQ(&input.doorOf({5, 0, {}}), &input.doors[2]) << "modulo their number";
}

}  // namespace
}  // namespace datmo::stage_input_test

// SPDX-License-Identifier: BSD-3-Clause
// The inputs of scripts/fuzz stages: any bytes are one, and the seeds are messages.
#include "fuzzed_drive.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "message_kinds.h"
#include <gtest/gtest.h>

namespace datmo::fuzzed_drive_test {
namespace {

fuzz::FuzzedDrive sample() {
  fuzz::FuzzedDrive drive;
  drive.graph = 3;
  drive.topics = {{"scan", "sensor_msgs/LaserScan"}, {"/tf", "tf2_msgs/TFMessage"}};
  drive.messages = {{1, 0, {7, 8, 9}}, {0, 60000, {}}, {1, 255, {255, 0}}};
  return drive;
}

fuzz::FuzzedDrive driveIn(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  return fuzz::decodeDrive(bytes.str());
}

TEST(FuzzedDrive, IsReadAsWritten) {
  const fuzz::FuzzedDrive read = fuzz::decodeDrive(encode(sample()));
  EXPECT_EQ(read.graph, 3);
  EXPECT_EQ(read.topics, sample().topics);
  ASSERT_EQ(read.messages.size(), 3U);
  for (std::size_t i = 0; i < read.messages.size(); ++i) {
    EXPECT_EQ(read.messages[i].topic, sample().messages[i].topic) << i;
    EXPECT_EQ(read.messages[i].wait, sample().messages[i].wait) << i;
    EXPECT_EQ(read.messages[i].bytes, sample().messages[i].bytes) << i;
  }
}

TEST(FuzzedDrive, OfWhichTheEndIsMissingHasAShorterMessage) {
  const std::string whole = encode(sample());
  const auto begin = std::string_view(whole).substr(0, whole.size() - 1);
  const fuzz::FuzzedDrive read = fuzz::decodeDrive(begin);
  ASSERT_EQ(read.messages.size(), 3U);
  EXPECT_EQ(read.messages.back().bytes, std::vector<std::uint8_t>{255});
  EXPECT_TRUE(fuzz::decodeDrive("").messages.empty());
  EXPECT_TRUE(fuzz::decodeDrive(std::string(2, '\0') + "no topics").messages.empty());
}

TEST(FuzzedDrive, KeepsEachTopicAndTypeOnce) {
  fuzz::FuzzedDrive drive = sample();
  EXPECT_EQ(topicIndexIn(drive, sample().topics[1]), 1);
  EXPECT_EQ(topicIndexIn(drive, {"scan", "sensor_msgs/MultiEchoLaserScan"}), 2);
  EXPECT_EQ(drive.topics.size(), 3U);
  EXPECT_EQ(&drive.topicOf({5, 0, {}}), &drive.topics[2]) << "modulo their number";
}

TEST(FuzzedDrive, GrowsByTheSizeOfAMessage) {
  fuzz::FuzzedDrive drive = sample();
  const std::size_t size = encode(drive).size();
  drive.messages.push_back({0, 1, std::vector<std::uint8_t>(300)});
  EXPECT_EQ(encode(drive).size(), size + encodedSize(drive.messages.back()));
}

TEST(FuzzedDrive, TheSeedsHoldMessagesOfTheirPresentDefinitions) {
  std::size_t seeds = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(DATMO_FUSION_SOURCE_DIR "/test/fuzz/corpus/stages")) {
    SCOPED_TRACE(entry.path().string() + ", written by fuzz_test_seeds");
    const fuzz::FuzzedDrive drive = driveIn(entry.path());
    EXPECT_FALSE(drive.messages.empty());
    for (const fuzz::TimedMessage& message : drive.messages) {
      const fuzz::TypedTopic& topic = drive.topicOf(message);
      const auto kind = campaign::messageKinds().find(topic.data_type);
      ASSERT_NE(kind, campaign::messageKinds().end()) << topic.data_type;
      ASSERT_NO_THROW({
        // Bytes of a field that was removed would be left over.
        EXPECT_EQ(kind->second.encoded(kind->second.decoded(message.bytes)), message.bytes)
            << topic.name;
      }) << topic.name;
    }
    ++seeds;
  }
  EXPECT_EQ(seeds, 8U) << "one for each graph";
}

}  // namespace
}  // namespace datmo::fuzzed_drive_test

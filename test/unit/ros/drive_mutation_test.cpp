// SPDX-License-Identifier: BSD-3-Clause
// How scripts/fuzz stages changes its inputs.
#include "drive_mutation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "raw_message.h"
#include <gtest/gtest.h>

#include <sensor_msgs/LaserScan.h>

namespace datmo::drive_mutation_test {
namespace {

constexpr unsigned kSeeds = 400;  // even the rarest change occurs several times
constexpr double kPeriod = 0.0625;

/// Empty messages, which are recognized by how long they wait.
fuzz::FuzzedDrive waiting(const std::string& topic, std::uint16_t first, std::uint16_t count) {
  fuzz::FuzzedDrive drive;
  drive.topics = {{topic, "sensor_msgs/LaserScan"}};
  for (std::uint16_t i = 0; i < count; ++i) {
    drive.messages.push_back({0, static_cast<std::uint16_t>(first + i), {}});
  }
  return drive;
}

/// Scans on the first of two topics.
fuzz::FuzzedDrive scans() {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(1000.0);
  scan.header.frame_id = "scanner";
  scan.ranges.assign(8, 5.0F);
  fuzz::FuzzedDrive drive;
  drive.graph = 1;
  drive.topics = {{"scans/front", "sensor_msgs/LaserScan"},
                  {"scans/rear", "sensor_msgs/LaserScan"}};
  drive.messages.assign(6, {0, 7, toRaw(scan).bytes});
  return drive;
}

void appendOne(std::vector<std::uint8_t>& bytes, std::size_t max_size) {
  ASSERT_GT(max_size, bytes.size());
  bytes.push_back(1);
}

fuzz::FuzzedDrive mutated(unsigned seed) {
  std::mt19937 random(seed);
  fuzz::FuzzedDrive drive = scans();
  mutate(drive, kPeriod, appendOne, random);
  return drive;
}

TEST(DriveMutation, OfTheSameSeedIsTheSame) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(encode(mutated(seed)), encode(mutated(seed))) << seed;
  }
}

TEST(DriveMutation, ChangesMessagesTheirNumberTimesTopicsAndGraph) {
  const fuzz::FuzzedDrive original = scans();
  std::set<std::string> changed;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const fuzz::FuzzedDrive drive = mutated(seed);
    if (drive.graph != original.graph) {
      changed.insert("graph");
    }
    if (drive.messages.size() != original.messages.size()) {
      changed.insert(drive.messages.size() < original.messages.size() ? "fewer" : "more");
      continue;
    }
    for (std::size_t i = 0; i < drive.messages.size(); ++i) {
      const fuzz::TimedMessage& message = drive.messages[i];
      const fuzz::TimedMessage& before = original.messages[i];
      if (message.wait != before.wait) {
        changed.insert("wait");
      }
      if (message.topic != before.topic) {
        changed.insert("topic");
      }
      if (message.bytes != before.bytes) {
        changed.insert(message.bytes.size() == before.bytes.size() + 1 ? "bytes" : "content");
      }
    }
  }
  const std::set<std::string> all{"bytes", "content", "fewer", "graph", "more", "topic", "wait"};
  EXPECT_EQ(changed, all);
}

TEST(DriveMutation, MessagesOfUnknownTypesOrNoneAreMutatedToo) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(seed);
    fuzz::FuzzedDrive none;
    mutate(none, kPeriod, appendOne, random);
    EXPECT_TRUE(none.messages.empty());
    fuzz::FuzzedDrive unknown = waiting("noise", 0, 2);
    unknown.topics[0].data_type = "std_msgs/Unknown";
    mutate(unknown, kPeriod, appendOne, random);
    EXPECT_EQ(fuzz::decodeDrive(encode(unknown)).messages.size(), unknown.messages.size());
  }
}

TEST(DriveMutation, ACrossedDriveIsTheBeginningOfOneAndTheEndOfTheOther) {
  fuzz::FuzzedDrive begin = waiting("scan", 0, 10);
  begin.graph = 5;
  const fuzz::FuzzedDrive end = waiting("echoes", 100, 20);
  std::set<std::size_t> cuts;
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const fuzz::FuzzedDrive both = crossed(begin, end, random);
    EXPECT_EQ(both.graph, 5);
    std::size_t cut = 0;
    for (; cut < both.messages.size() && both.topicOf(both.messages[cut]).name == "scan"; ++cut) {
      EXPECT_EQ(both.messages[cut].wait, cut);
    }
    cuts.insert(cut);
    // The same share of both, rounded down; the end has twice as many messages.
    const std::size_t dropped = cut + end.messages.size() - both.messages.size();
    EXPECT_TRUE(dropped == 2 * cut || dropped == 2 * cut + 1) << cut << ", " << dropped;
    for (std::size_t i = cut; i < both.messages.size(); ++i) {
      EXPECT_EQ(both.topicOf(both.messages[i]).name, "echoes");
      EXPECT_EQ(both.messages[i].wait, 100 + dropped + i - cut);
    }
  }
  EXPECT_GE(cuts.size(), 8U) << "anywhere";
}

TEST(DriveMutation, AShortenedDriveIsTheLongestBeginningThatFits) {
  fuzz::FuzzedDrive drive = waiting("scan", 0, 10);
  for (std::size_t i = 0; i < drive.messages.size(); ++i) {
    drive.messages[i].bytes.assign(7 * i, 1);
  }
  const std::string whole = encode(drive);
  for (std::size_t max_size = 0; max_size <= whole.size() + 1; ++max_size) {
    fuzz::FuzzedDrive shorter = drive;
    shorten(shorter, max_size);
    const std::string code = encode(shorter);
    EXPECT_EQ(code, whole.substr(0, code.size())) << "the times and their order remain";
    if (!shorter.messages.empty()) {
      EXPECT_LE(code.size(), max_size);
    }
    if (shorter.messages.size() < drive.messages.size()) {
      EXPECT_GT(code.size() + encodedSize(drive.messages[shorter.messages.size()]), max_size);
    }
  }
}

}  // namespace
}  // namespace datmo::drive_mutation_test

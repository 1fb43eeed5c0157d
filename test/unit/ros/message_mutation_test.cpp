// SPDX-License-Identifier: BSD-3-Clause
// The messages of mutate_messages: copies with other stamps, and with corrupted fields.
#include "message_mutation.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <geometry_msgs/Vector3Stamped.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/part_clocks.h"

namespace datmo::message_mutation_test {
namespace {

const ros::Duration kShift(0.25);

TEST(MessageMutation, ACopyHasAllStampsMovedAndNothingElse) {
  TrackArray tracks;
  tracks.header.stamp = ros::Time(100.0);
  tracks.header.frame_id = "map";
  tracks.tracks.resize(2);
  for (TrackMessage& track : tracks.tracks) {
    track.age = ros::Duration(3.0);
    track.history.resize(2);
    track.history[0].stamp = ros::Time(99.5);
    track.history[1].stamp = ros::Time(100.0);
  }
  const TrackArray copy = campaign::shifted(tracks, kShift);
  EXPECT_EQ(copy.header.stamp, ros::Time(100.25));
  for (const TrackMessage& track : copy.tracks) {
    EXPECT_EQ(track.history[0].stamp, ros::Time(99.75));
    EXPECT_EQ(track.history[1].stamp, ros::Time(100.25));
    EXPECT_EQ(track.age, ros::Duration(3.0)) << "no stamp";
  }
  EXPECT_EQ(campaign::shifted(copy, -kShift), tracks);
}

TEST(MessageMutation, StampsInListsWithoutHeaderOfTheirOwnAreMoved) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(2);
  message.transforms[1].header.stamp = ros::Time(7.0);
  const tf2_msgs::TFMessage copy = campaign::shifted(message, kShift);
  EXPECT_TRUE(copy.transforms[0].header.stamp.isZero()) << "unset remains unset";
  EXPECT_EQ(copy.transforms[1].header.stamp, ros::Time(7.25));
  PartClock clock;
  clock.asked = ros::Time(1.0);
  clock.answered = ros::Time(1.5);
  EXPECT_EQ(campaign::shifted(clock, kShift).asked, ros::Time(1.25));
  EXPECT_EQ(campaign::shifted(clock, kShift).answered, ros::Time(1.75));
}

/// Returns which of its fields differ from those of `original`, by their bytes: NaN is a change.
std::set<int> changedFields(const geometry_msgs::Vector3Stamped& original,
                            const geometry_msgs::Vector3Stamped& copy) {
  const auto differ = [](const auto& a, const auto& b) {
    return std::memcmp(&a, &b, sizeof(a)) != 0;
  };
  const std::array<bool, 6> changed{
      differ(original.header.seq, copy.header.seq),     original.header.stamp != copy.header.stamp,
      original.header.frame_id != copy.header.frame_id, differ(original.vector.x, copy.vector.x),
      differ(original.vector.y, copy.vector.y),         differ(original.vector.z, copy.vector.z),
  };
  std::set<int> fields;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    if (changed[i]) {
      fields.insert(static_cast<int>(i));
    }
  }
  return fields;
}

TEST(MessageMutation, OneToThreeFieldsAreCorruptedAnyOfThemAndRepeatably) {
  geometry_msgs::Vector3Stamped original;
  original.header.stamp = ros::Time(100.0);
  original.header.frame_id = "laser";
  original.vector.x = 2.0;
  original.vector.y = 3.0;
  original.vector.z = 4.0;
  std::set<int> changed;
  std::size_t most = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::mt19937 again(seed);
    const auto copy = campaign::mutated(original, random);
    const std::set<int> fields = changedFields(original, copy);
    EXPECT_EQ(changedFields(copy, campaign::mutated(original, again)), std::set<int>()) << seed;
    most = std::max(most, fields.size());
    changed.insert(fields.begin(), fields.end());
  }
  EXPECT_EQ(most, 3U);
  EXPECT_EQ(changed.size(), 6U);
}

}  // namespace
}  // namespace datmo::message_mutation_test

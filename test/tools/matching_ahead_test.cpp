// SPDX-License-Identifier: BSD-3-Clause
// Clouds that are matched ahead of the stages are those of the pairs that the stages have.
#include "run_bag/matching_ahead.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "stereo_pair_sample.h"
#include <gtest/gtest.h>

namespace datmo::matching_ahead_test {
namespace {

constexpr int kPairs = 12;
constexpr std::size_t kThreads = 3;

StereoTopics topics() {
  StereoTopics topics;
  topics.left_image = "/left/image_rect";
  topics.left_info = "/left/camera_info";
  topics.right_image = "/right/image_rect";
  topics.right_info = "/right/camera_info";
  return topics;
}

StereoImagesOptions options() {
  StereoImagesOptions options;
  options.disparity_range = 32;
  return options;
}

/// Pairs of a wall whose disparity differs from pair to pair.
class MatchingAheadTest : public testing::Test {
 protected:
  MatchingAheadTest()
      : bag_(std::filesystem::temp_directory_path() /
             (std::string("matching_ahead_") +
              testing::UnitTest::GetInstance()->current_test_info()->name() + ".bag")) {
    for (int i = 0; i < kPairs; ++i) {
      pairs_.push_back(pairAt(Stamp::fromSeconds(100.0 + 0.1 * i), 4 + i));
    }
    write();
  }
  ~MatchingAheadTest() override { std::filesystem::remove(bag_); }

  static StereoPair pairAt(Stamp stamp, int disparity) {
    StereoPairSample sample;
    sample.width = 80;
    sample.height = 40;
    sample.disparity = disparity;
    return {{stamp, sample.image(stamp, false, "mono8"), sample.info(stamp, false)},
            {stamp, sample.image(stamp, true, "mono8"), sample.info(stamp, true)}};
  }

  /// All pairs; messages are recorded in this order, whatever their stamps.
  void write() const {
    rosbag::Bag bag(bag_.string(), rosbag::bagmode::Write);
    ros::Time recorded(200.0);
    for (const StereoPair& pair : pairs_) {
      recorded += ros::Duration(0.1);
      bag.write(topics().left_image, recorded, pair.left.image);
      bag.write(topics().left_info, recorded, pair.left.info);
      bag.write(topics().right_image, recorded, pair.right.image);
      bag.write(topics().right_info, recorded, pair.right.info);
    }
  }

  std::unique_ptr<MatchingAhead> ahead() const {
    return std::make_unique<MatchingAhead>(bag_.string(), topics(), options(), kThreads);
  }

  static void expectCloud(MatchingAhead& ahead, const StereoPair& pair) {
    const auto expected = StereoMatcher(options()).cloudOf(pair);
    const auto cloud = ahead.cloudOf(pair);
    ASSERT_TRUE(cloud);
    EXPECT_EQ(cloud->data, expected->data);
    EXPECT_EQ(cloud->header, expected->header);
  }

  std::filesystem::path bag_;
  std::vector<StereoPair> pairs_;
};

TEST_F(MatchingAheadTest, EachPairIsMatchedAhead) {
  const auto ahead = this->ahead();
  for (const StereoPair& pair : pairs_) {
    expectCloud(*ahead, pair);
  }
  EXPECT_EQ(ahead->usedCount(), pairs_.size());
}

TEST_F(MatchingAheadTest, PairsThatNobodyNeedsAreLeftOut) {
  const auto ahead = this->ahead();
  for (const std::size_t i : {0U, 1U, 9U, 11U}) {
    expectCloud(*ahead, pairs_[i]);
  }
  EXPECT_EQ(ahead->usedCount(), 4U);
}

TEST_F(MatchingAheadTest, ImagesOfAnotherContentAreMatchedThemselves) {
  const auto ahead = this->ahead();
  StereoPair changed = pairAt(pairs_[2].left.stamp, 20);
  expectCloud(*ahead, changed);
  EXPECT_EQ(ahead->usedCount(), 0U);
  expectCloud(*ahead, pairs_[3]);
  EXPECT_EQ(ahead->usedCount(), 1U);
  expectCloud(*ahead, pairAt(pairs_.back().left.stamp + 1.0, 5));  // after the end of the bag
}

TEST_F(MatchingAheadTest, RecordingThatStartsOverIsMatchedAhead) {
  const std::vector<StereoPair> once = pairs_;
  pairs_.insert(pairs_.end(), once.begin(), once.end());
  write();
  const auto ahead = this->ahead();
  for (const StereoPair& pair : pairs_) {
    expectCloud(*ahead, pair);
  }
  EXPECT_EQ(ahead->usedCount(), pairs_.size());
}

TEST_F(MatchingAheadTest, PairsLeftOutBeforeStampsWereSetBackDoNotStayInTheWay) {
  const std::vector<StereoPair> once = pairs_;
  for (int round = 0; round < 3; ++round) {
    pairs_.insert(pairs_.end(), once.begin(), once.end());
  }
  write();
  const auto ahead = this->ahead();
  expectCloud(*ahead, once[0]);  // the others of the first round were left out
  for (int round = 0; round < 3; ++round) {
    for (const StereoPair& pair : once) {
      expectCloud(*ahead, pair);
    }
  }
  EXPECT_GT(ahead->usedCount(), 2 * once.size());
}

TEST_F(MatchingAheadTest, ImagesThatCannotBeMatchedFailWhereTheyAreNeeded) {
  const auto other_size = boost::make_shared<sensor_msgs::CameraInfo>(*pairs_[1].right.info);
  other_size->width += 2;
  pairs_[1].right.info = other_size;
  write();
  const auto ahead = this->ahead();
  expectCloud(*ahead, pairs_[0]);
  EXPECT_THROW(ahead->cloudOf(pairs_[1]), InputError);
  expectCloud(*ahead, pairs_[2]);
}

TEST_F(MatchingAheadTest, MayEndBeforeTheBag) {
  ahead();
  expectCloud(*ahead(), pairs_[0]);
}

}  // namespace
}  // namespace datmo::matching_ahead_test

// SPDX-License-Identifier: BSD-3-Clause
// What all stages that fuse lists refuse.
#include <functional>
#include <limits>
#include <string>

#include "object_fusion_sample.h"
#include "track_fusion_sample.h"
#include <gtest/gtest.h>

namespace datmo::fusion_input_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <typename StageTest>
class FusionInputTest : public StageTest {};

using StageTests = testing::Types<ObjectFusionStageTest, TrackFusionStageTest>;
TYPED_TEST_SUITE(FusionInputTest, StageTests);

TYPED_TEST(FusionInputTest, AStampFarAheadOfTheReferenceIsDropped) {
  this->handle("lidar", 100.0);
  const double ahead = 100.1 + this->options_.matcher.silent_after;
  this->handle("stereo", this->list(ahead, {}), Stamp::fromSeconds(100.0));
  EXPECT_EQ(this->drops("stamp_ahead"), 1U);
  const auto fused = this->nextAt(100.11);
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->header.stamp, ros::Time(100.0));
}

TYPED_TEST(FusionInputTest, BadListsAreDroppedAndCounted) {
  auto lists = this->list(100.0, {});
  lists.header.frame_id = "scanner";
  this->handle("lidar", lists);
  EXPECT_EQ(this->drops("wrong_frame"), 1U);
  const std::string said = std::string(TestFixture::kLists) + " of lidar in 'scanner'";
  EXPECT_NE(this->monitor_.lastError().find(said), std::string::npos);
  EXPECT_NE(this->monitor_.lastError().find(TestFixture::kFrame), std::string::npos);
  this->handle("radar", 100.0);
  EXPECT_EQ(this->drops("unknown_source"), 1U);
  this->handle("lidar", this->list(0.0, {}));
  EXPECT_EQ(this->drops("zero_stamp"), 1U);
  this->handle("lidar", 100.0);
  this->handle("lidar", 100.0);
  EXPECT_EQ(this->drops("repeated_stamp"), 1U);
  this->handle("lidar", 99.9);
  EXPECT_EQ(this->drops("old_stamp"), 1U);
  this->handle("stereo", 100.0);
  EXPECT_TRUE(this->nextAt(100.0));
  EXPECT_EQ(this->monitor_.droppedCount(), 5U);
}

TYPED_TEST(FusionInputTest, BadOptionsAreRefused) {
  using Stage = typename TestFixture::StageType;
  using Options = typename Stage::Options;
  const auto refused = [this](const std::function<void(Options&)>& spoil) {
    Options options;
    spoil(options);
    EXPECT_THROW(Stage(options, this->monitor_), OptionError);
  };
  refused([](auto& options) { options.matcher.reference = "radar"; });
  refused([](auto& options) { options.fuser.sources["lidar"].use = false; });
  refused([](auto& options) { options.matcher.max_wait = kNan; });
  refused([](auto& options) { options.matcher.tolerance = kNan; });
  for (const char* const name : {"fused", "", "2nd", "rear-lidar", "a b"}) {
    refused([&](auto& options) { options.fuser.sources[name].use = true; });
  }
}

}  // namespace
}  // namespace datmo::fusion_input_test

// SPDX-License-Identifier: BSD-3-Clause
// The running track_fusion nodelet, fed by the tracks of a scripted scanner and stereo camera: the
// output, which track scheme can be requested, and what happens if one of them is silent or sends
// invalid messages. The tests run through one drive, in this order.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "ros/track_fusion_sample.h"
#include "source_lists.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"

namespace datmo::track_fusion_test {
namespace {

constexpr double kAlone = 40.0;  // m to the left, of what stereo alone follows

class Lists : public SourceLists<TrackArray> {
 public:
  Lists() : SourceLists("tracks", "track_fusion") {}

  static TrackArray listOf(const std::string& sensor, double seconds) {
    const bool is_stereo = sensor == "stereo";
    const double now = kStart + seconds;
    TrackList list{Stamp::fromSeconds(now), {}, {}};
    list.tracks.push_back(carTrack(sensor, is_stereo ? 7 : 3, now));
    if (is_stereo) {
      list.tracks.push_back(carTrack(sensor, 8, now, kAlone));
    }
    return toMessage(list, "map");
  }

  void startStep(double seconds) { setClock(seconds); }
};

class TrackFusionTest : public SourceListsTest<Lists> {
 protected:
  /// Waits for the fused tracks of some earlier steps, since fusion waits for a camera that is not
  /// known to be silent.
  static void stepWithoutStereo() {
    sendLidarStep();
    const ros::Time some_before(kStart + now_ - 3.0 * kStep);
    ASSERT_TRUE(lists_->waitFor([&] { return last().header.stamp >= some_before; })) << now_;
    now_ += kStep;
  }

  /// Returns the track on this side of the road in the last list; null if there is none.
  static const TrackMessage* trackAt(double left) {
    for (const TrackMessage& track : last().tracks) {
      if (std::abs(track.pose.position.y - left) < 1.0) {
        return &track;
      }
    }
    return nullptr;
  }

  static Sensors sensorsAt(double left) {
    const TrackMessage* track = trackAt(left);
    return track ? track->sensors : Sensors{};
  }

  /// 0: no track is there.
  static std::uint32_t idAt(double left) {
    const TrackMessage* track = trackAt(left);
    return track ? track->id : 0;
  }

  static std::string askForScheme(const std::string& scheme) {
    return askForChoice("track_fusion", "scheme", scheme);
  }
};

TEST_F(TrackFusionTest, AnObjectTrackedByBothIsOneTrack) {
  ASSERT_NO_FATAL_FAILURE(driveOn(24));
  EXPECT_EQ(lists_->fused.size(), 24U);
  EXPECT_EQ(last().header.frame_id, "map");
  const TrackMessage* car = trackAt(0.0);
  ASSERT_TRUE(car);
  EXPECT_EQ(car->sensors, (Sensors{"lidar", "stereo"}));
  ASSERT_EQ(car->sources.size(), 2U);
  EXPECT_EQ(car->sources[0].id + car->sources[1].id, 3U + 7U);
  EXPECT_NEAR(car->pose.position.x, carAt(kStart + now_ - kStep), 0.01) << "at the scanner's time";
  EXPECT_TRUE(lists_->waitForCount("tracks of two or more sources", 1.0));
  EXPECT_EQ(lists_->diagnostic("dropped"), 0.0);
}

TEST_F(TrackFusionTest, TheSchemeChangesWhileItRuns) {
  EXPECT_EQ(sensorsAt(kAlone), Sensors{"stereo"}) << "where the scanner does not look";
  EXPECT_EQ(askForScheme("fused_plus_fallback"), "fused_plus_fallback");
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_FALSE(trackAt(kAlone)) << "the scanner's alone beyond the others, not stereo's";
  EXPECT_EQ(askForScheme("confirmed_by_all"), "confirmed_by_all");
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_FALSE(trackAt(kAlone));
  EXPECT_EQ(sensorsAt(0.0), (Sensors{"lidar", "stereo"}));
  EXPECT_EQ(askForScheme("by luck"), "confirmed_by_all") << "it stays";
}

TEST_F(TrackFusionTest, TheParameterServerHasTheNodeletsParameters) {
  EXPECT_NO_THROW(loadOptions<TrackFusionStageOptions>(ros::NodeHandle("/track_fusion")));
  EXPECT_EQ(ros::param::param<std::string>("/track_fusion/scheme", ""), "confirmed_by_all");
  EXPECT_EQ(askForScheme("union"), "union");
}

TEST_F(TrackFusionTest, WithoutStereoTheScannersTrackKeepsItsId) {
  const std::uint32_t id = idAt(0.0);
  ASSERT_GT(id, 0U);
  const std::size_t before = lists_->fused.size();
  for (int i = 0; i < 40; ++i) {
    ASSERT_NO_FATAL_FAILURE(stepWithoutStereo());
  }
  EXPECT_TRUE(lists_->waitFor([] { return lists_->isAt(now_ - kStep); }))
      << "at once, since stereo is silent";
  EXPECT_EQ(lists_->fused.size(), before + 40U) << "none is left out";
  EXPECT_EQ(sensorsAt(0.0), Sensors{"lidar"});
  EXPECT_EQ(idAt(0.0), id);
  EXPECT_TRUE(lists_->waitForCount("warned: silent_source", 1.0));
  EXPECT_TRUE(lists_->waitFor([] {
    return lists_->diagnosticMessage().find("no tracks/stereo") != std::string::npos;
  })) << lists_->diagnosticMessage();
  ASSERT_NO_FATAL_FAILURE(driveOn(24));
  EXPECT_EQ(sensorsAt(0.0), (Sensors{"lidar", "stereo"})) << "it is back";
  EXPECT_EQ(idAt(0.0), id);
}

TEST_F(TrackFusionTest, BadInputIsCountedAndTheRestIsProcessed) {
  TrackArray bad = Lists::listOf("stereo", now_);
  bad.header.frame_id = "base_link";
  lists_->sendStereo(bad);
  EXPECT_TRUE(lists_->waitForCount("dropped: wrong_frame", 1.0));
  bad = Lists::listOf("stereo", now_ + kStereoLater);
  bad.tracks[0].velocity.x = std::numeric_limits<double>::quiet_NaN();
  bad.views.resize(1);
  bad.views[0].beam_spacing = 0.0F;
  ASSERT_NO_FATAL_FAILURE(step(bad));
  EXPECT_TRUE(lists_->waitForCount("bad tracks of stereo", 1.0));
  EXPECT_EQ(lists_->diagnostic("warned: bad_track"), 1.0);
  EXPECT_EQ(lists_->diagnostic("bad views of stereo"), 1.0);
  ASSERT_NO_FATAL_FAILURE(driveOn(4));
  EXPECT_EQ(sensorsAt(0.0), (Sensors{"lidar", "stereo"}));
}

TEST_F(TrackFusionTest, ALoopedBag) {
  const std::uint32_t id = idAt(0.0);
  ASSERT_GT(id, 0U);
  now_ = 0.0;
  ASSERT_NO_FATAL_FAILURE(driveOn(24));
  EXPECT_TRUE(lists_->waitForCount("warned: clock_restart", 1.0));
  EXPECT_EQ(sensorsAt(0.0), (Sensors{"lidar", "stereo"}));
  EXPECT_GT(idAt(0.0), id) << "no id is used again";
}

}  // namespace
}  // namespace datmo::track_fusion_test

// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/arrival_check.h"

#include <limits>
#include <string>

#include "monitor_counts.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/ros/stage/queue_length.h"

namespace datmo::arrival_check_test {
namespace {

const ros::Time kNow(100.0);

class ArrivalCheckTest : public testing::Test {
 protected:
  bool take(const std::string& publisher, std::uint32_t sequence, const ros::Time& queued = kNow) {
    return check_.passes({publisher, sequence, queued}, kNow);
  }

  std::uint64_t dropped(const std::string& reason) const {
    return samples::drops(monitor_, reason);
  }

  StageMonitor monitor_{"stage"};
  ArrivalCheck check_{"scan", 0.5, monitor_};
};

TEST_F(ArrivalCheckTest, AGapInTheNumbersIsLostMessages) {
  EXPECT_TRUE(take("/driver", 7)) << "what came before the first is not known";
  EXPECT_TRUE(take("/driver", 8));
  EXPECT_EQ(monitor_.droppedCount(), 0U);
  EXPECT_TRUE(take("/driver", 12)) << "the message itself is served";
  EXPECT_EQ(dropped("lost_message"), 3U);
  EXPECT_TRUE(take("/driver", 14));
  EXPECT_EQ(dropped("lost_message"), 4U);
  EXPECT_EQ(monitor_.figures().at("lost on scan"), 4.0) << "a stage has several inputs";
  EXPECT_NE(monitor_.lastDrop().find("1 messages on scan from /driver"), std::string::npos);
}

TEST_F(ArrivalCheckTest, LossesDuringAStandstillAreAllCounted) {
  take("/driver", 7);
  take("/driver", 1000007);
  EXPECT_EQ(dropped("lost_message"), 999999U);
  EXPECT_EQ(monitor_.figures().at("lost on scan"), 999999.0);
  take("/driver", 2000008);
  EXPECT_EQ(dropped("lost_message"), 999999U) << "another count";
}

TEST_F(ArrivalCheckTest, UndecodableMessagesAreNotLost) {
  take("/driver", 7);
  check_.noteUndecodable("/driver", 8);
  take("/driver", 9);
  EXPECT_EQ(dropped("lost_message"), 0U);
  check_.noteUndecodable("/driver", 12);  // while 10 still waits
  check_.noteUndecodable("/other", 10);
  take("/driver", 10);
  EXPECT_EQ(dropped("lost_message"), 0U);
  take("/driver", 14);
  EXPECT_EQ(dropped("lost_message"), 2U) << "11 and 13";
  take("/driver", 3);
  check_.noteUndecodable("/driver", 4);
  take("/driver", 5);
  EXPECT_EQ(dropped("lost_message"), 2U) << "the numbers start over";
}

TEST_F(ArrivalCheckTest, AStreamOfUndecodableMessagesIsForgotten) {
  take("/driver", 7);
  for (std::uint32_t sequence = 8; sequence < 5008; ++sequence) {
    check_.noteUndecodable("/driver", sequence);
  }
  take("/driver", 5008);
  EXPECT_EQ(dropped("lost_message"), 4000U) << "the oldest ones";
}

TEST_F(ArrivalCheckTest, EachPublisherCountsByItself) {
  take("/driver", 7);
  take("/other", 100);
  take("/driver", 8);
  take("/other", 101);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(ArrivalCheckTest, APublisherThatStartsOverOrDoesNotCountHasLostNothing) {
  for (const std::uint32_t sequence : {5000U, 1U, 2U, 0U, 0U, 4000000000U, 4000000000U}) {
    EXPECT_TRUE(take("/driver", sequence));
  }
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(ArrivalCheckTest, PublishersWithANewNameEachTimeAreForgotten) {
  for (int i = 0; i < 100; ++i) {
    take("/play_" + std::to_string(i), 1);
  }
  take("/play_99", 3);
  EXPECT_EQ(dropped("lost_message"), 1U) << "the last one is still known";
}

TEST_F(ArrivalCheckTest, StaleMessagesGiveWayToNewerOnes) {
  EXPECT_TRUE(take("/driver", 1, kNow - ros::Duration(0.4)));
  EXPECT_FALSE(take("/driver", 2, kNow - ros::Duration(0.6)));
  EXPECT_EQ(dropped("stale_message"), 1U);
  EXPECT_NE(monitor_.lastDrop().find("0.60 s"), std::string::npos);
  EXPECT_TRUE(take("/driver", 3));
  EXPECT_EQ(dropped("lost_message"), 0U) << "what is dropped here has come";
}

TEST_F(ArrivalCheckTest, AMissingOrResetClockMakesNothingStale) {
  EXPECT_TRUE(take("/driver", 1, ros::Time()));
  EXPECT_TRUE(take("/driver", 2, kNow + ros::Duration(10.0)));
}

/// With events as ROS hands them to a stage.
class ArrivedTest : public ArrivalCheckTest {
 protected:
  ArrivedTest() { ros::Time::init(); }
  ~ArrivedTest() override { ros::Time::init(); }

  /// Takes a scan that has waited this long (s) in the queue of its stage.
  bool takeAfter(double wait) {
    const auto scan = boost::make_shared<sensor_msgs::LaserScan>();
    setSequence(*scan, ++sequence_);
    const ros::Time now = ros::Time::now();
    const ros::MessageEvent<const sensor_msgs::LaserScan> event(scan, now - ros::Duration(wait));
    return check_.passes(arrivedOf(event), now);
  }

  std::uint32_t sequence_ = 0;
};

TEST_F(ArrivedTest, LiveAStaleMessageGivesWayToNewerOnes) {
  ASSERT_FALSE(ros::Time::isSimTime());
  EXPECT_TRUE(takeAfter(0.4));
  EXPECT_FALSE(takeAfter(0.6));
  EXPECT_FALSE(takeAfter(60.0));
  EXPECT_TRUE(takeAfter(0.0));
  EXPECT_EQ(dropped("stale_message"), 2U);
  EXPECT_EQ(dropped("lost_message"), 0U);
}

TEST_F(ArrivedTest, InSimulatedTimeNoneIsStale) {
  ros::Time::setNow(kNow);
  ASSERT_TRUE(ros::Time::isSimTime());
  EXPECT_TRUE(takeAfter(60.0)) << "as in a bag that is played at a high rate";
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST(MaxWaitInQueue, MotionAddsUpAndMayWait) {
  EXPECT_EQ(maxWaitInQueue<nav_msgs::Odometry>(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(maxWaitInQueue<sensor_msgs::LaserScan>(), 1.0);
}

TEST(Sequence, OfTheHeaderIfThereIsOne) {
  sensor_msgs::LaserScan scan;
  setSequence(scan, 3);
  EXPECT_EQ(sequenceOf(scan), 3U);
  tf2_msgs::TFMessage transforms;
  setSequence(transforms, 3);
  EXPECT_EQ(sequenceOf(transforms), 0U);
}

}  // namespace
}  // namespace datmo::arrival_check_test

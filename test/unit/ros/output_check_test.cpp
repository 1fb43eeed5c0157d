// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/output_check.h"

#include <limits>

#include "monitor_counts.h"
#include <datmo_fusion/RiskArray.h>
#include <datmo_fusion/StationTracks.h>
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>

namespace datmo::output_check_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

OutputContent at(double seconds, const std::string& fault = "") {
  return {Stamp::fromSeconds(seconds), fault};
}

TEST(ContentFault, NoNumberOfAMessageMayBeNaN) {
  TrackArray tracks;
  EXPECT_EQ(contentFault(tracks), "");
  tracks.tracks.resize(2);
  EXPECT_EQ(contentFault(tracks), "");
  tracks.tracks[1].history.resize(1);
  tracks.tracks[1].history[0].pose.theta = kNaN;
  EXPECT_EQ(contentFault(tracks), "a number that is nan");
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(1);
  transforms.transforms[0].transform.translation.x = kInfinity;
  EXPECT_EQ(contentFault(transforms), "a number that is inf");
}

TEST(ContentFault, InfinityStaysWhereItHasAMeaning) {
  ObjectArray objects;
  objects.objects.resize(1);
  objects.objects[0].side_variance[0] = kInfinity;
  EXPECT_EQ(contentFault(objects), "");
  objects.objects[0].side_variance[0] = kNaN;
  EXPECT_NE(contentFault(objects), "");
  datmo_fusion::RiskArray risks;
  risks.risks.resize(1);
  risks.risks[0].median_ttc = std::numeric_limits<float>::infinity();
  EXPECT_EQ(contentFault(risks), "");
  sensor_msgs::LaserScan scan;
  scan.ranges = {std::numeric_limits<float>::quiet_NaN()};
  EXPECT_EQ(contentFault(scan), "") << "no measurement, by the message's definition";
}

TEST(ContentFault, TheAnglesOfAScanAreFinite) {
  for (float sensor_msgs::LaserScan::*const field :
       {&sensor_msgs::LaserScan::angle_min, &sensor_msgs::LaserScan::angle_max,
        &sensor_msgs::LaserScan::angle_increment, &sensor_msgs::LaserScan::time_increment,
        &sensor_msgs::LaserScan::scan_time, &sensor_msgs::LaserScan::range_min,
        &sensor_msgs::LaserScan::range_max}) {
    sensor_msgs::LaserScan scan;
    scan.*field = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(contentFault(scan), "a number that is nan");
  }
}

TEST(ContentFault, ACovarianceIsPositiveSemidefinite) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  EXPECT_EQ(contentFault(pose), "");
  pose.pose.covariance[0] = 1.0;
  pose.pose.covariance[7] = 1.0;
  pose.pose.covariance[1] = pose.pose.covariance[6] = 0.9;
  EXPECT_EQ(contentFault(pose), "");
  pose.pose.covariance[1] = pose.pose.covariance[6] = 1.1;
  EXPECT_EQ(contentFault(pose), "a covariance that is not positive semidefinite");
  pose.pose.covariance[1] = 0.9;
  pose.pose.covariance[6] = 0.5;
  EXPECT_NE(contentFault(pose), "") << "not symmetric";
  pose.pose.covariance[1] = pose.pose.covariance[6] = 1.1;
  pose.pose.covariance[35] = 1e8;
  EXPECT_NE(contentFault(pose), "") << "small beside another quantity's variance";
  TrackArray tracks;
  tracks.tracks.resize(1);
  tracks.tracks[0].covariance[0] = -1.0;
  EXPECT_NE(contentFault(tracks), "");
}

TEST(ContentFault, TheCovarianceOfTheMapOnTheEarthIsPositiveSemidefinite) {
  datmo_fusion::EarthFrame frame;
  EXPECT_EQ(contentFault(frame), "");
  frame.covariance = {1.0, 0.0, 0.9, 0.0, 1.0, 0.0, 0.9, 0.0, 1.0};
  EXPECT_EQ(contentFault(frame), "");
  frame.covariance[2] = frame.covariance[6] = 1.1;
  EXPECT_EQ(contentFault(frame), "a covariance that is not positive semidefinite");
  frame.covariance[2] = 0.9;
  frame.covariance[6] = 0.5;
  EXPECT_NE(contentFault(frame), "") << "not symmetric";
}

TEST(ContentFault, TheCovariancesOfTracksForOtherStationsArePositiveSemidefinite) {
  datmo_fusion::StationTracks list;
  list.tracks.resize(2);
  EXPECT_EQ(contentFault(list), "");
  auto& covariance = list.tracks[1].covariance;  // of position and velocity
  covariance[0] = covariance[5] = covariance[10] = covariance[15] = 1.0;
  covariance[7] = covariance[13] = 0.9;
  EXPECT_EQ(contentFault(list), "");
  covariance[7] = covariance[13] = 1.1;
  EXPECT_EQ(contentFault(list), "a covariance that is not positive semidefinite");
  covariance[13] = 0.9;
  EXPECT_NE(contentFault(list), "") << "not symmetric";
}

TEST(OutputCheck, InvalidOutputIsCountedAndTheStageStartsOver) {
  StageMonitor monitor("tracker");
  OutputCheck check("tracks", monitor);
  EXPECT_TRUE(check.passes(at(10.0)));
  EXPECT_FALSE(monitor.handleResetRequest());
  EXPECT_FALSE(check.passes(at(10.1, "a number that is nan")));
  EXPECT_TRUE(monitor.handleResetRequest());
  EXPECT_EQ(samples::drops(monitor, "bad_output"), 1U);
  EXPECT_EQ(monitor.lastError(),
            "would publish on tracks a number that is nan: drops it and starts over");
}

TEST(OutputCheck, TimeGoesBackOnlyAfterAReset) {
  StageMonitor monitor("tracker");
  OutputCheck check("tracks", monitor);
  EXPECT_TRUE(check.passes(at(10.0)));
  EXPECT_TRUE(check.passes(at(10.0)));
  EXPECT_FALSE(check.passes(at(9.9)));
  EXPECT_TRUE(monitor.handleResetRequest());
  EXPECT_TRUE(check.passes({std::nullopt, ""})) << "no stamp, no order";
  monitor.noteReset();
  EXPECT_TRUE(check.passes(at(5.0)));
}

TEST(OutputCheck, NoResultIsOfAFutureTime) {
  StageMonitor monitor("tracker");
  OutputCheck check("tracks", monitor);
  EXPECT_TRUE(check.passes(at(10.0))) << "of inputs nothing is known";
  monitor.noteInput(Stamp::fromSeconds(10.0));
  EXPECT_TRUE(check.passes(at(10.2)));
  EXPECT_FALSE(check.passes(at(110.0)));
  EXPECT_TRUE(monitor.handleResetRequest());
  EXPECT_TRUE(check.passes(at(10.3))) << "the next one is not late";
  monitor.forgetInputs();
  monitor.noteReset();
  monitor.noteInput(Stamp::fromSeconds(5.0));
  EXPECT_TRUE(check.passes(at(5.0)));
  EXPECT_FALSE(check.passes(at(10.0)));
}

}  // namespace
}  // namespace datmo::output_check_test

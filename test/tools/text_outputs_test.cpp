// SPDX-License-Identifier: BSD-3-Clause
// Results as text: hand-computed lines, and the files of a run.
#include "run_bag/text_outputs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "run_bag_drive.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::text_outputs_test {
namespace {

const ros::Time kStamp(12, 5000000);

struct Frame {
  Publication pose;
  Publication tracks;
};

template <typename Message>
Publication published(const std::string& topic, const boost::shared_ptr<Message>& message) {
  return {topic, ros::message_traits::datatype<Message>(), message};
}

/// The vehicle at (10, 20) faces to the left of the map's x axis; a car 3 m ahead of it and 1 m to
/// its left has the same heading.
Frame oneFrame() {
  const auto pose = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  pose->header.stamp = kStamp;
  pose->pose.pose = toMessage(Pose2(10.0, 20.0, kPi / 2.0));
  TrackMessage track;
  track.id = 7;
  track.pose = toMessage(Pose2(9.0, 23.0, kPi / 2.0));
  track.size.x = 4.5;
  track.size.y = 1.75;
  track.size.z = 1.5;
  track.classification = ObjectMessage::CLASS_VEHICLE;
  track.existence_probability = 0.5F;
  const auto tracks = boost::make_shared<TrackArray>();
  tracks->header.stamp = kStamp;
  tracks->tracks.push_back(track);
  return {published("pose", pose), published("tracks", tracks)};
}

void addFrame(TextOutputs& outputs) {
  const Frame frame = oneFrame();
  outputs.add(frame.pose);
  outputs.add(frame.tracks);
}

TEST(TextOutputs, TumHoldsStampPositionAndQuaternion) {
  TextOutputs outputs({"poses.txt", "tracks.txt", "mot.txt"});
  addFrame(outputs);
  EXPECT_EQ(outputs.tum(),
            "12.005000000 10.000000 20.000000 0.000000 0.000000 0.000000 0.707107 0.707107\n");
}

TEST(TextOutputs, KittiHoldsTheTrackAsTheVehicleSeesIt) {
  TextOutputs outputs({"poses.txt", "tracks.txt", "mot.txt"});
  addFrame(outputs);
  EXPECT_EQ(outputs.kitti(),
            "0 7 Car -1 -1 -10 -1 -1 -1 -1 1.500000 1.750000 4.500000 -1.000000 0 3.000000 "
            "-1.570796 0.500000\n");
}

TEST(TextOutputs, MotHoldsTheTrackInTheMapWithFramesFromOne) {
  TextOutputs outputs({"poses.txt", "tracks.txt", "mot.txt"});
  addFrame(outputs);
  EXPECT_EQ(outputs.mot(), "1,7,-1,-1,-1,-1,0.500000,9.000000,23.000000,0.000000\n");
}

TEST(TextOutputs, TracksWithoutPoseAreLeftOut) {
  TextOutputs outputs({"poses.txt", "tracks.txt", "mot.txt"});
  outputs.add(oneFrame().tracks);
  EXPECT_EQ(outputs.kitti() + outputs.mot() + outputs.tum(), "");
}

std::size_t linesIn(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(RunBag, ResultsAreWrittenAsTextOnRequest) {
  arguments_.text.tum = arguments_.output + ".tum";
  arguments_.text.kitti = arguments_.output + ".kitti";
  arguments_.text.mot = arguments_.output + ".mot";
  run();
  EXPECT_EQ(linesIn(bytes(arguments_.text.tum)), static_cast<std::size_t>(kScans));
  EXPECT_EQ(linesIn(bytes(arguments_.text.kitti)), linesIn(bytes(arguments_.text.mot)));
}

TEST_F(RunBag, WithoutABagNoTextIsLeft) {
  arguments_.text.tum = arguments_.output + ".tum";
  arguments_.input = "/nowhere.bag";
  EXPECT_THROW(run(), std::exception);
  EXPECT_FALSE(std::filesystem::exists(arguments_.text.tum));
}

TEST(TextOutputs, AnUnwritableFileIsNamedAtTheStart) {
  EXPECT_THROW(TextOutputs({"", "/nowhere/tracks.txt", ""}), std::runtime_error);
}

}  // namespace
}  // namespace datmo::text_outputs_test

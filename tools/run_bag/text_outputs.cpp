// SPDX-License-Identifier: BSD-3-Clause
#include "text_outputs.h"

#include <iomanip>
#include <sstream>
#include <utility>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/whole_file.h"

namespace datmo {

namespace {

/// Sufficient for 0.1 mm and 0.1 mrad; stamps have all their nanoseconds.
constexpr int kDecimals = 6;

const char* kittiType(std::uint8_t classification) {
  switch (classification) {
    case ObjectMessage::CLASS_VEHICLE:
      return "Car";
    case ObjectMessage::CLASS_PEDESTRIAN:
      return "Pedestrian";
    case ObjectMessage::CLASS_CYCLIST:
      return "Cyclist";
    default:
      return "Misc";
  }
}

std::ostringstream lineOfNumbers() {
  std::ostringstream line;
  line << std::fixed << std::setprecision(kDecimals);
  return line;
}

std::string tumLine(const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
  std::ostringstream line = lineOfNumbers();
  line << header.stamp.sec << '.' << std::setfill('0') << std::setw(9) << header.stamp.nsec << ' '
       << pose.position.x << ' ' << pose.position.y << ' ' << pose.position.z << ' '
       << pose.orientation.x << ' ' << pose.orientation.y << ' ' << pose.orientation.z << ' '
       << pose.orientation.w << '\n';
  return line.str();
}

std::string kittiLine(std::size_t frame, const TrackMessage& track, const Pose2& base_in_map) {
  const Pose2 in_base = base_in_map.inverse() * fromMessage(track.pose);
  std::ostringstream line = lineOfNumbers();
  line << frame << ' ' << track.id << ' ' << kittiType(track.classification)
       << " -1 -1 -10 -1 -1 -1 -1 " << track.size.z << ' ' << track.size.y << ' ' << track.size.x
       << ' ' << -in_base.y() << " 0 " << in_base.x() << ' '
       << normalizeAngle(-in_base.heading() - kPi / 2.0) << ' ' << track.existence_probability
       << '\n';
  return line.str();
}

std::string motLine(std::size_t frame, const TrackMessage& track) {
  const geometry_msgs::Point& position = track.pose.position;
  std::ostringstream line = lineOfNumbers();
  line << frame + 1 << ',' << track.id << ",-1,-1,-1,-1," << track.existence_probability << ','
       << position.x << ',' << position.y << ',' << position.z << '\n';
  return line.str();
}

}  // namespace

TextOutputs::TextOutputs(TextFiles files) : files_(std::move(files)) {
  for (const std::string& file : {files_.tum, files_.kitti, files_.mot}) {
    if (!file.empty()) {
      checkWritable(file);
    }
  }
}

void TextOutputs::add(const Publication& publication) {
  if (publication.topic == "pose") {
    addPose(*publication.as<geometry_msgs::PoseWithCovarianceStamped>());
  } else if (publication.topic == "tracks") {
    addTracks(*publication.as<TrackArray>());
  }
}

void TextOutputs::addPose(const geometry_msgs::PoseWithCovarianceStamped& pose) {
  const Frame frame{frames_.size(), fromMessage(pose.pose.pose)};
  frames_.emplace(pose.header.stamp, frame);
  if (!files_.tum.empty()) {
    tum_ += tumLine(pose.header, pose.pose.pose);
  }
}

void TextOutputs::addTracks(const TrackArray& tracks) {
  const auto found = frames_.find(tracks.header.stamp);
  if (found == frames_.end()) {
    return;
  }
  const Frame& frame = found->second;
  for (const TrackMessage& track : tracks.tracks) {
    if (!files_.kitti.empty()) {
      kitti_ += kittiLine(frame.number, track, frame.base_in_map);
    }
    if (!files_.mot.empty()) {
      mot_ += motLine(frame.number, track);
    }
  }
}

std::vector<NamedText> TextOutputs::files() const {
  std::vector<NamedText> wanted;
  for (const NamedText& each :
       {NamedText{files_.tum, tum_}, {files_.kitti, kitti_}, {files_.mot, mot_}}) {
    if (!each.file.empty()) {
      wanted.push_back(each);
    }
  }
  return wanted;
}

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#include "drive_summary.h"

#include <iomanip>
#include <ostream>
#include <string>

namespace datmo {

namespace {

/// Of the last stage; those of its sources have their own names below it.
constexpr char kTracks[] = "tracks";

constexpr int kNameWidth = 34;
constexpr int kValueWidth = 9;

std::ostream& line(std::ostream& out, const std::string& name) {
  return out << std::left << std::setw(kNameWidth) << name << std::right << std::setw(kValueWidth);
}

void printTimes(std::ostream& out, const StageTimes& times) {
  out << std::setprecision(3);
  line(out, "time per message") << "median" << std::setw(kValueWidth + 3) << "99 %\n";
  for (const StageTimes::Summary& stage : times.summaries()) {
    line(out, "  " + stage.stage) << 1e3 * stage.median << " ms" << std::setw(kValueWidth)
                                  << 1e3 * stage.percentile_99 << " ms\n";
  }
}

void printCounts(std::ostream& out, const std::string& what, const StageMonitor& monitor,
                 const std::map<std::string, std::uint64_t>& counts) {
  for (const auto& [reason, count] : counts) {
    line(out, what + " by " + monitor.stage() + ", " + reason) << count << '\n';
  }
}

void printRefusals(std::ostream& out, const InputRefusals& refusals) {
  for (const auto& [name, topic] : refusals.topics()) {
    for (const auto& [reason, refused] : topic.reasons) {
      line(out, "refused on " + name + ", " + reason)
          << refused.messages << " of " << topic.received << '\n';
    }
  }
}

}  // namespace

void DriveSummary::add(const Publication& publication) {
  fused_grids_ += publication.topic == "grids/fused" ? 1 : 0;
  fused_lists_ += publication.topic == "objects/fused" ? 1 : 0;
  if (const auto dropped = publication.as<DroppedObjects>()) {
    dropped_objects_ += dropped->objects.size();
  } else if (publication.topic == "pose") {
    addPose(*publication.as<geometry_msgs::PoseWithCovarianceStamped>());
  } else if (const auto tracks = publication.as<TrackArray>()) {
    addTracks(publication.topic, *tracks);
  }
}

void DriveSummary::addPose(const geometry_msgs::PoseWithCovarianceStamped& pose) {
  const Point2 position(pose.pose.pose.position.x, pose.pose.pose.position.y);
  distance_ += position_ ? (position - *position_).norm() : 0.0;
  position_ = position;
  ++scans_;
}

void DriveSummary::addTracks(const std::string& topic, const TrackArray& tracks) {
  if (topic != kTracks) {
    tracks_are_fused_ = true;
    ++source_track_lists_;
    return;
  }
  ++track_lists_;
  for (const TrackMessage& track : tracks.tracks) {
    track_ids_.insert(track.id);
  }
}

void printTable(std::ostream& out, const DriveSummary& drive, const GraphRunner& graph,
                const InputRefusals& refusals, const RunTime& time) {
  out << std::fixed << std::setprecision(1);
  line(out, "scans processed") << drive.scans() << '\n';
  if (drive.fusedGrids() > 0) {
    line(out, "grids fused") << drive.fusedGrids() << '\n';
  }
  if (drive.droppedObjects() > 0) {
    line(out, "objects left out at road borders") << drive.droppedObjects() << '\n';
  }
  if (drive.fusedLists() > 0) {
    line(out, "lists of objects fused") << drive.fusedLists() << '\n';
  }
  if (drive.fusedTrackLists() > 0) {
    line(out, "lists of tracks fused") << drive.fusedTrackLists() << '\n';
  }
  line(out, "distance driven") << drive.distance() << " m\n";
  line(out, "tracks confirmed") << drive.tracks() << '\n';
  line(out, "data") << time.data << " s\n";
  line(out, "took") << time.wall << " s\n";
  line(out, "speed") << time.data / time.wall << " x real time\n";
  printTimes(out, graph.times());
  printRefusals(out, refusals);
  for (const auto& [name, count] : graph.inputs().figures()) {
    line(out, name) << std::setprecision(0) << count << '\n';
  }
  for (const StageMonitor* monitor : graph.monitors()) {
    printCounts(out, "dropped", *monitor, monitor->drops());
    printCounts(out, "warned", *monitor, monitor->warnings());
  }
}

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#include "mutated_drive.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "message_kinds.h"
#include "processor_time.h"
#include <boost/make_shared.hpp>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>

#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo::campaign {

namespace {

constexpr double kStep = CampaignSensors::kStep;
constexpr int kMutatedSteps = 40;  // 2.5 s
constexpr int kCleanSteps = 48;    // longer than a map that starts over needs for its tracks
constexpr double kInPlace = 0.1;   // probability for each message; two or three a step
constexpr int kCopies = 24;        // mutated copies of earlier messages, after each step
constexpr const char* kClock = "clock_answer";

/// Reasons to drop a message before anything else in it is checked.
constexpr std::array<const char*, 5> kStampReasons{"zero_stamp", "stamp_out_of_range",
                                                   "repeated_stamp", "old_stamp", "stray_stamp"};

/// Returns whether a publication holds anything that must not be published.
template <typename... Messages>
std::string faultOf(const Publication& publication) {
  std::string fault;
  const auto check = [&](const auto& message) {
    if (message) {
      fault = contentFault(*message);
    }
  };
  (check(publication.as<Messages>()), ...);
  return fault;
}

}  // namespace

MutatedDrive::MutatedDrive(const std::string& config, unsigned seed, double max_seconds,
                           Tally& tally)
    : random_(seed),
      graph_(campaignGraphs()[seed % campaignGraphs().size()]),
      runner_(sensorsOf(config, graph_), graph_.switches),
      sensors_(graph_),
      clocks_(PartClocksOptions()),
      max_seconds_(max_seconds),
      tally_(tally) {
  runner_.changeInputs([this](const Publication& message) { return givenFor(message); });
}

std::vector<std::string> MutatedDrive::run() {
  for (int index = 0; index < kMutatedSteps + kCleanSteps; ++index) {
    step(index, index < kMutatedSteps);
  }
  step_ = "at the end";
  last_ = "nothing more";
  if (last_tracks_ < kStep * (kMutatedSteps + kCleanSteps / 2)) {
    note("no tracks again after " + std::to_string(kCleanSteps * kStep) + " s without mutations");
  }
  bookRefused();
  return std::move(faults_);
}

void MutatedDrive::step(int index, bool mutates) {
  step_ = "step " + std::to_string(index);
  now_ = Stamp::fromSeconds(World::kStart + kStep * index + 0.01);
  mutates_ = mutates;
  for (const Publication& message : sensors_.at(index)) {
    last_ = message.topic;
    ++tally_.messages;
    deliver(message, tally_.mutated);
  }
  askClock();
  if (mutates) {
    sendCopies();
  }
}

bool MutatedDrive::isTurn(double probability) {
  return std::uniform_real_distribution<double>()(random_) < probability;
}

AnyMessage MutatedDrive::givenFor(const Publication& message) {
  if (!mutates_) {
    return message.message;
  }
  samples_[message.topic] = {now_, message};
  return isTurn(kInPlace) ? mutatedOf(message, ros::Duration()) : message.message;
}

AnyMessage MutatedDrive::mutatedOf(const Publication& message, ros::Duration shift) {
  const auto kind = messageKinds().find(message.data_type);
  if (kind == messageKinds().end()) {
    note("nothing mutates a " + message.data_type);
    return message.message;
  }
  last_ = "mutated " + message.topic;
  ++tally_.mutated;
  ++tally_.mutated_on[message.topic];
  ++tally_.mutated_type[message.data_type];
  return kind->second.mutated(kind->second.shifted(message.message, shift), random_);
}

/// Sends mutated copies of earlier messages, with stamps between this step and the next one.
void MutatedDrive::sendCopies() {
  mutates_ = false;  // what follows from them is not mutated again
  const Stamp begin = now_;
  for (int i = 1; i <= kCopies; ++i) {
    now_ = begin + kStep * i / (kCopies + 1);
    auto sample = samples_.begin();
    std::advance(sample, static_cast<std::ptrdiff_t>(random_() % samples_.size()));
    const auto& [at, original] = sample->second;
    const std::uint64_t mutated_before = tally_.mutated;
    Publication copy = original;
    copy.message = mutatedOf(original, ros::Duration(secondsBetween(at, now_)));
    deliver(copy, mutated_before);
  }
}

/// Sends the clock answer of a part of the stack, which is no stage's input.
void MutatedDrive::askClock() {
  PartClock answer;
  answer.process = "/perception_manager";
  answer.asked = toTime(now_ + -0.002);
  answer.answered = toTime(now_ + -0.001);
  deliver(
      {kClock, ros::message_traits::datatype<PartClock>(), boost::make_shared<PartClock>(answer)},
      tally_.mutated);
}

void MutatedDrive::deliver(const Publication& message, std::uint64_t mutated_before) {
  const double begin = processorSeconds();
  try {
    if (message.topic == kClock) {
      clocks_.addAnswer(*boost::static_pointer_cast<const PartClock>(givenFor(message)), now_);
      clocks_.judged({}, now_);
      clocks_.descriptions(now_);
    } else {
      // The runner passes all others through givenFor() itself.
      const bool is_transforms = message.as<tf2_msgs::TFMessage>() != nullptr;
      take(handleAny(
          {message.topic, message.data_type, is_transforms ? givenFor(message) : message.message},
          now_, runner_));
    }
  } catch (const std::exception& error) {
    note(std::string("an exception left the graph: ") + error.what());
  }
  finish(processorSeconds() - begin, mutated_before);
}

void MutatedDrive::finish(double seconds, std::uint64_t mutated_before) {
  if (seconds > tally_.slowest) {
    tally_.slowest = seconds;
    tally_.slowest_on = graph_.name + ", " + last_;
  }
  if (seconds > max_seconds_) {
    note("took " + std::to_string(seconds) + " s of a processor, expected at most " +
         std::to_string(max_seconds_) + " s");
  }
  findFaults();
  // Several stages may each drop the same message: no more were stopped than were mutated.
  const std::uint64_t drops = stampDrops();
  tally_.stopped_by_stamp += std::min(drops - stamp_drops_, tally_.mutated - mutated_before);
  stamp_drops_ = drops;
}

std::uint64_t MutatedDrive::stampDrops() const {
  std::uint64_t drops = 0;
  for (const StageMonitor* monitor : runner_.monitors()) {
    for (const char* const reason : kStampReasons) {
      const auto found = monitor->drops().find(reason);
      drops += found == monitor->drops().end() ? 0 : found->second;
    }
  }
  return drops;
}

void MutatedDrive::take(const Publications& published) {
  for (const Publication& publication : published) {
    const std::string fault =
        faultOf<nav_msgs::Odometry, tf2_msgs::TFMessage, geometry_msgs::PoseWithCovarianceStamped,
                LabeledScanMessage, RoadBorders, ObjectArray, DroppedObjects, TrackArray,
                StereoAlignmentMessage, RiskArray, EarthFrameMessage, StationTracksMessage,
                nav_msgs::OccupancyGrid, nav_msgs::Path, sensor_msgs::LaserScan>(publication);
    if (!fault.empty()) {
      note("published on " + publication.topic + " " + fault);
    }
    if (const auto tracks = publication.as<TrackArray>()) {
      if (publication.topic == "tracks") {
        last_tracks_ = tracks->header.stamp.toSec() - World::kStart;
      }
    }
  }
}

/// Notes defects of the code since the last call.
void MutatedDrive::findFaults() {
  for (const StageMonitor* monitor : runner_.monitors()) {
    for (const char* const reason : kDefectReasons) {
      const auto found = monitor->drops().find(reason);
      if (found != monitor->drops().end() && found->second > unexpected_[monitor][reason]) {
        unexpected_[monitor][reason] = found->second;
        note(monitor->stage() + ": " + reason + ": " + monitor->lastDrop());
      }
    }
  }
}

void MutatedDrive::bookRefused() {
  for (const StageMonitor* monitor : runner_.monitors()) {
    for (const auto* counts : {&monitor->drops(), &monitor->warnings()}) {
      for (const auto& [reason, count] : *counts) {
        tally_.refused[reason] += count;
      }
    }
  }
}

void MutatedDrive::note(const std::string& what) {
  faults_.push_back(graph_.name + ", " + step_ + ", " + last_ + ": " + what);
}

}  // namespace datmo::campaign

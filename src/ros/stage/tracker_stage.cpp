// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/tracker_stage.h"

#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/descriptions.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/visibility/joint_visibility.h"

namespace datmo {

namespace {

/// Three seconds of a fast scanner: longer than waiting for any transform is useful.
constexpr std::size_t kMaxWaiting = 50;

}  // namespace

void TrackerStageOptions::visit(OptionVisitor& visitor) {
  visitor.number({"transform_wait", "s", "longest time that objects wait for their transform"},
                 transform_wait, {0.0, 5.0});
  visitor.toggle({"scan_view", "",
                  "the objects come from the scanner of labeled_scan, alone or with other sensors: "
                  "its field of view says where they could have been detected; false: from other "
                  "sensors only, and the labeled scan gives only the vehicle's pose"},
                 scan_view);
  visitor.group("input", [&] { input.visit(visitor); });
  tracker.visit(visitor);
}

TrackerStage::TrackerStage(const Checked<TrackerStageOptions>& options,
                           const TransformBuffer& transforms, StageMonitor& monitor,
                           StepClock clock)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      tracker_(options->tracker, std::move(clock)),
      runner_(monitor, options->input, "forgets all tracks", [this] { reset(); }),
      scan_views_(options->tracker.visibility) {}

void TrackerStage::handleLabeledScan(const LabeledScanMessage& message) {
  runner_.serve([&] {
    const LabeledScan scan = fromMessage(message);
    runner_.check("labeled_scan", message.header.stamp);
    scan_views_.add(message, scan);
    if (options_.scan_view && message.map_frame == options_.frames.map) {
      tracker_.addScan(scan);
    }
  });
}

void TrackerStage::handleClasses(const ObjectArray& message) {
  runner_.serve([&] {
    if (message.header.frame_id != options_.frames.base) {
      throw InputError("wrong_frame", "classes of objects in '" + message.header.frame_id +
                                          "': expected '" + options_.frames.base + "'");
    }
    runner_.check("classes", message.header.stamp);
    const TrackerCounts before = tracker_.counts();
    tracker_.addClasses(fromMessage(message));
    report(before, tracker_.counts());
  });
}

void TrackerStage::enqueue(const Waiting& waiting) {
  runner_.serve([&] {
    runner_.check(waiting.early ? "early_objects" : "objects", waiting.objects->header.stamp);
    if (queue_.size() >= kMaxWaiting) {
      queue_.pop_front();
      monitor_.dropped(InputError("queue_full", "more than " + std::to_string(kMaxWaiting) +
                                                    " messages wait for a transform: dropped the "
                                                    "oldest"));
    }
    queue_.push_back(waiting);
  });
}

TrackArrayPtr TrackerStage::next(Stamp now) {
  while (!queue_.empty()) {
    const Waiting waiting = queue_.front();
    if (!hasWaitedTooLong(waiting, now) && !knowsPose(waiting.objects->header)) {
      return nullptr;
    }
    queue_.pop_front();
    const auto tracks = runner_.serve([&] { return track(waiting); });
    if (tracks) {
      return tracks;
    }
  }
  return nullptr;
}

Pose2 TrackerStage::baseInFixed(const std_msgs::Header& base) const {
  if (const auto pose = scan_views_.pose(base, options_.frames.map)) {
    return *pose;
  }
  return planarPose(transforms_.core(), options_.frames.map, base.frame_id, base.stamp);
}

bool TrackerStage::knowsPose(const std_msgs::Header& base) const {
  try {
    baseInFixed(base);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TrackArrayPtr TrackerStage::track(const Waiting& waiting) {
  const Stopwatch watch;
  const std_msgs::Header& header = waiting.objects->header;
  const Stamp stamp = toStamp(header.stamp);
  const bool published = published_ && stamp <= *published_;
  if (waiting.early && published) {
    return nullptr;
  }
  const Pose2 base_in_fixed = baseInFixed(header);
  const ObjectList list = fromMessage(*waiting.objects);
  const Visibility* scan = options_.scan_view ? scan_views_.visibility(header) : nullptr;
  const TrackerInput input{list, base_in_fixed,
                           jointVisibility(scan, list, options_.tracker.visibility)};
  const TrackerCounts before = tracker_.counts();
  const TrackList tracks = waiting.early ? tracker_.processEarly(input) : tracker_.process(input);
  report(before, tracker_.counts());
  if (published) {
    unpublished_seconds_ += watch.seconds();
    return nullptr;
  }
  published_ = stamp;
  TrackArrayPtr message = messageOf(tracks);
  monitor_.processed({stamp, std::exchange(unpublished_seconds_, 0.0) + watch.seconds()});
  return message;
}

TrackArrayPtr TrackerStage::messageOf(const TrackList& list) {
  auto tracks = boost::make_shared<TrackArray>(toMessage(list, options_.frames.map));
  if (!tracks->tracks.empty()) {
    monitor_.announce("track",
                      "first track: " + descriptionOf(tracks->tracks.front(), options_.frames.map));
  }
  return tracks;
}

void TrackerStage::report(const TrackerCounts& before, const TrackerCounts& after) {
  if (after.intake.rejected > before.intake.rejected ||
      after.classes.rejected > before.classes.rejected) {
    monitor_.warned(InputError("bad_object",
                               "objects with numbers that are not finite or out of range, or a "
                               "covariance that is not positive definite: left out"));
  }
  if (after.intake.refused > before.intake.refused) {
    monitor_.warned(InputError("many_objects",
                               "more objects than intake/max_objects: the farthest are left out"));
  }
  if (after.association.refused_births > before.association.refused_births) {
    monitor_.warned(
        InputError("many_targets", "more targets than gating/max_targets: new objects wait"));
  }
  if (after.association.best_only_steps > before.association.best_only_steps) {
    monitor_.warned(InputError(
        "time_budget",
        "a step took longer than time_budget: continued with only the most likely hypothesis"));
  }
  monitor_.figure("classes without a target", static_cast<double>(after.classes.without_target));
  monitor_.figure("hypotheses cut", static_cast<double>(after.association.cut_hypotheses));
  monitor_.figure("steps beyond the time budget",
                  static_cast<double>(after.association.best_only_steps));
}

bool TrackerStage::hasWaitedTooLong(const Waiting& waiting, Stamp now) const {
  const double waited = secondsBetween(waiting.since, now);
  return waited > options_.transform_wait || waited < 0.0;
}

void TrackerStage::reset() {
  tracker_.reset();
  queue_.clear();
  published_.reset();
  scan_views_.clear();
}

void TrackerStage::change(const OptionValues& values) {
  const auto changed = withLiveValues(options_, values);
  tracker_.setOptions(changed.tracker);
  options_ = changed;
}

void TrackerStage::connect(StagePorts& ports) {
  tracks_ = ports.out<TrackArray>("tracks");
  ports.optionalIn<LabeledScanMessage>(
      "labeled_scan", [this](const auto& scan, Stamp /*now*/) { handleLabeledScan(*scan); });
  ports.in<ObjectArray>("objects",
                        [this](const auto& objects, Stamp now) { handleObjects(objects, now); });
  if (!options_.scan_view) {
    return;  // early lists and classes are those of a scan's objects
  }
  ports.optionalIn<ObjectArray>(
      "objects/classes", [this](const auto& classes, Stamp /*now*/) { handleClasses(*classes); });
  ports.optionalIn<ObjectArray>("early_objects", [this](const auto& objects, Stamp now) {
    handleEarlyObjects(objects, now);
  });
}

bool TrackerStage::publishNext(Stamp now) {
  const TrackArrayPtr tracks = next(now);
  tracks_.publish(tracks);
  return tracks != nullptr;
}

}  // namespace datmo

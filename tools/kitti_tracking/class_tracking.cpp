// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/class_tracking.h"

namespace datmo::kitti {

namespace {

/// Minimum existence probability of the tracks from which the vehicle's motion is estimated.
constexpr double kSureOfTrack = 0.8;

/// As in the labels: an object that is not detected may be hidden.
constexpr int kUnknownOcclusion = 3;

}  // namespace

void ClassTrackingOptions::visit(OptionVisitor& visitor) {
  visitor.group("detections", [&] { detections.visit(visitor); });
  visitor.group("tracker", [&] { tracker.visit(visitor); });
  visitor.group("vertical", [&] { vertical.visit(visitor); });
  visitor.number({"prior_log_odds", "1", "mean log odds of the detections of false tracks"},
                 prior_log_odds, {-100.0, 100.0});
  visitor.number(
      {"prior_weight", "1",
       "weight of prior_log_odds in the score of a track, as a number of its detections"},
      prior_weight, {0.0, 1000.0});
}

ClassTracking::ClassTracking(ObjectType type, const ClassTrackingOptions& options,
                             const CameraMount& mount)
    : type_(type),
      options_(options),
      mount_(mount),
      model_(options.detections),
      tracker_(options.tracker) {
  checkOptions(options);
}

ObjectList ClassTracking::objects(const std::vector<Detection>& detections, Stamp stamp) const {
  ObjectList list{stamp, {}, {}};
  for (const Detection& detection : detections) {
    list.objects.push_back(model_.object(detection, mount_));
  }
  return list;
}

void ClassTracking::track(const ObjectList& objects, const Pose2& base_in_fixed,
                          const std::vector<Box2>& seen) {
  const Visibility visibility(model_.view(mount_), seen, options_.tracker.visibility);
  tracks_ = tracker_.process(objects, base_in_fixed, visibility);
  base_in_fixed_ = base_in_fixed;
}

std::vector<Landmark> ClassTracking::landmarks() const {
  std::vector<Landmark> landmarks;
  for (const Track& track : tracks_.tracks) {
    if (track.existence_probability < kSureOfTrack || track.objects.empty()) {
      continue;
    }
    landmarks.push_back({track.state.head<2>(), track.covariance.topLeftCorner<2, 2>()});
  }
  return landmarks;
}

std::vector<TrackedObject> ClassTracking::rows(const ObjectList& objects,
                                               const std::vector<Detection>& detections,
                                               int frame) {
  std::vector<TrackedObject> rows;
  for (const Track& track : tracks_.tracks) {
    const Memory* memory = remember(track, objects, detections);
    if (memory == nullptr) {
      continue;
    }
    // An object that is no longer detected at the edge of the image has left it.
    const TrackedObject row = rowOf(track, *memory, frame);
    if (!track.objects.empty() || mount_.isWithinImage(row.image_box)) {
      rows.push_back(row);
    }
  }
  return rows;
}

const ClassTracking::Memory* ClassTracking::remember(const Track& track, const ObjectList& objects,
                                                     const std::vector<Detection>& detections) {
  auto found = memories_.find(track.id);
  if (track.objects.empty()) {
    return found == memories_.end() ? nullptr : &found->second;
  }
  const std::size_t measurement_index = track.objects.front();
  const Box3& box = detections.at(measurement_index).box;
  if (found == memories_.end()) {
    const VerticalExtent vertical(box.y, box.height, options_.vertical);
    found = memories_.emplace(track.id, Memory{vertical, tracks_.stamp, 0.0, 0}).first;
  } else {
    VerticalExtent& vertical = found->second.vertical;
    vertical.predict(secondsBetween(found->second.stamp, tracks_.stamp), options_.vertical);
    vertical.update(box.y, box.height, options_.vertical);
    found->second.stamp = tracks_.stamp;
  }
  found->second.log_odds += objects.objects.at(measurement_index).log_odds;
  ++found->second.detections;
  return &found->second;
}

double ClassTracking::scoreOf(const Memory& memory) const {
  return (memory.log_odds + options_.prior_weight * options_.prior_log_odds) /
         (memory.detections + options_.prior_weight);
}

TrackedObject ClassTracking::rowOf(const Track& track, const Memory& memory, int frame) const {
  const Pose2 center = base_in_fixed_.inverse() * track.box.center;
  TrackedObject row;
  row.frame = frame;
  row.id = static_cast<int>(track.id);
  row.type = type_;
  row.occluded = track.objects.empty() ? kUnknownOcclusion : 0;
  row.box = mount_.standing({center, track.box.length, track.box.width}, memory.vertical.bottom(),
                            memory.vertical.height());
  row.image_box = mount_.inImage(row.box);
  row.alpha = CameraMount::alpha(row.box);
  row.score = scoreOf(memory);
  return row;
}

}  // namespace datmo::kitti

// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/score_options.h"

#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo::evaluation {

namespace {

/// No sensor of a car sees farther.
constexpr double kMaxRange = 500.0;  // m

}  // namespace

void TopicOptions::visit(OptionVisitor& visitor) {
  visitor.text({"tracks", "", "TrackArray, the tracks to score"}, tracks, {});
  visitor.text({"pose", "", "PoseWithCovarianceStamped, estimated pose of the vehicle"}, pose, {});
  visitor.text({"objects", "",
                "ObjectArray of one measurement, optional (thesis table 3.4); empty: the tracker's "
                "input, /objects/fused if the run has it, else /objects"},
               objects, {});
  visitor.text({"road_borders", "", "RoadBorders, optional (thesis table 3.5)"}, road_borders, {});
  visitor.text({"timing", "", "StageTiming, optional"}, timing, {});
  visitor.text({"scan", "", "LaserScan, for --attainable"}, scan, {});
  visitor.text({"echoes", "", "MultiEchoLaserScan, the same if there is no scan"}, echoes, {});
  visitor.text({"true_objects", "", "TrueObjectArray"}, true_objects, {});
  visitor.text({"true_pose", "", "Odometry, true pose of the vehicle"}, true_pose, {});
  visitor.text({"true_road_borders", "", "TrueRoadBorders, optional"}, true_road_borders, {});
}

void RegionOptions::visit(OptionVisitor& visitor) {
  visitor.number({"range", "m",
                  "range around the true vehicle in which true objects have to be found and tracks "
                  "count as false (thesis 1.3.3: the scanner sees a car up to about 50 m)"},
                 range, {1.0, kMaxRange});
  visitor.number({"half_angle", "rad",
                  "the same as an angle to either side of straight ahead; less if the truth covers "
                  "only a sector, as KITTI's labels: 0.7"},
                 half_angle, {0.01, kPi});
}

void ClassOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"unknown", "", "objects of no known class have to be found"}, unknown);
  visitor.toggle({"pedestrian", "", "pedestrians have to be found"}, pedestrian);
  visitor.toggle({"cyclist", "", "cyclists have to be found"}, cyclist);
  visitor.toggle({"vehicle", "", "vehicles have to be found"}, vehicle);
}

void TruthOptions::visit(OptionVisitor& visitor) {
  visitor.group("classes", [&] { classes.visit(visitor); });
  visitor.text({"visible_to", "",
                "sensor that the object must be visible to, e.g. scanner; any: at least one; none: "
                "objects that no sensor sees also have to be found"},
               visible_to, {});
  visitor.integer({"min_beams", "1", "minimum number of the scan's beams that end on the object"},
                  min_beams, {0.0, 10000.0});
  visitor.number(
      {"min_speed", "m/s", "minimum speed of the object, which must also be moving in the truth"},
      min_speed, {0.0, kMaxSpeed});
  visitor.number({"min_time_seen", "s",
                  "total time for which the object meets the other conditions: one seen for less "
                  "need not be found, since no tracker can confirm it before it is gone"},
                 min_time_seen, {0.0, 3600.0});
}

void ScoreOptions::visit(OptionVisitor& visitor) {
  visitor.group("topics", [&] { topics.visit(visitor); });
  visitor.choice(
      {"align", "",
       "how tracks are aligned with the truth; pose_at_stamp: by the vehicle's estimated and true "
       "pose at each stamp, so that the drift of the map is scored with the pose and not with the "
       "tracks; first_pose: by the two first poses; none: the run's map is the truth's"},
      align,
      {{"pose_at_stamp", TrackAlignment::kPoseAtStamp},
       {"first_pose", TrackAlignment::kFirstPose},
       {"none", TrackAlignment::kNone}});
  visitor.group("region", [&] { region.visit(visitor); });
  visitor.group("truth", [&] { truth.visit(visitor); });
  visitor.toggle({"moving_tracks_only", "",
                  "tracks published as stationary do not count, neither as found nor as false"},
                 moving_tracks_only);
  visitor.number(
      {"near_range", "m",
       "track errors are also given for the objects within this range of the true vehicle"},
      near_range, {1.0, kMaxRange});
  metrics.visit(visitor);
  visitor.group("attainable", [&] { attainable.visit(visitor); });
  visitor.number({"max_gap", "s",
                  "nothing is interpolated or scored in a longer gap of the truth or of the poses"},
                 max_gap, {0.001, 10.0});
  visitor.number({"max_silence", "s",
                  "a stamp of the truth farther from any tracks counts as one without tracks, so "
                  "that silence is not rewarded"},
                 max_silence, {0.001, 10.0});
  visitor.number({"detection_gap", "s",
                  "a false moving object that reappears at the same position within this time is "
                  "the same one"},
                 detection_gap, {0.001, 60.0});
  visitor.number(
      {"intersection_merge_gap", "s", "two intersections with less time between them are merged"},
      intersection_merge_gap, {0.0, 60.0});
}

}  // namespace datmo::evaluation

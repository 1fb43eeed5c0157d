// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/score_options.h"

#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo::evaluation {

namespace {

/// No sensor of a car sees farther.
constexpr double kMaxRange = 500.0;  // m

}  // namespace

void TopicOptions::visit(OptionVisitor& visitor) {
  visitor.text({"tracks", "", "TrackArray, what is scored"}, tracks, {});
  visitor.text({"pose", "", "PoseWithCovarianceStamped, estimated pose of the vehicle"}, pose, {});
  visitor.text({"objects", "",
                "ObjectArray of one measurement, optional (thesis table 3.4); empty: what the "
                "tracker takes, /objects/fused if the run has it, else /objects"},
               objects, {});
  visitor.text({"road_borders", "", "RoadBorders, optional (thesis table 3.5)"}, road_borders, {});
  visitor.text({"timing", "", "StageTiming, optional"}, timing, {});
  visitor.text({"scan", "", "LaserScan, for --attainable"}, scan, {});
  visitor.text({"echoes", "", "MultiEchoLaserScan, the same where there is no scan"}, echoes, {});
  visitor.text({"true_objects", "", "TrueObjectArray"}, true_objects, {});
  visitor.text({"true_pose", "", "Odometry, true pose of the vehicle"}, true_pose, {});
  visitor.text({"true_road_borders", "", "TrueRoadBorders, optional"}, true_road_borders, {});
}

void RegionOptions::visit(OptionVisitor& visitor) {
  visitor.number({"range", "m",
                  "true objects within it of the true vehicle have to be found, and tracks count "
                  "as false (thesis 1.3.3: the scanner sees a car up to about 50 m)"},
                 range, {1.0, kMaxRange});
  visitor.number({"half_angle", "rad",
                  "the same to either side of straight ahead; less where the truth knows one side "
                  "only, as KITTI's labels, 0.7"},
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
                "sensor that the object must be visible to, e.g. scanner; any: one at least; "
                "none: also what no sensor sees has to be found"},
               visible_to, {});
  visitor.integer({"min_beams", "1", "of the scan that end on the object"}, min_beams,
                  {0.0, 10000.0});
  visitor.number({"min_speed", "m/s", "of the object, besides that the truth says it moves"},
                 min_speed, {0.0, kMaxSpeed});
  visitor.number({"min_time_seen", "s",
                  "in all, that the object meets the other conditions: who is seen for less need "
                  "not be found, since no tracker can confirm it before it is gone"},
                 min_time_seen, {0.0, 3600.0});
}

void ScoreOptions::visit(OptionVisitor& visitor) {
  visitor.group("topics", [&] { topics.visit(visitor); });
  visitor.choice(
      {"align", "",
       "how tracks are laid on the truth; pose_at_stamp: the estimated pose of the "
       "vehicle on its true one at each stamp, so that the drift of the map is scored "
       "with the pose and not with the tracks; first_pose: the maps on each other at the "
       "first pose; none: the run's map is the truth's"},
      align,
      {{"pose_at_stamp", TrackAlignment::kPoseAtStamp},
       {"first_pose", TrackAlignment::kFirstPose},
       {"none", TrackAlignment::kNone}});
  visitor.group("region", [&] { region.visit(visitor); });
  visitor.group("truth", [&] { truth.visit(visitor); });
  visitor.toggle({"moving_tracks_only", "",
                  "tracks that are published as standing do not count: neither found nor false"},
                 moving_tracks_only);
  visitor.number({"near_range", "m",
                  "errors of tracks are also given of the objects within it of the true vehicle"},
                 near_range, {1.0, kMaxRange});
  metrics.visit(visitor);
  visitor.group("attainable", [&] { attainable.visit(visitor); });
  visitor.number({"max_gap", "s",
                  "nothing is interpolated or scored in a gap of the truth or of the poses that is "
                  "longer"},
                 max_gap, {0.001, 10.0});
  visitor.number({"max_silence", "s",
                  "a stamp of the truth further from any tracks counts as one without tracks, so "
                  "so that silence is not rewarded"},
                 max_silence, {0.001, 10.0});
  visitor.number(
      {"detection_gap", "s",
       "a false moving object that comes back at the same position within it is the same "
       "one"},
      detection_gap, {0.001, 60.0});
  visitor.number(
      {"intersection_merge_gap", "s", "two intersections with less time between them are one"},
      intersection_merge_gap, {0.0, 60.0});
}

}  // namespace datmo::evaluation

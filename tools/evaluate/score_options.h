// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluate/attainable_options.h"
#include "evaluate/track_scores.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/options.h"

namespace datmo::evaluation {

/// Names of the topics in the bags.
struct TopicOptions {
  std::string tracks = "/tracks";
  std::string pose = "/pose";
  std::string objects;
  std::string road_borders = "/road_borders";
  std::string timing = "/timing";
  std::string scan = "/scan";
  std::string echoes = "/echoes";
  std::string true_objects = "/ground_truth/objects";
  std::string true_pose = "/ground_truth/pose";
  std::string true_road_borders = "/ground_truth/road_borders";

  void visit(OptionVisitor& visitor);
};

/// The region that is scored, relative to the true vehicle (base_link).
struct RegionOptions {
  double range = 50.0;      ///< m
  double half_angle = kPi;  ///< rad, to either side of straight ahead

  void visit(OptionVisitor& visitor);
};

/// Classes that have to be found.
struct ClassOptions {
  bool unknown = true;
  bool pedestrian = true;
  bool cyclist = true;
  bool vehicle = true;

  void visit(OptionVisitor& visitor);
};

/// Which true objects have to be found, of those that move at the stamp and are in the region.
struct TruthOptions {
  ClassOptions classes;
  std::string visible_to = "any";  ///< sensor; "any": at least one; "none": not required
  int min_beams = 0;
  double min_speed = 0.0;      ///< m/s
  double min_time_seen = 1.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// How tracks are aligned with the truth.
enum class TrackAlignment {
  kPoseAtStamp,  ///< as the vehicle sees them: its estimated pose on its true one at each stamp
  kFirstPose,    ///< map on map, once
  kNone,         ///< they are in the map of the truth
};

/// What is scored, and how the two recordings are combined; unit, range and source of each option
/// in visit().
struct ScoreOptions {
  TopicOptions topics;
  TrackAlignment align = TrackAlignment::kPoseAtStamp;
  RegionOptions region;
  TruthOptions truth;
  bool moving_tracks_only = true;
  double near_range = 20.0;  ///< m
  TrackScoreOptions metrics;
  AttainableOptions attainable;
  double max_gap = 0.5;                 ///< s
  double max_silence = 0.2;             ///< s
  double detection_gap = 0.5;           ///< s
  double intersection_merge_gap = 1.0;  ///< s

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo::evaluation

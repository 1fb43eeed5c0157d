// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/track/track_association.h"
#include "datmo_fusion/fusion/track/track_combination.h"
#include "datmo_fusion/fusion/track/track_prediction.h"
#include "datmo_fusion/tracking/class_by_speed.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// That a source has a track of a road user of one class that moves and that it could see lately:
/// near / (1 + exp((range - half_range) / 4 m)). The smaller one is and the farther, the fewer
/// beams or pixels it has, and the later its motion shows.
struct ClassDetectionOptions {
  double near = 0.6;         ///< 1, at range 0
  double half_range = 30.0;  ///< m, at which it has fallen to half of that

  void visit(OptionVisitor& visitor);

  /// At a range, m.
  double probability(double range) const;
};

/// The same of all classes. The defaults are for a source that was not calibrated: that it has no
/// track of a person counts little. calibrate_track_sources measures them.
struct TrackDetectionOptions {
  ClassDetectionOptions pedestrian{0.3, 25.0};
  ClassDetectionOptions cyclist{0.6, 30.0};
  ClassDetectionOptions vehicle{0.9, 40.0};

  void visit(OptionVisitor& visitor);

  /// Of what is of each class with its probability, at a range (m) from the sensor; what has no
  /// class here, or none, is as likely each of these.
  double probability(const ClassProbabilities& classes, double range) const;
};

/// Of a source's tracks, the share that are of what moves, by the class that they claim: what is
/// taken for a person seldom is anything else, a corner of a wall that is passed looks like a car.
struct TrueShareOptions {
  double pedestrian = 0.9;  ///< 1
  double cyclist = 0.9;     ///< 1
  double vehicle = 0.9;     ///< 1
  double other = 0.9;       ///< 1, of no class, or of one that does not move

  void visit(OptionVisitor& visitor);

  /// Of what is of each class with its probability.
  double of(const ClassProbabilities& classes) const;
};

/// One source of tracks.
struct TrackSourceOptions {
  bool use = true;
  TrackDetectionOptions detection;
  TrueShareOptions true_share;
  double false_agreement_probability = 0.1;  ///< 1
  bool class_by_speed = false;

  void visit(OptionVisitor& visitor);
};

/// Which tracks are published (thesis 3.4.2).
enum class TrackScheme { kByExistence, kFusedPlusFallback, kConfirmedByAll, kUnion };

struct TrackFuserOptions {
  std::map<std::string, TrackSourceOptions> sources;  ///< by name; at first lidar and stereo
  TrackScheme scheme = TrackScheme::kByExistence;
  std::string beyond = "lidar";  ///< name of a source
  int max_tracks = 200;
  double misses = 0.75;               ///< 1
  double published_existence = 0.85;  ///< 1
  double memory = 1.5;                ///< s
  double history_time = 3.0;          ///< s
  ClassBySpeedOptions class_by_speed;
  TrackPredictionOptions prediction;
  TrackAssociationOptions association;
  TrackCombinationOptions combination;
  VisibilityOptions visibility;

  TrackFuserOptions();

  void visit(OptionVisitor& visitor);

  /// Throws OptionError where `beyond` is none of the sources in use.
  void check() const;

  /// Names of the sources that are in use.
  std::vector<std::string> sourcesInUse() const;
};

}  // namespace datmo

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

/// Probability that a source tracks a moving road user of one class that it could see lately: near
/// / (1 + exp((range - half_range) / 4 m)). The smaller and the farther the road user is, the fewer
/// beams or pixels it has, and the later its motion is observable.
struct ClassDetectionOptions {
  double near = 0.6;         ///< 1, at range 0
  double half_range = 30.0;  ///< m, at which it has dropped to half of that

  void visit(OptionVisitor& visitor);

  /// At this range, m.
  double probability(double range) const;
};

/// The same for all classes. The defaults are for an uncalibrated source: a missing track of a
/// person has little weight. `evaluate calibrate_track_sources` measures them.
struct TrackDetectionOptions {
  ClassDetectionOptions pedestrian{0.3, 25.0};
  ClassDetectionOptions cyclist{0.6, 30.0};
  ClassDetectionOptions vehicle{0.9, 40.0};

  void visit(OptionVisitor& visitor);

  /// Returns the probability for an object with these class probabilities, at a range (m) from the
  /// sensor; probability of no class or of another class is spread evenly over these.
  double probability(const ClassProbabilities& classes, double range) const;
};

/// Share of a source's tracks that are real movers, by claimed class: a track classified as a
/// person is rarely anything else, but a corner of a wall that is passed looks like a car.
struct TrueShareOptions {
  double pedestrian = 0.9;  ///< 1
  double cyclist = 0.9;     ///< 1
  double vehicle = 0.9;     ///< 1
  double other = 0.9;       ///< 1, without class, or of a static class

  void visit(OptionVisitor& visitor);

  /// Returns the share for these class probabilities.
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

  /// Throws OptionError if `beyond` is not one of the sources in use.
  void check() const;

  /// Names of the sources that are in use.
  std::vector<std::string> sourcesInUse() const;
};

}  // namespace datmo

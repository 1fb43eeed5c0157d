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
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// That a source has a track of what moves and it could see for a second, by class: it tells most
/// road users of few beams or pixels later.
struct TrackDetectionOptions {
  double pedestrian = 0.3;  ///< 1
  double cyclist = 0.6;     ///< 1
  double vehicle = 0.9;     ///< 1

  void visit(OptionVisitor& visitor);

  /// Of what is of each class with its probability; what has no class here, or none, is as likely
  /// each of these.
  double probability(const ClassProbabilities& classes) const;
};

/// One source of tracks.
struct TrackSourceOptions {
  bool use = true;
  TrackDetectionOptions detection;
  double true_share = 0.9;                   ///< 1
  double false_agreement_probability = 0.1;  ///< 1

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

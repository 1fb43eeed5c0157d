// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/track/track_association.h"
#include "datmo_fusion/fusion/track/track_combination.h"
#include "datmo_fusion/fusion/track/track_prediction.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// One source of tracks.
struct TrackSourceOptions {
  bool use = true;
  bool alone = false;
  double detection_probability = 0.8;        ///< 1
  double false_agreement_probability = 0.1;  ///< 1

  void visit(OptionVisitor& visitor);
};

/// Which tracks are published (thesis 3.4.2).
enum class TrackScheme { kFusedPlusFallback, kConfirmedByAll, kUnion };

struct TrackFuserOptions {
  std::map<std::string, TrackSourceOptions> sources;  ///< by name; at first lidar and stereo
  TrackScheme scheme = TrackScheme::kFusedPlusFallback;
  std::string beyond = "lidar";  ///< name of a source
  int max_tracks = 200;
  double misses = 0.75;              ///< 1
  double published_existence = 0.5;  ///< 1
  double memory = 1.5;               ///< s
  double history_time = 3.0;         ///< s
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

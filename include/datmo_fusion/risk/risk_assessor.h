// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/track/track_prediction.h"
#include "datmo_fusion/risk/host_futures.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/risk/object_futures.h"
#include "datmo_fusion/risk/random_draws.h"
#include "datmo_fusion/risk/risk.h"
#include "datmo_fusion/risk/rule_methods.h"
#include "datmo_fusion/risk/standing_points.h"
#include "datmo_fusion/risk/warning_level.h"
#include "datmo_fusion/road/road_model.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// How risks are assessed: seeded joint futures, or a method for comparison (rule_methods.h).
enum class RiskMethod { kFutures, kThesis, kBoxes, kRss };

struct RiskOptions {
  RiskMethod method = RiskMethod::kFutures;
  int max_objects = 64;
  double max_silence = 1.0;  ///< s
  /// m, 0.05 to 2: spacing of the points of stationary obstacles: closer ones count once
  double point_spacing = 0.25;
  /// m, 0 to 5: points this close to a track's box belong to the track
  double point_margin = 0.5;
  /// m, 0.1 to 5: extent of a track whose own is not measured or is smaller: that of a pedestrian
  double default_size = 0.6;
  HostVehicleOptions vehicle;
  HorizonOptions horizon;
  HostFutureOptions host;
  ObjectFutureOptions objects;
  RuleOptions rules;
  WarningOptions warning;

  void visit(OptionVisitor& visitor);
};

/// Input of an assessment, all in one fixed frame.
struct RiskInput {
  Stamp stamp;  ///< of the host's state: tracks are predicted to it
  HostState host;
  TrackList tracks;
  std::vector<Point2> standing;   ///< m, end points of beams on stationary obstacles
  std::optional<RoadModel> road;  ///< none: unknown
};

/// Assesses the risk of each track and of stationary obstacles, given the host's motion, and one
/// overall level (thesis 5.3.5).
///
/// By default it uses seeded joint futures of the host (HostFutures) and of each object that it
/// could reach (ObjectFutures); `method` selects a method for comparison instead (rule_methods.h).
/// Each future ends at the first contact of the boxes; the share of futures with contact, weighted
/// by the object's existence, is the probability. Time to brake, threat numbers and the struck side
/// are those of the future with the median contact. Stationary obstacles that are not tracks are
/// treated as one more object.
///
/// Not thread safe.
class RiskAssessor {
 public:
  /// Throws OptionError.
  explicit RiskAssessor(const Checked<RiskOptions>& options);

  /// Assesses the risks at one stamp, which must not decrease. The host's state must be finite;
  /// invalid tracks are ignored and counted.
  RiskReport assess(const RiskInput& input);

  /// Forgets the level.
  void reset();

 private:
  std::vector<Track> admitted(const RiskInput& input, RiskCounts& counts) const;
  ObjectRisk byFutures(const Track& track, const HostFutures& host) const;
  ObjectRisk byRule(const Track& track, const HostFutures& host) const;
  ObjectRisk ofStanding(const RiskInput& input, const std::vector<Track>& tracks,
                        const HostFutures& host) const;
  bool reachable(const Track& track, const HostState& host) const;

  RiskOptions options_;
  RandomDraws draws_;
  WarningLevel level_;
  TrackPredictionOptions prediction_;
};

}  // namespace datmo

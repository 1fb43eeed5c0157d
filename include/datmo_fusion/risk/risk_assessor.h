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

/// How risks are assessed: seeded joint futures, or one to compare with (rule_methods.h).
enum class RiskMethod { kFutures, kThesis, kBoxes, kRss };

struct RiskOptions {
  RiskMethod method = RiskMethod::kFutures;
  int max_objects = 64;
  double max_silence = 1.0;     ///< s
  double point_spacing = 0.25;  ///< m
  double point_margin = 0.5;    ///< m
  double default_size = 0.6;    ///< m
  HostVehicleOptions vehicle;
  HorizonOptions horizon;
  HostFutureOptions host;
  ObjectFutureOptions objects;
  RuleOptions rules;
  WarningOptions warning;

  void visit(OptionVisitor& visitor);
};

/// What risks are assessed from, all in one fixed frame.
struct RiskInput {
  Stamp stamp;  ///< of the host's state: tracks are brought to it
  HostState host;
  TrackList tracks;
  std::vector<Point2> standing;   ///< m, end points of beams on what stands
  std::optional<RoadModel> road;  ///< none: not known
};

/// Tracks, what stands, and the host's motion -> the risk of each, and one level (thesis 5.3.5).
///
/// By default over seeded joint futures of the host (HostFutures) and of each object that it could
/// reach at all (ObjectFutures); `method` chooses one to compare with instead (rule_methods.h). The
/// futures' boxes meet at their first contact; the share of futures with contact, weighted by the
/// object's existence, is the probability. Time to brake, threat numbers and how it is struck are
/// those of the future whose contact is the median one. What stands and is no track is one object
/// more, by the same rule.
///
/// Not thread safe.
class RiskAssessor {
 public:
  /// Throws OptionError.
  explicit RiskAssessor(const Checked<RiskOptions>& options);

  /// Stamps rise. The host's state must be finite; tracks that are not valid are left out, and
  /// counted.
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/track/fused_targets.h"
#include "datmo_fusion/fusion/track/track_association.h"
#include "datmo_fusion/fusion/track/track_combination.h"
#include "datmo_fusion/fusion/track/track_correlations.h"
#include "datmo_fusion/fusion/track/track_fuser_options.h"
#include "datmo_fusion/tracking/class_by_speed.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/track_paths.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// The newest tracks of one source; all sources in one fixed frame.
struct SourceTracks {
  std::string source;
  std::shared_ptr<const TrackList> list;  ///< at its own stamp
};

/// What became of the tracks of one set of lists.
struct TrackFusionCounts {
  std::size_t rejected = 0;  ///< not valid (isValid)
  std::size_t refused = 0;   ///< beyond the most of one list: those of least existence
  std::size_t fused = 0;     ///< tracks that two or more sources have
  std::size_t published = 0;
};

/// One list of all sources.
struct TrackFusionResult {
  TrackList list;  ///< at the time of fusion; `views` are those of all sources
  TrackFusionCounts counts;
};

/// Lists of tracks of several sensors -> one list (thesis 3.4).
///
/// All tracks are brought to one time. Which of them are one object is decided by what they did
/// until now (TrackAssociation), the states of those are fused (combined), and the fused track has
/// an id of its own, which stays while one source loses the object and finds it again. That it
/// exists: fusedExistence, by what each source could see, as published with its tracks.
///
/// What is published, of the tracks that are likelier to exist than not:
///
///   - by_existence: those whose existence is probable enough by what all sources report, and those
///     that two sensors confirmed once. A source that has no track of what it would surely have
///     one of says as much as one that has.
///     The thesis's (3.4.2):
///   - fused_plus_fallback: those that all sources have, or had, that can see the position, and two
///     sensors at least; and those of one source, `beyond`, where no other can see. One that comes
///     from there into another's view stays for as long as that needs to confirm it.
///   - confirmed_by_all: the first of these alone. For very noisy sensors.
///   - union: all. `sensors` lists who sees them.
///
/// Of two at one position, of different sources, that are not associated yet, one is
/// published: two bodies cannot be at one position. A source whose view is not known is never
/// missed.
///
/// Not thread safe; stamps rise.
class TrackFuser {
 public:
  /// Throws OptionError.
  explicit TrackFuser(const Checked<TrackFuserOptions>& options);

  /// The tracks at `stamp`, of the newest lists of all sources that publish. A list may have been
  /// given before; it is no new evidence then. Tracks that do not name their sensors are their
  /// source's own. All sources must be in the options (else std::out_of_range).
  TrackFusionResult fuse(Stamp stamp, const std::vector<SourceTracks>& sources);

  /// Goes on with other live options (Tier::kLive) from the next call on; all others must be as
  /// they were. Throws OptionError.
  void setOptions(const Checked<TrackFuserOptions>& options);

  /// Forgets all tracks; ids go on, so that none is reused.
  void reset();

 private:
  std::vector<PresentTracks> ingest(Stamp stamp, const std::vector<SourceTracks>& sources,
                                    TrackFusionCounts& counts);

  /// What a source's track says of the class, with (withSpeed) or without (withoutSpeed) what its
  /// speed does.
  ClassProbabilities reportedClass(const Track& track, const TrackSourceOptions& source,
                                   decltype(withSpeed)* weigh) const;
  std::vector<Track> fused(const std::vector<TrackGroup>& groups,
                           const std::vector<PresentTracks>& present,
                           const std::vector<std::optional<Point2>>& sensors,
                           TrackFusionCounts& counts);

  /// The tracks of a group as one, surest first, whatever the order of the sources is. What each
  /// sensor takes to be the body's center (comparison/body_std) no tracker's covariance has, and it
  /// does not average away.
  Track joined(TrackGroup group, const std::vector<PresentTracks>& present,
               const std::vector<std::optional<Point2>>& sensors);

  /// How much each source would have detected each target lately. Who has a track of it is not
  /// evaluated: when it loses that, it takes a while until it is missed.
  void look(const std::vector<SourceTracks>& sources, double seconds);
  void judgeAll(Stamp stamp, const std::vector<PresentTracks>& present);

  /// The source's own track of a target; null if it has none.
  const Track* trackOf(const FusedTarget& target, std::size_t source,
                       const std::vector<PresentTracks>& present) const;
  void judge(FusedTarget& target, Stamp stamp, const std::vector<PresentTracks>& present) const;
  bool isWanted(const FusedTarget& target) const;

  /// So that a source without a track of it is evidence against it: of one that is published
  /// already when it has had time to confirm its own.
  bool isInOthersView(const FusedTarget& target) const;
  void publish(TrackFusionResult& result);

  TrackFuserOptions options_;
  std::vector<std::string> names_;              ///< of the sources, by number
  std::map<std::string, std::size_t> numbers_;  ///< of the sources
  TrackAssociation association_;
  TrackCorrelations correlations_;
  FusedTargets targets_;
  TrackPaths paths_;
  std::optional<Stamp> stamp_;                ///< of the last call
  std::vector<std::optional<Stamp>> newest_;  ///< list of each source
};

}  // namespace datmo

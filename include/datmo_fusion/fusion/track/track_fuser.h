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

/// The latest tracks of one source; all sources in one fixed frame.
struct SourceTracks {
  std::string source;
  std::shared_ptr<const TrackList> list;  ///< at its own stamp
};

/// Counts of one set of lists.
struct TrackFusionCounts {
  std::size_t rejected = 0;  ///< invalid (isValid)
  std::size_t refused = 0;   ///< beyond the maximum of one list: those of least existence
  std::size_t fused = 0;     ///< tracks that two or more sources have
  std::size_t published = 0;
};

/// The fused list of all sources.
struct TrackFusionResult {
  TrackList list;  ///< at the time of fusion; `views` are those of all sources
  TrackFusionCounts counts;
};

/// Fuses track lists of several sensors (thesis 3.4).
///
/// All tracks are predicted to one time. Their history decides which of them are one object
/// (TrackAssociation), the states of those are fused (combined), and the fused track has its own
/// id, which persists while one source loses the object and finds it again. Its existence is from
/// fusedExistence, by what each source could see, as published with its tracks.
///
/// Which tracks with an existence above one half are published:
///
///   - by_existence: those with sufficient existence according to all sources, and those that two
///     sensors once confirmed. A missing track of a source that would surely have one counts as
///     much as a track does.
///     The thesis's schemes (3.4.2):
///   - fused_plus_fallback: those that all sources that can see the position have or had, at least
///     two sensors; and those of the source `beyond` alone where no other can see. One that moves
///     from there into another's view stays for the time that source needs to confirm it.
///   - confirmed_by_all: only the first of these. For very noisy sensors.
///   - union: all. `sensors` lists who sees them.
///
/// Of two tracks of different sources at one position that are not associated yet, only one is
/// published: two bodies cannot be at one position. A source with an unknown view is never expected
/// to have a track.
///
/// Not thread safe; stamps must rise.
class TrackFuser {
 public:
  /// Throws OptionError.
  explicit TrackFuser(const Checked<TrackFuserOptions>& options);

  /// Fuses the newest lists of all publishing sources at `stamp`. A list may have been given
  /// before; it is not counted as new evidence then. Tracks that do not name their sensors count as
  /// their source's own. All sources must be in the options (else std::out_of_range).
  TrackFusionResult fuse(Stamp stamp, const std::vector<SourceTracks>& sources);

  /// Changes live options (Tier::kLive) from the next call on; all others must be unchanged. Throws
  /// OptionError.
  void setOptions(const Checked<TrackFuserOptions>& options);

  /// Forgets all tracks; ids continue, so that none is reused.
  void reset();

 private:
  std::vector<PresentTracks> ingest(Stamp stamp, const std::vector<SourceTracks>& sources,
                                    TrackFusionCounts& counts);

  /// Class probabilities of a source's track, with (withSpeed) or without (withoutSpeed) the
  /// evidence of its speed.
  ClassProbabilities weightedClass(const Track& track, const TrackSourceOptions& source,
                                   decltype(withSpeed)* weigh) const;
  std::vector<Track> fused(const std::vector<TrackGroup>& groups,
                           const std::vector<PresentTracks>& present,
                           const std::vector<std::optional<Point2>>& sensors,
                           TrackFusionCounts& counts);

  /// Fuses the tracks of a group, most certain first, independent of the order of the sources. The
  /// disagreement of sensors about the body's center (comparison/body_std) is in no tracker's
  /// covariance and does not average out.
  Track fusedTrack(TrackGroup group, const std::vector<PresentTracks>& present,
                   const std::vector<std::optional<Point2>>& sensors);

  /// Updates how probably each source would have detected each target lately. Sources that have a
  /// track of it are not evaluated: after losing it, it takes a while until they are expected to
  /// see it.
  void look(const std::vector<SourceTracks>& sources, double seconds);
  void judgeAll(Stamp stamp, const std::vector<PresentTracks>& present);

  /// The source's own track of a target; null if it has none.
  const Track* trackOf(const FusedTarget& target, std::size_t source,
                       const std::vector<PresentTracks>& present) const;
  void judge(FusedTarget& target, Stamp stamp, const std::vector<PresentTracks>& present) const;
  bool isWanted(const FusedTarget& target) const;

  /// Whether a missing track of some source is evidence against the target; for a target that is
  /// already published, only after that source had time to confirm its own.
  bool isInOthersView(const FusedTarget& target) const;
  void publish(TrackFusionResult& result);

  TrackFuserOptions options_;
  std::vector<std::string> names_;              ///< by index of the source
  std::map<std::string, std::size_t> numbers_;  ///< index by name
  TrackAssociation association_;
  TrackCorrelations correlations_;
  FusedTargets targets_;
  TrackPaths paths_;
  std::optional<Stamp> stamp_;                ///< of the last call
  std::vector<std::optional<Stamp>> newest_;  ///< stamp of each source's newest list
};

}  // namespace datmo

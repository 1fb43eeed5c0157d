// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/track/track_association.h"
#include "datmo_fusion/fusion/track/track_combination.h"
#include "datmo_fusion/fusion/track/track_prediction.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// One source of tracks.
struct TrackSourceOptions {
  bool use = true;
  double detection_probability = 0.8;        ///< 1
  double false_agreement_probability = 0.1;  ///< 1

  void visit(OptionVisitor& visitor);
};

struct TrackFuserOptions {
  static constexpr char kFusedPlusFallback[] = "fused_plus_fallback";
  static constexpr char kConfirmedByAll[] = "confirmed_by_all";
  static constexpr char kUnion[] = "union";

  std::map<std::string, TrackSourceOptions> sources;  ///< by name; at first lidar and stereo
  std::string scheme = kFusedPlusFallback;
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

/// Which tracks come out: the schemes' names.
const std::vector<std::string>& trackSchemeNames();

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
/// What is published, of the tracks that are likely enough to exist (thesis 3.4.2):
///
///   - fused_plus_fallback: those that all sources have, or had, that can see the position, and two
///     sensors at least; and those of one source, `beyond`, where no other can see. The thesis's
///     list.
///     One that comes from there into another's view stays for as long as that needs to confirm it.
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
  explicit TrackFuser(const TrackFuserOptions& options);
  ~TrackFuser();

  /// The tracks at `stamp`, of the newest lists of all sources that speak. A list may have been
  /// given before; it is no new evidence then. Tracks that do not name their sensors are their
  /// source's own. All sources must be in the options (else std::out_of_range).
  TrackFusionResult fuse(Stamp stamp, const std::vector<SourceTracks>& sources);

  /// Goes on with other live options (Tier::kLive) from the next call on; all others must be as
  /// they were. Throws OptionError.
  void setOptions(const TrackFuserOptions& options);

  /// Forgets all tracks; ids go on, so that none is reused.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo

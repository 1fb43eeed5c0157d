// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/track/track_comparison.h"
#include "datmo_fusion/fusion/track/windowed_evidence.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// When two tracks are one object (TrackAssociation).
enum class TrackAssociationTest { kAccumulated, kParallel };

struct TrackAssociationOptions {
  TrackAssociationTest test = TrackAssociationTest::kAccumulated;
  TrackComparisonOptions comparison;
  WindowedEvidenceOptions evidence;
  ParallelTracksOptions parallel;
  double required = 6.9;  ///< 1

  void visit(OptionVisitor& visitor);
};

/// Tracks of one source, all at one time in one fixed frame.
struct PresentTracks {
  std::size_t source = 0;     ///< number of the source, the same at all times
  bool fresh = true;          ///< false: these are known already, predicted
  std::vector<Track> tracks;  ///< valid (isValid); ids are unique
};

/// One track of those.
struct TrackPosition {
  std::size_t list = 0;  ///< index of its source's PresentTracks
  std::size_t track = 0;
};

/// Tracks that are one object, of different sources; at least one.
using TrackGroup = std::vector<TrackPosition>;

/// Decides which tracks of several sources are one object, by all that they did until now.
///
/// accumulated: each time two tracks are compared, the log-likelihood ratio of "one object" against
/// "two" counts (compare), summed over a window of time (Bar-Shalom, Willett, Tian, Tracking and
/// Data Fusion, 2011, 9.4.4: association from the histories of tracks): two cars that pass each
/// other agree for a moment, one object always. Two become one from `required` on.
///
/// parallel: thesis 3.4.2; two tracks in each other's gate are one if they were parallel over the
/// history that they have in common.
///
/// In both, one-to-one between sources and likeliest over all pairs, with a lead
/// (`association_hysteresis`) for those who were one before: accumulated, these also stay one until
/// they differ by as much more than it takes to become one.
class TrackAssociation {
 public:
  /// Throws OptionError.
  explicit TrackAssociation(const Checked<TrackAssociationOptions>& options);

  /// The groups of the tracks of a time, in the order of their first tracks: those of the first
  /// source, then the others'. Stamps rise.
  std::vector<TrackGroup> associate(Stamp stamp, const std::vector<PresentTracks>& sources);

  void reset() { *this = TrackAssociation(options_); }

 private:
  struct TrackKey {
    std::size_t source;
    std::uint32_t id;
    bool operator<(const TrackKey& other) const {
      return std::tie(source, id) < std::tie(other.source, other.id);
    }
  };
  using PairKey = std::pair<TrackKey, TrackKey>;
  struct Pair {
    WindowedEvidence evidence;
    bool together = false;  ///< at the last time
  };
  /// Two tracks of different sources that may be one object now.
  struct Candidate {
    TrackPosition one;
    TrackPosition other;  ///< of a later list
    double score = 0.0;   ///< more than 0: one object
    PairKey key;
  };

  void compareAll(Stamp stamp, const std::vector<PresentTracks>& sources, std::size_t one,
                  std::size_t other);
  std::optional<double> scoreOf(Stamp stamp, const Track& a, const Track& b, bool fresh,
                                const PairKey& key);
  /// Gives the tracks of a list to the groups of those before it, or each one of its own.
  void join(std::vector<TrackGroup>& groups, const std::vector<PresentTracks>& sources,
            std::size_t list) const;
  void remember(Stamp stamp, const std::vector<TrackGroup>& groups);

  TrackAssociationOptions options_;
  std::map<PairKey, Pair> pairs_;
  std::vector<Candidate> candidates_;  ///< of the present
};

}  // namespace datmo

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

/// How to decide that two tracks are one object (TrackAssociation).
enum class TrackAssociationTest { kAccumulated, kParallel };

struct TrackAssociationOptions {
  TrackAssociationTest test = TrackAssociationTest::kAccumulated;
  TrackComparisonOptions comparison;
  WindowedEvidenceOptions evidence;
  ParallelTracksOptions parallel;
  double required = 6.9;  ///< 1

  void visit(OptionVisitor& visitor);
};

/// Tracks of one source, all at one stamp in one fixed frame.
struct PresentTracks {
  std::size_t source = 0;     ///< index of the source, constant over time
  bool fresh = true;          ///< false: an earlier list, predicted
  std::vector<Track> tracks;  ///< valid (isValid); ids are unique
};

/// Refers to one of these tracks.
struct TrackPosition {
  std::size_t list = 0;  ///< index of its source's PresentTracks
  std::size_t track = 0;
};

/// Tracks of different sources that are one object; at least one.
using TrackGroup = std::vector<TrackPosition>;

/// Decides which tracks of several sources are one object, from their history.
///
/// accumulated: the log-likelihood ratio of "one object" against "two" (compare) is summed over a
/// time window (Bar-Shalom, Willett, Tian, Tracking and Data Fusion, 2011, 9.4.4: association from
/// the histories of tracks): two cars that pass each other agree for a moment, tracks of one object
/// always. Two tracks are associated if the sum reaches `required`.
///
/// parallel: thesis 3.4.2; two tracks in each other's gate are associated if they were parallel
/// over their common history.
///
/// Both are one-to-one between sources and choose the most likely assignment over all pairs, with
/// hysteresis (`association_hysteresis`) for pairs that were associated before: with accumulated, a
/// pair is kept until its sum falls below `required` by that much.
class TrackAssociation {
 public:
  /// Throws OptionError.
  explicit TrackAssociation(const Checked<TrackAssociationOptions>& options);

  /// Returns the groups of the tracks, ordered by their first tracks: those of the first source,
  /// then the others'. Stamps must rise.
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
    bool together = false;  ///< at the last stamp
  };
  /// Two tracks of different sources that may be one object.
  struct Candidate {
    TrackPosition one;
    TrackPosition other;  ///< in a later list
    double score = 0.0;   ///< above 0: one object
    PairKey key;
  };

  void compareAll(Stamp stamp, const std::vector<PresentTracks>& sources, std::size_t one,
                  std::size_t other);
  std::optional<double> scoreOf(Stamp stamp, const Track& a, const Track& b, bool fresh,
                                const PairKey& key);
  /// Adds the tracks of a list to the groups of those before it, or opens new groups.
  void join(std::vector<TrackGroup>& groups, const std::vector<PresentTracks>& sources,
            std::size_t list) const;
  void remember(Stamp stamp, const std::vector<TrackGroup>& groups);

  TrackAssociationOptions options_;
  std::map<PairKey, Pair> pairs_;
  std::vector<Candidate> candidates_;  ///< at the current stamp
};

}  // namespace datmo

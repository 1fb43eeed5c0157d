// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "datmo_fusion/fusion/track/class_memory.h"
#include "datmo_fusion/fusion/track/track_fuser_options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// An object that one source or more have a track of.
struct FusedTarget {
  using Member = ClassMemory::Member;

  std::uint32_t id = 0;
  Track track;                    ///< fused, at the present; `sources`: those it was last fused of
  std::map<Member, Stamp> since;  ///< when it got each of these tracks
  ClassMemory classes;            ///< what these and those before them believed of its class
  Stamp born;                     ///< when the first object of any of its tracks was seen
  bool present = true;            ///< a source has a track of it now
  double lost = 0.0;              ///< s, since one had
  bool confirmed = false;         ///< all sources that could see it, and two sensors, had tracks
  bool wanted = false;            ///< published, unless a surer one is at the same position
  bool published = false;         ///< came out
  /// By number of the source: that it would have detected it lately; none: not evaluated yet.
  std::vector<std::optional<double>> looked;
  std::vector<std::optional<double>> ranges;  ///< m, the same: from its sensor; none: not known

  /// Id of this source's track of it; none if it has none.
  std::optional<std::uint32_t> member(const std::string& source) const;

  /// Its class, by what all tracks of the present believe of what they are of, without their
  /// speed, and by its own.
  void updateClass(const ClassMemory::Beliefs& beliefs, const ClassBySpeedOptions& options);
};

/// Which fused target a group of tracks is: the one that has a track of the group already; of
/// several the confirmed, then one that was not lost, one that has more of the tracks, that has had
/// one for longer, the older one. So where the tracks of a target part, it goes on with the one
/// that it has had for longest. Of new groups those that are where one was lost within `memory` are
/// that one again. Ids rise and are never reused.
class FusedTargets {
 public:
  explicit FusedTargets(std::size_t sources) : sources_(sources) {}

  /// The present tracks, one for each group, at `stamp`, `seconds` after the last time. The
  /// covariances of those of several sources include TrackComparisonOptions::body_std.
  /// Targets without one are lost: predicted, and forgotten after `memory` s.
  void follow(Stamp stamp, double seconds, std::vector<Track> groups,
              const TrackFuserOptions& options);

  /// Publishes those that are wanted; of two at one position (reaches), which no source has tracks
  /// of both, the surer one: the one that was published before, if both are confirmed or neither
  /// is.
  void publish(double reach);

  std::vector<FusedTarget>& all() { return targets_; }

  void clear() { targets_.clear(); }

 private:
  using Owners = std::vector<std::optional<std::size_t>>;

  /// Tracks that a group has in common with a target.
  struct Shared {
    int tracks = 0;
    Stamp since;  ///< when the target got the first of them
  };
  /// By index of the target.
  std::map<std::size_t, Shared> sharedWith(
      const Track& group, const std::multimap<FusedTarget::Member, std::size_t>& owners_of) const;
  /// Of each group the index of its target, as far as it shares a track with one.
  Owners byMembers(const std::vector<Track>& groups) const;
  /// Those that are none's.
  std::vector<std::size_t> withoutGroup(const Owners& owners) const;
  /// Adds those that were lost where a new group is.
  void addRefound(const std::vector<Track>& groups, const TrackComparisonOptions& options,
                  Owners& owners) const;
  void forgetLost(double memory);

  std::size_t sources_;
  std::uint32_t next_id_ = 1;
  std::vector<FusedTarget> targets_;  ///< by rising id
};

}  // namespace datmo

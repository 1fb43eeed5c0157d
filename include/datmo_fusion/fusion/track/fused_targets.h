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

/// An object that at least one source tracks.
struct FusedTarget {
  using Member = ClassMemory::Member;

  std::uint32_t id = 0;
  Track track;                    ///< fused, at the current time; `sources`: those last fused
  std::map<Member, Stamp> since;  ///< when each of these tracks was associated
  ClassMemory classes;            ///< class beliefs of these and earlier tracks
  Stamp born;                     ///< when the first object of any of its tracks was seen
  bool present = true;            ///< at least one source has a track of it now
  double lost = 0.0;              ///< s, since no source had one
  bool confirmed = false;  ///< once had tracks of all sources that could see it, and of two sensors
  bool wanted = false;     ///< to be published, unless a more certain one is at the same position
  bool published = false;  ///< published in the last step
  /// By number of the source: probability that it would have detected it lately; none: not
  /// evaluated.
  std::vector<std::optional<double>> looked;
  std::vector<std::optional<double>> ranges;  ///< m, likewise: from its sensor; none: unknown

  /// Returns the id of this source's track of it; none if it has none.
  std::optional<std::uint32_t> member(const std::string& source) const;

  /// Updates its class from the class beliefs (without speed) of all current tracks and from its
  /// own speed.
  void updateClass(const ClassMemory::Beliefs& beliefs, const ClassBySpeedOptions& options);
};

/// Assigns groups of tracks to fused targets: a group continues the target that already has one of
/// its tracks. Among several, confirmed targets come first, then those that are not lost, those
/// that share more tracks, those that share one for longer, and older ones. So when the tracks of a
/// target separate, it keeps the one it has had for longest. A new group at the position of a
/// target lost within `memory` continues that target. Ids rise and are never reused.
class FusedTargets {
 public:
  explicit FusedTargets(std::size_t sources) : sources_(sources) {}

  /// Updates the targets with the current tracks, one per group, at `stamp`, `seconds` after the
  /// last call. The covariances of tracks fused from several sources include
  /// TrackComparisonOptions::body_std. Targets without a group are lost: predicted, and deleted
  /// after `memory` s.
  void follow(Stamp stamp, double seconds, std::vector<Track> groups,
              const TrackFuserOptions& options);

  /// Publishes the wanted targets. If two are at one position (reaches) and no source tracks both,
  /// only the more certain one is published: the previously published one, if both are confirmed or
  /// neither is.
  void publish(double reach);

  std::vector<FusedTarget>& all() { return targets_; }

  void clear() { targets_.clear(); }

 private:
  using Owners = std::vector<std::optional<std::size_t>>;

  /// Tracks that a group shares with a target.
  struct Shared {
    int tracks = 0;
    Stamp since;  ///< when the target got the first of them
  };
  /// By index of the target.
  std::map<std::size_t, Shared> sharedWith(
      const Track& group, const std::multimap<FusedTarget::Member, std::size_t>& owners_of) const;
  /// For each group the index of its target, if it shares a track with one.
  Owners byMembers(const std::vector<Track>& groups) const;
  /// Targets without a group.
  std::vector<std::size_t> withoutGroup(const Owners& owners) const;
  /// Adds lost targets that a new group is close to.
  void addRefound(const std::vector<Track>& groups, const TrackComparisonOptions& options,
                  Owners& owners) const;
  void forgetLost(double memory);

  std::size_t sources_;
  std::uint32_t next_id_ = 1;
  std::vector<FusedTarget> targets_;  ///< by rising id
};

}  // namespace datmo

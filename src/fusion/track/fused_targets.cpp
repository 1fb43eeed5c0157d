// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/fused_targets.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "datmo_fusion/assignment/assignment.h"
#include "datmo_fusion/tracking/duplicates.h"

namespace datmo {

namespace {

bool sharesSource(const Track& a, const Track& b) {
  return std::any_of(a.sources.begin(), a.sources.end(), [&](const SourceTrack& one) {
    return std::any_of(b.sources.begin(), b.sources.end(),
                       [&](const SourceTrack& other) { return one.source == other.source; });
  });
}

bool areDuplicates(const Track& a, const Track& b, double reach) {
  return !sharesSource(a, b) && (reaches(a.box, b.box, reach) || reaches(b.box, a.box, reach));
}

/// Sorts more certain targets first; of two published ones, the older one: existences change all
/// the time, and ids should not change with them.
bool isSurer(const FusedTarget* a, const FusedTarget* b) {
  const auto rank = [](const FusedTarget& one) {
    const double doubt = one.published ? 0.0 : -one.track.existence_probability;
    return std::make_tuple(!one.confirmed, !one.published, doubt, one.id);
  };
  return rank(*a) < rank(*b);
}

}  // namespace

std::optional<std::uint32_t> FusedTarget::member(const std::string& source) const {
  const auto found = std::find_if(track.sources.begin(), track.sources.end(),
                                  [&](const SourceTrack& one) { return one.source == source; });
  return found == track.sources.end() ? std::nullopt : std::make_optional(found->id);
}

void FusedTarget::updateClass(const ClassMemory::Beliefs& beliefs,
                              const ClassBySpeedOptions& options) {
  ClassMemory::Beliefs own;
  for (const SourceTrack& one : present ? track.sources : std::vector<SourceTrack>()) {
    const Member member(one.source, one.id);
    own[member] = beliefs.at(member);
  }
  classes.update(own, beliefs);
  track.class_probabilities = classes.belief();
  if (track.moving) {
    track.class_probabilities =
        withSpeed(track.class_probabilities, speedOf({track.state, track.covariance}), options);
  }
}

FusedTargets::Owners FusedTargets::byMembers(const std::vector<Track>& groups) const {
  // A lost target may be known by a track that has since switched to another object.
  std::multimap<FusedTarget::Member, std::size_t> owners_of;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    for (const auto& [member, since] : targets_[i].since) {
      owners_of.insert({member, i});
    }
  }
  // Order: confirmed, then not lost, then number of shared tracks, then duration of sharing, then
  // age.
  using Claim = std::tuple<bool, bool, int, std::int64_t, std::size_t, std::size_t>;
  std::vector<Claim> claims;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const auto& [target, shared] : sharedWith(groups[group], owners_of)) {
      const FusedTarget& one = targets_[target];
      claims.emplace_back(!one.confirmed, !one.present, -shared.tracks, shared.since.nanoseconds,
                          target, group);
    }
  }
  std::sort(claims.begin(), claims.end());
  Owners owners(groups.size());
  std::vector<bool> taken(targets_.size(), false);
  for (const auto& [unconfirmed, lost, fewer, since, target, group] : claims) {
    if (!owners[group] && !taken[target]) {
      owners[group] = target;
      taken[target] = true;
    }
  }
  return owners;
}

std::map<std::size_t, FusedTargets::Shared> FusedTargets::sharedWith(
    const Track& group, const std::multimap<FusedTarget::Member, std::size_t>& owners_of) const {
  std::map<std::size_t, Shared> all;
  for (const SourceTrack& track : group.sources) {
    const FusedTarget::Member member(track.source, track.id);
    const auto [first, last] = owners_of.equal_range(member);
    for (auto owner = first; owner != last; ++owner) {
      const Stamp since = targets_[owner->second].since.at(member);
      const auto [known, added] = all.emplace(owner->second, Shared{0, since});
      ++known->second.tracks;
      known->second.since = std::min(known->second.since, since);
    }
  }
  return all;
}

std::vector<std::size_t> FusedTargets::withoutGroup(const Owners& owners) const {
  std::vector<bool> taken(targets_.size(), false);
  for (const std::optional<std::size_t>& owner : owners) {
    if (owner) {
      taken[*owner] = true;
    }
  }
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) {
      left.push_back(i);
    }
  }
  return left;
}

void FusedTargets::addRefound(const std::vector<Track>& groups,
                              const TrackComparisonOptions& options, Owners& owners) const {
  const std::vector<std::size_t> lost = withoutGroup(owners);
  std::vector<std::size_t> fresh;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (!owners[group]) {
      fresh.push_back(group);
    }
  }
  if (lost.empty() || fresh.empty()) {
    return;
  }
  const auto rows = static_cast<Eigen::Index>(fresh.size());
  CostMatrix cost(rows, static_cast<Eigen::Index>(lost.size()));
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index column = 0; column < cost.cols(); ++column) {
      const TrackComparison same =
          compare(groups[fresh[static_cast<std::size_t>(row)]],
                  targets_[lost[static_cast<std::size_t>(column)]].track, options);
      const bool may_be = same.squared_distance <= options.gate && same.log_likelihood_ratio > 0.0;
      cost(row, column) = may_be ? -same.log_likelihood_ratio : kForbidden;
    }
  }
  const Assignment assignment = solveAssignment(cost, Eigen::VectorXd::Zero(rows));
  for (std::size_t row = 0; row < fresh.size(); ++row) {
    if (assignment.column_of_row[row] != kUnassigned) {
      owners[fresh[row]] = lost[static_cast<std::size_t>(assignment.column_of_row[row])];
    }
  }
}

void FusedTargets::forgetLost(double memory) {
  targets_.erase(
      std::remove_if(targets_.begin(), targets_.end(),
                     [memory](const FusedTarget& target) { return target.lost > memory; }),
      targets_.end());
}

void FusedTargets::follow(Stamp stamp, double seconds, std::vector<Track> groups,
                          const TrackFuserOptions& options) {
  Owners owners = byMembers(groups);
  for (const std::size_t lost : withoutGroup(owners)) {
    FusedTarget& target = targets_[lost];
    target.present = false;
    target.lost += seconds;
    target.track = predicted(std::move(target.track), seconds, options.prediction);
  }
  addRefound(groups, options.association.comparison, owners);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (!owners[group]) {
      owners[group] = targets_.size();
      FusedTarget target;
      target.id = next_id_++;
      target.born = stamp;
      target.looked.resize(sources_);
      target.ranges.resize(sources_);
      targets_.push_back(std::move(target));
    }
    FusedTarget& target = targets_[*owners[group]];
    target.born = std::min(target.born, stamp + -groups[group].age);
    std::map<FusedTarget::Member, Stamp> since;
    for (const SourceTrack& track : groups[group].sources) {
      const FusedTarget::Member member(track.source, track.id);
      const auto before = target.since.find(member);
      since[member] = before == target.since.end() ? stamp : before->second;
    }
    target.since = std::move(since);
    target.track = std::move(groups[group]);
    target.present = true;
    target.lost = 0.0;
  }
  forgetLost(options.memory);
}

void FusedTargets::publish(double reach) {
  std::vector<FusedTarget*> surest;
  for (FusedTarget& target : targets_) {
    if (target.wanted) {
      surest.push_back(&target);
    }
  }
  std::sort(surest.begin(), surest.end(), isSurer);
  for (FusedTarget& target : targets_) {
    target.published = target.wanted;
  }
  for (std::size_t i = 0; i < surest.size(); ++i) {
    for (std::size_t j = 0; j < i && surest[i]->published; ++j) {
      surest[i]->published =
          !surest[j]->published || !areDuplicates(surest[i]->track, surest[j]->track, reach);
    }
  }
}

}  // namespace datmo

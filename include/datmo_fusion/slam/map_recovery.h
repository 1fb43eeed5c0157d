// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/map_search.h"

namespace datmo {

/// How well the vehicle's pose in the map is known.
enum class Localization : std::uint8_t {
  kLocated,    ///< scans are matched to the map
  kUncertain,  ///< after a gap: somewhere within the pose's covariance
  kLost,       ///< as before, but no pose there fits, or the area is too large; or it was kidnapped
};

struct MapRecoveryOptions {
  /// m, 0.01 to 1000: a gap that makes the position this uncertain (standard deviation) requires a
  /// search of the map; after shorter ones the next scan is matched as usual
  double from_position_sigma = 0.5;
  double from_heading_sigma = degrees(5.0);  ///< rad, 0.001 to 10: the same for the heading
  double first_search_after = 1.2;           ///< s
  double search_period = 0.8;                ///< s
  double give_up_after = 5.0;                ///< s
  double lost_from_sigma = 15.0;             ///< m
  double min_kidnapped_log_ratio = 5.0;
  double kidnapped_after = 1.0;  ///< s
  int boxes_per_second = 50000;
  MapSearchOptions search;
  int prior_boxes_per_second = 400000;
  double confirmed_after = 0.5;  ///< m
  /// rad, 0 to pi: or, instead of the distance confirmed_after, after this turn
  double confirmed_after_turn = 0.5;
  MapSearchOptions prior_search = MapSearchOptions::inCompleteMap();

  void visit(OptionVisitor& visitor);
};

/// The vehicle's pose in an older map.
struct Relocalization {
  PoseWithCovariance in_older;
  bool is_unique = false;  ///< scans can be matched there; else the maps are only aligned
};

/// Widens the covariance of a pose so that the vehicle may have been carried anywhere around it.
PoseWithCovariance anywhereAbout(PoseWithCovariance pose);

/// Returns whether the uncertainty of a pose has grown from one covariance to the other so much, as
/// in a gap, that the vehicle must be searched for.
bool grewWider(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to,
               const MapRecoveryOptions& limits);

/// Relocalization in a map after a gap in which the vehicle may have gone anywhere within a wide
/// prior. Scans then build a newer map, starting at the prior's mean, and the older one is left
/// unchanged. The older map is searched for the newer one repeatedly as that grows, until there is
/// a unique answer, or one narrow enough to align the maps, or the search is given up in favor of
/// the newer map.
///
/// After the vehicle was carried elsewhere it may be anywhere, and all of the older map's window is
/// searched, as in a prior map.
///
/// The same localizes the vehicle in a prior map at the start, from an initial guess or globally.
/// Then the newer map never replaces it, and results must be confirmed: rooms that look the same
/// from one position differ further on. A position is accepted only if a second search, using what
/// was seen up to `confirmed_after` or `confirmed_after_turn` later, finds the same one, and no
/// search in between found another one more likely.
class MapRecovery {
 public:
  /// `start`: the prior in the older map's frame, where the newer one starts at this stamp. Throws
  /// OptionError.
  MapRecovery(const Checked<MapRecoveryOptions>& options, OccupancyMap older,
              const PoseWithCovariance& start, Stamp stamp);

  /// In a prior map: the vehicle may be in this region of it, and the newer map starts at the
  /// region's mean.
  MapRecovery(const Checked<MapRecoveryOptions>& options, OccupancyMap prior_map,
              const SearchRegion& region, Stamp stamp);

  /// For a vehicle that was carried elsewhere from about this pose in the older map, where the
  /// newer one starts at this stamp.
  static MapRecovery afterKidnapping(const Checked<MapRecoveryOptions>& options, OccupancyMap older,
                                     const PoseWithCovariance& pose, Stamp stamp);

  /// Returns the pose at which the newer map starts, in the older one.
  const PoseWithCovariance& start() const { return start_; }

  /// Returns whether the older map is a prior one.
  bool isInPriorMap() const { return region_.has_value(); }

  /// Returns whether the vehicle was carried elsewhere.
  bool isAfterKidnapping() const { return is_kidnapped_; }

  const OccupancyMap& older() const { return older_; }

  /// Returns a pose of the newer map in the older one, including the uncertainty of where the newer
  /// one lies in it.
  PoseWithCovariance inOlder(const PoseWithCovariance& in_newer) const;

  /// Returns the region of the older map to be searched for this pose.
  SearchRegion regionOf(const PoseWithCovariance& in_newer) const;

  /// Continues the search; called after each scan. Returns the vehicle's pose in the older map once
  /// it is found, or the maps are aligned.
  std::optional<Relocalization> advance(const OccupancyMap& newer,
                                        const PoseWithCovariance& in_newer, Stamp stamp);

  /// Returns whether the search has failed for long enough: either the newer map becomes the map,
  /// or all of a prior map is searched. A search of all of a prior map never ends.
  bool isOver(Stamp stamp) const {
    return !(region_ && region_->anywhere) &&
           secondsBetween(begun_, stamp) > options_.give_up_after;
  }

  /// Ends the search after this time (s), if that is earlier than by the options.
  void endAfter(double seconds) {
    options_.give_up_after = std::min(options_.give_up_after, seconds);
  }

  Localization state() const { return state_; }

  /// Returns the older map; this object must not be used afterwards.
  OccupancyMap takeOlder() { return std::move(older_); }

 private:
  /// Whether all of the older map's window is searched.
  bool searchesAnywhere() const { return isInPriorMap() ? region_->anywhere : is_kidnapped_; }
  /// Whether surfaces seen now that the older map lacks count against a pose in it.
  bool searchesCompleteMap() const { return isInPriorMap() || searchesAnywhere(); }
  void beginSearch(const OccupancyMap& newer, const PoseWithCovariance& in_newer, Stamp stamp);
  /// How many boxes the search may evaluate for the time since the last scan.
  int boxesUntil(Stamp stamp);
  /// The result of a search that has ended, for the pose now.
  std::optional<Relocalization> conclude(MapSearch::Outcome outcome, const Pose2& in_newer);
  /// Discards a candidate that a search without a unique result contradicts.
  void doubtCandidate(MapSearch::Outcome outcome);
  /// Whether an earlier search, from another position, has found the same pose.
  bool confirms(const Pose2& found);
  /// Whether this pose is the one that the candidate predicts for now.
  bool agreesWithCandidate(const Pose2& in_older) const;

  MapRecoveryOptions options_;
  OccupancyMap older_;
  std::shared_ptr<const SearchedMap> searched_;  ///< that map, from the first search on
  PoseWithCovariance start_;
  Stamp begun_;
  Stamp next_search_;
  Stamp advanced_;             ///< stamp of the last scan
  bool is_searchable_ = true;  ///< the prior is not too wide
  Localization state_ = Localization::kUncertain;
  std::optional<MapSearch> search_;
  Pose2 searched_from_;                 ///< pose in the newer map for which the search was started
  std::optional<SearchRegion> region_;  ///< of a prior map
  bool is_kidnapped_ = false;

  /// A search result that is not confirmed yet.
  struct Candidate {
    Pose2 in_older;
    Pose2 in_newer;
  };
  std::optional<Candidate> candidate_;
};

}  // namespace datmo

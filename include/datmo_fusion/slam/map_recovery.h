// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// How well the vehicle knows where it is in the map.
enum class Localization : std::uint8_t {
  kLocated,    ///< by scans matched to the map
  kUncertain,  ///< after a gap: somewhere within the pose's covariance
  kLost,  ///< the same, and the map fits nowhere there, or there is too much of it; or kidnapped
};

struct MapRecoveryOptions {
  double from_position_sigma = 0.5;          ///< m
  double from_heading_sigma = degrees(5.0);  ///< rad
  double first_search_after = 1.2;           ///< s
  double search_period = 0.8;                ///< s
  double give_up_after = 5.0;                ///< s
  double lost_from_sigma = 15.0;             ///< m
  double min_contradiction_rise = 0.2;       ///< 0 to 1
  double kidnapped_after = 1.0;              ///< s
  int boxes_per_scan = 600;
  MapSearchOptions search;
  int prior_boxes_per_second = 400000;
  double confirmed_after = 0.5;       ///< m
  double confirmed_after_turn = 0.5;  ///< rad
  MapSearchOptions prior_search = MapSearchOptions::inCompleteMap();

  void visit(OptionVisitor& visitor);
};

/// The pose of a vehicle that may have been carried elsewhere, anywhere about it.
PoseWithCovariance anywhereAbout(PoseWithCovariance pose);

/// Whether a pose has become so much more uncertain from one covariance to the other, as in a gap,
/// that it has to be searched for.
bool grewWider(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to,
               const MapRecoveryOptions& limits);

/// Relocalization in a map after a gap in which the vehicle may have gone anywhere within a wide
/// prior. Scans then build a newer map, which begins at the prior's mean, and the older one is left
/// as it was; it is searched for the newer one, again and again as that grows, until there is one
/// answer, or it is time to go on with the newer map alone.
///
/// After the vehicle was carried elsewhere it may be anywhere, and all of the older map's window is
/// searched, as a prior map is.
///
/// The same localizes the vehicle in a prior map at the start, within a guess or anywhere. There
/// the newer map is never taken for it, and what was found is confirmed: rooms that look alike from
/// one place differ some way on. Only when a second search, by what was seen up to
/// `confirmed_after` or `confirmed_after_turn` later, finds the same place is it the place, and if
/// no search in between thought another one likelier.
class MapRecovery {
 public:
  /// `start`: the prior in the older map's frame, where the newer one begins at this stamp. Throws
  /// OptionError.
  MapRecovery(const Checked<MapRecoveryOptions>& options, OccupancyMap older,
              const PoseWithCovariance& start, Stamp stamp);

  /// In a prior map: the vehicle may be in this region of it, and the newer map begins at the
  /// region's mean.
  MapRecovery(const Checked<MapRecoveryOptions>& options, OccupancyMap prior_map,
              const SearchRegion& region, Stamp stamp);

  /// Of a vehicle that was carried elsewhere from about this pose in the older map, where the newer
  /// one begins at this stamp.
  static MapRecovery afterKidnapping(const Checked<MapRecoveryOptions>& options, OccupancyMap older,
                                     const PoseWithCovariance& pose, Stamp stamp);

  /// The mean of where the newer map begins, in the older one.
  const PoseWithCovariance& start() const { return start_; }

  /// Whether the older map is a prior one.
  bool isInPriorMap() const { return region_.has_value(); }

  /// Whether the vehicle was carried elsewhere.
  bool isAfterKidnapping() const { return is_kidnapped_; }

  const OccupancyMap& older() const { return older_; }

  /// A pose of the newer map with what is not known of that map itself.
  PoseWithCovariance inOlder(const PoseWithCovariance& in_newer) const;

  /// Where that is searched for in the older map.
  SearchRegion regionOf(const PoseWithCovariance& in_newer) const;

  /// After each scan: goes on with the search. Returns the vehicle's pose in the older map once it
  /// is found.
  std::optional<PoseWithCovariance> advance(const OccupancyMap& newer,
                                            const PoseWithCovariance& in_newer, Stamp stamp);

  /// Whether it was searched for in vain long enough: the newer map is to be the map from now on,
  /// or all of a prior map is to be searched. A search of all of it goes on.
  bool isOver(Stamp stamp) const {
    return !(region_ && region_->anywhere) &&
           secondsBetween(begun_, stamp) > options_.give_up_after;
  }

  Localization state() const { return state_; }

  /// The older map; this object is of no use afterwards.
  OccupancyMap takeOlder() { return std::move(older_); }

 private:
  /// Whether all of the older map's window is searched.
  bool searchesAnywhere() const { return isInPriorMap() ? region_->anywhere : is_kidnapped_; }
  /// Whether what is seen and lacks in the older map counts against a place in it.
  bool searchesCompleteMap() const { return isInPriorMap() || searchesAnywhere(); }
  void beginSearch(const OccupancyMap& newer, const PoseWithCovariance& in_newer, Stamp stamp);
  /// How many boxes the search may look at since the last scan.
  int boxesUntil(Stamp stamp);
  /// Whether an earlier search has found the same place from another one.
  bool confirms(const Pose2& found);
  /// Whether this pose is where the vehicle is now if an earlier search was right.
  bool agreesWithCandidate(const Pose2& in_older) const;

  MapRecoveryOptions options_;
  OccupancyMap older_;
  std::shared_ptr<const SearchedMap> searched_;  ///< that map, from the first search on
  PoseWithCovariance start_;
  Stamp begun_;
  Stamp next_search_;
  Stamp advanced_;             ///< up to the last scan
  bool is_searchable_ = true;  ///< the prior is not too wide
  Localization state_ = Localization::kUncertain;
  std::optional<MapSearch> search_;
  Pose2 searched_from_;                 ///< where in the newer map the search is about
  std::optional<SearchRegion> region_;  ///< of a prior map
  bool is_kidnapped_ = false;

  /// What a search has found that none has confirmed yet.
  struct Candidate {
    Pose2 in_older;
    Pose2 in_newer;
  };
  std::optional<Candidate> candidate_;
};

}  // namespace datmo

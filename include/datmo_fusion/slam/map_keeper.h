// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/map_drift.h"
#include "datmo_fusion/slam/map_recovery.h"

namespace datmo {

/// A map that was made before, and where in it the vehicle may be when the first scan comes.
struct PriorMap {
  OccupancyMap map;
  SearchRegion start;
};

/// The map that scans are written to and, while the vehicle is searched for in an older one
/// (MapRecovery) or in a prior one, that one too; how far each has drifted, and where the frame of
/// the map lies in that of the first one.
///
/// Of the pose it knows what it is told: in the frame of the map that scans are written to. Where a
/// function begins or returns to another map, it returns the pose from which to go on in that.
class MapKeeper {
 public:
  /// `scale`: of the odometry, whose error the maps inherit. Throws OptionError.
  MapKeeper(const Checked<OccupancyMapOptions>& map, const Checked<MapRecoveryOptions>& recovery,
            const ScalePrior& scale);

  OccupancyMap& map() { return map_; }
  const OccupancyMap& map() const { return map_; }

  /// The map to keep: while the vehicle is not located, the one in which it was.
  const OccupancyMap& lastingMap() const { return recovery_ ? recovery_->older() : map_; }

  /// Throws std::invalid_argument for a map that reaches over more cells than can be searched.
  void setPriorMap(PriorMap prior_map);
  /// The same one as another keeper's, or none.
  void sharePriorMap(const MapKeeper& other) { prior_map_ = other.prior_map_; }
  bool hasPriorMap() const { return prior_map_ != nullptr; }

  /// Begins a map by which the vehicle is searched for in the prior one, from the first scan on.
  PoseWithCovariance startInPriorMap(Stamp stamp);

  /// Whether the vehicle is searched for in an older map.
  bool isSearching() const { return recovery_.has_value(); }
  bool isSearchingPriorMap() const { return recovery_ && recovery_->isInPriorMap(); }
  /// Since it was carried elsewhere.
  bool isSearchingKidnapped() const { return recovery_ && recovery_->isAfterKidnapping(); }
  Localization localization() const {
    return recovery_ ? recovery_->state() : Localization::kLocated;
  }

  /// Leaves the map as it is, and begins a new one at this pose, whose covariance says where in the
  /// map that was left the vehicle may be. Where it was not located yet, the map that it was
  /// searched for by is given up.
  PoseWithCovariance leave(const PoseWithCovariance& pose, Stamp stamp);

  /// The same of a vehicle that was carried elsewhere, if it is not at this pose after all. It must
  /// be located.
  PoseWithCovariance leaveKidnapped(const PoseWithCovariance& pose, Stamp stamp);

  /// To the map that was left: where the vehicle is in it is known again.
  void returnToLeftMap();

  /// What a step of the search has led to.
  struct SearchStep {
    std::optional<PoseWithCovariance> found;  ///< in the older map, which is the map again
    bool gave_up = false;                     ///< the newer map is the map from now on
  };
  /// One step of the search for the vehicle, which is at `pose` in the map; it holds from the next
  /// scan on.
  SearchStep search(const PoseWithCovariance& pose, Stamp stamp);

  /// A pose in the map, in the frame of the first one, with all that gaps left open.
  PoseWithCovariance inFirstMap(PoseWithCovariance pose) const;

  MapDrift& drift() { return drift_; }

  /// Maps that were given up, since the vehicle was not found again in them.
  int mapsBegun() const { return maps_begun_; }

 private:
  PoseWithCovariance searchPriorMap(OccupancyMap whole, const SearchRegion& region, Stamp stamp);
  MapDrift noDrift() const { return {scale_, map_options_.window.cell_size}; }

  OccupancyMapOptions map_options_;
  MapRecoveryOptions recovery_options_;
  ScalePrior scale_;
  OccupancyMap map_;
  std::optional<MapRecovery> recovery_;
  MapDrift drift_;
  MapDrift drift_of_left_map_;                 ///< while recovery_ searches it
  std::shared_ptr<const PriorMap> prior_map_;  ///< its window holds all that is known
  /// Of the map's frame in that of the first map, about the origin.
  Eigen::Matrix3d frame_covariance_ = Eigen::Matrix3d::Zero();
  int maps_begun_ = 0;
};

}  // namespace datmo

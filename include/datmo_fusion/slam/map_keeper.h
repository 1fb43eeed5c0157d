// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/map_drift.h"
#include "datmo_fusion/slam/map_recovery.h"

namespace datmo {

/// A map made before, and where in it the vehicle may be at the first scan.
struct PriorMap {
  OccupancyMap map;
  SearchRegion start;
};

/// The map that is updated with scans and, while the vehicle is searched for in an older map
/// (MapRecovery) or a prior one, that map, too; how far each has drifted, and the pose of the map's
/// frame in the first one.
///
/// It is given poses in the frame of the map that is updated. Functions that start a map or return
/// to one return the pose at which to continue in it.
class MapKeeper {
 public:
  /// `scale`: of the odometry, whose error the maps inherit. Throws OptionError.
  MapKeeper(const Checked<OccupancyMapOptions>& map, const Checked<MapRecoveryOptions>& recovery,
            const ScalePrior& scale);

  /// What continues in another keeper, besides the cells of the map.
  struct State {
    MapDrift::Covariance drift = MapDrift::Covariance::Zero();
    Eigen::Matrix3d frame = Eigen::Matrix3d::Zero();  ///< covariance of the map's frame
    int maps_begun = 0;
  };

  /// Returns the state; none while the vehicle is searched for, or in a map that replaced a prior
  /// one.
  std::optional<State> state() const;

  /// Continues, with the vehicle at this pose in the map, from the state of an earlier keeper with
  /// the same options and the same prior map, if any, before a map is started or left. `window`:
  /// the cells that were in its map's window. Those that had left it are lost, except for a prior
  /// map's.
  void continueFrom(const State& state, const std::vector<CellEvidence>& window,
                    const Pose2& base_in_map);

  OccupancyMap& map() { return map_; }
  const OccupancyMap& map() const { return map_; }

  /// Returns the map to keep: while the vehicle is not located, the one in which it last was.
  const OccupancyMap& lastingMap() const { return recovery_ ? recovery_->older() : map_; }

  /// Throws std::invalid_argument for a map with more cells than can be searched.
  void setPriorMap(PriorMap prior_map);
  /// Uses the same prior map as another keeper, or none.
  void sharePriorMap(const MapKeeper& other) { usePriorMap(other.prior_map_); }
  bool hasPriorMap() const { return prior_map_ != nullptr; }

  /// Starts a map by which the vehicle is searched for in the prior one, from the first scan on.
  PoseWithCovariance startInPriorMap(Stamp stamp);

  /// Whether the vehicle is searched for in an older map.
  bool isSearching() const { return recovery_.has_value(); }
  bool isSearchingPriorMap() const { return recovery_ && recovery_->isInPriorMap(); }
  /// Returns whether this is because it was carried elsewhere.
  bool isSearchingKidnapped() const { return recovery_ && recovery_->isAfterKidnapping(); }
  Localization localization() const {
    return recovery_ ? recovery_->state() : Localization::kLocated;
  }

  /// Leaves the current map unchanged and starts a new one at this pose, whose covariance describes
  /// where in the old map the vehicle may be. If it was not located yet, the map used to search for
  /// it is discarded.
  PoseWithCovariance leave(const PoseWithCovariance& pose, Stamp stamp);

  /// The same for a vehicle that was carried elsewhere, and may not be at this pose. It must be
  /// located.
  PoseWithCovariance leaveKidnapped(const PoseWithCovariance& pose, Stamp stamp);

  /// Limits the search that has just begun to this time (s).
  void endSearchAfter(double seconds) { recovery_->endAfter(seconds); }

  /// Returns to the map that was left, since the vehicle's pose in it is known again.
  void returnToLeftMap();

  /// The result of a search step.
  struct SearchStep {
    std::optional<PoseWithCovariance> found;  ///< in the older map, which becomes the map again,
                                              ///< alone or with the newer map merged into it
    bool gave_up = false;                     ///< the newer map becomes the map
  };
  /// Performs one step of the search for the vehicle, which is at `pose` in the map; the result
  /// applies from the next scan on.
  SearchStep search(const PoseWithCovariance& pose, Stamp stamp);

  /// Transforms a pose in the map to the frame of the first map, with the uncertainty of all gaps.
  PoseWithCovariance inFirstMap(PoseWithCovariance pose) const;

  MapDrift& drift() { return drift_; }

  /// Returns the number of maps given up because the vehicle was not found again in them.
  int mapsBegun() const { return maps_begun_; }

 private:
  void usePriorMap(std::shared_ptr<const PriorMap> prior_map);
  /// Merges the newer map into the older one, where the vehicle, at `in_newer`, is at `in_older`;
  /// how uncertain that is remains in the pose of the frame.
  PoseWithCovariance mergeIntoOlder(const PoseWithCovariance& in_older,
                                    const PoseWithCovariance& in_newer);
  PoseWithCovariance searchPriorMap(OccupancyMap whole, const SearchRegion& region, Stamp stamp);
  MapDrift noDrift() const { return {scale_, map_options_.window.cell_size}; }

  OccupancyMapOptions map_options_;
  MapRecoveryOptions recovery_options_;
  ScalePrior scale_;
  OccupancyMap map_;
  std::optional<MapRecovery> recovery_;
  MapDrift drift_;
  MapDrift drift_of_left_map_;                 ///< while recovery_ searches it
  std::shared_ptr<const PriorMap> prior_map_;  ///< its window covers all known cells
  /// Of the map's frame in that of the first map, about the origin.
  Eigen::Matrix3d frame_covariance_ = Eigen::Matrix3d::Zero();
  int maps_begun_ = 0;
};

}  // namespace datmo

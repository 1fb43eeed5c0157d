// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/map/aging_map.h"
#include "datmo_fusion/fusion/map/map_changes.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// How far the map of one source is to be believed.
struct MapSourceOptions {
  bool use = true;
  double reliability = 1.0;

  void visit(OptionVisitor& visitor);
};

struct MapFuserOptions {
  AgingMapOptions map;  ///< of each source
  MapChangeOptions changes;
  double prior_reliability = 0.7;
  double conflict_from = 0.25;
  double mover_margin = 1.0;                        ///< m
  std::map<std::string, MapSourceOptions> sources;  ///< by name; at first lidar, stereo, mono

  /// Reliabilities of scanner and stereo camera as measured on the simulated data sets 1 to 3: the
  /// depth's error smears what a camera sees, and no number of looks mends that. Those of the low
  /// level (GridFuserOptions) are of single measurements. That of a single camera is not measured.
  MapFuserOptions();

  void visit(OptionVisitor& visitor);

  /// Names of the sources that are in use and to be believed at all.
  std::vector<std::string> sourcesInUse() const;
};

/// The maps of all sources as one; grids in the map's frame.
struct FusedMaps {
  SensorGrid fused;
  SensorGrid conflict;                ///< percent of the evidence that contradicts itself
  int cells_in_conflict = 0;          ///< of at least `conflict_from`
  std::optional<MapChanges> changes;  ///< none without a prior map, or while the pose is uncertain
};

/// Fusion at map level (thesis 2.3.2, named there): each sensor keeps a map of its own, all by one
/// pose, and the maps are fused cell by cell. Sensors need not measure at one time, and one that is
/// silent is still there, as far as its evidence has not aged.
///
/// Each map is discounted by its source's reliability, and the log-odds add up (fuseGrids,
/// kLogOdds): reliability bounds what a source can say however often it looks, and where it is
/// alone, too, for its systematic errors do not average out. A prior map is one more source, which
/// does not age.
///
/// A pose that in one step becomes far more or less certain (by what MapRecoveryOptions calls a
/// gap), or jumps by more than the vehicle's motion, lies elsewhere than the maps: they begin anew.
/// While it is as uncertain, the prior map is left out.
class MapFuser {
 public:
  /// Throws OptionError.
  explicit MapFuser(const Checked<MapFuserOptions>& options);

  /// The map of what was there before; its window must be as that of the grids.
  void setPrior(OccupancyMap prior) { prior_ = std::move(prior); }

  /// Whether the vehicle is known much worse at this pose than at the last one.
  bool isLessCertain(const PoseWithCovariance& base_in_map) const;

  /// The vehicle's pose from now on, for the window and for what take() and fuse() do. `motion`: of
  /// the vehicle since the last pose, as something else than the map knows it; none: nothing does.
  void moveTo(const PoseWithCovariance& base_in_map,
              const std::optional<Pose2>& motion = std::nullopt);

  /// A grid that a source saw from a pose of the vehicle in the map; by rising stamp for each
  /// source, and all of one window, which is that of the maps, about the vehicle. What is occupied
  /// within `mover_margin` of a mover (m, map frame) is left out: the map is of what stands still.
  /// Throws std::out_of_range for a source that is not in use.
  void take(const std::string& source, const SensorGrid& grid, const Pose2& base_in_map,
            const std::vector<Point2>& movers);

  /// None before the first grid.
  std::optional<FusedMaps> fuse(Stamp now);

  /// How often the maps began anew after such a pose, since the start.
  int mapsBegun() const { return maps_begun_; }

  /// Forgets all but the prior map.
  void reset();

 private:
  bool isLocated() const;

  /// Whether the maps do not lie where this pose says.
  bool isElsewhere(const PoseWithCovariance& base_in_map, const std::optional<Pose2>& motion) const;

  MapFuserOptions options_;
  std::map<std::string, std::optional<AgingMap>> maps_;  ///< none before its first grid
  std::optional<OccupancyMap> prior_;
  std::optional<PoseWithCovariance> pose_;
  int maps_begun_ = 0;
};

}  // namespace datmo

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

/// Reliability of one source's map.
struct MapSourceOptions {
  bool use = true;
  double reliability = 1.0;

  void visit(OptionVisitor& visitor);
};

struct MapFuserOptions {
  AgingMapOptions map;  ///< for each source
  MapChangeOptions changes;
  double prior_reliability = 0.7;
  double conflict_from = 0.25;
  double mover_margin = 1.0;                        ///< m
  std::map<std::string, MapSourceOptions> sources;  ///< by name; at first lidar, stereo, mono

  /// The reliabilities of scanner and stereo camera were measured on the simulated data sets 1 to
  /// 3: depth errors smear a camera's map, and repeated observations do not fix that. Those of the
  /// low level (GridFuserOptions) are for single measurements. The single camera's was not
  /// measured.
  MapFuserOptions();

  void visit(OptionVisitor& visitor);

  /// Names of the sources that are in use and have a reliability above 0.
  std::vector<std::string> sourcesInUse() const;
};

/// The fused maps of all sources, in the map's frame.
struct FusedMaps {
  SensorGrid fused;
  SensorGrid conflict;                ///< percent of contradictory evidence
  int cells_in_conflict = 0;          ///< with at least `conflict_from`
  std::optional<MapChanges> changes;  ///< none without a prior map, or while the pose is uncertain
};

/// Fusion at map level (proposed in thesis 2.3.2): each sensor builds its own map, all with the
/// same pose, and the maps are fused cell by cell. Sensors need not measure at the same time, and a
/// silent one still contributes until its evidence has aged.
///
/// Each map is discounted by its source's reliability, and the log odds are summed (fuseGrids,
/// kLogOdds): reliability limits a source's evidence no matter how often it looks, even where it is
/// alone, because its systematic errors do not average out. A prior map is one more source, which
/// does not age.
///
/// If the pose becomes far more or less certain in one step (a gap in the sense of
/// MapRecoveryOptions), or jumps by more than the vehicle's motion, it no longer matches the maps:
/// they are restarted. While it is that uncertain, the prior map is ignored.
class MapFuser {
 public:
  /// Throws OptionError.
  explicit MapFuser(const Checked<MapFuserOptions>& options);

  /// Sets the prior map; its window must match that of the grids.
  void setPrior(OccupancyMap prior) { prior_ = std::move(prior); }

  /// Whether the pose is much less certain than the last one.
  bool isLessCertain(const PoseWithCovariance& base_in_map) const;

  /// Sets the vehicle's current pose, for the window and for add() and fuse(). `motion`: the
  /// vehicle's motion since the last pose, from a source other than the map; none: unknown.
  void moveTo(const PoseWithCovariance& base_in_map,
              const std::optional<Pose2>& motion = std::nullopt);

  /// Integrates a grid that a source observed from `base_in_map`; per source stamps must rise. All
  /// grids must have the same window, that of the maps about the vehicle. Occupied cells within
  /// `mover_margin` of a mover (m, map frame) are ignored: the map represents the static world.
  /// Throws std::out_of_range for a source that is not in use.
  void add(const std::string& source, const SensorGrid& grid, const Pose2& base_in_map,
           const std::vector<Point2>& movers);

  /// Returns none before the first grid.
  std::optional<FusedMaps> fuse(Stamp now);

  /// How often the maps were restarted after such a pose, since construction.
  int mapsBegun() const { return maps_begun_; }

  /// Forgets everything except the prior map.
  void reset();

 private:
  bool isLocated() const;

  /// Whether this pose is inconsistent with the maps.
  bool isElsewhere(const PoseWithCovariance& base_in_map, const std::optional<Pose2>& motion) const;

  MapFuserOptions options_;
  std::map<std::string, std::optional<AgingMap>> maps_;  ///< none before its first grid
  std::optional<OccupancyMap> prior_;
  std::optional<PoseWithCovariance> pose_;
  int maps_begun_ = 0;
};

}  // namespace datmo

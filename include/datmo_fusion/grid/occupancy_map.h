// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/beam_end.h"
#include "datmo_fusion/grid/cell_evidence.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/grid/hit_distribution.h"
#include "datmo_fusion/grid/rolling_grid.h"
#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/grid/tile_store.h"

namespace datmo {

struct OccupancyMapOptions {
  GridWindowOptions window;
  double hit_probability = 0.8;   ///< occupancy of a cell given a beam end in it
  double free_probability = 0.4;  ///< occupancy of a cell given a beam through it
  double min_probability = 0.02;  ///< cells are clamped to this and to 1 - this
  double beam_width = 0.0;        ///< rad, opening angle within which a beam frees space
  double surface_sigma = 0.2;     ///< m, 0: a beam frees every cell that it passes
  BeamEndOptions beam_end;
  double moving_below = 0.3;    ///< occupancy below which a cell counts as seen free
  double static_after = 0.8;    ///< s, between first and last hit of a static cell
  int static_neighborhood = 1;  ///< cells around an end point that can make it static
  int ghost_after = 2;          ///< beam ends refuted by other sensors
  int max_tiles = 2000;         ///< of 32 x 32 cells outside the window, in memory
  TileFileOptions tile_file;    ///< for further tiles

  void visit(OptionVisitor& visitor);
};

/// What a map knows about a cell.
enum class CellState : std::uint8_t {
  kUnknown,  ///< not seen, or not for long enough
  kFree,     ///< seen free
  kStatic,   ///< occupied by something that stands still
};

/// Input for updating the map from an instantaneous grid, all in the vehicle's frame.
struct GridUpdate {
  const SensorGrid* grid = nullptr;   ///< its free cells free those of the map
  std::vector<Point2> surfaces;       ///< m, exact points on static surfaces
  std::vector<Point2> cells;          ///< m, centers of other occupied cells
  std::vector<Point2> movers;         ///< m, beam ends on moving objects
  std::vector<Point2> refuted;        ///< m, beam ends where other sensors saw free space
  Point2 viewpoint = Point2::Zero();  ///< m, where the points were observed from
};

/// The map of static objects: a rolling grid of log-odds occupancy (thesis 3.1.1, eq. 3.1.13).
///
/// Beyond the thesis, each cell also keeps the mean and spread of its hits, so that scans can be
/// matched with subcell accuracy, and the time since it was first hit, so that the trail of a slow
/// mover in unknown space is not mistaken for a wall. Within one scan a cell is updated once, and a
/// hit takes precedence over a passing beam (as in Cartographer, Hess et al. 2016). The map
/// remembers where other sensors refuted the scanner (curbs, road markings), for the time when they
/// no longer look there.
///
/// Cells that leave the window are kept (TileStore) for evidence(). They return to the window only
/// in a map that was restored: while a map is being built, the pose may have drifted since.
class OccupancyMap {
 public:
  /// Throws OptionError, also if there are more cells than fit in memory.
  explicit OccupancyMap(const Checked<OccupancyMapOptions>& options);

  const GridWindow& window() const { return cells_.window(); }

  /// Centers the window on the vehicle's position (m, map frame).
  void centerOn(const Point2& position);

  /// Returns all that is known, inside and outside the window.
  MapEvidence evidence() const;

  /// Returns the same of the window alone.
  MapEvidence windowEvidence() const;

  /// Puts cells back that were in the window of an earlier map with the same options; those outside
  /// this window are left out.
  void recall(const std::vector<CellEvidence>& cells);

  /// Occupancy below which a cell counts as seen free.
  double freeBelow() const { return options_.moving_below; }

  /// Returns the smallest window that contains all known cells; a single cell if there are none.
  GridWindow extent() const;

  /// Creates a map from this evidence, whose cells must have the size given in the options; its
  /// window is the one of the options, about the origin. Throws OptionError.
  static OccupancyMap restored(const Checked<OccupancyMapOptions>& options,
                               const MapEvidence& evidence);

  /// Adds what another map of the same cell size, whose frame is at `other_in_map`, knows about the
  /// window, as if it had been seen independently: occupied cells move with the mean of their hits,
  /// and take precedence over free ones. What lies outside of this map's window is left out.
  void merge(const OccupancyMap& other, const Pose2& other_in_map);

  /// Changes the window, of at least one cell and the same cell size, without losing knowledge.
  void setWindow(const GridWindow& window);

  /// Number of tiles of 32 x 32 cells missing in evidence(), because there was no room for them in
  /// memory or in the file; tileFileError() tells why the file had none.
  std::size_t forgottenTiles() const { return outside_.forgotten(); }
  std::string tileFileError() const { return outside_.fileError(); }

  /// Returns the occupancy probability of a cell, 0 to 1; 0.5 if nothing is known.
  double occupancy(CellIndex cell) const {
    return static_cast<double>(cells_.atOrEmpty(cell).occupancy);
  }

  /// Returns the sum of the occupancies of the first `count` (at most kMany) of many cells, of
  /// which those outside the window count as unknown.
  template <std::size_t kMany>
  double occupancySum(const std::array<int, kMany>& columns, const std::array<int, kMany>& rows,
                      std::size_t count) const {
    const std::array<unsigned, kMany> indices = cells_.indicesOf(columns, rows);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      sum += static_cast<double>(cells_.atIndex(indices[i]).occupancy);
    }
    return sum;
  }

  /// Returns the state of a beam end at this point (m) in the map (thesis 3.3.1; there without
  /// kUnknown, footprint, neighborhood and age). `half_footprint`: from the beam's axis to its edge
  /// at this range, m; the hit may lie anywhere in between. A single static cell within the
  /// footprint makes the point static; it is moving only if the whole footprint was seen free.
  PointState judge(const Point2& point, const Point2& half_footprint = Point2::Zero()) const;

  /// Returns whether the beam passed through a static surface, which would have ended it in front
  /// of its hit.
  bool seesThrough(const Ray& ray, const Pose2& base_in_map) const;

  /// Returns the state of a cell; unknown outside the window.
  CellState stateOf(CellIndex cell) const;

  /// Returns the means of the hits in static cells, m, row by row from the lower left corner.
  std::vector<Point2> staticSurfaces() const;

  /// Returns the hits in the occupied ones of the 3 x 3 cells around a point; none if there are
  /// none.
  std::optional<HitDistribution> hitsAround(const Point2& point) const;

  /// Returns the hits of the one of these cells whose mean is nearest to the point.
  std::optional<HitDistribution> nearestHits(const Point2& point) const;

  /// Integrates a scan taken from `base_in_map`: space along its beams is free; their ends are
  /// occupied, except those with state kMoving. `states` holds one state per ray of the scan, in
  /// order; states of rays without a hit are ignored.
  void update(const Scan& scan, const std::vector<PointState>& states, const Pose2& base_in_map);

  /// Integrates an instantaneous grid taken from `base_in_map` (thesis 3.2.5, eq. 3.2.7), as the
  /// scan above but with cells instead of beams. Its exact points locate surfaces within their
  /// cells, so that scans can be matched with them; its other cells are only marked as occupied.
  void update(const GridUpdate& grid_update, const Pose2& base_in_map);

  /// Returns the occupancy row by row from the lower left corner: 0 to 100 percent, -1 if nothing
  /// is known (nav_msgs/OccupancyGrid).
  std::vector<std::int8_t> occupancyImage() const;

 private:
  /// Maximum number of hits in a cell, so that its surface follows recent measurements.
  static constexpr float kMaxHits = 50.0F;

  struct Cell {
    float log_odds = 0.0F;
    float occupancy = 0.5F;     ///< of log_odds; read far more often than changed
    std::uint32_t updated = 0;  ///< number of the last update of this cell; 0: never
    float freed = 0.0F;         ///< share of free_log_odds_ already added in this update
    float first_hit = 0.0F;     ///< s since the first update; of the current occupant
    float last_hit = 0.0F;
    float mean_hit = 0.0F;  ///< of the hits below
    int refuted = 0;        ///< beam ends here that other sensors refuted
    int believed = 0;       ///< other beam ends here, counted since there are fused grids
    CellHits hits;
  };

  static bool isKnown(const Cell& cell) { return cell.updated != 0; }
  static bool isOccupied(const Cell& cell) { return cell.log_odds > 0.0F; }

  /// Whether the hits in a cell represent a surface.
  static bool hasSurface(const Cell& cell) { return isOccupied(cell) && cell.hits.count > 0.0F; }

  /// Calls `visit(CellIndex, const Cell&)` for each known cell of the window.
  template <typename Visit>
  void forEachKnownInWindow(Visit&& visit) const;
  /// The same for each known cell, inside and outside the window.
  template <typename Visit>
  void forEachKnown(Visit&& visit) const;
  static CellEvidence evidenceOf(CellIndex index, const Cell& cell);
  /// Returns the cell for saved evidence, as if last hit now.
  Cell cellOf(const CellEvidence& known) const;

  /// The parts of merge(): a cell that the other map has seen occupied, whose times are later by
  /// `delay` (s) here, and those it has seen free, where nothing occupied was merged.
  void mergeOccupied(const Cell& from, const Point2& center, const Pose2& other_in_map,
                     float delay);
  void mergeFree(const OccupancyMap& other, const Pose2& other_in_map);
  void beginUpdate(Stamp stamp);
  void change(Cell& cell, float log_odds_step) const;
  /// Marks a cell as occupied in this update; null if it is not in the window.
  Cell* occupy(CellIndex index);
  void hit(const Point2& point);
  void pass(CellIndex cell, const Point2& from, const Point2& direction);

  /// How strongly a beam through a cell is evidence against the surface in it, 0 to 1.
  float contradiction(const Cell& cell, CellIndex index, const Point2& from,
                      const Point2& direction) const;
  void passBeam(const Ray& ray, const Pose2& base_in_map);
  bool isStatic(const Cell& cell) const;
  bool isGhost(const Cell& cell) const;

  /// Time between a cell's first and last hit as a share of static_after, 0 to 1.
  double maturity(const Cell& cell) const {
    const double age = cell.last_hit - cell.first_hit;
    return age >= options_.static_after ? 1.0 : age / options_.static_after;
  }

  /// Calls `visit(cell, index)` for each of the 3 x 3 cells around a point that has a surface.
  template <typename Visit>
  void forEachSurfaceAround(const Point2& point, Visit&& visit) const;

  /// Whether `test(cell)` holds for a cell or one within static_neighborhood.
  template <typename Test>
  bool anyNear(CellIndex cell, Test&& test) const;

  OccupancyMapOptions options_;
  float hit_log_odds_;
  float free_log_odds_;
  float log_odds_limit_;
  RollingGrid<Cell> cells_;
  TileStore<Cell> outside_;
  bool is_restored_ = false;
  std::uint32_t update_ = 0;
  std::optional<Stamp> first_stamp_;
  float now_ = 0.0F;  ///< s since the first update
};

}  // namespace datmo

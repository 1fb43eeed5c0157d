// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  double hit_probability = 0.8;   ///< of a cell in which a beam ends
  double free_probability = 0.4;  ///< of a cell that a beam passes
  double min_probability = 0.02;  ///< to which a cell is clamped; 1 - it at the other end
  double beam_width = 0.0;        ///< rad, in which a beam is free up to its end
  double surface_sigma = 0.2;     ///< m, 0: a beam frees each cell that it passes
  BeamEndOptions beam_end;
  double moving_below = 0.3;    ///< occupancy that counts as seen free
  double static_after = 0.8;    ///< s, between first and last hit of a static cell
  int static_neighborhood = 1;  ///< cells around an end point that vouch for it
  int ghost_after = 2;          ///< ends that others have refuted
  int max_tiles = 2000;         ///< of 32 x 32 cells outside of the window, in memory
  TileFileOptions tile_file;    ///< for those beyond

  void visit(OptionVisitor& visitor);
};

/// What a map knows of a cell.
enum class CellState : std::uint8_t {
  kUnknown,  ///< not seen, or not for long enough
  kFree,     ///< seen free
  kStatic,   ///< occupied by what stands still
};

/// What the map is updated with from an instantaneous grid, all in the vehicle's frame.
struct GridUpdate {
  const SensorGrid* grid = nullptr;   ///< its free cells are free
  std::vector<Point2> surfaces;       ///< m, exact points on surfaces that stand still
  std::vector<Point2> cells;          ///< m, centers of further cells that are occupied
  std::vector<Point2> movers;         ///< m, ends of beams on what moves
  std::vector<Point2> refuted;        ///< m, ends of beams where others have seen nothing
  Point2 viewpoint = Point2::Zero();  ///< m, from where they were seen
};

/// The map of what stands still: a rolling grid of log-odds occupancy (thesis 3.1.1, eq. 3.1.13).
///
/// Beyond the thesis, each cell also keeps the mean and spread of the hits in it, so that a scan
/// can be matched below the size of a cell, and since when it has been hit, so that the trail of a
/// slow mover in unknown space is not mistaken for a wall. Within one scan a cell is updated once,
/// and a hit wins over a beam that passes (as in Cartographer, Hess et al. 2016). Where other
/// sensors have refuted the scanner (curbs, paint on the road) it is remembered for when they look
/// elsewhere.
///
/// What leaves the window is kept (TileStore) for evidence(). It comes back into the window only in
/// a map that was restored: in one that is being made, the pose may have drifted since.
class OccupancyMap {
 public:
  /// Throws OptionError, also for more cells than any memory holds.
  explicit OccupancyMap(const Checked<OccupancyMapOptions>& options);

  const GridWindow& window() const { return cells_.window(); }

  /// Moves the window with the vehicle (m, map frame).
  void centerOn(const Point2& position);

  /// All that is known, within the window and outside of it.
  MapEvidence evidence() const;

  /// Occupancy below which a cell counts as seen free.
  double freeBelow() const { return options_.moving_below; }

  /// The smallest window that holds all that is known; of one cell if nothing is.
  GridWindow extent() const;

  /// A map of this evidence, whose cells have the size that the options say, with the window that
  /// they say about the origin. Throws OptionError.
  static OccupancyMap restored(const Checked<OccupancyMapOptions>& options,
                               const MapEvidence& evidence);

  /// The same knowledge through another window, of at least one cell and of the same cell size.
  void setWindow(const GridWindow& window);

  /// Tiles of 32 x 32 cells that evidence() lacks, since there was no room for them, neither in
  /// memory nor in the file; and why the file had none.
  std::size_t forgottenTiles() const { return outside_.forgotten(); }
  std::string tileFileError() const { return outside_.fileError(); }

  /// Occupancy probability of a cell, 0 to 1; 0.5 where nothing is known.
  double occupancy(CellIndex cell) const {
    return static_cast<double>(cells_.atOrEmpty(cell).occupancy);
  }

  /// State in the map of a beam that ends at this point, m (thesis 3.3.1; there without kUnknown,
  /// footprint, neighborhood and age). `half_footprint`: from the beam's axis to its edge at this
  /// range, m; what it hit may lie anywhere between. One static cell there makes the point static;
  /// it is moving only if the whole footprint has been seen free.
  PointState judge(const Point2& point, const Point2& half_footprint = Point2::Zero()) const;

  /// Whether the beam has passed through a static surface: something that is known to stand there
  /// would have ended it, in front of whatever it hit.
  bool seesThrough(const Ray& ray, const Pose2& base_in_map) const;

  /// Also for cells outside of the window, which are unknown.
  CellState stateOf(CellIndex cell) const;

  /// Means of the hits in the static cells, m, row by row from the lower left corner.
  std::vector<Point2> staticSurfaces() const;

  /// Hits in the 3 x 3 occupied cells around a point; none where there are no occupied ones.
  std::optional<HitDistribution> hitsAround(const Point2& point) const;

  /// Hits of that one of these cells whose mean is nearest to the point.
  std::optional<HitDistribution> nearestHits(const Point2& point) const;

  /// Takes in a scan seen from `base_in_map`: its beams are free up to their ends; ends are
  /// occupied but for those whose state is kMoving. `states` holds a state for each ray of the
  /// scan, in order; those of beams without a hit are not read.
  void update(const Scan& scan, const std::vector<PointState>& states, const Pose2& base_in_map);

  /// Takes in an instantaneous grid seen from `base_in_map` (thesis 3.2.5, eq. 3.2.7), as the scan
  /// above with its cells in place of beams. Its exact points give where surfaces lie within their
  /// cells, so that scans can be matched with them; its other cells are occupied and no more.
  void update(const GridUpdate& grid_update, const Pose2& base_in_map);

  /// Row by row from the lower left corner: 0 to 100 percent, -1 where nothing is known
  /// (nav_msgs/OccupancyGrid).
  std::vector<std::int8_t> occupancyImage() const;

 private:
  struct Cell {
    float log_odds = 0.0F;
    float occupancy = 0.5F;     ///< of log_odds; read far more often than changed
    std::uint32_t updated = 0;  ///< number of the update that touched it last; 0: never
    float freed = 0.0F;         ///< share of free_log_odds_ that this update has given it
    float first_hit = 0.0F;     ///< s since the first update; of the present occupant
    float last_hit = 0.0F;
    float mean_hit = 0.0F;  ///< of the hits below
    int refuted = 0;        ///< ends of beams here that others have refuted
    int believed = 0;       ///< other ends of beams here, since there are fused grids
    CellHits hits;
  };

  static bool isKnown(const Cell& cell) { return cell.updated != 0; }
  static bool isOccupied(const Cell& cell) { return cell.log_odds > 0.0F; }

  /// Whether the hits in a cell stand for a surface.
  static bool hasSurface(const Cell& cell) { return isOccupied(cell) && cell.hits.count > 0.0F; }

  /// `visit(CellIndex, const Cell&)` for each known cell, within the window and outside of it.
  template <typename Visit>
  void forEachKnown(Visit&& visit) const;

  void beginUpdate(Stamp stamp);
  void change(Cell& cell, float log_odds_step) const;
  /// The cell has an occupant in this update; null if it is not in the window.
  Cell* occupy(CellIndex index);
  void hit(const Point2& point);
  void pass(CellIndex cell, const Point2& from, const Point2& direction);

  /// How far a beam through a cell is evidence against the surface in it, 0 to 1.
  float contradiction(const Cell& cell, CellIndex index, const Point2& from,
                      const Point2& direction) const;
  void passBeam(const Ray& ray, const Pose2& base_in_map);
  bool isStatic(const Cell& cell) const;
  bool isGhost(const Cell& cell) const;

  /// How much of static_after lies between a cell's first and last hit, 0 to 1.
  double maturity(const Cell& cell) const {
    const double age = cell.last_hit - cell.first_hit;
    return age >= options_.static_after ? 1.0 : age / options_.static_after;
  }

  /// `visit(cell, index)` for each of the 3 x 3 cells around a point that has a surface.
  template <typename Visit>
  void forEachSurfaceAround(const Point2& point, Visit&& visit) const;

  /// Whether `test(cell)` holds for a cell or one of those around it that vouch for it.
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

// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/passage_grid.h"

#include "datmo_fusion/grid/ray_walk.h"

namespace datmo {

PassageGridOptions::PassageGridOptions() {
  window.length = 90.0;
  window.width = 90.0;
  window.cell_size = 0.5;
}

void PassageGridOptions::visit(OptionVisitor& visitor) {
  visitor.group(
      "window", [&] { window.visit(visitor); }, Tier::kExpert);
  visitor.integer({"min_hits", "1", "minimum number of beams that end in a cell that is not free"},
                  min_hits, {1, 1000});
  visitor.number({"end_margin", "m",
                  "distance before the end of a beam in which it does not free cells: noise of its "
                  "range, and the cell's size"},
                 end_margin, {0.0, 10.0});
  visitor.integer({"max_beams", "1",
                   "maximum number of beams that a cell counts; beyond it, the older half is "
                   "forgotten, since obstacles may leave"},
                  max_beams, {2, 1000000});
}

PassageGrid::PassageGrid(const Checked<PassageGridOptions>& options)
    : options_(*options), cells_(options->window.window(), Cell{}) {}

void PassageGrid::update(const BorderScan& scan) {
  const Point2 from = scan.scanner.position();
  cells_.centerOn(from);
  for (const BorderScan::Beam& beam : scan.beams) {
    const Point2 ray = beam.end - from;
    const double free = ray.norm() - (beam.hit ? options_.end_margin : 0.0);
    if (free > 0.0) {
      walkRay(cells_.window(), from, from + free * ray.normalized(),
              [this](CellIndex cell) { count(cell, 0, 1); });
    }
    if (beam.hit) {
      count(cells_.window().cellAt(beam.end), 1, 0);
    }
  }
}

void PassageGrid::count(CellIndex index, int hits, int passages) {
  if (!cells_.window().contains(index)) {
    return;
  }
  Cell& cell = cells_.at(index);
  cell.hits += hits;
  cell.passages += passages;
  if (cell.hits + cell.passages > options_.max_beams) {
    cell.hits /= 2;
    cell.passages /= 2;
  }
}

PassageGrid::State PassageGrid::at(const Point2& point) const {
  const Cell& cell = cells_.atOrEmpty(cells_.window().cellAt(point));
  const int beams = cell.hits + cell.passages;
  if (cell.hits >= options_.min_hits && cell.hits > options_.hit_share * beams) {
    return State::kOccupied;
  }
  return cell.passages > 0 ? State::kFree : State::kUnknown;
}

void PassageGrid::reset() { cells_ = RollingGrid<Cell>(options_.window.window(), Cell{}); }

}  // namespace datmo

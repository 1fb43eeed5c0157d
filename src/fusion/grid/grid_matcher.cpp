// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_matcher.h"

#include <memory>
#include <utility>

namespace datmo {

std::string describe(const GridWindow& window) {
  return std::to_string(window.columns) + " x " + std::to_string(window.rows) + " cells of " +
         toText(OptionValue(window.cell_size)) + " m from cell (" +
         std::to_string(window.corner.column) + ", " + std::to_string(window.corner.row) + ")";
}

GridMatcher::GridMatcher(const SourceMatcherOptions& options,
                         const std::vector<std::string>& sources)
    : reference_(options.reference), matcher_(options, sources, Serving::kOften) {}

void GridMatcher::reset() {
  matcher_.reset();
  window_.reset();
}

void GridMatcher::checkWindow(const std::string& source, const GridWindow& window) {
  if (window_ && *window_ != window) {
    if (source != reference_) {
      throw WrongWindowError("window of " + source + ": " + describe(window) +
                             ", expected that of the other grids: " + describe(*window_));
    }
    matcher_.forgetSamples();
  }
  window_ = window;
}

void GridMatcher::add(const std::string& source, SensorGrid grid) {
  matcher_.checkSource(source);
  checkWindow(source, grid.window());
  const Stamp stamp = grid.stamp();
  matcher_.add(source, stamp, std::make_shared<const SensorGrid>(std::move(grid)));
}

}  // namespace datmo

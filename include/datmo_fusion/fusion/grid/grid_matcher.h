// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "datmo_fusion/fusion/sync/source_matcher.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

using MatchedGrid = SourceSample<SensorGrid>;
using MatchedGrids = MatchedSamples<SensorGrid>;

/// Thrown for a grid with another window than those it is to be matched with; the message names
/// both.
class WrongWindowError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// For messages: "300 x 360 cells of 0.3 m from cell (-150, -180)".
std::string describe(const GridWindow& window);

/// Matches grids of several sources that have the same window and belong together in time
/// (SourceMatcher). A grid may be in several sets: it remains the best knowledge until a newer one
/// arrives.
class GridMatcher {
 public:
  /// `sources`: the names of all possible publishers. Throws OptionError, also if the reference is
  /// not one of them.
  GridMatcher(const SourceMatcherOptions& options, const std::vector<std::string>& sources);

  /// Adds a grid; one that is not newer than the last of its source is ignored.
  ///
  /// Throws WrongWindowError if the window differs from the reference's (before the reference's
  /// first grid: from that of the first grid), and std::invalid_argument for an unknown source. If
  /// the reference itself has a new window, all waiting grids are dropped.
  void add(const std::string& source, SensorGrid grid);

  /// Returns the next set, by rising stamp (SourceMatcher::next).
  std::optional<MatchedGrids> next(Stamp now) { return matcher_.next(now); }

  /// Forgets everything; call it when the clock has jumped back.
  void reset();

 private:
  void checkWindow(const std::string& source, const GridWindow& window);

  std::string reference_;
  SourceMatcher<SensorGrid> matcher_;
  std::optional<GridWindow> window_;
};

}  // namespace datmo

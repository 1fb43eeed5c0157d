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

/// A grid of another window than those that it is to be matched with; the message names both.
class WrongWindowError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// For messages: "300 x 360 cells of 0.3 m from cell (-150, -180)".
std::string describe(const GridWindow& window);

/// Which grids of several sources belong together: those of one window that SourceMatcher says
/// belong together in time. A grid may be in several sets: it is what is known of the world until
/// there is a newer one.
class GridMatcher {
 public:
  /// `sources`: the names of all that may publish. Throws OptionError, also if the reference is not
  /// one of them.
  GridMatcher(const SourceMatcherOptions& options, const std::vector<std::string>& sources);

  /// One more grid; one that is not newer than the last of its source is left out.
  ///
  /// Throws WrongWindowError for a window that is not the reference's (before that has spoken: not
  /// the first one's), and std::invalid_argument for a source that there is not. If the reference
  /// itself comes with a new window, what waits is forgotten.
  void add(const std::string& source, SensorGrid grid);

  /// The next set, by rising stamp (SourceMatcher::next).
  std::optional<MatchedGrids> next(Stamp now) { return matcher_.next(now); }

  /// Forgets all: the clock has jumped back.
  void reset();

 private:
  void checkWindow(const std::string& source, const GridWindow& window);

  std::string reference_;
  SourceMatcher<SensorGrid> matcher_;
  std::optional<GridWindow> window_;
};

}  // namespace datmo

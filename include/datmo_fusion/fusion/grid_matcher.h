#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

struct GridMatcherOptions {
  std::string reference = "lidar";
  double tolerance = 0.1;     ///< s
  double longest_wait = 0.1;  ///< s
  double silent_after = 0.5;  ///< s

  void visit(OptionVisitor& visitor);
};

/// What one source said, at its own stamp.
struct MatchedGrid {
  std::string source;
  std::shared_ptr<const SensorGrid> grid;
};

enum class WhyMissing {
  kSilent,    ///< it has said nothing for `silent_after`
  kNoneNear,  ///< it speaks, but had nothing within `tolerance` when it was asked
  kNoMotion,  ///< it had, but how the vehicle moved in between is not known
};

/// "silent", "none near", "no motion".
const char* toText(WhyMissing why);

struct MissingSource {
  std::string source;
  WhyMissing why = WhyMissing::kSilent;
};

/// What belongs together: the reference's grid first, then the others by name.
struct MatchedGrids {
  std::vector<MatchedGrid> grids;      ///< at least one
  std::vector<MissingSource> missing;  ///< by name

  const MatchedGrid& reference() const { return grids.front(); }
  Stamp stamp() const { return reference().grid->stamp(); }
};

/// A grid of another window than those that it is to be matched with; the message names both.
class WrongWindowError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Which grids of several sources belong together in time. Each grid of the reference source leads
/// to one set, as soon as every other live source has spoken of its stamp or a later one, or after
/// `longest_wait`; of each other source the grid nearest in time is in the set, of two equally near
/// ones the earlier. While the reference is silent the next live source by name takes its place;
/// it has it back when it speaks again.
///
/// Silence counts from a source's last stamp; before its first, from the first stamp of any. Pure
/// data time: what comes out hangs on what is put in, and on nothing else.
class GridMatcher {
 public:
  /// `sources`: the names of all that may speak. Throws OptionError, also if the reference is not
  /// one of them.
  GridMatcher(const GridMatcherOptions& options, const std::vector<std::string>& sources);

  /// One more grid; one that is not newer than the last of its source is left out.
  ///
  /// Throws WrongWindowError for a window that is not the reference's (before that has spoken: not
  /// the first one's), and std::invalid_argument for a source that there is not. If the reference
  /// itself comes with a new window, what waits is forgotten.
  void add(const std::string& source, SensorGrid grid);

  /// The next set, by rising stamp; none if nothing is ready. To be asked until there is none.
  /// `now`: time of the data, the newest stamp that the caller has seen.
  std::optional<MatchedGrids> next(Stamp now);

  /// Forgets all: the clock has jumped back.
  void reset();

 private:
  struct Source {
    std::deque<std::shared_ptr<const SensorGrid>> grids;  ///< rising stamps; the last ones
  };
  using Entry = std::map<std::string, Source>::value_type;

  bool isSilent(const Source& source, Stamp now) const;
  /// The source whose grids lead to sets at this time; null: all are silent.
  const Entry* leader(Stamp now) const;
  /// The leader's oldest grid that has not led to a set; null if there is none.
  std::shared_ptr<const SensorGrid> pending(const Source& source) const;
  bool isComplete(Stamp stamp, Stamp now) const;
  MatchedGrids match(const Entry& leader, std::shared_ptr<const SensorGrid> grid, Stamp now) const;
  void checkWindow(const std::string& source, const GridWindow& window);

  GridMatcherOptions options_;
  std::map<std::string, Source> sources_;
  std::optional<GridWindow> window_;
  std::optional<Stamp> first_;    ///< of all grids since the last reset
  std::optional<Stamp> matched_;  ///< of the last set
};

}  // namespace datmo

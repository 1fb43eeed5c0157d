#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/fusion/grid_fuser.h"
#include "datmo_fusion/fusion/grid_matcher.h"
#include "datmo_fusion/ros/input_error.h"
#include "datmo_fusion/ros/motion_input.h"
#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

struct GridFusionStageOptions {
  std::string base_frame = "base_link";
  MotionInputOptions motion;
  StreamOptions input;
  GridMatcherOptions matcher;
  GridFuserOptions fuser;

  void visit(OptionVisitor& visitor);
};

/// What one set of grids led to, ready to be published.
struct GridFusionOutput {
  nav_msgs::OccupancyGridPtr fused;
  nav_msgs::OccupancyGridPtr conflict;
};

/// GridMatcher and GridFuser between messages: the same ones serve the nodelet and the bag runner.
///
/// Bad input is dropped through the monitor, never thrown. A source that falls silent is said once
/// until it is fused again, and so is one that for as long is always too late or whose motion is
/// not known; the fused grids go on with the others. When the clock jumps back all state is
/// forgotten.
///
/// The reference's stamps are the ones that hold: while it speaks, a grid of another source that is
/// ahead of them by more than `silent_after` is dropped (`stamp_ahead`), for a clock that is ahead
/// would make the reference look silent.
///
/// Time is the data's: that of the newest grid, and from its arrival on as much later as the
/// caller's clock says. So the two clocks need not agree.
class GridFusionStage {
 public:
  /// `monitor` must outlive the stage. Throws OptionError.
  GridFusionStage(const GridFusionStageOptions& options, StageMonitor& monitor);

  /// The sources in use, by name.
  std::vector<std::string> sources() const { return options_.fuser.sourcesInUse(); }

  /// One grid of a source (else it is dropped: `unknown_source`). `now`: ROS time.
  void takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& message, Stamp now);

  /// Newest odometry; not read where the options say that the vehicle has none.
  void takeOdometry(const nav_msgs::Odometry& message);

  /// Newest pose of the SLAM; read only where the options say that the vehicle has no odometry.
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// The next set of grids that is ready, fused; none if there is none. To be asked until there is
  /// none, after each grid and from time to time: nobody knows before whether one that is waited
  /// for still comes. `now`: ROS time.
  std::optional<GridFusionOutput> next(Stamp now);

  /// The rule by its name, from the next set on. Throws OptionError for a name that there is not.
  void setRule(const std::string& name) { fuser_.setRule(fusionRule(name)); }

 private:
  /// A grid's arrival; `came`: on the caller's clock.
  struct Arrived {
    Stamp stamp;
    Stamp came;
  };

  /// Of a source that the last set was without.
  struct Absence {
    Stamp since;                ///< stamp of the first set without it
    std::set<WhyMissing> said;  ///< reasons that have been warned of
  };

  /// Throws InputError.
  SensorGrid gridOf(const std::string& source, const nav_msgs::OccupancyGrid& message, Stamp now);
  void checkAhead(const std::string& source, Stamp stamp, Stamp now) const;
  void add(const std::string& source, SensorGrid grid);

  template <typename Message>
  void takeMotion(const Message& message);

  void restart();
  static Stamp dataTime(const Arrived& last, Stamp now);
  void report(const FusionResult& result);
  InputError warningOf(const MissingSource& missing) const;

  GridFusionStageOptions options_;
  StageMonitor& monitor_;
  GridMatcher matcher_;
  GridFuser fuser_;
  MotionInput motion_;
  std::map<std::string, StampCheck> stamps_;  ///< by source
  std::optional<Arrived> newest_;
  std::optional<Arrived> reference_;                   ///< the newest of the reference
  std::map<std::string, Absence> absences_;            ///< by source
  std::map<std::string, std::uint64_t> times_missed_;  ///< sets without this source
};

}  // namespace datmo

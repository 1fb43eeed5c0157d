// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/vision/point_velocity.h"

namespace datmo {

struct VelocityWaitOptions {
  double max_wait = 0.1;      ///< s
  double silent_after = 0.5;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Brings the objects of a cloud and the points with velocity of its stamp together, whichever come
/// first. Objects are waited for by nobody but these points: where none have come for
/// `silent_after`, or ever, they go on at once.
///
/// Objects wait until the points of their stamp come, or those of a later one, which tell that
/// there are none; `max_wait` at most, by the stamps of later objects and by the clock of the
/// caller. A bounded number waits, of both. What goes on without is warned of (`no_velocities`),
/// what comes too late or has no cloud is dropped through the monitor (`late_velocities`,
/// `velocities_without_cloud`).
///
/// What comes out depends on stamps, order and the caller's clock alone.
class VelocityWait {
 public:
  /// Objects of one stamp, with the points of that stamp if there are any.
  struct Served {
    ObjectList list;
    double seconds = 0.0;  ///< as they were added
    std::optional<std::vector<PointVelocity>> points;
  };

  /// `monitor` must outlive it. Throws OptionError.
  VelocityWait(const Checked<VelocityWaitOptions>& options, StageMonitor& monitor);

  /// By rising stamp.
  void addPoints(Stamp stamp, std::vector<PointVelocity> points);

  /// By rising stamp. `seconds`: that they took, which comes out again.
  void addObjects(ObjectList list, double seconds);

  /// The oldest objects if they need not wait, by what has come; none if they do, or there are
  /// none.
  std::optional<Served> next();

  /// The same if they have waited for long enough by a clock: `now`, the same at each call or
  /// later.
  std::optional<Served> next(Stamp now);

  void clear();

 private:
  struct Points {
    Stamp stamp;
    std::vector<PointVelocity> points;
  };
  struct Waiting {
    ObjectList list;
    double seconds = 0.0;
    bool waits = false;          ///< somebody publishes points
    std::optional<Stamp> since;  ///< by the caller's clock
  };

  bool speaks(Stamp now) const;
  bool mayGoOn(const Waiting& waiting) const;
  Served serveOldest();

  VelocityWaitOptions options_;
  StageMonitor& monitor_;
  std::deque<Points> points_;    ///< rising stamps, after those of the last objects served
  std::deque<Waiting> waiting_;  ///< rising stamps
  std::optional<Stamp> newest_;  ///< of all points
  std::optional<Stamp> served_;  ///< of the last objects
};

}  // namespace datmo

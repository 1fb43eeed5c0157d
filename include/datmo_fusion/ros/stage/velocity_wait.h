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

/// Matches the objects of a cloud with the points with velocity of its stamp, in either order of
/// arrival. Objects wait only for these points: if none were received for `silent_after`, or ever,
/// the objects pass at once.
///
/// Objects wait until the points of their stamp are received, or those of a later one, which means
/// that there are none; at most `max_wait`, by the stamps of later objects and by the caller's
/// clock. The numbers of waiting objects and points are bounded. Objects that pass without points
/// cause a warning (`no_velocities`); points that are too late or have no cloud are dropped and
/// reported to the monitor (`late_velocities`, `velocities_without_cloud`).
///
/// The output depends only on stamps, order and the caller's clock.
class VelocityWait {
 public:
  /// Objects of one stamp, with the points of that stamp if there are any.
  struct Served {
    ObjectList list;
    double seconds = 0.0;  ///< as passed to addObjects
    std::optional<std::vector<PointVelocity>> points;
  };

  /// `monitor` must outlive it. Throws OptionError.
  VelocityWait(const Checked<VelocityWaitOptions>& options, StageMonitor& monitor);

  /// Adds points; stamps must rise.
  void addPoints(Stamp stamp, std::vector<PointVelocity> points);

  /// Adds objects; stamps must rise. `seconds`: their processing time, which is returned with them.
  void addObjects(ObjectList list, double seconds);

  /// Returns the oldest objects if they need not wait, according to the received data; none if they
  /// must wait, or there are none.
  std::optional<Served> next();

  /// The same, also if they have waited long enough by a clock: `now` must not decrease from call
  /// to call.
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
    bool waits = false;          ///< points are being published
    std::optional<Stamp> since;  ///< on the caller's clock
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

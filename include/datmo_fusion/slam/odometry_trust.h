// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

struct OdometryTrustOptions {
  double window = 1.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Whether odometry tells the vehicle's motion, or not: frozen, late, of other wheels.
///
/// From one scan to the next odometry that is wrong is hardly to be told from one that is right,
/// and the match follows it. So the pose is carried on over a window by the scans alone, as if
/// there were no odometry, and by odometry alone, as if there were no scans; where both cannot be
/// of one vehicle (the innovation test of Bar-Shalom, Li & Kirubarajan, 2001, 5.4), odometry is not
/// followed until they have agreed for a window.
class OdometryTrust {
 public:
  /// Throws OptionError.
  explicit OdometryTrust(const Checked<OdometryTrustOptions>& options) : options_(*options) {}

  /// From this state of the vehicle on, unless a window has begun already.
  void observeFrom(Stamp stamp, const PoseFilter& vehicle);

  /// The vehicle's state is another for a reason of its own: what was observed is void.
  void interrupt() { window_.reset(); }

  /// To the next scan: by odometry alone by this motion, and by scans alone. After observeFrom().
  void predict(const Pose2& motion, double seconds);

  /// The vehicle by the scans alone; the caller corrects it by the scan. After observeFrom().
  PoseFilter& byScans() { return window_->by_scans; }

  /// After that. `scans_fit_better`: than where odometry has the vehicle, surely; else it is the
  /// scans that were followed wrongly. Asked only where both contradict each other.
  void judge(Stamp stamp, const std::function<bool()>& scans_fit_better);

  /// After judge(): the window ends if it is over.
  void endWindow(Stamp stamp);

  bool isTrusted() const { return is_trusted_; }

  /// Squared Mahalanobis distance of both at the last scan.
  double contradiction() const { return contradiction_; }

 private:
  struct Window {
    Stamp begun;
    PoseFilter by_scans;
    PoseFilter by_odometry;
  };

  OdometryTrustOptions options_;
  std::optional<Window> window_;
  std::optional<Stamp> contradicted_;  ///< last
  bool is_trusted_ = true;
  double contradiction_ = 0.0;
};

}  // namespace datmo

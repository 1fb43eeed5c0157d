// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/risk/risk.h"

namespace datmo {

/// When a driver is warned.
struct WarningOptions {
  double information_probability = 0.3;  ///< 1
  double warning_probability = 0.6;      ///< 1
  double warning_time = 1.4;             ///< s
  double warning_ttc = 1.9;              ///< s
  double imminent_time = 0.3;            ///< s
  double raise_time = 0.1;               ///< s
  double hold_time = 0.8;                ///< s
  double release = 0.7;                  ///< 1

  void visit(OptionVisitor& visitor);
};

/// The level that one object asks for. A warning needs both: contact is likelier than
/// `warning_probability`, and the time to brake ends within `warning_time` or contact comes within
/// `warning_ttc`, or every parked car in a bend would warn. Braking must help: of who is struck
/// from behind, or stands, the driver is informed only.
///
/// `host_speed`: m/s, below 0 in reverse, where behind is its front. `ease`: 1, or more to keep a
/// level: probabilities count so many times, times the inverse.
RiskLevel levelOf(const ObjectRisk& risk, double host_speed, const WarningOptions& options,
                  double ease = 1.0);

/// The overall level with hysteresis. It rises when it has been asked for over `raise_time`, and
/// falls when it has not been asked for, by thresholds that are eased by `release`, over
/// `hold_time`.
class WarningLevel {
 public:
  /// Throws OptionError.
  explicit WarningLevel(const Checked<WarningOptions>& options);

  /// Puts level, cause and reason into the report; `host_speed`: m/s. Stamps rise.
  void judge(RiskReport& report, double host_speed);

  void reset();

 private:
  WarningOptions options_;
  RiskLevel level_ = RiskLevel::kNone;
  std::optional<Stamp> asked_since_;   ///< that a higher level is asked for
  std::optional<Stamp> kept_at_;       ///< the level was last asked for
  std::uint32_t cause_ = kStandingId;  ///< of what was last asked for
  std::string reason_;
};

/// The reason of a level in words: "pedestrian 7 at the front with 8.3 m/s in 1.6 s (82 %): brake
/// within 0.4 s"; of braking only where it helps at `host_speed` (m/s).
std::string reasonOf(const ObjectRisk& risk, double host_speed);

}  // namespace datmo

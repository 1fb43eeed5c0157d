// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/risk/risk.h"

namespace datmo {

/// Thresholds for warning the driver.
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

/// Returns the level that one object requires. A warning requires both that contact is likelier
/// than `warning_probability`, and that the time to brake is within `warning_time` or contact
/// within `warning_ttc`; otherwise every parked car in a bend would cause a warning. Braking must
/// help: if the host is stationary or struck from behind, the driver is only informed.
///
/// `host_speed`: m/s, negative in reverse, when behind means its front. `ease`: 1, or more to keep
/// a level: probabilities are multiplied by it, times divided.
RiskLevel levelOf(const ObjectRisk& risk, double host_speed, const WarningOptions& options,
                  double ease = 1.0);

/// The overall level with hysteresis. It rises after objects have required it, or a higher one, for
/// `raise_time`, and falls after none has required it, by thresholds eased by `release`, for
/// `hold_time`.
class WarningLevel {
 public:
  /// Throws OptionError.
  explicit WarningLevel(const Checked<WarningOptions>& options);

  /// Writes level, cause and reason to the report; `host_speed`: m/s. Stamps must not decrease.
  void judge(RiskReport& report, double host_speed);

  void reset();

 private:
  /// Returns the highest level that has been required for `raise_time`.
  RiskLevel heldBy(RiskLevel required, Stamp now);

  WarningOptions options_;
  RiskLevel level_ = RiskLevel::kNone;
  /// Since when each level, or a higher one, has been required; none: it is not.
  std::array<std::optional<Stamp>, static_cast<std::size_t>(RiskLevel::kImminent) + 1>
      required_since_;
  std::optional<Stamp> kept_at_;       ///< the level was last required
  std::uint32_t cause_ = kStandingId;  ///< object that last required the level
  std::string reason_;
};

/// Returns the reason for a level in words: "pedestrian 7 at the front with 8.3 m/s in 1.6 s (82
/// %): brake within 0.4 s"; braking is mentioned only if it helps at `host_speed` (m/s).
std::string reasonOf(const ObjectRisk& risk, double host_speed);

}  // namespace datmo

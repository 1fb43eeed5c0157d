// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/clock_offset.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stack_health.h"

namespace datmo {

struct PartClocksOptions {
  ClockOffsetOptions exchanges;
  double max_offset = 0.010;   ///< s
  double silent_after = 10.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Compares the clocks of the machines that run parts of the stack with ours.
class PartClocks {
 public:
  /// Throws OptionError.
  explicit PartClocks(const Checked<PartClocksOptions>& options) : options_(*options) {}

  /// `received`: time of arrival on our machine's clock.
  void addAnswer(const PartClock& answer, Stamp received);

  /// Descriptions for people, by process: "1.2 +- 0.3 ms ahead", "no answer for 12 s".
  std::map<std::string, std::string> descriptions(Stamp now) const;

  /// Returns `health`, extended by the first clock that is certainly off by more than `max_offset`,
  /// or whose machine no longer answers.
  StackHealth judged(StackHealth health, Stamp now) const;

 private:
  struct Clock {
    ClockOffsetEstimator estimator;
    Stamp last;  ///< last answer, on our clock
  };

  std::optional<std::string> fault(const std::string& process, const Clock& clock, Stamp now) const;
  std::string description(const Clock& clock, Stamp now) const;
  bool isSilent(const Clock& clock, Stamp now) const;

  PartClocksOptions options_;
  std::map<std::string, Clock> clocks_;  ///< by process
};

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/windowed_evidence.h"

#include <algorithm>

namespace datmo {

void WindowedEvidenceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"window", "s", "evidence older than this does not count"}, window, {0.0, 60.0});
  visitor.number({"correlation_time", "s",
                  "time in which the errors of a track change: observations in quicker succession "
                  "count by their share of it"},
                 correlation_time, {0.001, 10.0});
  visitor.number({"look_limit", "1", "most that one observation may add to the sum, or subtract"},
                 look_limit, {0.1, 1000.0});
}

void WindowedEvidence::look(Stamp stamp, double log_likelihood_ratio,
                            const WindowedEvidenceOptions& options) {
  const double since = looks_.empty() ? options.correlation_time
                                      : std::max(0.0, secondsBetween(looks_.back().stamp, stamp));
  const double weight = std::min(1.0, since / options.correlation_time);
  const double limited = std::clamp(log_likelihood_ratio, -options.look_limit, options.look_limit);
  looks_.push_back({stamp, weight * limited});
  sum_ += looks_.back().value;
  forgetBefore(stamp, options);
}

void WindowedEvidence::forgetBefore(Stamp stamp, const WindowedEvidenceOptions& options) {
  while (!looks_.empty() && secondsBetween(looks_.front().stamp, stamp) > options.window) {
    sum_ -= looks_.front().value;
    looks_.pop_front();
  }
  if (looks_.empty()) {
    sum_ = 0.0;  // removes accumulated rounding errors
  }
}

}  // namespace datmo

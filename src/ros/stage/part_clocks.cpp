// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/part_clocks.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

std::string inMilliseconds(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", 1e3 * seconds);
  return text.data();
}

std::string textOf(const ClockOffset& offset) {
  return inMilliseconds(std::abs(offset.ahead)) + " +- " + inMilliseconds(offset.uncertainty) +
         " ms " + (offset.ahead < 0.0 ? "behind" : "ahead");
}

}  // namespace

void PartClocksOptions::visit(OptionVisitor& visitor) {
  visitor.group("clock", [&] { exchanges.visit(visitor); });
  visitor.number({"max_clock_offset", "s",
                  "a clock that is certainly off by more causes a warning: at 10 m/s an object "
                  "moves 0.1 m in 10 ms, half a cell of the map"},
                 max_offset, {1e-4, 10.0});
  visitor.number(
      {"silent_after", "s", "a part whose process has not answered for this long causes a warning"},
      silent_after, {1.0, 600.0});
}

void PartClocks::addAnswer(const PartClock& answer, Stamp received) {
  const auto clock = clocks_
                         .try_emplace(withoutSlash(answer.process),
                                      Clock{ClockOffsetEstimator(options_.exchanges), received})
                         .first;
  clock->second.estimator.add({toStamp(answer.asked), toStamp(answer.answered), received});
  clock->second.last = received;
}

bool PartClocks::isSilent(const Clock& clock, Stamp now) const {
  return secondsBetween(clock.last, now) > options_.silent_after;
}

std::string PartClocks::description(const Clock& clock, Stamp now) const {
  if (isSilent(clock, now)) {
    return "no answer for " + std::to_string(std::lround(secondsBetween(clock.last, now))) + " s";
  }
  const std::optional<ClockOffset> offset = clock.estimator.at(now);
  return offset ? textOf(*offset) : "unknown";
}

std::map<std::string, std::string> PartClocks::descriptions(Stamp now) const {
  std::map<std::string, std::string> texts;
  for (const auto& [process, clock] : clocks_) {
    texts[process] = description(clock, now);
  }
  return texts;
}

std::optional<std::string> PartClocks::fault(const std::string& process, const Clock& clock,
                                             Stamp now) const {
  if (isSilent(clock, now)) {
    return process + ": " + description(clock, now);
  }
  const std::optional<ClockOffset> offset = clock.estimator.at(now);
  if (offset && std::abs(offset->ahead) - offset->uncertainty > options_.max_offset) {
    return "clock of " + process + ": " + textOf(*offset) + ", expected at most " +
           inMilliseconds(options_.max_offset) + " ms; synchronize the machines' clocks (chrony)";
  }
  return std::nullopt;
}

StackHealth PartClocks::judged(StackHealth health, Stamp now) const {
  for (const auto& [process, clock] : clocks_) {
    if (const auto found = fault(process, clock, now)) {
      const bool is_good = health.level == HealthLevel::kOk;
      return {is_good ? HealthLevel::kDegraded : health.level,
              (is_good ? "degraded: " : health.sentence + "; ") + *found};
    }
  }
  return health;
}

}  // namespace datmo

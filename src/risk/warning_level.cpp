// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/warning_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace datmo {

namespace {

/// m/s; below this, the host is stationary, and braking changes nothing.
constexpr double kStanding = 0.1;

/// Returns false if the host is stationary, or is moving and struck from behind.
bool brakingHelps(const ObjectRisk& risk, double host_speed) {
  const StruckSide behind = host_speed < 0.0 ? StruckSide::kFront : StruckSide::kRear;
  return std::abs(host_speed) > kStanding && risk.side != behind;
}

const ObjectRisk* mostUrgent(const RiskReport& report, double host_speed,
                             const WarningOptions& options, double ease) {
  const auto urgency = [&](const ObjectRisk& risk) {
    return std::make_tuple(levelOf(risk, host_speed, options, ease), -risk.time_to_brake,
                           risk.probability());
  };
  const auto most = std::max_element(
      report.objects.begin(), report.objects.end(),
      [&](const ObjectRisk& a, const ObjectRisk& b) { return urgency(a) < urgency(b); });
  return most == report.objects.end() ? nullptr : &*most;
}

std::string decimal(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

}  // namespace

const char* nameOf(RiskLevel level) {
  switch (level) {
    case RiskLevel::kNone:
      break;
    case RiskLevel::kInformation:
      return "information";
    case RiskLevel::kWarning:
      return "warning";
    case RiskLevel::kImminent:
      return "imminent";
  }
  return "none";
}

void WarningOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kProbability{0.0, 1.0};
  constexpr Bounds kTime{0.0, 5.0};
  visitor.number({"information_probability", "1",
                  "the driver is informed from this probability of contact within 4 s"},
                 information_probability, kProbability);
  visitor.number({"warning_probability", "1",
                  "the driver is warned from this probability of contact within 4 s, if the time "
                  "left to brake runs out"},
                 warning_probability, kProbability);
  visitor.number(
      {"warning_time", "s",
       "the driver is warned from this time to brake: 1 s for a driver's reaction (thesis 5.3.5; "
       "Zhang et al. 2006), and the delay of the brakes and of perception"},
      warning_time, kTime);
  visitor.number(
      {"warning_ttc", "s",
       "the driver is warned from this time to contact, however late braking would do: test "
       "protocols of forward collision warnings require 1.7 s; raise_time and a scan come on top"},
      warning_ttc, kTime);
  visitor.number(
      {"imminent_time", "s",
       "time to brake from which no driver can react any more, but automatic brakes would"},
      imminent_time, kTime);
  visitor.number(
      {"raise_time", "s", "how long the conditions of a level must hold before it is reported"},
      raise_time, kTime);
  visitor.number(
      {"hold_time", "s", "how long a level is kept after its conditions have ceased to hold"},
      hold_time, kTime);
  visitor.number({"release", "1",
                  "the conditions of a level hold down to this share of its probability, and up to "
                  "its time divided by this share"},
                 release, {0.1, 1.0});
}

RiskLevel levelOf(const ObjectRisk& risk, double host_speed, const WarningOptions& options,
                  double ease) {
  const double probability = ease * risk.probability();
  const double time = risk.time_to_brake / ease;
  if (probability >= options.warning_probability && probability > 0.0 &&
      brakingHelps(risk, host_speed)) {
    if (time <= options.imminent_time) {
      return RiskLevel::kImminent;
    }
    if (time <= options.warning_time || risk.median_ttc / ease <= options.warning_ttc) {
      return RiskLevel::kWarning;
    }
  }
  return probability >= options.information_probability && probability > 0.0
             ? RiskLevel::kInformation
             : RiskLevel::kNone;
}

WarningLevel::WarningLevel(const Checked<WarningOptions>& options) : options_(*options) {}

void WarningLevel::reset() {
  level_ = RiskLevel::kNone;
  required_since_ = {};
  kept_at_.reset();
  cause_ = kStandingId;
  reason_.clear();
}

RiskLevel WarningLevel::heldBy(RiskLevel required, Stamp now) {
  RiskLevel held = RiskLevel::kNone;
  for (const RiskLevel level :
       {RiskLevel::kInformation, RiskLevel::kWarning, RiskLevel::kImminent}) {
    std::optional<Stamp>& since = required_since_[static_cast<std::size_t>(level)];
    if (required < level) {
      since.reset();
      continue;
    }
    since = since.value_or(now);
    if (secondsBetween(*since, now) >= options_.raise_time) {
      held = level;
    }
  }
  return held;
}

void WarningLevel::judge(RiskReport& report, double host_speed) {
  const ObjectRisk* now = mostUrgent(report, host_speed, options_, 1.0);
  const RiskLevel required = now ? levelOf(*now, host_speed, options_) : RiskLevel::kNone;
  const double ease = 1.0 / options_.release;
  const ObjectRisk* eased = mostUrgent(report, host_speed, options_, ease);
  const RiskLevel kept = eased ? levelOf(*eased, host_speed, options_, ease) : RiskLevel::kNone;
  level_ = std::max(level_, heldBy(required, report.stamp));
  if (kept >= level_) {
    kept_at_ = report.stamp;
  } else if (!kept_at_ || secondsBetween(*kept_at_, report.stamp) >= options_.hold_time) {
    level_ = kept;
    kept_at_ = report.stamp;
  }
  // While a level is held, the object that required it remains its reason, even if others require
  // less.
  if (kept != RiskLevel::kNone && kept >= level_) {
    cause_ = eased->id;
    reason_ = reasonOf(*eased, host_speed);
  }
  report.level = level_;
  if (level_ != RiskLevel::kNone) {
    report.cause = cause_;
    report.reason = reason_;
  }
}

std::string reasonOf(const ObjectRisk& risk, double host_speed) {
  const std::string what = risk.id == kStandingId
                               ? "stationary obstacle"
                               : nameOf(risk.object_class) + (" " + std::to_string(risk.id));
  const std::string percent = std::to_string(std::lround(100.0 * risk.probability())) + " %";
  if (risk.side == StruckSide::kNone) {
    return what + ": contact possible (" + percent + ")";
  }
  std::string contact = what + " at the " + nameOf(risk.side) + " with " +
                        decimal(risk.strike_speed) + " m/s in " + decimal(risk.median_ttc) +
                        " s (" + percent + ")";
  if (!brakingHelps(risk, host_speed)) {
    return contact;
  }
  return risk.time_to_brake > 0.0 ? contact + ": brake within " + decimal(risk.time_to_brake) + " s"
                                  : contact + ": braking no longer avoids it";
}

}  // namespace datmo

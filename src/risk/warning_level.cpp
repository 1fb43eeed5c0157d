// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/warning_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace datmo {

namespace {

/// m/s; slower the host stands, and braking changes nothing.
constexpr double kStanding = 0.1;

/// Not where the host stands, or is struck from behind as it moves.
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
                  "probability of contact within 4 s from which the driver is informed"},
                 information_probability, kProbability);
  visitor.number({"warning_probability", "1",
                  "the same from which the driver is warned, if braking time runs out"},
                 warning_probability, kProbability);
  visitor.number({"warning_time", "s",
                  "time to brake from which the driver is warned: 1 s of a driver's reaction "
                  "(thesis 5.3.5; Zhang et al. 2006), and the brakes' and the perception's delay"},
                 warning_time, kTime);
  visitor.number(
      {"warning_ttc", "s",
       "time to contact from which the driver is warned however late he could brake: test "
       "protocols of forward collision warnings ask for 1.7 s, on top of raise_time and a "
       "scan"},
      warning_ttc, kTime);
  visitor.number({"imminent_time", "s",
                  "time to brake from which no driver reacts any more: automatic brakes would"},
                 imminent_time, kTime);
  visitor.number({"raise_time", "s", "how long a level must be asked for before it is given"},
                 raise_time, kTime);
  visitor.number({"hold_time", "s", "how long a level stays when it is not asked for any more"},
                 hold_time, kTime);
  visitor.number({"release", "1",
                  "a level is still asked for at this share of its probability, and at its time "
                  "over this share"},
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
  asked_since_.reset();
  kept_at_.reset();
  cause_ = kStandingId;
  reason_.clear();
}

void WarningLevel::judge(RiskReport& report, double host_speed) {
  const ObjectRisk* now = mostUrgent(report, host_speed, options_, 1.0);
  const RiskLevel asked = now ? levelOf(*now, host_speed, options_) : RiskLevel::kNone;
  const double ease = 1.0 / options_.release;
  const ObjectRisk* eased = mostUrgent(report, host_speed, options_, ease);
  const RiskLevel kept = eased ? levelOf(*eased, host_speed, options_, ease) : RiskLevel::kNone;
  if (asked > level_) {
    asked_since_ = asked_since_.value_or(report.stamp);
    if (secondsBetween(*asked_since_, report.stamp) >= options_.raise_time) {
      level_ = asked;
      asked_since_.reset();
    }
  } else {
    asked_since_.reset();
  }
  if (kept >= level_) {
    kept_at_ = report.stamp;
  } else if (!kept_at_ || secondsBetween(*kept_at_, report.stamp) >= options_.hold_time) {
    level_ = kept;
    kept_at_ = report.stamp;
  }
  // While a level is held, what asked for it stays its reason, whatever else asks for less.
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
                               ? "what stands"
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

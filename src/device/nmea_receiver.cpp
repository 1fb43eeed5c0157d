// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/nmea_receiver.h"

#include <utility>

namespace datmo {

namespace {

constexpr TickFormat kNmeaTicks{1e-3, 86400000};  // to midnight

constexpr int kMaxBadSentences = 20;  ///< in a row: it is not a receiver

}  // namespace

void NmeaOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"baud", "1", "bits per second of a serial port"}, baud, {4800.0, 460800.0});
  visitor.number({"delay", "s",
                  "delay from the time of a position to its first byte: the time the receiver "
                  "needs to compute it (data sheet)"},
                 delay, {0.0, 1.0});
  visitor.number({"sigma", "m",
                  "standard deviation along each axis of a position without corrections at an HDOP "
                  "of 1; corrections reduce it by fixed factors"},
                 sigma, {0.01, 100.0});
}

NmeaReceiver::NmeaReceiver(StreamOpener open, const NmeaOptions& options, double timeout,
                           const DeviceHost& host)
    : open_(std::move(open)), options_(options), timeout_(timeout), host_(host) {}

std::string NmeaReceiver::connect() {
  stream_ = open_();
  host_.clock.restart(kNmeaTicks);
  nextSentence();  // the first one may be incomplete
  last_timed_ = Clock::now();
  return "a satellite receiver";
}

NmeaSentence NmeaReceiver::nextSentence() {
  for (int bad = 1;;) {
    try {
      if (std::optional<NmeaSentence> sentence = reader_.next()) {
        return *std::move(sentence);
      }
    } catch (const DeviceError& error) {
      if (++bad > kMaxBadSentences) {
        throw;
      }
      host_.warn(error);
      continue;
    }
    reader_.feed(stream_->receive());
  }
}

DeviceMeasurement NmeaReceiver::next() {
  if (pending_) {
    return *std::exchange(pending_, std::nullopt);
  }
  while (true) {
    const NmeaSentence sentence = nextSentence();
    checkHasPositions(sentence);
    try {
      if (std::optional<DeviceMeasurement> measurement = measurementOf(sentence)) {
        return *std::move(measurement);
      }
    } catch (const DeviceError& error) {
      host_.warn(error);
    }
  }
}

void NmeaReceiver::checkHasPositions(const NmeaSentence& sentence) {
  // One without satellites speaks, too: it needs time, and not another connection.
  if (sentence.type == "GGA" || sentence.type == "RMC") {
    last_timed_ = Clock::now();
    return;
  }
  // It may pause for almost the timeout before each burst, in which others may come first.
  const double limit = 2.0 * timeout_;
  if (std::chrono::duration<double>(Clock::now() - last_timed_).count() > limit) {
    throw DeviceError("no_positions", "no GGA or RMC for " + std::to_string(limit) +
                                          " s, but other sentences, the last one " + sentence.type +
                                          ": expected a receiver set up to send them; "
                                          "reconnecting");
  }
}

std::optional<DeviceMeasurement> NmeaReceiver::measurementOf(const NmeaSentence& sentence) {
  const bool is_rmc = sentence.type == "RMC";
  has_rmc_ = has_rmc_ || is_rmc;
  if (sentence.type == "GGA") {
    const std::optional<GroundVelocity> velocity = std::exchange(waiting_velocity_, std::nullopt);
    if (readTime(sentence.field(0))) {
      if (velocity) {
        pending_ = DeviceMeasurement{stamp_, *velocity, 0};
      }
      return DeviceMeasurement{stamp_, nmeaFix(sentence, options_.sigma), 0};
    }
  } else if (is_rmc ? readTime(sentence.field(0))
                    : sentence.type == "VTG" && has_time_ && !has_rmc_) {
    const std::optional<GroundVelocity> velocity = nmeaVelocity(sentence);
    if (velocity && !is_rmc && isOfNextTime()) {
      waiting_velocity_ = velocity;
    } else if (velocity) {
      return DeviceMeasurement{stamp_, *velocity, 0};
    }
  }
  return std::nullopt;
}

bool NmeaReceiver::isOfNextTime() const {
  const double period = host_.clock.interval();
  return period > 0.0 && 2.0 * secondsBetween(arrival_, host_.clock.now()) > period;
}

bool NmeaReceiver::readTime(const std::string& field) {
  constexpr double kOld = 1.0;  // s; an older time means that the clock was set
  const std::optional<std::uint64_t> ticks = nmeaTime(field);
  if (!ticks) {
    host_.warn({"no_time", "the receiver does not know the time yet: expected satellites in view"});
    return false;
  }
  if (has_time_) {
    const double since = host_.clock.sinceLast(*ticks);
    if (since == 0.0) {
      return true;
    }
    if (since < 0.0 && since > -kOld) {
      host_.warn({"late_sentence", "a sentence " + std::to_string(-since) +
                                       " s older than the last one: expected them in order"});
      return false;
    }
  }
  stamp_ = host_.clock.add(*ticks, options_.delay);
  arrival_ = host_.clock.now();
  has_time_ = true;
  return true;
}

}  // namespace datmo

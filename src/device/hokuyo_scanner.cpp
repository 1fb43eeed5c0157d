// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/hokuyo_scanner.h"

#include <optional>
#include <utility>

#include "datmo_fusion/device/stream_opener.h"

namespace datmo {

namespace {

constexpr TickFormat kScipTicks{1e-3, std::uint64_t{1} << kScipClockBits};

/// Maximum number of answers to earlier commands that may still arrive.
constexpr int kOldAnswers = 100;

constexpr const char* kBadAnswer = "bad_answer";
constexpr const char* kQuit = "QT";  ///< ends all scans

}  // namespace

void HokuyoOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"baud", "1", "bits per second of a serial port; irrelevant on USB"}, baud,
                  {4800.0, 460800.0});
}

HokuyoScanner::HokuyoScanner(DeviceAddress address, const HokuyoOptions& options,
                             const DeviceHost& host)
    : address_(std::move(address)), options_(options), host_(host) {}

std::string HokuyoScanner::connect() {
  connection_ = openStream(address_, options_.baud, true, host_.stop);
  host_.clock.restart(kScipTicks);
  if (isSerial(address_)) {
    beginAtSerialPort();
  } else {
    ask(kQuit);
  }
  model_ = scipModel(ask("PP"));
  // 00: the laser is on now; 02: it was on.
  const ScipAnswer laser = ask("BM");
  if (laser.status != "00" && laser.status != "02") {
    throw DeviceError("device_fault", "'" + model_.name +
                                          "' does not switch its laser on (status " + laser.status +
                                          "): expected 00 or 02");
  }
  const ScipAnswer started = ask(scipScanRequest(model_));
  if (started.status != "00") {
    throw DeviceError("device_fault", "'" + model_.name + "' does not start scanning (status " +
                                          started.status + "): expected 00");
  }
  return model_.name + ", " + std::to_string(model_.beams()) + " beams, at " + address_.host;
}

void HokuyoScanner::beginAtSerialPort() {
  // A scanner that already speaks SCIP 2.0 rejects this command.
  connection_->send("SCIP2.0\n");
  connection_->send(std::string(kQuit) + "\n");
  for (int i = 0; i < kOldAnswers; ++i) {
    try {
      if (nextAnswer().command == kQuit) {
        return;
      }
    } catch (const DeviceError& error) {
      if (error.reason() != kBadAnswer) {
        throw;
      }
    }
  }
  throw DeviceError(kBadAnswer, "no answer to " + std::string(kQuit) + " among " +
                                    std::to_string(kOldAnswers) +
                                    ": expected a scanner with SCIP 2.0");
}

ScipAnswer HokuyoScanner::ask(const std::string& command) {
  connection_->send(command + "\n");
  for (int i = 0; i < kOldAnswers; ++i) {
    ScipAnswer answer = nextAnswer();
    if (answer.command == command) {
      return answer;
    }
  }
  throw DeviceError(kBadAnswer, "no answer to " + command + " among " +
                                    std::to_string(kOldAnswers) + ": expected one");
}

ScipAnswer HokuyoScanner::nextAnswer() {
  while (true) {
    if (std::optional<ScipAnswer> answer = reader_.next()) {
      return *std::move(answer);
    }
    reader_.feed(connection_->receive());
  }
}

DeviceMeasurement HokuyoScanner::next() {
  constexpr double kMillimeter = 1e-3;  // m
  ScipScan raw = scipScan(nextAnswer(), model_);
  DeviceScan scan;
  scan.first_bearing = model_.firstBearing();
  scan.beam_spacing = model_.beamSpacing();
  scan.beam_time = model_.beamTime();
  scan.scan_time = model_.scanTime();
  scan.min_range = model_.min_range * kMillimeter;
  scan.max_range = model_.max_range * kMillimeter;
  scan.ranges = std::move(raw.ranges);
  DeviceMeasurement measurement;
  measurement.stamp = host_.clock.add(raw.clock) + -scan.sweep();
  measurement.missed = missedIn(host_.clock.interval(), scan.scan_time);
  measurement.data = std::move(scan);
  return measurement;
}

}  // namespace datmo

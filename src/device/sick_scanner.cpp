// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/sick_scanner.h"

#include <optional>
#include <string_view>
#include <utility>

namespace datmo {

namespace {

constexpr TickFormat kSickTicks{1e-6, std::uint64_t{1} << 32U};
constexpr double kMicrosecond = 1e-6;  // s

constexpr std::string_view kScanTelegram = "sSN LMDscandata";
constexpr std::string_view kStateAnswer = "sRA STlms";

/// The first word of the answer on its state.
constexpr std::uint32_t kUndefined = 0;
constexpr std::uint32_t kIdle = 3;
constexpr std::uint32_t kMeasuring = 7;

constexpr const char* kSilent = "silent_device";

/// So many scans may still come of what was asked before.
constexpr int kOldScans = 100;

bool startsWith(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

}  // namespace

SickScanner::SickScanner(DeviceAddress address, const DeviceHost& host)
    : address_(std::move(address)), host_(host) {}

std::string SickScanner::connect() {
  connection_ = std::make_unique<Connection>(address_, host_.stop);
  host_.clock.restart(kSickTicks);
  try {
    model_ = sickModel(ask("sRN DeviceIdent", "sRA DeviceIdent"));
  } catch (const DeviceError& error) {
    if (error.reason() != kSilent) {
      throw;
    }
    // In the other dialect it does not answer at all.
    throw DeviceError(kSilent, std::string(error.what()) + "; does it speak " + kColaDialect + "?");
  }
  // As user 3, authorized client, by the hash of the password that all scanners leave the factory
  // with.
  ask("sMN SetAccessMode 03 F4724744", "sAN SetAccessMode 1");
  // First echoes with remission, both of 16 bits; neither encoder, position, name, comment nor
  // date; each scan. It is not kept when the scanner is switched off.
  ask("sWN LMDscandatacfg 01 00 1 1 0 00 00 0 0 0 0 +1", "sWA LMDscandatacfg");
  ask("sMN LMCstartmeas", "sAN LMCstartmeas 0");
  ask("sMN Run", "sAN Run");  // manuals differ in what follows; that scans come shows it
  ask("sEN LMDscandata 1", "sEA LMDscandata 1");
  return model_.name + " at " + address_.host;
}

std::string SickScanner::ask(const std::string& command, const std::string& expected) {
  connection_->send(colaTelegram(command));
  for (int i = 0; i < kOldScans; ++i) {
    std::string answer = nextTelegram();
    if (startsWith(answer, expected)) {
      return answer;
    }
    if (!startsWith(answer, kScanTelegram)) {
      throw DeviceError("device_fault", "the device answers " + shownBytes(answer) + " to '" +
                                            command + "': expected '" + expected +
                                            "'; is it a scanner of SICK's with the password that "
                                            "it left the factory with?");
    }
  }
  throw DeviceError("bad_answer", "no answer to '" + command + "' among " +
                                      std::to_string(kOldScans) + " scans: expected one");
}

std::string SickScanner::nextTelegram() {
  while (true) {
    if (std::optional<std::string> telegram = reader_.next()) {
      return *std::move(telegram);
    }
    reader_.feed(connection_->receive());
  }
}

bool SickScanner::isWarmingUp() {
  connection_->send(colaTelegram("sRN STlms"));
  const std::string answer = nextTelegram();
  if (startsWith(answer, kScanTelegram)) {
    return true;  // it has just begun: the next telegram is a scan's, too
  }
  if (!startsWith(answer, kStateAnswer)) {
    return false;
  }
  ColaWords words(answer);
  words.text("the kind of answer");
  words.text("its name");
  const auto state = words.number("the scanner's state");
  // One that was stopped has to be started again, by a new connection.
  return state > kUndefined && state < kMeasuring && state != kIdle;
}

std::string SickScanner::nextTelegramOnceWarm() {
  while (true) {
    try {
      return nextTelegram();
    } catch (const DeviceError& error) {
      if (error.reason() != kSilent || !isWarmingUp()) {
        throw;
      }
      host_.warn({"warming_up", "'" + model_.name + "' is not measuring yet: waits for its scans"});
    }
  }
}

DeviceMeasurement SickScanner::next() {
  std::string telegram = nextTelegramOnceWarm();
  while (!startsWith(telegram, kScanTelegram)) {
    if (startsWith(telegram, "sFA")) {
      throw DeviceError("device_fault", "the scanner says " + shownBytes(telegram) +
                                            ": expected scans; its manual has the error");
    }
    telegram = nextTelegramOnceWarm();
  }
  SickScan raw = sickScan(telegram, model_);
  warnOf(raw.state);
  DeviceMeasurement measurement;
  const Stamp sent = host_.clock.add(raw.sent);
  measurement.stamp = sent + -static_cast<double>(raw.sent - raw.begun) * kMicrosecond;
  const auto scans = static_cast<std::uint16_t>(raw.counter - last_counter_);
  last_counter_ = raw.counter;
  // Without a time since the last one that one was of another clock, and so of another counter.
  measurement.missed = host_.clock.interval() > 0.0 && scans > 0 ? scans - 1U : 0;
  measurement.data = std::move(raw.scan);
  return measurement;
}

void SickScanner::warnOf(SickState state) const {
  if (state == SickState::kFault) {
    host_.warn({"device_error", "'" + model_.name +
                                    "' says that it has an error: its scans may "
                                    "be wrong; its display or SOPAS ET has the "
                                    "cause"});
  } else if (state == SickState::kDirty) {
    host_.warn({"dirty_window", "'" + model_.name + "' says that its window is dirty: clean it"});
  }
}

}  // namespace datmo

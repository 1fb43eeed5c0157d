// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/sick_scanner.h"

#include <optional>
#include <utility>

namespace datmo {

namespace {

constexpr TickFormat kSickTicks{1e-6, std::uint64_t{1} << 32U};
constexpr double kMicrosecond = 1e-6;  // s

constexpr std::string_view kScanTelegram = "sSN LMDscandata";

constexpr const char* kSilent = "silent_device";
constexpr const char* kLost = "lost_connection";

/// Maximum number of scans of an earlier request that may still arrive.
constexpr int kOldScans = 100;

DeviceError wrongAnswer(const ColaTelegram& answer, std::string_view command,
                        std::string_view expected) {
  return {"device_fault", "the device answers " + shownBytes(answer.bytes) + " to '" +
                              std::string(command) + "': expected '" + std::string(expected) +
                              "'; is it a SICK scanner with its factory password?"};
}

}  // namespace

SickScanner::SickScanner(DeviceAddress address, std::shared_ptr<ColaDialect> dialect,
                         const DeviceHost& host)
    : address_(std::move(address)), dialect_(std::move(dialect)), host_(host), reader_(*dialect_) {}

std::string SickScanner::connect() {
  host_.clock.restart(kSickTicks);
  identify();
  // As user 3, authorized client, with the hash of the factory password.
  command("sMN SetAccessMode", "sAN SetAccessMode", 1, {{"03"}, {"F4724744", 4}});
  // First echoes with remission, both of 16 bits; neither encoder, position, name, comment nor
  // date; each scan. The setting is lost when the scanner is switched off.
  ask("sWN LMDscandatacfg", "sWA LMDscandatacfg",
      {{"01"}, {"00"}, {"1"}, {"1"}, {"0"}, {"00"}, {"00"}, {"0"}, {"0"}, {"0"}, {"0"}, {"+1", 2}});
  command("sMN LMCstartmeas", "sAN LMCstartmeas", 0);
  ask("sMN Run", "sAN Run");  // manuals differ in what follows; arriving scans confirm it
  command("sEN LMDscandata", "sEA LMDscandata", 1, {{"1"}});
  return model_.name + " at " + address_.host + ", " + nameOf(*dialect_);
}

void SickScanner::identify() {
  const ColaDialect first = *dialect_;
  try {
    identifyIn(first);
    return;
  } catch (const DeviceError& error) {
    // In the other dialect most scanners do not answer at all.
    if (error.reason() != kSilent && error.reason() != kLost && error.reason() != kWrongDialect) {
      throw;
    }
  }
  try {
    identifyIn(otherThan(first));
  } catch (const DeviceError& error) {
    if (error.reason() != kSilent) {
      throw;
    }
    throw DeviceError(kSilent, std::string(error.what()) + "; it was asked in " + nameOf(first) +
                                   " and in " + nameOf(otherThan(first)) +
                                   ": is it a SICK scanner?");
  }
}

void SickScanner::identifyIn(ColaDialect dialect) {
  *dialect_ = dialect;
  reader_ = ColaReader(dialect);
  connection_.reset();  // some scanners serve only one connection
  connection_ = std::make_unique<Connection>(address_, host_.stop);
  model_ = sickModel(ask("sRN DeviceIdent", "sRA DeviceIdent"));
}

void SickScanner::send(std::string_view command, const std::vector<ColaParameter>& parameters) {
  connection_->send(colaFrame(colaCommand(*dialect_, command, parameters)));
}

ColaTelegram SickScanner::ask(std::string_view command, std::string_view expected,
                              const std::vector<ColaParameter>& parameters) {
  send(command, parameters);
  for (int i = 0; i < kOldScans; ++i) {
    ColaTelegram answer = nextTelegram();
    if (answer.isCalled(expected)) {
      return answer;
    }
    if (!answer.isCalled(kScanTelegram)) {
      throw wrongAnswer(answer, command, expected);
    }
  }
  throw badAnswer("no answer to '" + std::string(command) + "' among " + std::to_string(kOldScans) +
                  " scans: expected one");
}

void SickScanner::command(std::string_view command, std::string_view expected, std::uint32_t result,
                          const std::vector<ColaParameter>& parameters) {
  const ColaTelegram answer = ask(command, expected, parameters);
  if (ColaFields(answer).number(1, "the result of a command") != result) {
    throw wrongAnswer(answer, command, std::string(expected) + ' ' + std::to_string(result));
  }
}

ColaTelegram SickScanner::nextTelegram() {
  while (true) {
    if (std::optional<ColaTelegram> telegram = reader_.next()) {
      return *std::move(telegram);
    }
    reader_.feed(connection_->receive());
  }
}

bool SickScanner::isWarmingUp() {
  send("sRN STlms");
  const ColaTelegram answer = nextTelegram();
  if (answer.isCalled(kScanTelegram)) {
    return true;  // it has just started: the next telegram is also a scan
  }
  return answer.isCalled("sRA STlms") && isSickWarmingUp(answer);
}

ColaTelegram SickScanner::nextTelegramOnceWarm() {
  while (true) {
    try {
      return nextTelegram();
    } catch (const DeviceError& error) {
      if (error.reason() != kSilent || !isWarmingUp()) {
        throw;
      }
      host_.warn(
          {"warming_up", "'" + model_.name + "' is not measuring yet: waiting for its scans"});
    }
  }
}

DeviceMeasurement SickScanner::next() {
  ColaTelegram telegram = nextTelegramOnceWarm();
  while (!telegram.isCalled(kScanTelegram)) {
    if (telegram.bytes.rfind("sFA", 0) == 0) {
      throw DeviceError("device_fault", "the scanner reports " + shownBytes(telegram.bytes) +
                                            ": expected scans; see its manual for the error");
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
  // Without an interval, the last scan belongs to another clock, and so to another counter.
  measurement.missed = host_.clock.interval() > 0.0 && scans > 0 ? scans - 1U : 0;
  measurement.data = std::move(raw.scan);
  return measurement;
}

void SickScanner::warnOf(SickState state) const {
  if (state == SickState::kFault) {
    host_.warn({"device_error", "'" + model_.name +
                                    "' reports an error: its scans may be wrong; see its display "
                                    "or SOPAS ET for the cause"});
  } else if (state == SickState::kDirty) {
    host_.warn({"dirty_window", "'" + model_.name + "' reports a dirty window: clean it"});
  }
}

}  // namespace datmo

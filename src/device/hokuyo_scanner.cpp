// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/hokuyo_scanner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace datmo {

namespace {

constexpr double kMillisecond = 1e-3;  // s
constexpr std::uint32_t kClockMask = (1U << kScipClockBits) - 1U;

/// So many answers may still come of what was asked before.
constexpr int kOldAnswers = 100;

/// It waits no more: no error.
struct Stopped {};

}  // namespace

void HokuyoOptions::visit(OptionVisitor& visitor) {
  constexpr double kPorts = 65535.0;
  visitor.text({"address", "", "the scanner's name or address on the network"}, address, {});
  visitor.integer({"port", "1", "its TCP port"}, port, {1.0, kPorts});
  visitor.number({"timeout", "s", "a scanner silent for so long is connected again"}, timeout,
                 {0.05, 60.0});
  visitor.number({"min_backoff", "s", "the first pause before it is connected again"}, min_backoff,
                 {0.001, 60.0});
  visitor.number({"max_backoff", "s", "pauses grow up to this"}, max_backoff, {0.001, 600.0});
  visitor.group("clock", [&] { clock.visit(visitor); });
}

HokuyoScanner::HokuyoScanner(const Checked<HokuyoOptions>& options, DeviceHandlers handlers)
    : options_(*options),
      handlers_(std::move(handlers)),
      clock_(options_.clock),
      backoff_(options_.min_backoff),
      thread_([this] { run(); }) {}

HokuyoScanner::~HokuyoScanner() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_all();
  thread_.join();
}

void HokuyoScanner::run() {
  while (!stop_) {
    try {
      serve();
    } catch (const DeviceError& error) {
      handlers_.fault(error);
      waitBeforeNext();
    } catch (const Stopped&) {
      return;
    }
  }
}

void HokuyoScanner::waitBeforeNext() {
  std::unique_lock<std::mutex> lock(mutex_);
  stopped_.wait_for(lock, std::chrono::duration<double>(backoff_), [this] { return stop_.load(); });
  backoff_ = std::min(2.0 * backoff_, options_.max_backoff);
}

void HokuyoScanner::serve() {
  const Connection connection({options_.address, options_.port, options_.timeout}, stop_);
  reader_ = ScipReader();
  clock_.restart();
  has_scan_ = false;
  ask(connection, "QT");
  const ScipModel model = scipModel(ask(connection, "PP"));
  // 00: the laser is on now; 02: it was on.
  const ScipAnswer laser = ask(connection, "BM");
  if (laser.status != "00" && laser.status != "02") {
    throw DeviceError("device_fault", "'" + model.name + "' does not switch its laser on (status " +
                                          laser.status + "): expected 00 or 02");
  }
  const ScipAnswer started = ask(connection, scipScanRequest(model));
  if (started.status != "00") {
    throw DeviceError("device_fault", "'" + model.name + "' does not begin to scan (status " +
                                          started.status + "): expected 00");
  }
  handlers_.connected(model);
  while (true) {
    take(model, nextAnswer(connection));
  }
}

ScipAnswer HokuyoScanner::ask(const Connection& connection, const std::string& command) {
  connection.send(command + "\n");
  for (int i = 0; i < kOldAnswers; ++i) {
    ScipAnswer answer = nextAnswer(connection);
    if (answer.command == command) {
      return answer;
    }
  }
  throw DeviceError("bad_answer", "no answer to " + command + " among " +
                                      std::to_string(kOldAnswers) + ": expected one");
}

ScipAnswer HokuyoScanner::nextAnswer(const Connection& connection) {
  while (!stop_) {
    if (std::optional<ScipAnswer> answer = reader_.next()) {
      return *std::move(answer);
    }
    reader_.feed(connection.receive());
  }
  throw Stopped();
}

double HokuyoScanner::clockSeconds(std::uint32_t clock) {
  ticks_ = has_scan_ ? ticks_ + ((clock - last_clock_) & kClockMask) : clock;
  last_clock_ = clock;
  return static_cast<double>(ticks_) * kMillisecond;
}

void HokuyoScanner::take(const ScipModel& model, const ScipAnswer& answer) {
  const Stamp arrival = handlers_.now();
  ScipScan raw = scipScan(answer, model);
  const std::uint32_t step = (raw.clock - last_clock_) & kClockMask;
  DeviceScan scan;
  if (has_scan_) {
    const double turns = std::round(step * kMillisecond / model.scanTime());
    scan.missed = turns > 1.0 ? static_cast<std::uint64_t>(turns) - 1 : 0;
  }
  const std::uint64_t steps_before = clock_.steps();
  const Stamp sent = clock_.add(clockSeconds(raw.clock), arrival);
  if (clock_.steps() != steps_before) {
    scan.missed = 0;
  }
  has_scan_ = true;
  backoff_ = options_.min_backoff;
  scan.stamp = sent + -model.beamTime() * static_cast<double>(model.beams() - 1);
  scan.ranges = std::move(raw.ranges);
  scan.clock_offset = clock_.offset().value_or(0.0);
  scan.clock_drift = clock_.drift();
  scan.clock_steps = clock_.steps();
  handlers_.scan(model, std::move(scan));
}

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/device_runner.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace datmo {

void DeviceRunnerOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_backoff", "s", "first pause before reconnecting"}, min_backoff,
                 {0.001, 60.0});
  visitor.number({"max_backoff", "s", "longest pause; pauses grow up to this"}, max_backoff,
                 {0.001, 600.0});
  visitor.group("clock", [&] { clock.visit(visitor); });
}

DeviceRunner::DeviceRunner(const Checked<DeviceRunnerOptions>& options, DeviceMaker make,
                           DeviceHandlers handlers)
    : options_(*options),
      make_(std::move(make)),
      handlers_(std::move(handlers)),
      clock_(options_.clock, handlers_.now),
      backoff_(options_.min_backoff),
      thread_([this] { run(); }) {}

DeviceRunner::~DeviceRunner() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_all();
  thread_.join();
}

void DeviceRunner::run() {
  while (!stop_) {
    try {
      serve();
    } catch (const RecordingEnd& end) {
      handlers_.fault(end);
      return;
    } catch (const DeviceError& error) {
      handlers_.fault(error);
      waitBeforeNext();
    } catch (const DeviceStopped&) {
      return;
    } catch (const std::exception& error) {
      // The other nodelets of the process must continue after any exception.
      handlers_.fault(DeviceError("internal_error", error.what()));
      waitBeforeNext();
    }
  }
}

void DeviceRunner::serve() {
  const std::unique_ptr<Device> device = make_(DeviceHost{stop_, clock_, handlers_.warning});
  handlers_.connected(device->connect());
  while (!stop_) {
    DeviceMeasurement measurement = device->next();
    backoff_ = options_.min_backoff;
    handlers_.measured(std::move(measurement), clock_.state());
  }
}

void DeviceRunner::waitBeforeNext() {
  std::unique_lock<std::mutex> lock(mutex_);
  stopped_.wait_for(lock, std::chrono::duration<double>(backoff_), [this] { return stop_.load(); });
  backoff_ = std::min(2.0 * backoff_, options_.max_backoff);
}

}  // namespace datmo

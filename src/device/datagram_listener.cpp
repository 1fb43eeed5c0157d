// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/datagram_listener.h"

#include <chrono>
#include <exception>
#include <limits>
#include <utility>

#include "datmo_fusion/device/datagram_socket.h"

namespace datmo {

DatagramListener::DatagramListener(const DeviceAddress& source, DatagramHandlers handlers)
    : source_(source), handlers_(std::move(handlers)) {
  source_.timeout = std::numeric_limits<double>::infinity();
  thread_ = std::thread([this] { run(); });
}

DatagramListener::~DatagramListener() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_all();
  thread_.join();
}

void DatagramListener::listen() {
  DatagramSocket socket(source_, stop_);
  handlers_.listening();
  while (true) {
    handlers_.received(socket.next());
  }
}

void DatagramListener::run() {
  constexpr std::chrono::seconds kPause(1);
  while (!stop_) {
    try {
      listen();
    } catch (const DeviceStopped&) {
      return;
    } catch (const DeviceError& error) {
      handlers_.fault(error);
    } catch (const std::exception& error) {
      // The other nodelets of the process must continue after any exception.
      handlers_.fault(DeviceError("internal_error", error.what()));
    }
    std::unique_lock<std::mutex> lock(mutex_);
    stopped_.wait_for(lock, kPause, [this] { return stop_.load(); });
  }
}

}  // namespace datmo

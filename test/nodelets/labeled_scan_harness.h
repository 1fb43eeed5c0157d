// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chain.h"
#include "ros/labeled_scan_samples.h"

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// A nodelet that subscribes to labeled scans, and a scripted grid_slam before it. Times count from
/// the start of the drive, samples::kStart.
class LabeledScanHarness : public Listener {
 public:
  static constexpr double kStep = 1.0 / 16.0;  // s

  explicit LabeledScanHarness(std::string nodelet) : nodelet_(std::move(nodelet)) {}

  /// Waits until the nodelet is subscribed and reports.
  bool waitForNodelet() {
    setClock(-kStep);
    return waitFor(
        [this] { return labeled_scan_.getNumSubscribers() >= 1 && !diagnosticMessage().empty(); });
  }

  void setClock(double seconds) { Listener::setClock(ros::Time(samples::kStart + seconds)); }

  void send(const LabeledScanMessage& message) { labeled_scan_.publish(message); }
  void send(const LabeledScan& scan) { send(toMessage(scan, "base_link", "map")); }

  double diagnostic(const std::string& key) const { return Listener::diagnostic(nodelet_, key); }
  std::string diagnosticMessage() const { return Listener::diagnosticMessage(nodelet_); }

  /// Waits until the key's value reaches this one; returns whether it did.
  bool waitForCount(const std::string& key, double count) {
    return waitFor([&] { return diagnostic(key) == count; });
  }

  /// Waits until the diagnostics report this; returns whether they did.
  bool waitForMessage(const std::string& part) {
    return waitFor([&] { return diagnosticMessage().find(part) != std::string::npos; });
  }

 protected:
  static constexpr std::uint32_t kQueue = 1000;

  ros::NodeHandle node_;

 private:
  std::string nodelet_;
  ros::Publisher labeled_scan_ = node_.advertise<LabeledScanMessage>("labeled_scan", kQueue);
};

}  // namespace datmo

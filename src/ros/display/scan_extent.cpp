// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/scan_extent.h"

#include <algorithm>
#include <string>

namespace datmo {

namespace {

/// Number of scans before the verdict: one or two seconds.
constexpr std::size_t kScans = 20;

/// Maximum share of end points outside the window; fewer are irrelevant distant walls.
constexpr double kMaxOutside = 0.1;

/// Maximum window on both sides relative to the scanner's range: twice leaves room for what is
/// behind.
constexpr double kMaxExcess = 4.0;

std::string meters(double length) {
  std::string text = std::to_string(length);
  return text.substr(0, text.find('.') + 2) + " m";
}

std::string sizeOf(const GridWindowOptions& window) {
  return "the map's window, " + meters(window.length) + " x " + meters(window.width) +
         " (grid_slam: {map: {length, width}})";
}

}  // namespace

std::optional<InputError> ScanExtent::update(const Scan& scan) {
  if (scans_ >= kScans) {
    return std::nullopt;
  }
  const double half = 0.5 * std::max(window_.length, window_.width);
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      ++hits_;
      outside_ += ray.end.norm() > half ? 1 : 0;
      farthest_ = std::max(farthest_, ray.range);
    }
  }
  return ++scans_ == kScans ? judge(scan.field.range) : std::nullopt;
}

std::optional<InputError> ScanExtent::judge(double reach) const {
  if (static_cast<double>(outside_) > kMaxOutside * static_cast<double>(hits_)) {
    return InputError("small_window",
                      std::to_string(outside_) + " of the first " + std::to_string(hits_) +
                          " end points, up to " + meters(farthest_) + " away, lie outside of " +
                          sizeOf(window_) + ": expected a window of about twice that distance");
  }
  if (0.5 * std::min(window_.length, window_.width) > kMaxExcess * reach) {
    return InputError("large_window",
                      "the scanner reaches " + meters(reach) + " and detects objects up to " +
                          meters(farthest_) + " away, a small part of " + sizeOf(window_) +
                          ": expected settings of the scanner's scale, also for the targets "
                          "(tracker: {target: {box: {size}}}); see config/model_car.yaml");
  }
  return std::nullopt;
}

}  // namespace datmo

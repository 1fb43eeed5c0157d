// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/kidnapping_detector.h"

#include <algorithm>
#include <cstddef>

namespace datmo {

namespace {

/// Scans before the rise, the most contradicted of which counts.
constexpr std::size_t kScansBefore = 5;

/// Share of the rise that must remain: what has not gone back is elsewhere.
constexpr double kRemaining = 0.25;

/// With fewer beams an object that comes into view takes much of it.
constexpr int kMinBeams = 20;

}  // namespace

void KidnappingDetector::add(Stamp stamp, const MapAgreement& agreement) {
  if (agreement.beams < kMinBeams) {
    return;
  }
  const double share = static_cast<double>(agreement.contradicted) / agreement.beams;
  const double rise = shares_.size() == kScansBefore
                          ? share - *std::max_element(shares_.begin(), shares_.end())
                          : 0.0;
  if (rise > (isSuspected() ? kRemaining * min_rise_ : min_rise_)) {
    suspected_since_ = suspected_since_.value_or(stamp);
    is_confirmed_ = secondsBetween(*suspected_since_, stamp) >= confirmed_after_;
    return;
  }
  suspected_since_.reset();
  shares_.push_back(share);
  if (shares_.size() > kScansBefore) {
    shares_.pop_front();
  }
}

void KidnappingDetector::reset() {
  shares_.clear();
  suspected_since_.reset();
  is_confirmed_ = false;
}

}  // namespace datmo

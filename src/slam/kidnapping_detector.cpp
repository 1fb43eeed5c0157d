// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/kidnapping_detector.h"

#include <algorithm>
#include <cstddef>

namespace datmo {

namespace {

/// Scans before the rise, of which the most contradicted one counts: their shares differ by up to
/// 0.1 in traffic (measured on simulated and recorded drives).
constexpr std::size_t kScansBefore = 5;

/// Share of min_rise that must remain. If the vehicle is still in the map, the share of
/// contradicted beams returns to about its former value; elsewhere it varies as the vehicle drives
/// on.
constexpr double kRemaining = 0.25;

/// With fewer beams, a single object that comes into view covers more of them than min_rise.
constexpr int kMinBeams = 20;

}  // namespace

void KidnappingDetector::add(Stamp stamp, const MapAgreement& agreement) {
  if (agreement.beams < kMinBeams) {
    suspected_since_.reset();
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

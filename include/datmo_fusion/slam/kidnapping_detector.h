// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// How well a scan agrees with the map at its best-matching pose.
struct MapAgreement {
  int beams = 0;         ///< with a hit, or known to be free up to some range
  int contradicted = 0;  ///< end where the map is free, or pass through static surfaces
};

/// Detects that the vehicle was carried elsewhere (the kidnapped robot problem: Thrun, Burgard &
/// Fox, "Probabilistic Robotics", 2005, 7.1) without its odometry noticing. The scan matcher finds
/// some pose anywhere, and the map soon adapts to it, so a wrong pose by itself is never noticed.
///
/// Moving objects and changed surfaces come into view gradually, however many there are. In a
/// different place, the share of beams that contradict the map rises from one scan to the next, and
/// stays high. It also rises briefly when the vehicle pitches and beams hit the road, or when the
/// scanner is covered; the map must not be updated until that is decided.
class KidnappingDetector {
 public:
  /// `min_rise`: minimum rise of the share of contradicted beams (0 to 1) from one scan to the
  /// next; `confirmed_after`: time for which it must stay up, s.
  KidnappingDetector(double min_rise, double confirmed_after)
      : min_rise_(min_rise), confirmed_after_(confirmed_after) {}

  /// Adds the scan of this stamp. One with few beams is not evaluated, and ends a suspicion.
  void add(Stamp stamp, const MapAgreement& agreement);

  /// Returns whether the last scan may have been taken elsewhere.
  bool isSuspected() const { return suspected_since_.has_value(); }
  /// Returns whether this is confirmed.
  bool isKidnapped() const { return is_confirmed_; }

  /// Restarts in a map with which the earlier scans were not compared.
  void reset();

 private:
  double min_rise_;
  double confirmed_after_;
  std::deque<double> shares_;  ///< contradicted, of the last unsuspicious scans
  std::optional<Stamp> suspected_since_;
  bool is_confirmed_ = false;
};

}  // namespace datmo

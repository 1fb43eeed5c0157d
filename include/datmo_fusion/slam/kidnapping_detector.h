// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// How a scan agrees with the map from the pose at which it fits best.
struct MapAgreement {
  int beams = 0;         ///< of the scan: with a hit, or known free up to some range
  int contradicted = 0;  ///< end where the map is free, or pass through what stands in it
};

/// Whether the vehicle was carried to another place (the kidnapped robot problem: Thrun, Burgard &
/// Fox, "Probabilistic Robotics", 2005, 7.1) while its odometry knows nothing of it. The scan
/// matcher finds some pose everywhere, and the map soon adapts to it, so a wrong pose alone is
/// never noticed.
///
/// Movers and changed surfaces come into view little by little, however many there are. At another
/// place the map contradicts many more of the beams from one scan to the next, and goes on to. So
/// it does for a moment where the vehicle pitches and the beams meet the road, or where the scanner
/// is covered; the map must be left as it was until that is decided.
class KidnappingDetector {
 public:
  /// `min_rise`: of the share of contradicted beams, from one scan to the next, 0 to 1;
  /// `confirmed_after`: s, for which it stays so.
  KidnappingDetector(double min_rise, double confirmed_after)
      : min_rise_(min_rise), confirmed_after_(confirmed_after) {}

  /// Takes the scan of this stamp. One of few beams says nothing, and ends a
  /// suspicion.
  void add(Stamp stamp, const MapAgreement& agreement);

  /// The last scan may have been made elsewhere.
  bool isSuspected() const { return suspected_since_.has_value(); }
  /// So it was.
  bool isKidnapped() const { return is_confirmed_; }

  /// In a map to which scans that were added before were not compared.
  void reset();

 private:
  double min_rise_;
  double confirmed_after_;
  std::deque<double> shares_;  ///< contradicted, of the last scans that were not suspected
  std::optional<Stamp> suspected_since_;
  bool is_confirmed_ = false;
};

}  // namespace datmo

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
  int confirmed = 0;     ///< end on static surfaces
};

/// Detects that the vehicle was carried elsewhere (the kidnapped robot problem: Thrun, Burgard &
/// Fox, "Probabilistic Robotics", 2005, 7.1) without its odometry noticing. The scan matcher finds
/// some pose anywhere, and the map soon adapts to it, so a wrong pose by itself is never noticed.
///
/// Each scan is a Bayesian comparison of two hypotheses by their marginal likelihoods. Beams are
/// contradicted or confirmed by the map; those that end where it knows nothing count for neither
/// hypothesis. If the vehicle is where it was, the share of contradicted beams is that of the scans
/// before: moving objects and changed surfaces come into view gradually, however many there are. If
/// it is elsewhere, any share is equally likely. A share that rises at once, as the vehicle pitches
/// and beams hit the road, or when the scanner is covered, is suspicious until a scan is again more
/// likely as before; the map must not be updated until that is decided. A vehicle that drives on
/// into unknown space neither confirms nor refutes the suspicion.
class KidnappingDetector {
 public:
  /// `min_log_ratio`: minimum log-likelihood ratio of a scan for a suspicion; `confirmed_after`:
  /// time for which it must last, s.
  KidnappingDetector(double min_log_ratio, double confirmed_after)
      : min_log_ratio_(min_log_ratio), confirmed_after_(confirmed_after) {}

  /// Adds the scan of this stamp. One with few beams is not evaluated, and ends a suspicion; one
  /// with enough beams, few of which are contradicted or confirmed, does not end it.
  void add(Stamp stamp, const MapAgreement& agreement);

  /// Returns whether the last scan may have been taken elsewhere.
  bool isSuspected() const { return suspected_since_.has_value(); }
  /// Returns whether this is confirmed.
  bool isKidnapped() const { return is_confirmed_; }

  /// Restarts in a map with which the earlier scans were not compared.
  void reset();

 private:
  /// Independent observations, numbers of objects rather than of beams.
  struct Observations {
    double contradicted = 0.0;
    double confirmed = 0.0;

    double all() const { return contradicted + confirmed; }
  };
  static Observations observationsOf(const MapAgreement& agreement);
  /// Of the last unsuspicious scans together.
  Observations before() const;
  /// Log-likelihood ratio of `now` being elsewhere, and not where it was.
  static double logRatio(const Observations& before, const Observations& now);

  double min_log_ratio_;
  double confirmed_after_;
  std::deque<Observations> before_;  ///< of the last unsuspicious scans
  std::optional<Stamp> suspected_since_;
  bool is_confirmed_ = false;
};

}  // namespace datmo

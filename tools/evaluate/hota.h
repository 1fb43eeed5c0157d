// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "evaluate/scored_run.h"

namespace datmo::evaluation {

/// Higher order tracking accuracy (Luiten et al., HOTA: a higher order metric for evaluating
/// multi-object tracking, International Journal of Computer Vision 129, 2021).
struct HotaScores {
  std::optional<double> hota;  ///< 0 to 1, mean over alpha; none: neither objects nor tracks
  std::optional<double> deta;  ///< detection accuracy, likewise
  std::optional<double> assa;  ///< association accuracy, likewise; 0 where nothing is matched
  /// Localization accuracy: mean similarity of the matches, over the alphas that have some.
  std::optional<double> loca;
  std::vector<double> alphas;      ///< 0.05, 0.10, … 0.95: minimum similarity of a match
  std::vector<double> hota_alpha;  ///< HOTA at each of them; empty: hota is none
};

/// The similarity of an object and a track is 1 - distance / gate, 0 beyond the gate (`gate` in m,
/// above 0: the one with which the frames were matched).
HotaScores scoreHota(const ScoredRun& run, double gate);

}  // namespace datmo::evaluation

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace datmo {

/// What one source reports on the existence of an object.
struct ExistenceReport {
  bool has_track = false;
  double existence = 0.0;              ///< 0 to 1, by its own tracker; unused without a track
  double looked = 0.0;                 ///< 0 to 1, that it looked at the object's position
  double detection_probability = 0.0;  ///< 0 to 1, that it has a track of an object it looks at
  double false_agreement_probability =
      1.0;  ///< above 0, up to 1, that it has a track of a ghost there
};

/// Returns the existence probability by Bayes: it starts at that of the most certain source with a
/// track. Each other source with a track multiplies the odds by detection_probability /
/// false_agreement_probability (at least 1), and each one without by 1 - detection_probability *
/// looked. 0 if no source has a track.
double fusedExistence(const std::vector<ExistenceReport>& reports);

}  // namespace datmo

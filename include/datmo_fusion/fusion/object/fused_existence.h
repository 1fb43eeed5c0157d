// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace datmo {

/// What one source reports on the existence of an object.
struct ExistenceReport {
  bool has_track = false;
  double existence = 0.0;              ///< 0 to 1, by its own tracker; of no use without track
  double looked = 0.0;                 ///< 0 to 1, that it looked where the object is
  double detection_probability = 0.0;  ///< 0 to 1, that it has a track of what it looks at
  double false_agreement_probability =
      1.0;  ///< more than 0, to 1, that it has one there of a ghost
};

/// That an object exists, by Bayes: as likely as the source says that is surest of it; each other
/// one that has a track of it, too, multiplies the odds by detection_probability /
/// false_agreement_probability (1 at least), and each that has none by 1 - detection_probability *
/// looked. Of no source with a track: 0.
double fusedExistence(const std::vector<ExistenceReport>& reports);

}  // namespace datmo

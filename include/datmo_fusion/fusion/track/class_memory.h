// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "datmo_fusion/common/class_belief.h"

namespace datmo {

/// Combines the class beliefs of all sources on one object, from their tracks of it.
///
/// An object keeps its class when it leaves the view of the sensor that classified it, so the
/// belief of a track that ended is kept until its source has another track with class information.
/// The belief of a track that switched to another object is dropped.
class ClassMemory {
 public:
  using Member = std::pair<std::string, std::uint32_t>;  ///< a source, and the id of its track
  using Beliefs = std::map<Member, ClassProbabilities>;

  /// Sets the current beliefs: `own` from the tracks of this object, empty while it is lost; `all`
  /// from those of any object.
  void update(const Beliefs& own, const Beliefs& all);

  /// Returns the belief of all sources combined as if they were independent; equal probabilities
  /// before there was any information.
  ClassProbabilities belief() const;

 private:
  Beliefs present_;
  std::map<std::string, ClassProbabilities> ended_;  ///< by source; of its last track
};

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "datmo_fusion/common/class_belief.h"

namespace datmo {

/// What all sources believe of the class of one object, by the tracks that they have of it.
///
/// An object stays what it is when it leaves the view of the sensor that classified it, so the
/// belief of a track that ended counts on, until its source has another one that tells something.
/// That of a track that went over to another object does not.
class ClassMemory {
 public:
  using Member = std::pair<std::string, std::uint32_t>;  ///< a source, and the id of its track
  using Beliefs = std::map<Member, ClassProbabilities>;

  /// The beliefs of the present: `own` of the tracks of the object, none while it is lost; `all` of
  /// those of any.
  void update(const Beliefs& own, const Beliefs& all);

  /// Of all sources together, as if they were independent. Equal probabilities before anything was
  /// said.
  ClassProbabilities belief() const;

 private:
  Beliefs present_;
  std::map<std::string, ClassProbabilities> ended_;  ///< by source; of the last one
};

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "datmo_fusion/common/class_belief.h"

namespace datmo {

/// What all sources have said of the class of one object, by the tracks that they had of it.
///
/// An object stays what it is when it leaves the view of the sensor that told its class, so the
/// belief of a track that ended counts on. That of one that went over to another object does not.
class ClassMemory {
 public:
  using Member = std::pair<std::string, std::uint32_t>;  ///< a source, and the id of its track

  /// Takes in what the tracks of the present say: `own` are those of the object, `all` those of
  /// any.
  void update(const std::map<Member, ClassProbabilities>& own,
              const std::map<Member, ClassProbabilities>& all);

  /// Of all sources together, as independent; of the tracks of one source, which err alike, the
  /// surest counts. Equal probabilities before anything was said.
  ClassProbabilities belief() const;

 private:
  std::map<Member, ClassProbabilities> said_;
};

}  // namespace datmo

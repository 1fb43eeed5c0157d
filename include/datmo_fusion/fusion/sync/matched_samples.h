// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

enum class WhyMissing {
  kSilent,    ///< it has published nothing for `silent_after`
  kNoneNear,  ///< it publishes, but had nothing within `tolerance` of the requested stamp
  kNoMotion,  ///< it had one, but the vehicle's motion in between is unknown
};

/// "silent", "none near", "no motion".
const char* toText(WhyMissing why);

/// A source without a sample in this set, and why.
struct MissingSource {
  std::string source;
  WhyMissing why = WhyMissing::kSilent;
};

/// A sample of one source, at its own stamp.
template <typename Payload>
struct SourceSample {
  std::string source;
  Stamp stamp;
  std::shared_ptr<const Payload> payload;
};

/// A matched set: the reference's sample first, then the others by name.
template <typename Payload>
struct MatchedSamples {
  std::vector<SourceSample<Payload>> samples;  ///< at least one
  std::vector<MissingSource> missing;          ///< by name

  const SourceSample<Payload>& reference() const { return samples.front(); }
  Stamp stamp() const { return reference().stamp; }
};

}  // namespace datmo

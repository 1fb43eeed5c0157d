#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

struct TrackAssociationOptions {
  static constexpr char kAccumulated[] = "accumulated";
  static constexpr char kParallel[] = "parallel";

  std::string test = kAccumulated;

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo

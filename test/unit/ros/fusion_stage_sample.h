// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// A stage that fuses the lists of a scanner and a stereo camera, and its reports about them.
template <typename FusionStage>
class FusionStageTest : public testing::Test {
 protected:
  using StageType = FusionStage;

  explicit FusionStageTest(const std::string& name,
                           const typename FusionStage::Options& options = {})
      : monitor_(name), options_(options) {}

  auto nextAt(double seconds) { return stage_.next(Stamp::fromSeconds(seconds)); }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }
  std::uint64_t warnings(const std::string& reason) const {
    return samples::warnings(monitor_, reason);
  }
  double figure(const std::string& name) const { return monitor_.figures().at(name); }

  StageMonitor monitor_;
  typename FusionStage::Options options_;
  FusionStage stage_{options_, monitor_};
};

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "datmo_fusion/ros/shared_options.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/tracking/step_budget.h"

namespace datmo {

/// What a host provides to a stage besides its options; all of it outlives the stage.
struct StageContext {
  const TransformBuffer& transforms;
  StageMonitor& monitor;
  StepClock clock;  ///< none: the output depends on the input alone
};

namespace detail {

template <typename MadeStage>
inline constexpr bool kTakesClock =
    std::is_constructible_v<MadeStage, const typename MadeStage::Options&, const TransformBuffer&,
                            StageMonitor&, StepClock>;

template <typename MadeStage>
inline constexpr bool kTakesClockAlone =
    std::is_constructible_v<MadeStage, const typename MadeStage::Options&, StageMonitor&,
                            StepClock>;

}  // namespace detail

/// Whether a stage uses tf.
template <typename MadeStage>
inline constexpr bool kTakesTransforms =
    std::is_constructible_v<MadeStage, const typename MadeStage::Options&, const TransformBuffer&,
                            StageMonitor&>;

/// Creates a stage with the arguments that its constructor takes. Throws OptionError.
template <typename MadeStage>
std::unique_ptr<MadeStage> makeStage(const typename MadeStage::Options& options,
                                     const StageContext& context) {
  if constexpr (detail::kTakesClock<MadeStage>) {
    return std::make_unique<MadeStage>(options, context.transforms, context.monitor, context.clock);
  } else if constexpr (kTakesTransforms<MadeStage>) {
    return std::make_unique<MadeStage>(options, context.transforms, context.monitor);
  } else if constexpr (detail::kTakesClockAlone<MadeStage>) {
    return std::make_unique<MadeStage>(options, context.monitor, context.clock);
  } else {
    return std::make_unique<MadeStage>(options, context.monitor);
  }
}

}  // namespace datmo

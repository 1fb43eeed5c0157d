// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <utility>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/mount_options.h"

namespace datmo {

/// What all stages share, and a sensor set says once: sections `frames`, `mounts` and `motion`.
struct SharedOptions {
  FrameOptions frames;
  Mounts mounts;
  MotionOptions motion;
};

/// The names of those sections.
inline constexpr char kFramesSection[] = "frames";
inline constexpr char kMountsSection[] = "mounts";
inline constexpr char kMotionSection[] = "motion";

/// From the values of the three sections, keys relative to each; slashes at the front of frames are
/// left out. Throws OptionError that names the section.
SharedOptions readSharedOptions(const OptionValues& frames, const OptionValues& mounts,
                                const OptionValues& motion);

namespace detail {

template <typename Options, typename = void>
struct HasFrames : std::false_type {};
template <typename Options>
struct HasFrames<Options, std::void_t<decltype(std::declval<Options>().frames)>> : std::true_type {
};

template <typename Options, typename = void>
struct HasMotion : std::false_type {};
template <typename Options>
struct HasMotion<Options, std::void_t<decltype(std::declval<Options>().motion)>> : std::true_type {
};

/// Throws OptionError for a key that sensor sets had in the section of each stage, naming the one
/// that it is now.
void refuseMovedKeys(const OptionValues& stage_values);

}  // namespace detail

/// The options of a stage: its own section's values, and what all stages share, where it has
/// members `frames` and `motion` for it. Throws OptionError.
template <typename Options>
Options readStageOptions(const OptionValues& values, const SharedOptions& shared) {
  detail::refuseMovedKeys(values);
  auto options = readOptions<Options>(values);
  if constexpr (detail::HasFrames<Options>::value) {
    options.frames = shared.frames;
  }
  if constexpr (detail::HasMotion<Options>::value) {
    options.motion = shared.motion;
  }
  return options;
}

}  // namespace datmo

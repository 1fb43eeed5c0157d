// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/mount_options.h"
#include "datmo_fusion/ros/shared_keys.h"

namespace datmo {

/// Options that all stages share, defined once in a sensor set.
struct SharedOptions {
  FrameOptions frames;
  Mounts mounts;
  MotionOptions motion;
  /// Values of the sections `scanner`, `stereo_camera`, `vehicle` and `motion`, by section and key
  /// (`scanner/free_range`), and the pairing of images from `stereo_image_proc`. Only values that
  /// are set: otherwise each stage uses the default of its own option, which equals the section's.
  OptionValues sensors;
};

/// Names of these sections.
inline constexpr char kFramesSection[] = "frames";
inline constexpr char kMountsSection[] = "mounts";
inline constexpr char kMotionSection[] = "motion";
inline constexpr char kScannerSection[] = "scanner";
inline constexpr char kStereoCameraSection[] = "stereo_camera";
inline constexpr char kVehicleSection[] = "vehicle";
/// Also the name of the nodelet.
inline constexpr char kStereoImagesSection[] = "stereo_image_proc";

/// All except the last one.
std::vector<std::string> sharedSections();

/// Returns the values of a section, keys relative to it; empty if none are set.
using SectionReader = std::function<OptionValues(const std::string& section)>;

/// Leading slashes of frames are stripped. Throws OptionError that names the section.
SharedOptions readSharedOptions(const SectionReader& section);

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

template <typename Options, typename = void>
struct HasSharedKeys : std::false_type {};
template <typename Options>
struct HasSharedKeys<Options, std::void_t<decltype(Options::sharedKeys())>> : std::true_type {};

/// Returns the values of a stage's section combined with the shared ones. Throws OptionError for a
/// key that used to be in each stage's section, naming its replacement.
OptionValues withShared(const OptionValues& stage_values, const SharedKeys& keys,
                        const OptionValues& shared);

}  // namespace detail

/// Which of a stage's options are in the shared sections.
template <typename Options>
SharedKeys sharedKeysOf() {
  if constexpr (detail::HasSharedKeys<Options>::value) {
    return Options::sharedKeys();
  } else {
    return SharedKeys();
  }
}

/// Returns the options of a stage: the values of its own section, and those shared by all stages if
/// it has members `frames` and `motion` for them, or names them in `sharedKeys()`. Throws
/// OptionError.
template <typename Options>
Options readStageOptions(const OptionValues& values, const SharedOptions& shared) {
  auto options =
      readOptions<Options>(detail::withShared(values, sharedKeysOf<Options>(), shared.sensors));
  if constexpr (detail::HasFrames<Options>::value) {
    options.frames = shared.frames;
  }
  if constexpr (detail::HasMotion<Options>::value) {
    options.motion = shared.motion;
  }
  return options;
}

}  // namespace datmo

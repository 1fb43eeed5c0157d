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

/// What all stages share, and a sensor set says once.
struct SharedOptions {
  FrameOptions frames;
  Mounts mounts;
  MotionOptions motion;
  /// What the sections `scanner`, `stereo_camera`, `vehicle` and `motion` say, by section and key
  /// (`scanner/free_range`), and of `stereo_image_proc` how it pairs images. Only what is set: each
  /// stage has the default of its own option for the rest, which is that of the section.
  OptionValues sensors;
};

/// The names of those sections.
inline constexpr char kFramesSection[] = "frames";
inline constexpr char kMountsSection[] = "mounts";
inline constexpr char kMotionSection[] = "motion";
inline constexpr char kScannerSection[] = "scanner";
inline constexpr char kStereoCameraSection[] = "stereo_camera";
inline constexpr char kVehicleSection[] = "vehicle";
/// That of the nodelet of this name, too.
inline constexpr char kStereoImagesSection[] = "stereo_image_proc";

/// All but the last one.
std::vector<std::string> sharedSections();

/// The values of a section, keys relative to it; none where nobody has set any.
using SectionReader = std::function<OptionValues(const std::string& section)>;

/// Slashes at the front of frames are left out. Throws OptionError that names the section.
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

/// The values of a stage's section with those that it shares. Throws OptionError for a key that
/// sensor sets had in the section of each stage, naming the one that it is now.
OptionValues withShared(const OptionValues& stage_values, const SharedKeys& keys,
                        const OptionValues& shared);

}  // namespace detail

/// Which of a stage's options stand in the shared sections.
template <typename Options>
SharedKeys sharedKeysOf() {
  if constexpr (detail::HasSharedKeys<Options>::value) {
    return Options::sharedKeys();
  } else {
    return SharedKeys();
  }
}

/// The options of a stage: its own section's values, and what all stages share, where it has
/// members `frames` and `motion` for it, or names it by `sharedKeys()`. Throws OptionError.
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

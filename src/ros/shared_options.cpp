// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/shared_options.h"

#include "datmo_fusion/ros/frame_ids.h"

namespace datmo {

namespace {

/// Keys of single stages in older sensor sets, and what says it for all stages now.
const std::map<std::string, std::string> kMovedKeys = {
    {"map_frame", "frames: {map: ...}"},
    {"fixed_frame", "frames: {map: ...}"},
    {"odom_frame", "frames: {odom: ...}"},
    {"base_frame", "frames: {base: ...}"},
    {"scanner_frame", "frames: {scanner: ...}"},
    {"camera_frame", "frames: {camera: ...}"},
    {"odometry", "motion: {source: odometry}, or none, twist, imu, imu_and_twist, imu_and_wheels"},
    {"odometry_pose", "motion: {odometry_pose: ...}"},
    {"odometry_hold", "motion: {hold: ...}"},
};

template <typename Read>
auto inSection(const std::string& section, const Read& read) {
  try {
    return read();
  } catch (const OptionError& error) {
    throw OptionError(section + ": " + error.what());
  }
}

FrameOptions readFrames(const OptionValues& values) {
  auto frames = readOptions<FrameOptions>(values);
  for (std::string* frame :
       {&frames.map, &frames.odom, &frames.base, &frames.scanner, &frames.camera}) {
    *frame = withoutSlash(*frame);
  }
  checkFrames(frames);
  return frames;
}

}  // namespace

SharedOptions readSharedOptions(const OptionValues& frames, const OptionValues& mounts,
                                const OptionValues& motion) {
  return {inSection(kFramesSection, [&] { return readFrames(frames); }),
          inSection(kMountsSection, [&] { return readMounts(mounts); }),
          inSection(kMotionSection, [&] { return readOptions<MotionOptions>(motion); })};
}

void detail::refuseMovedKeys(const OptionValues& stage_values) {
  for (const auto& [key, value] : stage_values) {
    const auto moved = kMovedKeys.find(key);
    if (moved != kMovedKeys.end()) {
      throw OptionError(key + " = " + toText(value) +
                        ": expected once for all stages, at the top of the file, as " +
                        moved->second);
    }
  }
}

}  // namespace datmo

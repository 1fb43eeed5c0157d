// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/shared_options.h"

#include <set>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/scanner_options.h"
#include "datmo_fusion/ros/stereo_camera_options.h"
#include "datmo_fusion/ros/vehicle_options.h"

namespace datmo {

namespace {

/// Keys of single stages in older sensor sets, and the shared keys that replace them.
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
  frames.prefix = withoutSlash(frames.prefix);
  for (std::string* frame :
       {&frames.map, &frames.odom, &frames.base, &frames.scanner, &frames.camera}) {
    *frame = frame->empty() ? "" : frames.prefix + *frame;
  }
  return frames;
}

Mounts withPrefix(const Mounts& mounts, const std::string& prefix) {
  Mounts prefixed;
  for (const auto& [frame, mount] : mounts) {
    prefixed[prefix + frame] = mount;
  }
  return prefixed;
}

/// For these 0 means unknown, and each stage has its own default.
const std::set<std::string> kUnknownIfZero = {"scanner/range_sigma", "stereo_camera/min_depth"};

/// Settings shared by stereo_image_proc and point_velocity.
const std::vector<std::string> kPairing = {"approximate_sync", "pair_tolerance"};

bool isZero(const OptionValue& value) {
  return value == OptionValue(0) || value == OptionValue(0.0);
}

/// Adds the values of a section, checked.
template <typename Options>
void addSection(const std::string& name, const SectionReader& section, OptionValues& sensors) {
  const OptionValues values = section(name);
  inSection(name, [&] { return readOptions<Options>(values); });
  for (const auto& [key, value] : values) {
    const std::string full_key = name + "/" + key;
    if (kUnknownIfZero.count(full_key) == 0 || !isZero(value)) {
      sensors[full_key] = value;
    }
  }
}

OptionValues readSensors(const SectionReader& section) {
  OptionValues sensors;
  addSection<ScannerOptions>(kScannerSection, section, sensors);
  addSection<StereoSceneOptions>(kStereoCameraSection, section, sensors);
  addSection<VehicleOptions>(kVehicleSection, section, sensors);
  addSection<MotionOptions>(kMotionSection, section, sensors);
  const OptionValues images = section(kStereoImagesSection);
  for (const std::string& key : kPairing) {
    if (const auto found = images.find(key); found != images.end()) {
      sensors[kStereoImagesSection + ("/" + key)] = found->second;
    }
  }
  return sensors;
}

/// `scanner/free_range` -> `scanner: {free_range: ...}`
std::string inYaml(const std::string& key) {
  std::string yaml;
  std::string braces;
  for (const char letter : key) {
    if (letter == '/') {
      yaml += ": {";
      braces += "}";
    } else {
      yaml += letter;
    }
  }
  return yaml + ": ..." + braces;
}

void refuse(const std::string& key, const OptionValue& value, const std::string& instead) {
  throw OptionError(key + " = " + toText(value) +
                    ": expected once for all stages, at the top of the file, as " + instead);
}

}  // namespace

std::vector<std::string> sharedSections() {
  return {kFramesSection,  kMountsSection,       kMotionSection,
          kScannerSection, kStereoCameraSection, kVehicleSection};
}

SharedOptions readSharedOptions(const SectionReader& section) {
  const FrameOptions frames =
      inSection(kFramesSection, [&] { return readFrames(section(kFramesSection)); });
  const Mounts mounts =
      inSection(kMountsSection, [&] { return readMounts(section(kMountsSection)); });
  return {frames, withPrefix(mounts, frames.prefix),
          inSection(kMotionSection,
                    [&] { return readOptions<MotionOptions>(section(kMotionSection)); }),
          readSensors(section)};
}

OptionValues detail::withShared(const OptionValues& stage_values, const SharedKeys& keys,
                                const OptionValues& shared) {
  for (const auto& [key, value] : stage_values) {
    if (const auto moved = kMovedKeys.find(key); moved != kMovedKeys.end()) {
      refuse(key, value, moved->second);
    }
  }
  OptionValues values = stage_values;
  for (const SharedKey& key : keys) {
    if (const auto own = stage_values.find(key.own); own != stage_values.end()) {
      refuse(key.own, own->second, inYaml(key.shared));
    }
    if (const auto said = shared.find(key.shared); said != shared.end()) {
      values[key.own] = said->second;
    }
  }
  return values;
}

}  // namespace datmo

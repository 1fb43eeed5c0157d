// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace datmo {

/// The command line of clouds_to_scans.
struct CloudsToScansArguments {
  std::string input;   ///< bag with the clouds of a 3D lidar
  std::string output;  ///< bag to write
  std::string config;  ///< sensor set; its section cloud_to_scan is used
  std::string cloud_topic = "/cloud";
  std::string scan_topic = "/scan";
  bool keep_clouds = false;
};

/// Throws UsageError, and Answer for --help.
CloudsToScansArguments parseCloudsToScans(std::vector<std::string> words);

struct ConvertedClouds {
  std::size_t scans = 0;
  std::size_t dropped = 0;  ///< clouds, each reason reported once
};

/// Copies a bag, with a planar scan by CloudToScanStage in place of (or in addition to) each cloud.
/// A scan is recorded when its last beam has been measured, not before its cloud's stamp; the mount
/// of its frame is written first, to /tf_static.
///
/// Throws OptionError for the yaml file, std::runtime_error for bags, and NoUsableInput if no cloud
/// could be used; no output bag is left in this case.
ConvertedClouds convertClouds(const CloudsToScansArguments& arguments);

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/velodyne_model.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// Two banks that fire alternately; the lasers of each are equally spaced, from the lowest one.
struct Banks {
  double first;    ///< deg, of laser 0, 2, 4, ...
  double second;   ///< deg, of laser 1, 3, 5, ...
  double spacing;  ///< deg
};

std::vector<double> elevationsOf(const Banks& banks, std::size_t count) {
  std::vector<double> elevations;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t in_bank = i / 2;
    elevations.push_back((i % 2 == 0 ? banks.first : banks.second) +
                         banks.spacing * static_cast<double>(in_bank));
  }
  return elevations;
}

/// The lasers of a model, in the order in which they fire.
struct LaserTable {
  std::vector<double> elevations;  ///< deg
  double firing_time = 0.0;        ///< s, from a firing to the next
  std::vector<double> heights;     ///< mm; empty: all start at the origin
  std::vector<double> offsets;     ///< deg of azimuth, clockwise; empty: none
  std::size_t per_firing = 1;      ///< lasers that fire together
};

double valueAt(const std::vector<double>& values, std::size_t i) {
  return values.empty() ? 0.0 : values[i];
}

std::vector<VelodyneLaser> lasersOf(const LaserTable& table) {
  constexpr double kMillimeter = 1e-3;  // m
  std::vector<VelodyneLaser> lasers;
  for (std::size_t i = 0; i < table.elevations.size(); ++i) {
    const double elevation = degrees(table.elevations[i]);
    const double offset = degrees(valueAt(table.offsets, i));
    const std::size_t firing = i / table.per_firing;
    VelodyneLaser laser;
    laser.cos_elevation = static_cast<float>(std::cos(elevation));
    laser.sin_elevation = static_cast<float>(std::sin(elevation));
    laser.cos_offset = static_cast<float>(std::cos(offset));
    laser.sin_offset = static_cast<float>(std::sin(offset));
    laser.time = static_cast<float>(table.firing_time * static_cast<double>(firing));
    laser.height = static_cast<float>(valueAt(table.heights, i) * kMillimeter);
    laser.ring = static_cast<std::uint16_t>(
        std::count_if(table.elevations.begin(), table.elevations.end(),
                      [&](double other) { return other < table.elevations[i]; }));
    lasers.push_back(laser);
  }
  return lasers;
}

constexpr std::size_t kPuckLasers = 16;
constexpr std::size_t kHdlLasers = 32;

constexpr double kPuckFiring = 2.304e-6;     // s
constexpr double kPuckSequence = 55.296e-6;  // s

/// VLP-16, Puck LITE: VLP-16 User Manual, 63-9243 Rev. E, 9.2 (angles, heights) and 9.4 (times).
VelodyneModel vlp16() {
  return {"VLP-16", 0x22,
          lasersOf({elevationsOf({-15.0, 1.0, 2.0}, kPuckLasers),
                    kPuckFiring,
                    {11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1, 5.1, -6.6, 3.7, -8.1, 2.2, -9.7,
                     0.7, -11.2},
                    {}}),
          kPuckSequence, false};
}

/// Puck Hi-Res: VLP-16 Puck Hi-Res User Manual, 63-9318, the same sections.
VelodyneModel puckHiRes() {
  return {"Puck Hi-Res", 0x24,
          lasersOf({elevationsOf({-10.0, 2.0 / 3.0, 4.0 / 3.0}, kPuckLasers),
                    kPuckFiring,
                    {7.4, -0.9, 6.5, -1.8, 5.5, -2.7, 4.6, -3.7, 3.7, -4.6, 2.7, -5.5, 1.8, -6.5,
                     0.9, -7.4},
                    {}}),
          kPuckSequence, false};
}

/// VLP-32C (Puck Ultra): VLP-32C User Manual, 63-9325 Rev. C, tables 9-2 and 9-6 (angles, offsets)
/// and 9.4 (times; two lasers fire together). Apollo and Autoware.Auto have the same values.
VelodyneModel vlp32c() {
  constexpr std::size_t kPair = 2;
  constexpr float kFourMillimeters = 4e-3F;
  return {
      "VLP-32C",
      0x28,
      lasersOf(
          {{-25.0,  -1.0,   -1.667, -15.639, -11.31, 0.0,    -0.667, -8.843, -7.254, 0.333,  -0.333,
            -6.148, -5.333, 1.333,  0.667,   -4.0,   -4.667, 1.667,  1.0,    -3.667, -3.333, 3.333,
            2.333,  -2.667, -3.0,   7.0,     4.667,  -2.333, -2.0,   15.0,   10.333, -1.333},
           kPuckFiring,
           {},
           {1.4, -4.2, 1.4, -1.4, 1.4, -1.4, 4.2, -1.4, 1.4, -4.2, 1.4, -1.4, 4.2, -1.4, 4.2, -1.4,
            1.4, -4.2, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4, 1.4, -1.4, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4},
           kPair}),
      kPuckSequence,
      false,
      kFourMillimeters};
}

/// HDL-32E User's Manual, 63-9113, laser firing sequence (angles, steps of 4/3 degree) and appendix
/// E (times: -542.592 us of the first firing of a packet).
VelodyneModel hdl32e() {
  constexpr double kFiring = 1.152e-6;    // s
  constexpr double kSequence = 46.08e-6;  // s
  return {
      "HDL-32E", 0x21,
      lasersOf({elevationsOf({-92.0 / 3.0, -28.0 / 3.0, 4.0 / 3.0}, kHdlLasers), kFiring, {}, {}}),
      kSequence, true};
}

}  // namespace

const std::vector<VelodyneModel>& velodyneModels() {
  static const std::vector<VelodyneModel> models{vlp16(), puckHiRes(), vlp32c(), hdl32e()};
  return models;
}

}  // namespace datmo

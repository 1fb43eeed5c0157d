// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/velodyne_model.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// Two banks that fire in turn; the lasers of each have the same spacing, from the lowest one.
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

/// `heights`: mm by laser; empty: they all leave at the origin.
std::vector<VelodyneLaser> lasersOf(const std::vector<double>& elevations,
                                    const std::vector<double>& heights) {
  constexpr double kMillimeter = 1e-3;  // m
  std::vector<VelodyneLaser> lasers;
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    const double elevation = degrees(elevations[i]);
    const auto lower = std::count_if(elevations.begin(), elevations.end(),
                                     [&](double other) { return other < elevations[i]; });
    lasers.push_back({static_cast<float>(std::cos(elevation)),
                      static_cast<float>(std::sin(elevation)),
                      heights.empty() ? 0.0F : static_cast<float>(heights[i] * kMillimeter),
                      static_cast<std::uint16_t>(lower)});
  }
  return lasers;
}

constexpr std::size_t kPuckLasers = 16;
constexpr std::size_t kHdlLasers = 32;

/// VLP-16, Puck LITE: VLP-16 User Manual, 63-9243 Rev. E, 9.2 (angles, heights) and 9.4 (times).
VelodyneModel vlp16() {
  return {"VLP-16",
          0x22,
          lasersOf(elevationsOf({-15.0, 1.0, 2.0}, kPuckLasers),
                   {11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1, 5.1, -6.6, 3.7, -8.1, 2.2, -9.7,
                    0.7, -11.2}),
          2.304e-6,
          55.296e-6,
          false};
}

/// Puck Hi-Res: VLP-16 Puck Hi-Res User Manual, 63-9318, the same sections.
VelodyneModel puckHiRes() {
  return {"Puck Hi-Res",
          0x24,
          lasersOf(elevationsOf({-10.0, 2.0 / 3.0, 4.0 / 3.0}, kPuckLasers),
                   {7.4, -0.9, 6.5, -1.8, 5.5, -2.7, 4.6, -3.7, 3.7, -4.6, 2.7, -5.5, 1.8, -6.5,
                    0.9, -7.4}),
          2.304e-6,
          55.296e-6,
          false};
}

/// HDL-32E User's Manual, 63-9113, laser firing sequence (angles, steps of 4/3 degree) and appendix
/// E (times: -542.592 us of the first firing of a packet).
VelodyneModel hdl32e() {
  return {"HDL-32E",
          0x21,
          lasersOf(elevationsOf({-92.0 / 3.0, -28.0 / 3.0, 4.0 / 3.0}, kHdlLasers), {}),
          1.152e-6,
          46.08e-6,
          true};
}

}  // namespace

const std::vector<VelodyneModel>& velodyneModels() {
  static const std::vector<VelodyneModel> models{vlp16(), puckHiRes(), hdl32e()};
  return models;
}

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

/// A stereo camera's cloud of a street, as published by stereo_image_proc: 640 x 480 points.
class StereoStreet {
 public:
  StereoStreet();
  StereoStreet(const StereoStreet&) = delete;  // the message refers to the object's memory
  StereoStreet& operator=(const StereoStreet&) = delete;

  const StereoCloud& cloud() const { return cloud_; }

 private:
  StereoCloud cloud_;
  std::vector<std::uint8_t> memory_;
};

}  // namespace datmo

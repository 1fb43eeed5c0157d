// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/depth_bins.h"

#include <algorithm>
#include <cmath>

namespace datmo {

DepthBins::DepthBins(const StereoCamera& camera, double farthest, double finest)
    : farthest_(static_cast<float>(farthest)), bins_per_meter_(static_cast<float>(2.0 / finest)) {
  std::vector<double> ends;
  for (double begin = 0.0; begin < farthest;) {
    const double end = begin + std::max(finest, 0.5 * camera.depthSigma(begin));
    middles_.push_back(static_cast<float>(0.5 * (begin + end)));
    ends.push_back(end);
    begin = end;
  }
  const auto half_bins = static_cast<std::size_t>(std::ceil(2.0 * farthest / finest)) + 1;
  bin_at_.reserve(half_bins);
  before_.reserve(half_bins);
  int bin = 0;
  for (std::size_t half_bin = 0; half_bin < half_bins; ++half_bin) {
    const double depth = (static_cast<double>(half_bin) + 0.5) * 0.5 * finest;
    while (bin + 1 < size() && depth >= ends[static_cast<std::size_t>(bin)]) {
      ++bin;
    }
    bin_at_.push_back(bin);
    before_.push_back(depth > middle(bin) ? bin + 1 : bin);
  }
}

}  // namespace datmo

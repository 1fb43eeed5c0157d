// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/depth_noise.h"

#include <stdexcept>

namespace datmo {

void StructuredLightNoiseOptions::visit(OptionVisitor& visitor) {
  visitor.number({"constant", "m",
                  "the constant in the standard deviation constant + quadratic (depth - nearest)^2 "
                  "(Nguyen et al. 2012; Khoshelham and Elberink 2012: 0, 0.001425, 0)"},
                 constant, {0.0, 0.5});
  visitor.number({"quadratic", "1/m", "its quadratic coefficient"}, quadratic, {1e-5, 0.1});
  visitor.number({"nearest", "m", "the depth with the least noise"}, nearest, {0.0, 5.0});
}

void TimeOfFlightNoiseOptions::visit(OptionVisitor& visitor) {
  visitor.number({"constant", "m",
                  "the constant in the standard deviation constant + linear depth (Azure Kinect's "
                  "data sheet, random and systematic error)"},
                 constant, {0.0001, 0.5});
  visitor.number({"linear", "m/m", "its linear coefficient"}, linear, {0.0, 0.1});
}

void DepthNoiseOptions::visit(OptionVisitor& visitor) {
  visitor.choice({"depth_noise", "",
                  "how the camera measures depth, which determines the noise of depths: stereo "
                  "(camera info of a right camera), active_stereo (a depth camera with two cameras "
                  "of its own), structured_light, time_of_flight",
                  Tier::kPublic},
                 principle,
                 {{"stereo", DepthPrinciple::kStereo},
                  {"active_stereo", DepthPrinciple::kActiveStereo},
                  {"structured_light", DepthPrinciple::kStructuredLight},
                  {"time_of_flight", DepthPrinciple::kTimeOfFlight}});
  visitor.number({"disparity_sigma", "px",
                  "standard deviation of a disparity, for both kinds of stereo; at 0.25 px two "
                  "standard deviations of the demonstrator's depth are 5 m at 36 m (thesis 3.3.3)",
                  Tier::kPublic},
                 disparity_sigma, {0.01, 10.0});
  visitor.group("structured_light", [&] { structured_light.visit(visitor); });
  visitor.group("time_of_flight", [&] { time_of_flight.visit(visitor); });
}

DepthNoise depthNoise(const DepthNoiseOptions& options, double focal_length, double baseline) {
  switch (options.principle) {
    case DepthPrinciple::kStereo:
    case DepthPrinciple::kActiveStereo:
      return DepthNoise::ofDisparity(focal_length, baseline, options.disparity_sigma);
    case DepthPrinciple::kStructuredLight: {
      const StructuredLightNoiseOptions& light = options.structured_light;
      return DepthNoise::ofPolynomial(
          light.constant + light.quadratic * light.nearest * light.nearest,
          -2.0 * light.quadratic * light.nearest, light.quadratic);
    }
    case DepthPrinciple::kTimeOfFlight:
      return DepthNoise::ofPolynomial(options.time_of_flight.constant,
                                      options.time_of_flight.linear, 0.0);
  }
  throw std::logic_error("depth_noise: a principle without a noise model");
}

}  // namespace datmo

// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/road_color.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

constexpr double kLevels = 256.0;  ///< of a channel

/// Minimum number of samples for a mixture.
constexpr std::size_t kMinSamples = 64;

/// Rounds of EM on the first samples.
constexpr int kFirstRounds = 10;

/// Maximum distance of a color from a matching component, in standard deviations.
constexpr double kLikeness = 3.0;

/// Components with less weight are removed.
constexpr double kMinWeight = 1e-3;

/// Share of the road's pixels of any other color: seams, leaves, noise. It bounds what a single
/// pixel says against the road.
constexpr double kOutlierShare = 0.05;

double uniformDensity(Eigen::Index channels) {
  return std::pow(kLevels, -static_cast<double>(channels));
}

}  // namespace

void RoadColorOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"components", "1",
                   "number of Gaussians in the mixture of the road's colors: sun, shade, asphalt, "
                   "grass; thesis (4.1.4): 1"},
                  components, {1.0, 16.0});
  visitor.number({"learning_time", "s",
                  "time in which learned colors lose all but 1/e of their weight to newer images, "
                  "at any frame rate: a vehicle enters shade as quickly"},
                 learning_time, {0.01, 1000.0});
}

void RoadColor::Moments::add(double share, const PixelColor& color) {
  weight += share;
  sum += share * color;
  squares += share * color * color.transpose();
}

void RoadColor::Moments::scale(double factor) {
  weight *= factor;
  sum *= factor;
  squares *= factor;
}

RoadColor::Gaussian::Gaussian(Moments from, double min_sigma)
    : moments(std::move(from)), mean(moments.sum / moments.weight) {
  const Eigen::Index channels = mean.size();
  ColorMatrix covariance = moments.squares / moments.weight - mean * mean.transpose();
  covariance += square(min_sigma) * ColorMatrix::Identity(channels, channels);
  information = covariance.inverse();
  peak = moments.weight /
         std::sqrt(std::pow(2.0 * kPi, static_cast<double>(channels)) * covariance.determinant());
}

double RoadColor::Gaussian::squaredDistance(const PixelColor& color) const {
  const PixelColor offset = color - mean;
  return offset.dot(information * offset);
}

double RoadColor::Gaussian::density(const PixelColor& color) const {
  return peak * std::exp(-0.5 * squaredDistance(color));
}

void RoadColor::learn(const PixelColors& samples, Stamp stamp) {
  if (samples.size() < kMinSamples) {
    return;
  }
  if (!isKnown(samples.front().size())) {
    begin(samples);
  } else {
    const double seconds = std::max(0.0, secondsBetween(learned_, stamp));
    const double share = -std::expm1(-seconds / options_.learning_time);
    shift(samples, share, options_.components > 1);
  }
  learned_ = stamp;
}

void RoadColor::begin(PixelColors samples) {
  gaussians_.clear();
  std::sort(samples.begin(), samples.end(),
            [](const PixelColor& a, const PixelColor& b) { return a.sum() < b.sum(); });
  const auto groups = static_cast<std::size_t>(options_.components);
  for (std::size_t group = 0; group < groups; ++group) {
    Moments moments(samples.front().size());
    for (std::size_t i = group * samples.size() / groups; i < (group + 1) * samples.size() / groups;
         ++i) {
      moments.add(1.0 / static_cast<double>(samples.size()), samples[i]);
    }
    gaussians_.emplace_back(std::move(moments), options_.min_sigma);
  }
  for (int round = 0; round < kFirstRounds; ++round) {
    shift(samples, 1.0, false);
  }
}

void RoadColor::shift(const PixelColors& samples, double share, bool finds_new) {
  const Eigen::Index channels = samples.front().size();
  std::vector<Moments> moments;
  for (const Gaussian& gaussian : gaussians_) {
    moments.push_back(gaussian.moments);
    moments.back().scale(1.0 - share);
  }
  Moments unmatched(channels);
  const double each = share / static_cast<double>(samples.size());
  std::vector<double> densities(gaussians_.size());
  for (const PixelColor& color : samples) {
    double sum = 0.0;
    for (std::size_t i = 0; i < gaussians_.size(); ++i) {
      densities[i] = gaussians_[i].density(color);
      sum += densities[i];
    }
    if (finds_new && distance(color) > kLikeness) {
      unmatched.add(each, color);
      continue;
    }
    for (std::size_t i = 0; sum > 0.0 && i < gaussians_.size(); ++i) {
      moments[i].add(each * densities[i] / sum, color);
    }
  }
  if (unmatched.weight > 0.0 && unmatched.weight >= options_.min_new_share * share) {
    if (moments.size() >= static_cast<std::size_t>(options_.components)) {
      moments.erase(
          std::min_element(moments.begin(), moments.end(),
                           [](const auto& a, const auto& b) { return a.weight < b.weight; }));
    }
    moments.push_back(std::move(unmatched));
  }
  keep(std::move(moments));
}

void RoadColor::keep(std::vector<Moments> moments) {
  double sum = 0.0;
  for (const Moments& one : moments) {
    sum += one.weight;
  }
  gaussians_.clear();
  for (Moments& one : moments) {
    one.scale(1.0 / sum);
    if (one.weight >= kMinWeight) {
      gaussians_.emplace_back(std::move(one), options_.min_sigma);
    }
  }
}

double RoadColor::density(const PixelColor& color) const {
  double sum = 0.0;
  for (const Gaussian& gaussian : gaussians_) {
    sum += gaussian.density(color);
  }
  return sum;
}

double RoadColor::probability(const PixelColor& color) const {
  const double other = uniformDensity(color.size());
  const double road = (1.0 - kOutlierShare) * density(color) + kOutlierShare * other;
  return road / (road + other);
}

double RoadColor::distance(const PixelColor& color) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Gaussian& gaussian : gaussians_) {
    nearest = std::min(nearest, gaussian.squaredDistance(color));
  }
  return std::sqrt(nearest);
}

}  // namespace datmo

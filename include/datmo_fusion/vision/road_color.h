// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// A pixel's gray level, or its blue, green and red; 0 to 255 each.
using PixelColor = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
using PixelColors = std::vector<PixelColor>;

struct RoadColorOptions {
  int components = 4;
  double learning_time = 0.45;  ///< s
  /// 0 to 1: colors missing in the mixture become its newest component if at least this share of an
  /// image's samples has them
  double min_new_share = 0.1;
  /// gray levels, 0.1 to 100: smallest standard deviation of a component
  double min_sigma = 3.0;

  void visit(OptionVisitor& visitor);
};

/// Appearance of the road: a mixture of Gaussians over colors, learned from image to image.
///
/// The thesis has one Gaussian, learned once from manually segmented pixels (4.1.4, eq. 4.1.4 to
/// 4.1.6): `components: 1`. A road in sun and shade has several colors, and they change: here each
/// image's samples shift the components according to the elapsed time (on-line EM; Cappe &
/// Moulines, On-line expectation-maximization algorithm for latent data models, 2009), and a color
/// that matches none of them replaces the rarest one (Stauffer & Grimson, Adaptive background
/// mixture models for real-time tracking, 1999).
class RoadColor {
 public:
  /// Throws OptionError.
  explicit RoadColor(const Checked<RoadColorOptions>& options) : options_(*options) {}

  /// Learns the road pixels of an image exposed at `stamp`, all with the same number of channels. A
  /// changed number of channels starts over; too few samples change nothing. Deterministic.
  void learn(const PixelColors& samples, Stamp stamp);

  /// Whether anything was learned from images with this number of channels.
  bool isKnown(Eigen::Index channels) const {
    return !gaussians_.empty() && gaussians_.front().mean.size() == channels;
  }

  /// Returns the probability that a pixel of this color is road, with a prior of one half and a
  /// uniform distribution of other colors, which a small share of the road's pixels have, too: more
  /// than 0. `color`: with the number of channels that was learned.
  double probability(const PixelColor& color) const;

  /// Mahalanobis distance to the nearest component; it replaces the thesis's threshold on the
  /// density (eq. 4.1.6), of which it is a function for one Gaussian.
  double distance(const PixelColor& color) const;

  /// Forgets everything.
  void reset() { gaussians_.clear(); }

 private:
  using ColorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

  /// Weighted sums over samples.
  struct Moments {
    double weight = 0.0;
    PixelColor sum;
    ColorMatrix squares;

    explicit Moments(Eigen::Index channels)
        : sum(PixelColor::Zero(channels)), squares(ColorMatrix::Zero(channels, channels)) {}
    void add(double share, const PixelColor& color);
    void scale(double factor);
  };

  struct Gaussian {
    Moments moments;
    PixelColor mean;
    ColorMatrix information;
    double peak = 0.0;  ///< density at the mean, times the weight

    Gaussian(Moments from, double min_sigma);
    double squaredDistance(const PixelColor& color) const;
    double density(const PixelColor& color) const;
  };

  void begin(PixelColors samples);
  /// Moves the components toward the samples by `share`. `finds_new`: samples that match no
  /// component are left out, and may become a new one.
  void shift(const PixelColors& samples, double share, bool finds_new);
  /// Keeps the components with any weight, normalized to a total of 1.
  void keep(std::vector<Moments> moments);
  double density(const PixelColor& color) const;

  RoadColorOptions options_;
  std::vector<Gaussian> gaussians_;
  Stamp learned_;  ///< stamp of the last learning step
};

}  // namespace datmo

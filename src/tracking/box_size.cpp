// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/box_size.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Log odds; no hypothesis falls farther below the best one, so that it can recover.
constexpr double kMinLogWeight = -12.0;

/// Squared Mahalanobis distance from which an extent is hardly of this object: three sigma.
constexpr double kFarOff = 9.0;

/// Standard deviations by which a lower bound stays below the visible extent: noise exceeds this
/// once in fifteen times.
constexpr double kSureBound = 1.5;

/// Limit for the probability from a classifier that is certain: it may still err.
constexpr double kSurestClass = 0.999;
constexpr double kMinClass = 1e-6;

/// Vehicle, cyclist, pedestrian, anything else.
constexpr int kClasses = 4;

/// By kind.
std::array<const SizePrior*, 5> priorsOf(const BoxSizeOptions& options) {
  return {&options.vehicle, &options.lorry, &options.two_wheeler, &options.person, &options.other};
}

/// Whether objects of the kind (index as in BoxSizeOptions) are of the class.
bool isOfClass(std::size_t kind, ObjectClass object_class) {
  switch (object_class) {
    case ObjectClass::kVehicle:
      return kind <= 1;
    case ObjectClass::kCyclist:
      return kind == 2;
    case ObjectClass::kPedestrian:
      return kind == 3;
    case ObjectClass::kPole:
    case ObjectClass::kUnknown:
      break;
  }
  return kind == 4;
}

/// Updates one estimate with an extent; returns its log-likelihood, up to a term that is the same
/// for all estimates. An extent that is far off may be from two objects, or from a side that was
/// confused with another: it only increases the variance, so that the third of its kind is
/// accepted.
double ingest(const VisibleExtent& seen, double noise, double& mean, double& variance) {
  const double length = seen.whole ? seen.length : seen.length - kSureBound * seen.hidden_std;
  const double residual = length - mean;
  if (!seen.whole && residual <= 0.0) {
    return 0.0;
  }
  const double total = variance + noise;
  const double distance2 = residual * residual / total;
  if (distance2 > kFarOff) {
    variance += residual * residual / (2.0 * kFarOff);
  } else {
    const double gain = variance / total;
    mean += gain * residual;
    variance *= 1.0 - gain;
  }
  const double log_likelihood = -0.5 * std::min(distance2, kFarOff);
  return seen.whole ? log_likelihood - 0.5 * std::log(total) : log_likelihood;
}

}  // namespace

void SizePrior::visit(OptionVisitor& visitor, const std::string& kind, const std::string& source) {
  constexpr Bounds kSize{0.05, 30.0};
  visitor.group(kind, [&] {
    visitor.number(
        {"share", "1", "prior share of objects of this kind, relative to the other kinds"}, share,
        {1e-6, 1.0});
    visitor.number({"length", "m", "mean; " + source}, length, kSize);
    visitor.number({"length_std", "m", "standard deviation of the length"}, length_std,
                   {0.01, 30.0});
    visitor.number({"width", "m", "mean; " + source}, width, kSize);
    visitor.number({"width_std", "m", "standard deviation of the width"}, width_std, {0.01, 30.0});
  });
}

void BoxSizeOptions::visit(OptionVisitor& visitor) {
  vehicle.visit(visitor, "vehicle",
                "cars and vans (KITTI: 3.9 x 1.6 m, Europe's new cars: 4.4 x 1.8 m)");
  lorry.visit(visitor, "lorry",
              "trucks and buses (EU directive 96/53/EC: up to 12 m, 2.55 m wide)");
  two_wheeler.visit(visitor, "two_wheeler", "with its rider (KITTI: 1.8 x 0.6 m)");
  person.visit(visitor, "person", "walking (KITTI: 0.8 x 0.6 m)");
  other.visit(visitor, "other", "anything else: prams, animals, trailers");
  visitor.number({"extent_std", "m",
                  "standard deviation of the extent of a rigid body from scan to scan beyond the "
                  "variances of its sides: mirrors, round corners, another height"},
                 extent_std, {0.001, 2.0});
  visitor.number({"correlation_time", "s",
                  "time over which the observed extent of a body has the same error, so that all "
                  "scans within it count as one"},
                 correlation_time, {0.0, 10.0});
  visitor.number(
      {"wrong_size", "1",
       "share of sizes that do not depend on the class: several objects merged, or a part of one"},
      wrong_size, {1e-3, 1.0});
  visitor.number(
      {"drift", "m^2/s", "growth of the variance of each size: other parts come into view"}, drift,
      {0.0, 10.0});
}

BoxSize::BoxSize(const BoxSizeOptions& options) {
  const auto priors = priorsOf(options);
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const SizePrior& prior = *priors[kind];
    const double length_variance = square(prior.length_std);
    const double width_variance = square(prior.width_std);
    const double log_weight = std::log(prior.share);
    hypotheses_[kAxes * kind] = {
        log_weight, 0.0, {prior.length, prior.width}, {length_variance, width_variance}};
    hypotheses_[kAxes * kind + 1] = {
        log_weight, 0.0, {prior.width, prior.length}, {width_variance, length_variance}};
  }
  summarize();
}

void BoxSize::classify(ObjectClass object_class, double probability) {
  if (object_class == ObjectClass::kUnknown) {
    return;
  }
  const double sure = std::min(probability, kSurestClass);
  const double others = std::max(kMinClass, (1.0 - sure) / static_cast<double>(kClasses - 1));
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    hypotheses_[i].log_weight +=
        std::log(isOfClass(i / kAxes, object_class) ? std::max(kMinClass, sure) : others);
  }
  summarize();
}

void BoxSize::update(const std::array<VisibleExtent, 2>& seen, double seconds,
                     const BoxSizeOptions& options) {
  const bool is_independent = !was_seen_ || seconds >= options.correlation_time;
  const double news = is_independent ? 1.0 : seconds / options.correlation_time;
  was_seen_ = true;
  if (news <= 0.0) {
    return;
  }
  for (Hypothesis& hypothesis : hypotheses_) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      hypothesis.variance[axis] += options.drift * seconds;
      const double noise = (seen[axis].variance + square(options.extent_std)) / news;
      hypothesis.add(ingest(seen[axis], noise, hypothesis.mean[axis], hypothesis.variance[axis]));
    }
  }
  summarize();
}

RoadUserLikelihoods BoxSize::likelihoods(const BoxSizeOptions& options) const {
  const auto priors = priorsOf(options);
  const auto of = [&](ObjectClass object_class) {
    double shares = 0.0;
    double sum = 0.0;
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      if (isOfClass(kind, object_class)) {
        shares += priors[kind]->share;
        sum += priors[kind]->share * (std::exp(hypotheses_[kAxes * kind].log_size) +
                                      std::exp(hypotheses_[kAxes * kind + 1].log_size));
      }
    }
    return sum / shares;
  };
  const RoadUserLikelihoods seen{of(ObjectClass::kPedestrian), of(ObjectClass::kCyclist),
                                 of(ObjectClass::kVehicle)};
  const double best = std::max({seen.pedestrian, seen.cyclist, seen.vehicle});
  const auto unlessWrong = [&](double likelihood) {
    return (1.0 - options.wrong_size) * likelihood / best + options.wrong_size;
  };
  return {unlessWrong(seen.pedestrian), unlessWrong(seen.cyclist), unlessWrong(seen.vehicle)};
}

void BoxSize::addOddsAlongFirst(double log_odds) {
  for (std::size_t i = 0; i < hypotheses_.size(); i += kAxes) {
    hypotheses_[i].add(log_odds);
  }
  summarize();
}

void BoxSize::swapAxes() {
  for (std::size_t i = 0; i < hypotheses_.size(); i += kAxes) {
    std::swap(hypotheses_[i], hypotheses_[i + 1]);
    for (std::size_t k = i; k < i + kAxes; ++k) {
      std::swap(hypotheses_[k].mean[0], hypotheses_[k].mean[1]);
      std::swap(hypotheses_[k].variance[0], hypotheses_[k].variance[1]);
    }
  }
  summarize();
}

/// Computes weights relative to the best one, and the moments of the mixture.
void BoxSize::summarize() {
  double best = hypotheses_[0].log_weight;
  double best_size = hypotheses_[0].log_size;
  for (const Hypothesis& hypothesis : hypotheses_) {
    best = std::max(best, hypothesis.log_weight);
    best_size = std::max(best_size, hypothesis.log_size);
  }
  const double min_weight = std::exp(kMinLogWeight);  // for most hypotheses
  double total = 0.0;
  double along_first = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    Hypothesis& hypothesis = hypotheses_[i];
    hypothesis.log_weight = std::max(hypothesis.log_weight - best, kMinLogWeight);
    hypothesis.log_size = std::max(hypothesis.log_size - best_size, kMinLogWeight);
    const double weight =
        hypothesis.log_weight == kMinLogWeight ? min_weight : std::exp(hypothesis.log_weight);
    total += weight;
    along_first += i % kAxes == 0 ? weight : 0.0;
    const Eigen::Vector2d mean(hypothesis.mean[0], hypothesis.mean[1]);
    sum += weight * mean;
    squares += weight *
               (Eigen::Vector2d(hypothesis.variance[0], hypothesis.variance[1]) + mean.cwiseAbs2());
  }
  mean_ = sum / total;
  variance_ = (squares / total - mean_.cwiseAbs2()).cwiseMax(0.0);
  along_first_ = along_first / total;
}

}  // namespace datmo

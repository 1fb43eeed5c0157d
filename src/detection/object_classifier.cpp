#include "datmo_fusion/detection/object_classifier.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// m, mean sizes of anything else, of which nothing more is known: buildings, hedges, bushes.
constexpr double kMeanHeight = 5.0;
constexpr double kMeanAcross = 10.0;

/// Directions from which a kind is looked at, over a quarter turn: none is likelier.
constexpr int kAspects = 8;

double square(double value) { return value * value; }

/// Probability density of a size that is seen as `seen`, or that it is at least that.
double likelihood(double seen, double mean, double variance, bool more) {
  const double ratio = (seen - mean) / std::sqrt(variance);
  return more ? 0.5 * std::erfc(ratio / std::sqrt(2.0))
              : std::exp(-0.5 * square(ratio)) / std::sqrt(2.0 * kPi * variance);
}

double likelihood(const SeenSize& seen, const KindSize& kind) {
  const double by_height = likelihood(
      seen.height, kind.height, square(kind.height_sigma) + square(seen.height_sigma), seen.higher);
  double by_across = 0.0;
  for (int i = 0; i < kAspects; ++i) {
    const double aspect = (i + 0.5) / kAspects * kQuarterTurn;
    const double s = std::sin(aspect);
    const double c = std::cos(aspect);
    by_across += likelihood(seen.across, kind.length * s + kind.width * c,
                            square(kind.length_sigma * s) + square(kind.width_sigma * c) +
                                square(seen.across_sigma),
                            seen.wider) /
                 kAspects;
  }
  return by_height * by_across;
}

/// Of a size of which only the mean is known: the distribution that assumes nothing more.
double likelihoodOfAny(double seen, double mean, bool more) {
  const double tail = std::exp(-seen / mean);
  return more ? tail : tail / mean;
}

}  // namespace

void KindSize::visit(OptionVisitor& visitor) {
  visitor.number({"share", "1", "how many there are, relative to the other kinds"}, share,
                 {0.0, 1000.0});
  visitor.number({"height", "m", "mean"}, height, {0.1, 20.0});
  visitor.number({"height_sigma", "m", "standard deviation"}, height_sigma, {0.01, 10.0});
  visitor.number({"length", "m", "mean"}, length, {0.01, 30.0});
  visitor.number({"length_sigma", "m", "standard deviation"}, length_sigma, {0.01, 10.0});
  visitor.number({"width", "m", "mean"}, width, {0.01, 10.0});
  visitor.number({"width_sigma", "m", "standard deviation"}, width_sigma, {0.01, 10.0});
}

void ObjectClassifierOptions::visit(OptionVisitor& visitor) {
  visitor.group("pedestrian", [&] { pedestrian.visit(visitor); });
  visitor.group("cyclist", [&] { cyclist.visit(visitor); });
  visitor.group("car", [&] { car.visit(visitor); });
  visitor.group("van", [&] { van.visit(visitor); });
  visitor.group("truck", [&] { truck.visit(visitor); });
  visitor.group("pole", [&] { pole.visit(visitor); });
  visitor.number({"else_share", "1", "how many other things there are, relative to these kinds"},
                 else_share, {0.001, 1000.0});
  visitor.number({"least_probability", "1", "an object is of a class that is likelier than this"},
                 least_probability, {0.0, 1.0});
}

ObjectClassifier::ObjectClassifier(const ObjectClassifierOptions& options) : options_(options) {
  checkOptions(options);
}

ClassProbabilities ObjectClassifier::probabilities(const SeenSize& seen) const {
  ClassProbabilities result{};
  const auto add = [&](ObjectClass object_class, const KindSize& kind) {
    result[static_cast<std::size_t>(object_class)] += kind.share * likelihood(seen, kind);
  };
  add(ObjectClass::kPedestrian, options_.pedestrian);
  add(ObjectClass::kCyclist, options_.cyclist);
  add(ObjectClass::kVehicle, options_.car);
  add(ObjectClass::kVehicle, options_.van);
  add(ObjectClass::kVehicle, options_.truck);
  add(ObjectClass::kPole, options_.pole);
  result[static_cast<std::size_t>(ObjectClass::kUnknown)] =
      options_.else_share * likelihoodOfAny(seen.height, kMeanHeight, seen.higher) *
      likelihoodOfAny(seen.across, kMeanAcross, seen.wider);
  const double sum = std::accumulate(result.begin(), result.end(), 0.0);
  if (!(sum > 0.0)) {
    result.fill(0.0);
    result[static_cast<std::size_t>(ObjectClass::kUnknown)] = 1.0;
    return result;
  }
  for (double& value : result) {
    value /= sum;
  }
  return result;
}

}  // namespace datmo

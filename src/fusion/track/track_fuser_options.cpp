// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_fuser_options.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/fusion/sync/names_in_use.h"

namespace datmo {

namespace {

/// m, range over which the detection probability falls from high to low: about the distance in
/// which the number of beams or pixels on a road user halves at the ranges where that begins to
/// matter.
constexpr double kFalloff = 4.0;

/// Probability of each road user class, or of anything else.
struct RoadUserShares {
  explicit RoadUserShares(const ClassProbabilities& classes)
      : pedestrian(classes[static_cast<std::size_t>(ObjectClass::kPedestrian)]),
        cyclist(classes[static_cast<std::size_t>(ObjectClass::kCyclist)]),
        vehicle(classes[static_cast<std::size_t>(ObjectClass::kVehicle)]),
        other(std::max(0.0, 1.0 - pedestrian - cyclist - vehicle)) {}

  double pedestrian;
  double cyclist;
  double vehicle;
  double other;
};

}  // namespace

void ClassDetectionOptions::visit(OptionVisitor& visitor) {
  visitor.number({"near", "1", "probability that the source has a track of a moving one close by"},
                 near, {0.01, 0.99});
  visitor.number({"half_range", "m", "range at which that has fallen to half"}, half_range,
                 {1.0, 300.0});
}

double ClassDetectionOptions::probability(double range) const {
  return near / (1.0 + std::exp((range - half_range) / kFalloff));
}

void TrackDetectionOptions::visit(OptionVisitor& visitor) {
  visitor.group("pedestrian", [&] { pedestrian.visit(visitor); });
  visitor.group("cyclist", [&] { cyclist.visit(visitor); });
  visitor.group("vehicle", [&] { vehicle.visit(visitor); });
}

double TrackDetectionOptions::probability(const ClassProbabilities& classes, double range) const {
  const RoadUserShares is(classes);
  const double each = is.other / 3.0;
  return (is.pedestrian + each) * pedestrian.probability(range) +
         (is.cyclist + each) * cyclist.probability(range) +
         (is.vehicle + each) * vehicle.probability(range);
}

void TrueShareOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kShare{0.01, 0.999};
  visitor.number({"pedestrian", "1",
                  "share of its tracks of pedestrians that are of moving objects: alone, it is not "
                  "believed more than that"},
                 pedestrian, kShare);
  visitor.number({"cyclist", "1", "the same for cyclists"}, cyclist, kShare);
  visitor.number({"vehicle", "1", "the same for vehicles"}, vehicle, kShare);
  visitor.number({"other", "1", "the same for anything else, and for no class"}, other, kShare);
}

double TrueShareOptions::of(const ClassProbabilities& classes) const {
  const RoadUserShares is(classes);
  return is.pedestrian * pedestrian + is.cyclist * cyclist + is.vehicle * vehicle +
         is.other * other;
}

void TrackSourceOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"use", "", "off: its tracks are not read", Tier::kPublic}, use);
  visitor.group("detection", [&] { detection.visit(visitor); });
  visitor.group("true_share", [&] { true_share.visit(visitor); });
  visitor.number({"false_agreement_probability", "1",
                  "probability that it has a track that agrees, by chance, with a false track of "
                  "another source"},
                 false_agreement_probability, {0.001, 1.0});
  visitor.toggle({"class_by_speed", "",
                  "whether the classes of its tracks use their speed, as in `tracker`, whose "
                  "options are the same as here: this evidence counts once for all sources"},
                 class_by_speed);
}

TrackFuserOptions::TrackFuserOptions() {
  sources["lidar"].class_by_speed = true;
  sources["stereo"].class_by_speed = true;
}

void TrackFuserOptions::visit(OptionVisitor& visitor) {
  visitor.each({"sources", "", "the sensors whose tracks are fused"}, sources);
  visitor.choice({"scheme", "",
                  "which tracks are published: those that exist according to all sources; or a "
                  "scheme of the thesis (3.4.2): those of all sources that can see the position "
                  "and those of `beyond` where no other can, the first of these alone, or all",
                  Tier::kLive},
                 scheme,
                 {{"by_existence", TrackScheme::kByExistence},
                  {"fused_plus_fallback", TrackScheme::kFusedPlusFallback},
                  {"confirmed_by_all", TrackScheme::kConfirmedByAll},
                  {"union", TrackScheme::kUnion}});
  visitor.text({"beyond", "", "source whose tracks are also published where no other can see",
                Tier::kPublic},
               beyond, {});
  visitor.integer({"max_tracks", "1",
                   "maximum number of tracks taken from one list, the likeliest ones; bounds the "
                   "time of a step"},
                  max_tracks, {1, 2000});
  visitor.number({"misses", "1",
                  "a track published from `beyond` alone is kept when it comes into view, until a "
                  "source without a track of it would recently have detected it with this "
                  "probability: no tracker confirms at once"},
                 misses, {0.0, 1.0});
  visitor.number({"published_existence", "1",
                  "existence probability above which a track is published by_existence; the other "
                  "schemes publish tracks that are likelier to exist than not",
                  Tier::kLive},
                 published_existence, {0.5, 1.0});
  visitor.number({"memory", "s", "an object that all sources have lost keeps its id for this time"},
                 memory, {0.0, 60.0});
  visitor.number({"history_time", "s", "how much of its path is published with a track"},
                 history_time, {0.0, 60.0});
  visitor.group("class_by_speed", [&] { class_by_speed.visit(visitor); });
  visitor.group("prediction", [&] { prediction.visit(visitor); });
  visitor.group("association", [&] { association.visit(visitor); });
  visitor.group("combination", [&] { combination.visit(visitor); });
  visitor.group("visibility", [&] { visibility.visit(visitor); });
}

void TrackFuserOptions::check() const {
  std::string names;
  for (const std::string& name : sourcesInUse()) {
    if (name == beyond) {
      return;
    }
    names += (names.empty() ? "" : ", ") + name;
  }
  throw OptionError("beyond = \"" + beyond + "\": expected one of the sources in use (" + names +
                    ")");
}

std::vector<std::string> TrackFuserOptions::sourcesInUse() const { return namesInUse(sources); }

}  // namespace datmo

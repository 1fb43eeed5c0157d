// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/sweep_timing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/quantile.h"

namespace datmo {

namespace {

/// Sectors of one degree: finer than the beams of the scan need, and with many points each.
constexpr int kSectors = 360;
constexpr double kSectorWidth = kTurn / kSectors;

/// Minimum number of sectors with points, and of neighbors among them, for an estimate.
constexpr std::size_t kMinSectors = 30;

/// Maximum number of points that are used.
constexpr std::size_t kMaxTimedPoints = 20000;

/// s; a smaller spread of times counts as simultaneous.
constexpr double kMinSpread = 1e-4;

/// Share of the turn by which a sector's time may deviate from a uniform turn.
constexpr double kMaxResidual = 0.1;

/// The angle, wrapped to 0 to 2 pi.
double fullAngle(double angle) { return angle - kTurn * std::floor(angle / kTurn); }

struct Sector {
  double sum = 0.0;  ///< of times, s
  int count = 0;
  double earliest = std::numeric_limits<double>::infinity();
  double latest = -std::numeric_limits<double>::infinity();

  void add(double time) {
    sum += time;
    ++count;
    earliest = std::min(earliest, time);
    latest = std::max(latest, time);
  }

  double mean() const { return sum / count; }
};

/// Mean times of the points by bearing.
class Sectors {
 public:
  Sectors(const LidarPoints& points, const std::vector<float>& times, const Point2& lidar)
      : sectors_(kSectors) {
    const std::size_t stride = points.size() / kMaxTimedPoints + 1;
    for (std::size_t i = 0; i < points.size(); i += stride) {
      const double bearing = std::atan2(points[i].y - lidar.y(), points[i].x - lidar.x());
      const int index = static_cast<int>(fullAngle(bearing) / kSectorWidth) % kSectors;
      sectors_[static_cast<std::size_t>(index)].add(times[i]);
      all_.add(times[i]);
    }
  }

  double spread() const { return all_.count > 0 ? all_.latest - all_.earliest : 0.0; }

  /// It has points, but not from both the start and the end of the turn.
  bool isUsable(int index) const {
    const Sector& sector = at(index);
    return sector.count > 0 && sector.latest - sector.earliest < 0.5 * spread();
  }

  const Sector& at(int index) const {
    return sectors_[static_cast<std::size_t>((index + kSectors) % kSectors)];
  }

  /// s, from each sector to its neighbor to the left, unless the turn ends between them.
  std::vector<double> steps() const {
    std::vector<double> steps;
    for (int i = 0; i < kSectors; ++i) {
      const double step = isUsable(i) && isUsable(i + 1) ? at(i + 1).mean() - at(i).mean() : 0.0;
      if (step != 0.0 && std::abs(step) < 0.5 * spread()) {
        steps.push_back(step);
      }
    }
    return steps;
  }

  /// The usable sector that is measured first.
  int first() const {
    int first = -1;
    for (int i = 0; i < kSectors; ++i) {
      if (isUsable(i) && (first < 0 || at(i).mean() < at(first).mean())) {
        first = i;
      }
    }
    return first;
  }

 private:
  std::vector<Sector> sectors_;
  Sector all_;
};

/// Fits duration and start by least squares over the usable sectors; first bearing and direction
/// are those of `timing`.
SweepTiming fitted(const Sectors& sectors, const SweepTiming& timing) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < kSectors; ++i) {
    if (sectors.isUsable(i)) {
      const Eigen::Vector2d row(1.0, timing.turned((i + 0.5) * kSectorWidth));
      information += row * row.transpose();
      sum += row * sectors.at(i).mean();
    }
  }
  const Eigen::Vector2d solution = information.inverse() * sum;
  return {timing.first_bearing, timing.clockwise, solution[1], solution[0]};
}

/// Whether the times of all usable sectors agree with `timing`.
bool isEven(const Sectors& sectors, const SweepTiming& timing) {
  const double max_residual = kMaxResidual * timing.duration;
  for (int i = 0; i < kSectors; ++i) {
    const double residual =
        sectors.isUsable(i) ? sectors.at(i).mean() - timing.timeAt((i + 0.5) * kSectorWidth) : 0.0;
    if (!(std::abs(residual) <= max_residual)) {
      return false;
    }
  }
  return true;
}

}  // namespace

double SweepTiming::turned(double bearing) const {
  return fullAngle(clockwise ? first_bearing - bearing : bearing - first_bearing) / kTurn;
}

void SweepOptions::visit(OptionVisitor& visitor) {
  visitor.number({"duration", "s",
                  "duration of one turn of the lidar, for clouds without a time for each point; 0: "
                  "all points are treated as measured at once",
                  Tier::kPublic},
                 duration, {0.0, 1.0});
  visitor.toggle({"clockwise", "", "the lidar turns clockwise, seen from above (Velodyne, Ouster)",
                  Tier::kPublic},
                 clockwise);
  visitor.number({"first_bearing", "rad",
                  "bearing where the turn begins, in the axes of the base frame", Tier::kPublic},
                 first_bearing, {-kTurn, kTurn});
  visitor.number(
      {"stamp_share", "1",
       "share of the turn that is over at the cloud's stamp: 0 at its start, 1 at its end",
       Tier::kPublic},
      stamp_share, {0.0, 1.0});
}

std::optional<SweepTiming> SweepOptions::timing() const {
  if (duration == 0.0) {
    return std::nullopt;
  }
  return SweepTiming{first_bearing, clockwise, duration, -stamp_share * duration};
}

std::optional<SweepTiming> sweepOf(const LidarPoints& points, const std::vector<float>& times,
                                   const Point2& lidar) {
  const Sectors sectors(points, times, lidar);
  const std::vector<double> steps = sectors.steps();
  if (sectors.spread() < kMinSpread || steps.size() < kMinSectors) {
    return std::nullopt;
  }
  SweepTiming timing;
  timing.clockwise = quantile(steps, 0.5) < 0.0;
  timing.first_bearing = (sectors.first() + (timing.clockwise ? 1 : 0)) * kSectorWidth;
  timing = fitted(sectors, timing);
  return isEven(sectors, timing) ? std::optional<SweepTiming>(timing) : std::nullopt;
}

}  // namespace datmo

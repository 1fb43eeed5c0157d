// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/branch_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace datmo {

namespace {

/// m, between the samples of a corridor, along and across.
constexpr double kSampleStep = 0.5;

/// m, from the place to where a corridor begins: the vehicle itself.
constexpr double kBranchBegin = 1.0;

int stepsIn(double length) { return static_cast<int>(std::lround(length / kSampleStep)); }

std::vector<Point2> pointsOfRoad(const std::vector<RoadBorder>& borders) {
  std::vector<Point2> points;
  for (const RoadBorder& border : borders) {
    for (const BorderPoint& point : border.points) {
      points.push_back(point.position);
    }
  }
  return points;
}

/// Headings in a row that are free, of a full turn in equal steps.
std::vector<RoadBranch> runsOf(const std::vector<bool>& free, double step) {
  const std::size_t count = free.size();
  const auto closed = std::find(free.begin(), free.end(), false);
  std::vector<RoadBranch> runs;
  if (closed == free.end()) {
    return {{0.0, kTurn}};
  }
  const auto start = static_cast<std::size_t>(closed - free.begin());
  std::size_t length = 0;
  for (std::size_t i = 1; i <= count; ++i) {
    if (free[(start + i) % count]) {
      ++length;
    } else if (length > 0) {
      const double middle = static_cast<double>(start + i) - 0.5 * static_cast<double>(length + 1);
      runs.push_back({normalizeAngle(middle * step), static_cast<double>(length) * step});
      length = 0;
    }
  }
  return runs;
}

}  // namespace

void BranchSearchOptions::visit(OptionVisitor& visitor) {
  visitor.number({"length", "m", "of a corridor that is a street: yards end before"}, length,
                 {5.0, 40.0});
  visitor.number({"width", "m", "of it: two lanes; driveways and gaps between cars are narrower"},
                 width, {1.0, 20.0});
  visitor.number(
      {"max_shift", "m",
       "from the place to its middle line: beside a yard that is so long for a moment only"},
      max_shift, {0.0, 10.0});
  visitor.number({"heading_step", "rad", "from a heading that is tried to the next"}, heading_step,
                 {degrees(1.0), degrees(30.0)});
  visitor.number({"min_free", "1", "share of a street that beams have passed"}, min_free,
                 {0.1, 1.0});
  visitor.number({"blocked_weight", "1",
                  "share that has to have been passed beyond min_free for each share of the length "
                  "in which something stands: a vehicle that waits"},
                 blocked_weight, {0.0, 100.0});
  visitor.number({"border_width", "m", "in the middle of a street, where no border runs"},
                 border_width, {0.0, 20.0});
  visitor.number({"max_angle", "rad", "what is free in a wider one is open space"}, max_angle,
                 {degrees(10.0), kTurn});
  visitor.number({"min_separation", "rad", "of two streets' headings"}, min_separation,
                 {degrees(10.0), degrees(120.0)});
}

bool BranchSearch::isFree(const PassageGrid& grid, const std::vector<Point2>& borders,
                          const Pose2& from) const {
  const int slices = stepsIn(options_.length - kBranchBegin);
  const int across = stepsIn(options_.width) + 1;
  const int shifts = stepsIn(2.0 * options_.max_shift) + 1;
  const double rightmost = -options_.max_shift - 0.5 * options_.width;
  std::vector<int> passed(static_cast<std::size_t>(shifts), 0);
  std::vector<int> blocked(static_cast<std::size_t>(shifts), 0);
  // Of the points of a slice before each, so that the sums of all corridors are differences.
  std::vector<int> free_before(static_cast<std::size_t>(shifts + across), 0);
  std::vector<int> occupied_before(free_before.size(), 0);
  for (int slice = 0; slice < slices; ++slice) {
    for (std::size_t i = 0; i + 1 < free_before.size(); ++i) {
      const PassageGrid::State state =
          grid.at(from * Point2(kBranchBegin + slice * kSampleStep,
                                rightmost + static_cast<double>(i) * kSampleStep));
      free_before[i + 1] = free_before[i] + (state == PassageGrid::State::kFree ? 1 : 0);
      occupied_before[i + 1] =
          occupied_before[i] + (state == PassageGrid::State::kOccupied ? 1 : 0);
    }
    for (std::size_t i = 0; i < passed.size(); ++i) {
      const std::size_t end = i + static_cast<std::size_t>(across);
      passed[i] += free_before[end] - free_before[i];
      blocked[i] += occupied_before[end] > occupied_before[i] ? 1 : 0;
    }
  }
  const Pose2 map_in_from = from.inverse();
  for (std::size_t i = 0; i < passed.size(); ++i) {
    const double share = static_cast<double>(passed[i]) / (slices * across);
    if (share - options_.blocked_weight * blocked[i] / slices < options_.min_free) {
      continue;
    }
    const double shift = -options_.max_shift + static_cast<double>(i) * kSampleStep;
    const bool closed = std::any_of(borders.begin(), borders.end(), [&](const Point2& point) {
      const Point2 seen = map_in_from * point;
      return seen.x() >= 0.0 && seen.x() <= options_.length &&
             std::abs(seen.y() - shift) <= 0.5 * options_.border_width;
    });
    if (!closed) {
      return true;
    }
  }
  return false;
}

std::vector<RoadBranch> BranchSearch::search(const PassageGrid& grid,
                                             const std::vector<RoadBorder>& borders,
                                             const Point2& from) const {
  const std::vector<Point2> points = pointsOfRoad(borders);
  const auto count = static_cast<std::size_t>(std::lround(kTurn / options_.heading_step));
  const double step = kTurn / static_cast<double>(count);
  std::vector<bool> free;
  free.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    free.push_back(isFree(grid, points, {from, static_cast<double>(i) * step}));
  }
  std::vector<RoadBranch> runs = runsOf(free, step);
  std::stable_sort(runs.begin(), runs.end(), [](const RoadBranch& one, const RoadBranch& other) {
    return one.angle > other.angle;
  });
  if (!runs.empty() && runs.front().angle > options_.max_angle) {
    return {};
  }
  std::vector<RoadBranch> branches;
  for (const RoadBranch& run : runs) {
    const bool apart = std::all_of(branches.begin(), branches.end(), [&](const RoadBranch& branch) {
      return std::abs(angleBetween(branch.heading, run.heading)) >= options_.min_separation;
    });
    if (apart) {
      branches.push_back(run);
    }
  }
  return branches;
}

}  // namespace datmo

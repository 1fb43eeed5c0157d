// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/branch_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace datmo {

namespace {

/// m, spacing of the samples of a corridor, along and across.
constexpr double kSampleStep = 0.5;

/// m, from the vehicle's center to the start of a corridor.
constexpr double kBranchBegin = 1.0;

/// m, from the vehicle to where the sides of a street begin: closer ones may belong to the
/// vehicle's own road, four lanes and a sidewalk wide.
constexpr double kSidesBegin = 14.0;

/// m, maximum distance of a corridor's sides from its edge: beyond a parking strip and a sidewalk.
constexpr double kSideReach = 5.0;

/// m, unseen distance allowed in front of a side: beams end before what they hit.
constexpr double kUnseenBeforeSide = 1.0;

int stepsIn(double length) { return static_cast<int>(std::lround(length / kSampleStep)); }

/// Runs of free headings, in equal steps over a full turn; `sides` of each heading: none if it is
/// not free.
std::vector<RoadBranch> runsOf(const std::vector<std::optional<double>>& sides, double step) {
  const std::size_t count = sides.size();
  const auto closed = std::find(sides.begin(), sides.end(), std::nullopt);
  std::vector<RoadBranch> runs;
  if (closed == sides.end()) {
    return {{0.0, kTurn, std::max_element(sides.begin(), sides.end())->value_or(0.0)}};
  }
  const auto start = static_cast<std::size_t>(closed - sides.begin());
  std::size_t length = 0;
  double most = 0.0;
  for (std::size_t i = 1; i <= count; ++i) {
    if (const auto& here = sides[(start + i) % count]) {
      ++length;
      most = std::max(most, *here);
    } else if (length > 0) {
      const double middle = static_cast<double>(start + i) - 0.5 * static_cast<double>(length + 1);
      runs.push_back({normalizeAngle(middle * step), static_cast<double>(length) * step, most});
      length = 0;
      most = 0.0;
    }
  }
  return runs;
}

/// Whether there is an obstacle beside a corridor, outward from its edge (m, along and to the left
/// of its axis); at most kUnseenBeforeSide before it may be unseen.
bool hasSide(const PassageGrid& grid, const Pose2& axis, const Point2& edge) {
  const double outward = edge.y() < 0.0 ? -kSampleStep : kSampleStep;
  int unseen = 0;
  for (int i = 0; i <= stepsIn(kSideReach); ++i) {
    const auto state = grid.at(axis * Point2(edge.x(), edge.y() + i * outward));
    if (state == PassageGrid::State::kOccupied) {
      return unseen <= stepsIn(kUnseenBeforeSide);
    }
    unseen = state == PassageGrid::State::kUnknown ? unseen + 1 : 0;
  }
  return false;
}

}  // namespace

void BranchSearchOptions::visit(OptionVisitor& visitor) {
  visitor.number({"length", "m", "length of a corridor that is a street: yards are shorter"},
                 length, {kSidesBegin + 2.0, 40.0});
  visitor.number(
      {"width", "m", "its width: two lanes; driveways and gaps between cars are narrower"}, width,
      {1.0, 20.0});
  visitor.number(
      {"min_sides", "1",
       "minimum share of a street's length, beyond the vehicle's own road, with obstacles "
       "beside it, mean of both sides: open ground that is seen through a gap has none"},
      min_sides, {0.0, 1.0});
}

double BranchSearch::sidesOf(const PassageGrid& grid, const Pose2& axis) const {
  const int slices = stepsIn(options_.length - kSidesBegin);
  int sides = 0;
  for (int slice = 0; slice < slices; ++slice) {
    const double along = kSidesBegin + slice * kSampleStep;
    for (const double edge : {0.5 * options_.width, -0.5 * options_.width}) {
      sides += hasSide(grid, axis, {along, edge}) ? 1 : 0;
    }
  }
  return 0.5 * sides / slices;
}

std::optional<double> BranchSearch::freeShift(const PassageGrid& grid, const Pose2& from) const {
  const int slices = stepsIn(options_.length - kBranchBegin);
  const int across = stepsIn(options_.width) + 1;
  const int shifts = stepsIn(2.0 * options_.max_shift) + 1;
  const double rightmost = -options_.max_shift - 0.5 * options_.width;
  std::vector<int> passed(static_cast<std::size_t>(shifts), 0);
  std::vector<int> blocked(static_cast<std::size_t>(shifts), 0);
  // Prefix sums over the points of a slice, so that each corridor's sum is a difference.
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
  double sum = 0.0;
  int free = 0;
  for (std::size_t i = 0; i < passed.size(); ++i) {
    const double share = static_cast<double>(passed[i]) / (slices * across);
    if (share - options_.blocked_weight * blocked[i] / slices >= options_.min_free) {
      sum += -options_.max_shift + static_cast<double>(i) * kSampleStep;
      ++free;
    }
  }
  return free > 0 ? std::make_optional(sum / free) : std::nullopt;
}

std::vector<RoadBranch> BranchSearch::search(const PassageGrid& grid, const Point2& from) const {
  const auto count = static_cast<std::size_t>(std::lround(kTurn / options_.heading_step));
  const double step = kTurn / static_cast<double>(count);
  std::vector<std::optional<double>> sides;
  sides.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Pose2 along(from, static_cast<double>(i) * step);
    const std::optional<double> shift = freeShift(grid, along);
    sides.push_back(shift ? std::make_optional(sidesOf(grid, along * Pose2(0.0, *shift, 0.0)))
                          : std::nullopt);
  }
  std::vector<RoadBranch> runs = runsOf(sides, step);
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
    if (apart && run.sides >= options_.min_sides) {
      branches.push_back(run);
    }
  }
  return branches;
}

}  // namespace datmo

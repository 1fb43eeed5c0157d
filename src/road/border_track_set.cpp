// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_track_set.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace datmo {

namespace {

/// Lines closer to each other are the same border, m.
constexpr double kSameBorderDistance = 0.7;

/// Maximum number of followed lines.
constexpr int kMaxBorders = 16;

/// Maximum number of windows tried outward in one search: beyond refuted lines.
constexpr int kMaxWindows = 3;

/// Whether two followed lines are the same: they run side by side where either was observed.
bool sameLine(const FollowedBorder& one, const FollowedBorder& other, double distance) {
  const std::vector<ArcLengthInterval> pieces = one.evidence().pieces();
  if (one.side() != other.side() || pieces.empty()) {
    return false;
  }
  const double first = pieces.front().first - one.track().arcLength();
  const double last = pieces.back().last - one.track().arcLength();
  for (const double along : {first, 0.5 * (first + last), last}) {
    const Point2 point = one.table().at(along).position();
    if (std::abs(other.table().locate(point).aside) > distance) {
      return false;
    }
  }
  return true;
}

}  // namespace

void BorderTrackSetOptions::visit(OptionVisitor& visitor) {
  visitor.group("border", [&] { border.visit(visitor); });
}

void BorderTrackSet::clear() {
  borders_.clear();
  turn_ = 0;
}

void BorderTrackSet::update(const BorderScan& scan, const HitGrid& hits,
                            const BorderSearch& search) {
  follow(scan);
  borders_.erase(
      std::remove_if(borders_.begin(), borders_.end(),
                     [&](const FollowedBorder& border) { return border.isOver(scan.scanner); }),
      borders_.end());
  removeDuplicates();
  const std::size_t positions = options_.search_from.size();
  if (positions > 0) {
    const RoadSide side = turn_ % 2 == 0 ? RoadSide::kLeft : RoadSide::kRight;
    const double ahead = options_.search_from[turn_ / 2 % positions];
    turn_ = (turn_ + 1) % (2 * positions);
    searchFrom(hits, search, scan.scanner * Pose2(ahead, 0.0, 0.0), side);
  }
}

void BorderTrackSet::follow(const BorderScan& scan) {
  nearest_.assign(scan.beams.size(), std::numeric_limits<double>::infinity());
  for (FollowedBorder& border : borders_) {
    border.advance(scan);
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      nearest_[i] = std::min(nearest_[i], border.distanceOf(i));
    }
  }
  for (FollowedBorder& border : borders_) {
    is_nearest_.assign(nearest_.size(), false);
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      is_nearest_[i] = std::isfinite(nearest_[i]) && border.distanceOf(i) == nearest_[i];
    }
    border.update(scan, is_nearest_);
  }
}

void BorderTrackSet::removeDuplicates() {
  for (std::size_t i = 0; i < borders_.size(); ++i) {
    for (std::size_t j = borders_.size(); j-- > 0;) {
      const bool both_tried = borders_[i].state() == FollowedBorder::State::kConfirmed &&
                              borders_[j].state() != FollowedBorder::State::kRefuted;
      if (i != j && both_tried &&
          borders_[i].evidence().seenStations() >= borders_[j].evidence().seenStations() &&
          sameLine(borders_[j], borders_[i], kSameBorderDistance)) {
        borders_.erase(borders_.begin() + static_cast<std::ptrdiff_t>(j));
        if (j < i) {
          --i;
        }
      }
    }
  }
}

const FollowedBorder* BorderTrackSet::alongside(const FoundBorder& found) const {
  const Point2 middle = found.line * Point2(0.5 * found.length, 0.0);
  for (const FollowedBorder& border : borders_) {
    if (border.side() == found.side && border.explains(middle, kSameBorderDistance)) {
      return &border;
    }
  }
  return nullptr;
}

void BorderTrackSet::searchFrom(const HitGrid& hits, const BorderSearch& search, const Pose2& from,
                                RoadSide side) {
  Pose2 begin = from;
  for (int i = 0; i < kMaxWindows; ++i) {
    const std::optional<FoundBorder> found = search.search(hits, begin, side);
    if (!found) {
      return;
    }
    const FollowedBorder* known = alongside(*found);
    if (known == nullptr) {
      if (static_cast<int>(borders_.size()) < kMaxBorders) {
        borders_.emplace_back(options_.border, *found);
      }
      return;
    }
    if (known->state() != FollowedBorder::State::kRefuted) {
      return;
    }
    const double aside = (begin.inverse() * found->line).y();
    if (outwardOf(side, aside) <= 0.0) {
      return;
    }
    begin = begin * Pose2(0.0, aside, 0.0);
  }
}

}  // namespace datmo

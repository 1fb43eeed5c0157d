// SPDX-License-Identifier: BSD-3-Clause
#include "map_nodes.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace datmo {

namespace {

/// Bits of the coordinates of Node-XY-20b to Node-XY-32b.
constexpr std::array<unsigned, 6> kNodeBits = {10, 11, 12, 13, 14, 16};
constexpr std::int64_t kGeodeticNode = 6;  ///< index in the choice; the next one, 7, is regional
constexpr std::int64_t kRegionalNode = 7;

/// Offset-B10 and its like.
void walkOffset(Uper& uper, std::int64_t& value, unsigned bits) {
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  uper.integer(value, -half, half - 1);
}

/// DF LaneDataAttribute.
void skipLaneData(Uper& uper) {
  constexpr std::int64_t kLast = 6;
  constexpr std::int64_t kMerge = 4;
  constexpr std::int64_t kLimits = 5;
  if (uper.extended()) {
    uper.skipAddedChoice();
    return;
  }
  std::int64_t kind = 0;
  uper.integer(kind, 0, kLast);
  if (kind == 0) {
    uper.skipInteger(-150, 150);
  } else if (kind < kMerge) {
    uper.skipInteger(-128, 127);
  } else if (kind == kMerge) {
    uper.skipInteger(-180, 180);
  } else if (kind == kLimits) {
    skipSpeedLimits(uper);
  } else {
    skipRegionals(uper);
  }
}

/// DF NodeAttributeSetXY.
void skipNodeAttributes(Uper& uper) {
  constexpr std::int64_t kMost = 8;
  const bool is_extended = uper.extended();
  std::array<bool, 7> has{};  // node, disabled, enabled, data, width, elevation, regional
  for (bool& one : has) {
    one = uper.present(false);
  }
  if (has[0]) {
    skipList(uper, kMost, [](Uper& one) { skipEnumerated(one, 11); });
  }
  for (const bool has_segments : {has[1], has[2]}) {
    if (has_segments) {
      skipList(uper, kMost, [](Uper& one) { skipEnumerated(one, 37); });
    }
  }
  if (has[3]) {
    skipList(uper, kMost, skipLaneData);
  }
  for (const bool has_offset : {has[4], has[5]}) {
    if (has_offset) {
      uper.skipInteger(-512, 511);
    }
  }
  if (has[6]) {
    skipRegionals(uper);
  }
  if (is_extended) {
    uper.skipAdditions();
  }
}

/// The smallest alternative of the choice that can hold the node.
std::int64_t kindOf(const MapNode& node) {
  const auto fits = [&node](unsigned bits) {
    const std::int64_t half = std::int64_t{1} << (bits - 1);
    const auto is_within = [half](std::int64_t value) { return value >= -half && value < half; };
    return is_within(node.x) && is_within(node.y);
  };
  const auto* const found = std::find_if(kNodeBits.begin(), kNodeBits.end() - 1, fits);
  return node.is_geodetic ? kGeodeticNode : found - kNodeBits.begin();
}

/// A node; a regional one, whose position is unknown, leaves the lane without nodes.
void walkNode(Uper& uper, MapNode& node, bool& is_known) {
  const bool is_extended = uper.extended();
  const bool has_attributes = uper.present(false);
  std::int64_t kind = kindOf(node);
  uper.integer(kind, 0, kRegionalNode);
  node.is_geodetic = kind == kGeodeticNode;
  if (kind == kRegionalNode) {
    skipRegional(uper);
    is_known = false;
  } else if (node.is_geodetic) {
    uper.integer(node.x, -1800000000, ItsPosition::kNoLongitude);
    uper.integer(node.y, -900000000, ItsPosition::kNoLatitude);
  } else {
    walkOffset(uper, node.x, kNodeBits[static_cast<std::size_t>(kind)]);
    walkOffset(uper, node.y, kNodeBits[static_cast<std::size_t>(kind)]);
  }
  if (has_attributes) {
    skipNodeAttributes(uper);
  }
  if (is_extended) {
    uper.skipAdditions();
  }
}

/// DrivenLineOffsetSm or DrivenLineOffsetLg.
void walkDrivenOffset(Uper& uper, std::int64_t& value) {
  constexpr std::int64_t kSmall = 2047;
  constexpr std::int64_t kLarge = 32767;
  const std::int64_t most = uper.present(std::abs(value) > kSmall) ? kLarge : kSmall;
  uper.integer(value, -most, most);
}

void walkComputed(Uper& uper, MapComputedLane& lane) {
  const bool is_extended = uper.extended();
  const bool has_turn = uper.present(false);
  const bool has_x_scale = uper.present(false);
  const bool has_y_scale = uper.present(false);
  const bool has_regional = uper.present(false);
  uper.integer(lane.reference, 0, kItsByteMax);
  walkDrivenOffset(uper, lane.x);
  walkDrivenOffset(uper, lane.y);
  if (has_turn) {
    uper.skipInteger(0, 28800);
  }
  for (const bool has_scale : {has_x_scale, has_y_scale}) {
    if (has_scale) {
      uper.skipInteger(-2048, 2047);
    }
  }
  lane.is_changed = has_turn || has_x_scale || has_y_scale || has_regional;
  skipEnd(uper, has_regional, is_extended);
}

}  // namespace

void skipSpeedLimits(Uper& uper) {
  skipList(uper, 9, [](Uper& one) {
    skipEnumerated(one, 12);
    one.skipInteger(0, 8191);
  });
}

void walkNodes(Uper& uper, MapLane& lane) {
  if (uper.extended()) {
    uper.skipAddedChoice();
    return;
  }
  if (uper.present(lane.computed.has_value())) {
    MapComputedLane computed = lane.computed.value_or(MapComputedLane());
    walkComputed(uper, computed);
    lane.computed = computed;
    return;
  }
  bool is_known = true;
  walkList(uper, lane.nodes, 2, 63,
           [&is_known](Uper& one, MapNode& node) { walkNode(one, node, is_known); });
  if (!is_known) {
    lane.nodes.clear();
  }
}

}  // namespace datmo
